"""Trust: each fact has that of its document, and what moves the motor runs only when it was read or checked."""

from dataclasses import replace
from pathlib import Path

import pytest
from click.testing import CliRunner
from tests.shipped import drives

from driveblocks.cli import app
from driveblocks.docs.page import documents
from driveblocks.maps import trust
from driveblocks.maps.load import loads
from driveblocks.maps.model import Document, Drive
from driveblocks.maps.revision import checked, revision
from driveblocks.render.library import drive as library_of
from driveblocks.render.library import generic
from driveblocks.render.text import languages

LANGUAGES = languages(["en"], "utf-8")
EXAMPLE = Path(__file__).with_name("example.yaml").read_text(encoding="utf-8")
DOCUMENTS = {
    "guide": "  - {id: guide, title: Fieldbus guide of the EX200, publisher: Example Drives, trust: sister}\n",
    "driver": "  - {id: driver, title: Driver of a milling machine, publisher: Its user, trust: in_use}\n",
}
STANDSTILL, FAULTS, TABLE = "  standstill:\n", "\nfaults:\n", "  - id: status\n"
MIXED = {STANDSTILL: "    document: driver\n", FAULTS: "  document: guide\n"}
"""The faults are those of a sister model; the standstill is what the software of a machine goes by."""


def _text(added: dict[str, str]) -> str:
    """The example with lines after some of its own, and the documents that these name."""
    named = [line for name, line in DOCUMENTS.items() if any(name in text for text in added.values())]
    text = EXAMPLE.replace("\ndocuments:\n", "\ndocuments:\n" + "".join(named))
    for line, more in added.items():
        assert text.count(line) == 1
        text = text.replace(line, line + more)
    return text


def _drive(added: dict[str, str]) -> Drive:
    return loads(_text(added), "example.yaml")


def test_what_names_no_document_is_read_in_the_manual() -> None:
    drive = _drive({})
    many = {"commands": 5, "reference": 3, "status": 7, "watchdog": 2, "serial": 3, "settings": 2, "faults": 4}
    assert trust.counted(drive) == {part: {"read": many[part]} if part in many else {} for part in trust.PARTS}
    assert (trust.second_hand(drive), trust.heard(drive), trust.rung(drive)) == (False, [], "read")


def test_facts_are_counted_by_their_documents() -> None:
    drive = _drive(MIXED)
    assert trust.counted(drive)["status"] == {"read": 6, "in_use": 1}
    assert trust.counted(drive)["faults"] == {"sister": 4}
    assert (trust.second_hand(drive), trust.rung(drive)) == (True, "status in use, faults sister")
    assert trust.heard(drive)[0] == "status, in use (Driver of a milling machine, Its user): standstill"
    assert trust.heard(drive)[1] == "faults, sister (Fieldbus guide of the EX200, Example Drives): all 4"


ONE_FACT = {
    "reference: reference": "    means: percent_of_maximum\n",
    "reference: scale": "          source: section 9.5 (I), 000FH bit 0\n",
    "commands: fault_reset": ', source: "section 9.5 (I), 0002H"',
    "status: bus in command": "commanded_by: {all: [{register: 0011H, equals: 1}]",
    "status: identity": "  source: section 9.5 (III), 0031H\n",
    "watchdog: reactions": "  feeds: writes\n",
    "watchdog: time": "time: {register: 0202H",
    "settings: H5-01": "    needed: {why: the address that the PLC uses}\n",
    "serial: bit rate": "    setting: H5-02\n",
    "serial: format": "    setting: H5-03\n",
}
"""Where `document:` goes, by the only fact that it is about: on a line of its own, or in a mapping on one line."""


def _text_of(fact: str) -> str:
    """The example with this one from somebody's driver."""
    where = ONE_FACT[fact]
    whole_line = where.endswith("\n")
    blanks = where[: len(where) - len(where.lstrip())]
    return _text({where: f"{blanks}document: driver\n" if whole_line else ", document: driver"})


@pytest.mark.parametrize("fact", ONE_FACT)
def test_one_fact_of_a_motion_from_somebodys_driver_wants_the_check(fact: str) -> None:
    """A wrong factor is a tenfold speed, a wrong watchdog a motor that nothing stops."""
    drive, (part, name) = loads(_text_of(fact), "example.yaml"), fact.split(": ")
    (found,) = (one for one in trust.facts(drive) if one.trust != "read")
    assert (found.part, found.name, found.trust, found.document) == (part, name, "in_use", drive.documents[0])
    assert _text_of(fact).splitlines()[found.place[0] - 1].count("document: driver") == 1
    assert (trust.second_hand(drive), trust.rung(drive)) == (True, f"{part} in use")
    assert trust.heard(drive) == [f"{part}, in use (Driver of a milling machine, Its user): {name.replace('_', ' ')}"]
    assert checked(drive) != checked(_drive({}))


