"""What a person reads of a map that numbers registers has the manual's numbers, with what is sent beside each."""

import io
import re
from collections.abc import Callable, Iterable
from functools import cache
from pathlib import Path

import pytest
from rich.console import Console, RenderableType
from tests.maps.test_numbering import numbered, wrong

from driveblocks.bench import access, parameter, register, request, standstill
from driveblocks.commands import show
from driveblocks.desk.explain import page, paste
from driveblocks.desk.explain.explanation import Explainer
from driveblocks.desk.run.drives import Named
from driveblocks.desk.site import saved
from driveblocks.docs.page import documents
from driveblocks.maps import catalog
from driveblocks.maps.form import wire
from driveblocks.maps.load import load, loads
from driveblocks.maps.model import Drive
from driveblocks.modbus.frame import seal
from driveblocks.render import library
from driveblocks.render.text import languages

MAPS = [
    pytest.param("mx2", marks=pytest.mark.thorough),
    "4xxxx",
    pytest.param("hexadecimal", marks=pytest.mark.thorough),
]
TESTS = (access, parameter, register, request, standstill)
_NUMBER = r"(?:[0-9A-F]{4}H|[1-9][0-9]{4,5})"
_RUN = rf"{_NUMBER}(?:(?:-|, | and | or | to ){_NUMBER})*(?:\.[0-9A-F](?:-[0-9A-F])?)?"
_BESIDE = re.compile(rf"{_RUN}\s+\(wire\s[^)]*\)|{_RUN}(?=.*\n\s*\(wire )|^\s*\(wire [^)]*\)", re.MULTILINE)
"""A number with what is sent, in a column perhaps below it."""
_ADDRESS = re.compile(r"(?<![#0-9A-F])[0-9A-F]{4}H")
_OTHER = re.compile(
    r"(?:AND|bits|sub-function|data|=|_Test|_TestCoil|\(\* \d+:) ?[0-9A-F]{4}H"
    r"|[0-9A-F]{4}H(?: is | = |: (?:not )?proven| +Loop-back)"
)
"""Words, masks and names."""


@cache
def drive(name: str) -> Drive:
    """A map that numbers registers."""
    return load(catalog.resolve(name)) if name == "mx2" else loads(numbered(name), "acme.yaml")


def text(parts: Iterable[RenderableType]) -> str:
    """Tables and cards, as wide as they like."""
    console = Console(width=400, file=io.StringIO(), record=True)
    for part in parts:
        console.print(part)
    return console.export_text()


def shown(of: Drive, _: Path) -> str:
    return "".join(text(show._pages(of, "map", each, each)) for each in (None, *show.TOPICS))


def blocks(of: Drive, _: Path) -> str:
    english = languages(["en"], "utf-8")
    own = [*library.drive("map", of, english)]
    made = documents([*library.generic(english), *own], [of])
    pages = [each for path, each in made.items() if path.endswith((f"{of.prefix}_Drive.md", "Families.md"))]
    return "\n".join([*(file.text for file in own), *pages])


def checks(of: Drive, _: Path) -> str:
    scripts = [script for module in TESTS for script in module.scripts(of, "map")]
    return "\n".join(program.text for script in scripts for program in script.programs())


def simulated(of: Drive, _: Path) -> str:
    return " ".join(line.strip() for line in Named(Path("map.yaml"), of, 1).told())


def explained(of: Drive, _: Path) -> str:
    found = []
    for function, table in ((3, "holding"), (1, "coil")):
        rows = [wire(row.address.first) for section, row in of.registers() if (section.space or "holding") == table]
        asked = [seal("rtu", bytes([1, function, at >> 8, at & 0xFF, 0, 1])) for at in rows]
        found += [Explainer(of).explain(paste.read(each.hex(" "))) for each in asked]
    return "\n".join(
        [text(page.pages(each, of)) for each in found] + [line for each in found for line in page.brief(each)]
    )


def parameters(of: Drive, folder: Path) -> str:
    file = folder / "parameters.csv"
    saved.write(file, "map", of, 1, {row.address.first: 1 for _, row in of.registers()})
    assert saved.read(file).words
    return file.read_text(encoding="utf-8")


ROOMS = (
    *(pytest.param(room, marks=pytest.mark.thorough) for room in (shown, blocks, checks)),
    *(simulated, explained, parameters),
)


@pytest.mark.parametrize("name", MAPS)
@pytest.mark.parametrize("room", ROOMS, ids=lambda room: room.__name__)
def test_no_room_prints_what_is_sent_alone(room: Callable[[Drive, Path], str], name: str, tmp_path: Path) -> None:
    of = drive(name)
    listed = {f"{wire(at):04X}H" for _, row in of.registers() for at in row.address}
    lines = _BESIDE.sub("", room(of, tmp_path)).splitlines()
    left = [line for line in lines if "(wire " in line or listed & {*_ADDRESS.findall(_OTHER.sub("", line))}]
    assert left == []


def test_a_mistake_is_told_by_the_manuals_number() -> None:
    text = numbered("4xxxx")
    moved = wrong(text.replace("address: 44098", "address: 44099", 1))
    assert any("44098 (wire 1001H) is in no register table" in each for each in moved)
    twice = "errata: [{about: [register 40001, register 40001], where: s, printed: p, used: u, why: w, "
    told = wrong(text.replace("errata: []", f"{twice}confidence: open, measured: false}}]"))
    assert "`register 40001 (wire 0000H)` is twice in one list" in told
    assert "`register 40001 (wire 0000H)` names nothing in this map" in told
