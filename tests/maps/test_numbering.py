"""Maps whose addresses are the manual's own numbers of registers."""

import re
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest
from click.testing import CliRunner
from tests.maps.test_base import BASE

from driveblocks.cli import app
from driveblocks.desk.run.drives import Named
from driveblocks.maps import catalog, lookup
from driveblocks.maps.form import Span, address_text, said, span_text
from driveblocks.maps.load import load, loads
from driveblocks.maps.model import Drive
from driveblocks.maps.numbering import at
from driveblocks.maps.problem import MapError

RULES: dict[str, tuple[str, Callable[[int], str]]] = {
    "1": ("first: 1, proof: request", lambda address: str(address + 1)),
    "4xxxx": ("first: 40001, proof: request", lambda address: str(address + 40001)),
    "hexadecimal": ("first: 1, proof: request", lambda address: f"{address + 1:04X}H"),
    "from words": ("first: 1, says: the number minus 1 is sent", lambda address: str(address + 1)),
}


def numbered(name: str, text: str = BASE) -> str:
    """The smallest map, its registers numbered by a rule."""
    rule, number = RULES[name]
    text = re.sub(r"\b([0-9A-F]{4})H", lambda found: number(int(found[1], 16)), text)
    return text.replace("id_forms:", f"numbering: {{{rule}, source: section 1}}\nid_forms:")


def wrong(text: str) -> list[str]:
    """What is refused."""
    with pytest.raises(MapError) as caught:
        loads(text, "map")
    return [each.wrong for each in caught.value.problems]


def bare(drive: Drive) -> Drive:
    """A map without its rule, and without words in which numbers are."""
    frames = [replace(one, means=replace(one.means, says="")) for one in drive.frames]
    return replace(drive, numbering=None, frames=tuple(frames))


@pytest.mark.parametrize("name", RULES)
def test_numbers_become_the_addresses_that_are_sent(name: str) -> None:
    map_ = loads(numbered(name), "map")
    assert bare(map_) == bare(loads(BASE, "map"))
    assert map_.numbering
    assert map_.numbering.first == {"4xxxx": 40001}.get(name, 1)


def test_references_are_numbers_too() -> None:
    text = BASE.replace("about: [faults]", "about: [register 2002H, bit 2000H.0]")
    assert loads(numbered("4xxxx", text), "map").absent[0].about == ("register 2002H", "bit 2000H.0")


@pytest.mark.parametrize(
    ("old", "new", "told"),
    [
        ("proof: request, ", "", "nothing shows which address a number is"),
        ("proof: request", "proof: reply", "`reply` is no example request that names a register"),
        ("address: 44097", "address: 40000", "40000 is no number of a register"),
        ("address: 44097", "address: 4H", "`address: 4H` is not an address or range"),
        ("first: 40001", "first: 40002", "`means` says address 2000H, the bytes say 2001H"),
        ("address: 44097", "address: 44097-44098", "a range of registers cannot have bits, values or a scale"),
        ("first: 40001", "first: none", "`first: none` is not a count"),
    ],
)
def test_what_is_wrong_with_numbers(old: str, new: str, told: str) -> None:
    text = numbered("4xxxx")
    assert old in text
    assert any(told in each for each in wrong(text.replace(old, new, 1)))


def test_a_register_is_shown_with_its_number(tmp_path: Path) -> None:
    file = tmp_path / "acme.yaml"
    file.write_text(numbered("4xxxx"), encoding="utf-8")
    shown = CliRunner().invoke(app, ["show", file.as_posix(), "1001H"])
    assert re.search(r"^ACME  44098 \(wire 1001H\)$", shown.stdout, re.MULTILINE)
    assert re.search(r"^ *address +1001H = 4097$", shown.stdout, re.MULTILINE)


@pytest.mark.parametrize(("word", "told"), [("44098", "1001H = 4097"), ("4098", "1001H"), ("40000", None)])
def test_a_register_is_found_by_its_number(word: str, told: str | None, tmp_path: Path) -> None:
    file = tmp_path / "acme.yaml"
    file.write_text(numbered("4xxxx" if word[0] == "4" and len(word) == 5 else "1"), encoding="utf-8")
    shown = CliRunner().invoke(app, ["show", file.as_posix(), word])
    assert shown.exit_code == (0 if told else 2)
    assert (told or "") in shown.stdout


COILS = """
  - id: inputs
    title: {en: Inputs}
    source: section 9
    access: r
    space: coil
    registers:
      - {address: 1, name: First coil}
"""


def test_each_table_has_its_own_numbers() -> None:
    text = numbered("4xxxx")
    text = text.replace("\n  - id: commands\n", f"\n{COILS[1:]}  - id: commands\n", 1)
    assert any("1 is no number of a coil" in each for each in wrong(text))
    map_ = loads(text.replace("first: 40001", "first: 40001, coil: 1"), "map")
    row = next(row for _, row in map_.registers() if row.name == "First coil")
    about = text.replace("first: 40001", "first: 40001, coil: 1").replace("about: [faults]", "about: [faults, coil 1]")
    assert said(loads(about, "map").absent[0].about[1]) == "coil 1 (wire 0000H)"
    assert span_text(row.address) == "coil 1 (wire 0000H)"
    assert lookup.find(map_, "coil 1")[0].entry == lookup.find(map_, "coil 0000H")[0].entry == row


@pytest.mark.parametrize(("name", "told"), [("4xxxx", "44097-44098"), ("hexadecimal", "1001H-1002H")])
def test_registers_are_named_as_the_map_writes_their_numbers(name: str, told: str) -> None:
    map_ = loads(numbered(name), "map")
    assert span_text(Span(at(map_, 0x1000), at(map_, 0x1001))) == f"{told} (wire 1000H-1001H)"
    assert address_text(at(map_, 0x1000), ".3") == f"{told.partition('-')[0]}.3 (wire 1000H)"
    assert at(loads(BASE, "map"), 0x1000) == 0x1000


def test_the_simulator_says_numbers_where_the_manual_has_them() -> None:
    shown = CliRunner().invoke(app, ["show", "mx2", "coil 0002H"]).stdout
    assert re.search(r"^MX2  coil 0002H \(wire 0001H\)$", shown, re.MULTILINE)
    assert re.search(r"^ *address +coil 0001H = 1$", shown, re.MULTILINE)
    path = catalog.resolve("mx2")
    told = " ".join(line.strip() for line in Named(path, load(path), 1).unwritten())
    assert "reads 0 until written: 0002H-0006H (wire 0001H-0005H), 0011H (wire 0010H)," in told
    assert ", coil 0002H-0003H (wire 0001H-0002H), " in told