RUNG_OF_ITS_OWN = {
    "reference: scale": ("          source: section 9.5 (I), 000FH bit 0\n", "transcribed"),
    "commands: fault_reset": (', source: "section 9.5 (I), 0002H"', "sister"),
    "status: standstill": ("  standstill:\n", "in_use"),
    "watchdog: reactions": ("  feeds: writes\n", "transcribed"),
    "settings: H5-01": ("    needed: {why: the address that the PLC uses}\n", "sister"),
    "serial: format": ("    setting: H5-03\n", "sister"),
}
"""Where a rung goes, by the only fact that it is about."""


@pytest.mark.parametrize("fact", RUNG_OF_ITS_OWN)
def test_the_weakest_rung_decides_whether_the_manual_has_to_be_checked(fact: str) -> None:
    (where, rung), (part, name) = RUNG_OF_ITS_OWN[fact], fact.split(": ")
    blanks = where[: len(where) - len(where.lstrip())] + ("  " if where == STANDSTILL else "")
    drive = _drive({where: f"{blanks}rung: {rung}\n" if where.endswith("\n") else f", rung: {rung}"})
    (found,) = (one for one in trust.facts(drive) if one.trust != "read")
    assert (found.part, found.name, found.trust, found.document) == (part, name, rung, None)
    assert trust.second_hand(drive)
    assert trust.shown(drive)["control" if part in trust.CONTROL else part] == trust.words(found.trust)
    assert "rung" in _text({where: f"{blanks}rung"}).splitlines()[found.place[0] - 1]


def test_what_is_derived_says_how() -> None:
    drive = _drive({STANDSTILL: "    rung: derived\n    rule: running is what is not stopped\n"})
    assert trust.heard(drive) == ["status, derived (running is what is not stopped): standstill"]
    assert (trust.second_hand(drive), trust.shown(drive)["control"]) == (True, "derived")
    fault = _drive({"{code: 02H, id: OV": ", rung: derived, rule: it is the next bit"})
    assert trust.heard(fault) == ["faults, derived (it is the next bit): 02H"]
    assert not trust.second_hand(fault)


def test_a_rung_below_that_of_its_document_counts_and_a_better_one_does_not() -> None:
    worse = _drive({STANDSTILL: "    document: guide\n    rung: in_use\n"})
    assert trust.rung(worse) == "status in use"
    assert trust.heard(worse)[0].startswith("status, in use (Fieldbus guide of the EX200")


def test_a_printed_cell_changes_no_number() -> None:
    plain, more = _drive({}), _drive({STANDSTILL: "    printed: [bit 0]\n"})
    assert more.operation.standstill.printed == ("bit 0",)
    assert (revision(more), checked(more)) == (revision(plain), checked(plain))
    assert revision(_drive({STANDSTILL: "    rung: sister\n"})) != revision(plain)


def test_what_one_register_says_is_trusted_no_further_than_its_table() -> None:
    drive = _drive({TABLE: "    document: guide\n"})
    assert trust.counted(drive)["status"] == {"read": 1, "sister": 6}, "the identity is in another table"
    assert trust.second_hand(drive)


def test_a_row_that_says_when_a_scale_holds_is_a_fact_of_the_scale() -> None:
    drive = _drive({"        name: Choice of units\n": "        document: driver\n"})
    assert trust.heard(drive) == ["reference, in use (Driver of a milling machine, Its user): reference, scale"]


def test_the_scale_of_what_is_shown_is_a_fact_of_its_measure() -> None:
    at = '    - {shows: fault, any: [{register: 0010H, bit: 3, equals: 1}], source: "section 9.5 (II), 0010H"}\n'
    measure = "  measures: [{shows: dc_bus_voltage, register: 0023H, source: section 9.5 (III)}]\n"
    drive = _drive({at: measure, "        scale: {factor: 0.1": ", document: driver"})
    assert trust.heard(drive) == ["measures, in use (Driver of a milling machine, Its user): dc bus voltage"]
    assert (trust.second_hand(drive), trust.rung(drive)) == (True, "measures in use")
    assert checked(drive) != checked(_drive({at: measure}))


