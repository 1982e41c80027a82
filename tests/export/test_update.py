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
ADDED = "MB_Added"
LINK = r'    <Compile Include="\.\.\\library\\.*?</Compile>\r?\n'


@cache
def versions() -> tuple[Shelf, Shelf]:
    """The library, and a later one: every head says so, and there is one shared function more, `MB_Added`."""
    parts = list(map(later, made().parts))
    place, old = next((place, part) for place, part in enumerate(parts) if part.name == "MB_Lrc")
    text, path = old.text.replace(old.name, ADDED), old.unit.path.replace(old.name, ADDED)
    parts.insert(place + 1, Part(old.folder, parse(text, path)))
    return made(), replace(made(), parts=tuple(parts))


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
    """Beremiz: what the library's file has replaces what has the same name; what is new comes before the user's."""
    whole = project["CHF_Motor.xml"]
    mine = elements(whole)["CHF_Motor"]
    for name, text in elements(new["CHF.xml"]).items():
        if name in elements(whole):
            whole = whole.replace(elements(whole)[name], text)
        else:
            whole = whole.replace(mine, f"{text}\n{mine}")
    return project | {"CHF_Motor.xml": whole}


def linked(project: Files, new: Files) -> Files:
    """TwinCAT: the new folder of the library, and its links in the place of those of the user's project."""
    path = "motor/CHF_Motor.plcproj"
    rows, others = re.findall(LINK, new[path], re.DOTALL), re.split(LINK, project[path], flags=re.DOTALL)
    kept = {name: text for name, text in project.items() if not name.startswith("library/")}
    library = {name: text for name, text in new.items() if name.startswith("library/")}
    return kept | library | {path: others[0] + "".join(rows) + others[-1]}


def elements(text: str) -> dict[str, str]:
    """The types and blocks of a project, by their names."""
    found = re.findall(r'^      <(dataType|pou) name="(\w+)".*?^      </\1>', text, re.MULTILINE | re.DOTALL)
    whole = re.finditer(r'^      <(dataType|pou) name="\w+".*?^      </\1>', text, re.MULTILINE | re.DOTALL)
    return {name: one[0] for (_, name), one in zip(found, whole, strict=True)}


PLATFORMS = {
    "codesys": ("CHF_Motor.xml", only(r"CHF\.xml")),
    "plcopen": ("CHF_Motor.xml", merged),
    "twincat": ("motor/CHF_Motor.TcPOU", linked),
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
    assert f"VERSION TWO {ADDED}" in library


def test_a_twincat_project_that_links_the_library_lists_every_file_only_after_its_rows_were_taken() -> None:
    project, new = built("twincat", 0), built("twincat", 1)
    motor = "motor/CHF_Motor.plcproj"
    before, after = links(only(r"library/.*")(project, new)[motor]), links(linked(project, new)[motor])
    whole = set(re.findall(r'Compile Include="([^"]+)"', new["library/CHF.plcproj"]))
    assert after == whole
    assert whole - before == {rf"modbus\{ADDED}.TcPOU"}
    assert {"library/" + path.replace("\\", "/") for path in after} <= linked(project, new).keys()


def links(project: str) -> set[str]:
    """The files of the library that a project lists, below its folder."""
    return set(re.findall(r'Compile Include="\.\.\\library\\([^"]+)"', project))


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
