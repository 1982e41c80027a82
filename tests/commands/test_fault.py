"""`driveblocks fault` and the table of the page: what helps, as typed by hand from what the maker's tables say."""

from pathlib import Path

import pytest
from click.testing import CliRunner, Result
from tests.maps.test_base import BASE
from tests.maps.test_older import refused

from driveblocks.cli import app
from driveblocks.maps import catalog
from driveblocks.maps.load import load, loads
from driveblocks.maps.revision import checked, revision
from driveblocks.meaning.advice import advice, asked

Row = tuple[int, tuple[str, ...], tuple[str, ...]]
"""A number, words of the causes, words of the remedies."""
PAGES = Path(__file__).parents[2] / "blocks/docs"
# Chapter 4 of 520-UM001: number, a word of the description, words of the actions
PF525: dict[str, Row] = {
    "F002": (2, ("external",), ("wiring", "program")),
    "F003": (3, ("one phase",), ("mains", "fuses", "load")),
    "F005": (5, ("DC bus", "maximum"), ("mains", "ramp down longer", "braking resistor")),
    "F007": (7, ("overload",), ("P033", "A530")),
    "F008": (8, ("heatsink",), ("fins", "air", "fan")),
    "F013": (13, ("earth",), ("motor", "cable")),
    "F029": (29, ("t094", "t097"), ("wire", "settings")),
    "F059": (59, ("safety inputs", "t105"), ("signals", "S1, S2 and S+")),
    "F081": (81, ("Modbus", "silent"), ("off and on", "cables", "C125", "C1 and C2")),
    "F109": (109, ("another type",), ("P053 to 3",)),
}
# 22B-UM001J, pages 93 and 94, the first line of each
PF4: dict[str, Row] = {
    "F2": (2, ("auxiliary input", "open"), ("wiring",)),
    "F4": (4, ("DC bus fell",), ("mains",)),
    "F5": (5, ("DC bus rose",), ("mains",)),
    "F8": (8, ("heatsink",), ("fins",)),
    "F13": (13, ("earth",), ("motor", "cable")),
    "F38": (38, ("phase U",), ("cable", "motor")),
    "F41": (41, ("U and V",), ("short", "replace")),
    "F64": (64, ("above its rating",), ("load", "ramp")),
    "F81": (81, ("RS-485",), ("unplugged",)),
    "F122": (122, ("I/O",), ("off and on",)),
}
# the Altivar 312's programming guide BBV46387, from Spanish
ATV312: dict[str, Row] = {
    "SLF": (5, ("Modbus", "LCC"), ("bus", "remote terminal")),
    "EPF": (8, ("outside",), ("contact",)),
    "OCF": (9, ("drC-", "inertia", "stuck"), ("plate", "ACC")),
    "LFF": (13, ("4 to 20 mA",), ("AI3",)),
    "OLF": (17, ("current", "rSC"), ("ItH", "cool", "rSC")),
    "ObF": (18, ("brakes too hard",), ("dEC", "resistor")),
    "OPF": (20, ("phase", "contactor", "motor"), ("OPL to OAC", "UFr, UnS and nCr", "tUn")),
    "PHF": (21, ("fuse", "one phase"), ("fuses", "reset", "three phases")),
    "SOF": (24, ("unstable", "load drives"), ("FLG",)),
    "SCF": (32, ("short",), ("cable", "insulation")),
}
# Goodrive200A, V2.4, 8.5, pages 112 to 116
GD200A: dict[str, Row] = {
    "OUt1": (1, ("fast", "IGBT module", "interference", "wires", "earth"), ("ramp up", "power unit", "wires")),
    "OC2": (5, ("mains are too low", "phase lost", "stall"), ("ramp longer", "larger drive", "turns freely")),
    "OV3": (9, ("energy back", "braking"), ("ramp down longer", "turning motor", "braking unit or resistor")),
    "UV": (10, ("mains", "stall"), ("mains", "settings")),
    "OL1": (11, ("rated current", "stalls"), ("mains", "rated current", "torque")),
    "OL2": (12, ("fast", "again", "mains", "heavy", "too small"), ("ramp up", "restart", "larger drive", "fits")),
    "SPO": (14, ("U, V and W", "uneven"), ("output wiring", "cable")),
    "OH2": (16, ("duct", "fan", "hot", "too long"), ("duct", "cooler")),
    "CE": (18, ("bit rate", "line", "address", "interference"), ("bit rate", "wiring", "address", "shield")),
    "tE": (20, ("not fit", "set wrong", "too long"), ("plate", "uncouple", "two thirds")),
    "EEP": (21, ("written or read", "EEPROM"), ("STOP/RST", "main control board")),
    "bCE": (23, ("transistor", "resistor"), ("braking unit", "resistor")),
    "END": (24, ("longer",), ("supplier",)),
    "ETH2": (33, ("short to earth", "current detection", "another power"), ("Hall", "main control board")),
    "LL": (36, ("underload",), ("load",)),
}
# SN300G5, resetting the communication fault CE, and notes (2) and (3)
SN300G5: dict[str, Row] = {"CE": (33, ("line", "key"), ("line", "off and on", "2 s", "H5-05"))}