def test_the_maximum_and_full_scale_are_facts_of_the_reference() -> None:
    row = ", id: E1-04, name: Maximum output frequency, zh: 最高输出频率"
    drive = _drive({row: ", document: driver"})
    assert trust.heard(drive) == ["reference, in use (Driver of a milling machine, Its user): maximum"]
    speed = replace(drive.operation.reference, means="fraction_of_full_scale", maximum=None, document="driver")
    fractions = [
        replace(drive, operation=replace(drive.operation, reference=replace(speed, full_scale=count)))
        for count in (0x4000, 0x2000)
    ]
    heard = ["reference, in use (Driver of a milling machine, Its user): reference"]
    assert [trust.heard(one) for one in fractions] == [heard, heard]
    assert checked(fractions[0]) != checked(fractions[1])


@pytest.mark.parametrize(
    ("said", "other", "is_one"),
    [
        ("range: {min: -10000, max: 10000}", "range: {min: -10000, max: 9000}", True),
        ("{register: 0202H, milliseconds: 100", "{register: 0202H, milliseconds: 10", True),
        ("reactions: [{does: coast_stop}]", "reactions: [{does: runs_on}]", True),
        ("{code: 1, parity: even,", "{code: 1, parity: none,", True),
        ("needed: {value: 1, why", "needed: {value: 0, why", True),
        ("all: [{register: 0031H, equals: 6401H}]", "all: [{register: 0031H, equals: 6402H}]", True),
        ("note: check the braking resistor", "note: check the ramp", False),
        ("{value: 4, name: Overrun", "{value: 8, name: Overrun", False),
        ("max: 247, setting: H5-01", "max: 127, setting: H5-01", False),
    ],
)
def test_the_number_is_of_what_a_motion_depends_on(said: str, other: str, is_one: bool) -> None:
    assert EXAMPLE.count(said) == 1
    assert (checked(loads(EXAMPLE.replace(said, other), "example.yaml")) != checked(_drive({}))) == is_one


def test_what_only_a_person_needs_asks_nobody_to_check_the_manual() -> None:
    drive = _drive({FAULTS: "  document: guide\n"})
    assert (trust.second_hand(drive), len(trust.heard(drive))) == (False, 1)
    assert checked(drive) == checked(_drive({}))


def test_a_map_that_others_wrote_down_is_transcribed() -> None:
    drive = _drive({})
    drive = replace(drive, manual=replace(drive.manual, second_hand=True))
    assert trust.rung(drive) == ", ".join(f"{part} transcribed" for part in trust.PARTS if trust.counted(drive)[part])
    assert trust.heard(drive)[0].startswith("commands, transcribed (the manual as others wrote it down): run forward,")


def test_a_key_that_is_left_out_changes_no_number() -> None:
    """The numbers are printed on pages and typed into programs: they stay what they were without the key."""
    drive = _drive({})
    assert "document=None" in repr(drive)
    assert (revision(drive), checked(drive)) == (1877820950, 64688)
    assert checked(_drive(MIXED)) != checked(drive)


def test_the_block_and_its_page_ask_for_the_check() -> None:
    drive = drives()["JSCC"]
    guide = Document(id="driver", title="Driver of a mill", publisher="Its user", trust="in_use")
    still = replace(drive.operation.standstill, document="driver")
    mixed = replace(drive, documents=(guide,), operation=replace(drive.operation, standstill=still))
    files = [*generic(LANGUAGES), *library_of("jscc", mixed, LANGUAGES)]
    block = next(file.text for file in files if file.name == "JSCC_Drive")
    page = documents(files, [mixed])["docs/JSCC_Drive.md"]
    assert f"ManualChecked <> {checked(mixed)}" in block
    assert f"**`ManualChecked := {checked(mixed)}`**" in page
    assert "\n- status, in use (Driver of a mill, Its user): standstill\n" in page


@pytest.mark.parametrize("command", ["list", "show"])
def test_commands_say_what_was_not_read(command: str, tmp_path: Path) -> None:
    path = tmp_path / "mixed.yaml"
    path.write_text(_text(MIXED), encoding="utf-8")
    shown = CliRunner().invoke(app, [command, str(path)], env={"COLUMNS": "200"})
    assert shown.exit_code == 0
    assert "status, in use (Driver of a milling machine, Its user): standstill" in shown.stdout
