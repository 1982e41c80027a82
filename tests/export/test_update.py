"""An update as the page of each platform tells it: build, edit the first motor, build another version, import again."""

import re
from collections.abc import Callable
from dataclasses import replace
from functools import cache

import pytest
from tests.export.stock import made

from driveblocks.export.part import Part, Shelf
from driveblocks.export.target import WRITERS
from structured_text.language.parser import parse

Files = dict[str, str]
MARK = "STOPWITHINMS := 4321"


@cache
def versions() -> tuple[Shelf, Shelf]:
    """The library, and a later one: every block of it says another body."""
    return made(), replace(made(), parts=tuple(map(later, made().parts)))


def later(part: Part) -> Part:
    """A part of a later version: its head says so, and so does what an import replaces."""
    text = part.text.replace("(* ", "(* VERSION TWO ", 1)
    return Part(part.folder, parse(text, part.unit.path))


def built(target: str, number: int) -> Files:
    """The files of a version."""
    return {path.removeprefix(f"{target}/"): text for path, text in WRITERS[target](versions()[number]).items()}


def edited(text: str) -> str:
    """A first motor with the user's own ramp in it."""
    assert text.count("StopWithinMs := 15000") >= 1
    return text.replace("StopWithinMs := 15000", MARK)


def only(names: str) -> Callable[[Files, Files], Files]:
    """Import again the files whose names match, over what is there."""

    def update(project: Files, new: Files) -> Files:
        return project | {path: text for path, text in new.items() if re.fullmatch(names, path)}

    return update


def merged(project: Files, new: Files) -> Files:
    """Beremiz: what the library's file has takes the place of what has the same name in the project."""
    whole = project["CHF_Motor.xml"]
    for name, text in elements(new["CHF.xml"]).items():
        whole = whole.replace(elements(whole)[name], text)
    return project | {"CHF_Motor.xml": whole}


def elements(text: str) -> dict[str, str]:
    """The types and blocks of a project, by their names."""
    found = re.findall(r'^      <(dataType|pou) name="(\w+)".*?^      </\1>', text, re.MULTILINE | re.DOTALL)
    whole = re.finditer(r'^      <(dataType|pou) name="\w+".*?^      </\1>', text, re.MULTILINE | re.DOTALL)
    return {name: one[0] for (_, name), one in zip(found, whole, strict=True)}


PLATFORMS = {
    "codesys": ("CHF_Motor.xml", only(r"CHF\.xml")),
    "plcopen": ("CHF_Motor.xml", merged),
    "twincat": ("motor/CHF_Motor.TcPOU", only(r"library/.*")),
    "siemens": ("CHF_Motor.scl", only(r"DriveBlocks\.\w+|CHF\.scl|SI_Port\.scl")),
    "openplc": ("CHF_Motor.st", only(r"CHF\.st|LX_Line8\.st")),
}


@pytest.mark.parametrize("target", PLATFORMS)
def test_an_update_replaces_the_library_and_leaves_the_motor_as_its_user_wrote_it(target: str) -> None:
    motor, update = PLATFORMS[target]
    project = built(target, 0)
    project[motor] = edited(project[motor])
    mine = project[motor]
    after = update(project, built(target, 1))
    assert MARK in after[motor]
    if target != "plcopen":
        assert after[motor] == mine
    else:
        assert elements(after[motor])["CHF_Motor"] == elements(mine)["CHF_Motor"]
    library = "".join(text for path, text in after.items() if path != motor or target == "plcopen")
    assert "VERSION TWO CHF_Drive" in library
    assert "VERSION TWO MB_Line8" in library


@pytest.mark.parametrize("target", PLATFORMS)
def test_no_file_of_the_library_holds_a_program_of_the_user(target: str) -> None:
    motor, _ = PLATFORMS[target]
    files = built(target, 0)
    holding = [path for path, text in files.items() if re.search(r"PROGRAM CHF_Motor|\"CHF_Motor\"", text)]
    page = [path for path in holding if path.endswith(".md")]
    assert motor in holding
    own = re.compile(r"(motor/)?CHF_(Motor|MotorBytes|Task)\.\w+")
    assert [path for path in holding if not own.fullmatch(path) and path not in page] == []


@pytest.mark.parametrize("target", PLATFORMS)
def test_the_page_says_how_to_update(target: str) -> None:
    page = built(target, 0)["README.md"]
    section = page.partition("\n## 5. Update\n")[2].partition("\n## ")[0]
    assert "_Version" in section
    assert "Item := 1" in section
    assert "standstill" in section or "motors\n   stand" in section
    assert "yours" in section or "your program" in section.lower()