def fault(*words: str) -> Result:
    return CliRunner().invoke(app, ["fault", *words])


@pytest.mark.parametrize(
    ("family", "typed"),
    [
        ("rockwell_powerflex_525", PF525),
        ("rockwell_powerflex_4", PF4),
        ("rockwell_powerflex_400", PF4),
        ("schneider_altivar_312", ATV312),
        ("invt_gd200a", GD200A),
        ("shuen_sn300g5", SN300G5),
    ],
)
def test_causes_and_remedies_say_what_the_table_says(family: str, typed: dict[str, Row]) -> None:
    known = load(catalog.folder() / f"{family}.yaml")
    page = (PAGES / f"{known.prefix}_Drive.md").read_text(encoding="utf-8").partition("## What a fault means")[2]
    for keypad, (code, causes, remedies) in typed.items():
        (one,) = asked(known, keypad)
        assert one.code == code
        assert [word for word in causes if word not in "; ".join(one.causes)] == []
        assert [word for word in remedies if word not in "; ".join(one.remedies)] == []
        (row,) = (line for line in page.splitlines() if line.startswith(f"| {keypad} |"))
        assert f"| {code} ({code:02X}H) |" in row
        assert "; ".join(one.remedies) in row


def test_a_code_is_found_by_its_display_and_as_the_bus_gives_it() -> None:
    known = load(catalog.folder() / "rockwell_powerflex_525.yaml")
    assert {asked(known, word)[0].code for word in ("F081", "f081", "81", "51H", "0x51")} == {81}
    result = fault("pf525", "13")
    assert result.exit_code == 0
    assert result.stdout.splitlines()[0] == "PF525 F013  13 (0DH)  Ground fault"
    assert "FaultCode 13, Reason 40" in result.stdout
    assert "520-UM001" in result.stdout


def test_a_fault_of_which_nothing_was_read_says_so() -> None:
    page = (PAGES / "SN300G5_Drive.md").read_text(encoding="utf-8").partition("## What a fault means")[2]
    assert "Where a cell is empty, nothing was read: see the drive's own manual." in page
    assert "none in the map; see the drive's own manual" in fault("sn300g5", "OC").stdout
    assert "none in the map; see the drive's own manual" in fault("mx2", "E01").stdout
    assert "The map has no list of fault codes" in (PAGES / "CHF_Drive.md").read_text(encoding="utf-8")


def test_what_clears_it_is_the_reset_of_the_family_unless_only_power_does() -> None:
    clears = {one.code: one.clears for one in advice(load(catalog.folder() / "rockwell_powerflex_525.yaml"))}
    assert (clears[13], clears[94]) == ("`FaultReset`", "switch the drive off and on")
    assert "nothing on the bus; reset it at the drive" in fault("sn300g5", "UV1").stdout


def test_an_unknown_code_ends_with_2_and_the_nearest() -> None:
    result = fault("gd200a", "OL7")
    assert result.exit_code == 2
    assert "OL3  25 (19H)" in result.stderr
    assert "F013  13 (0DH)" in fault("pf525", "14").stderr
    assert fault("chf", "3").exit_code == 2


CODES = "codes: [{code: 01H, id: OC, name: Overcurrent"
HELP = ", causes: [{en: short ramp}], remedies: [{en: a longer ramp}]"


def test_what_helps_needs_a_source_and_changes_no_number() -> None:
    assert CODES in BASE
    without = BASE.replace(CODES, CODES + HELP)
    assert "nothing says where what helps against fault 01H is from" in refused(without)[0]
    helped = loads(without.replace("codes: [{code: 01H", "help: {source: table 9}, codes: [{code: 01H"), "acme.yaml")
    plain = loads(BASE, "acme.yaml")
    assert [each.en for each in helped.faults.codes[0].remedies] == ["a longer ramp"]
    assert (revision(helped), checked(helped)) == (revision(plain), checked(plain))
    assert "no code has causes" in refused(BASE.replace(CODES, f"help: {{source: table 9}}, {CODES}"))[0]
