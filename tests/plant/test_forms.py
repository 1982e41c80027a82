"""The program of each example plant in the form of each platform, as the independent readers of the forms find it."""

import functools
import posixpath
import re
import shutil
import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest
from tests.blocks.toolchains import COMPILER, FOUND, compile_c, translate
from tests.plant.bench import PLANTS, example
from tests.platforms import tc6_checks, tc_reader
from tests.platforms.siemens import scl
from tests.platforms.tc6_checks import DIALECTS, Made
from tests.platforms.tc6_reader import File

from driveblocks.desk.run.source import known, needed
from driveblocks.plant import forms, program
from driveblocks.platforms.part import Part
from driveblocks.render.library import EXTRAS
from driveblocks.render.text import ENGLISH
from structured_text.engines.matiec.installation import Installation
from structured_text.language.lint import lint_sources
from structured_text.language.parser import parse

STRUCPP = shutil.which("strucpp")


@functools.cache
def made(name: str, target: str) -> dict[str, str]:
    return forms.files(example(name), target, [ENGLISH])


def meant(name: str, platform: str, *, ladder: bool = False) -> str:
    """The program that is to be read back."""
    plant = example(name)
    text = program.source(plant, platform, own=False, name=f"{plant.program}_Ladder" if ladder else "")
    head, last, body = text.rpartition("END_VAR\n")
    return head + last + re.sub(r"^  \(\*.*\*\)\n", "", body, flags=re.MULTILINE) if ladder else text


def whole(name: str, target: str) -> list[str]:
    """Every text in the order in which a compiler takes them."""
    files = {path: text for path, text in made(name, target).items() if path.endswith(".st")}
    return [files[path] for path in sorted(files, key=_rank)]


def _rank(path: str) -> tuple[int, bool, bool]:
    late = ("_Line32", "_Parameters", "_Meter", "_Plant")
    return (
        _layer(path),
        "_Port" in path,
        path.removesuffix(".st").endswith(late),
    )


@pytest.mark.parametrize("check", tc6_checks.CHECKS, ids=lambda each: each.__name__)
@pytest.mark.parametrize("ladder", [False, True])
@pytest.mark.parametrize("name", PLANTS)
def test_codesys(name: str, ladder: bool, check: Callable[[Made], None]) -> None:
    text = meant(name, "codesys", ladder=ladder)
    path = f"yours/{example(name).program}{'_Ladder' if ladder else ''}"
    check(Made("codesys", path, File(made(name, "codesys")[f"{path}.xml"], *DIALECTS["codesys"]), (text,), ()))


@pytest.mark.parametrize(
    "name", [pytest.param(PLANTS[0]), *(pytest.param(each, marks=pytest.mark.thorough) for each in PLANTS[1:])]
)
def test_beremiz(name: str) -> None:
    own = [meant(name, "linux", ladder=ladder) for ladder in (False, True)]
    stock, plant = forms.stocked(example(name), [ENGLISH]), example(name)
    shared = [part for part in stock.parts if part.folder not in stock.drives]
    port = [part for one in stock.port("linux") for part in one.parts]
    families = [part for part in stock.parts if part.folder in stock.drives]
    texts = [part.text for part in (*_by_volume(shared), *port, *_by_volume(families))]
    path = f"yours/{plant.program}/plc"
    file = File(made(name, "beremiz")[f"{path}.xml"], *DIALECTS["beremiz"])
    one = Made("beremiz", path, file, (*texts, *own), ())
    for check in tc6_checks.CHECKS:
        if check is not tc6_checks.assert_tasks:
            check(one)
    (task,) = file.all("instances/configurations/configuration/resource/task")
    assert task.get("interval") == f"T#{plant.scan_ms}ms"
    assert [each.get("typeName") for each in file.all("pouInstance", task)] == [plant.program]


def _by_volume(parts: list[Part]) -> list[Part]:
    """In the order of the files of a library: the extras come last, family by family."""
    folders = dict.fromkeys(part.folder for part in parts)
    shared = len({part.folder for part in parts} & {"line", "vfd"}) > 0
    groups = [parts] if shared else [[part for part in parts if part.folder == folder] for folder in folders]
    return [part for group in groups for extra in ("", *EXTRAS) for part in group if part.extra == extra]


@pytest.mark.parametrize("name", PLANTS)
def test_twincat(name: str) -> None:
    files, plant = made(name, "twincat"), example(name)
    text = program.source(plant, "twincat")
    read = tc_reader.read("Plant.TcPOU", files[f"yours/{plant.program}.TcPOU"])
    unit = Part("twincat", parse(text, "twincat/Plant.st"))
    assert read.name == plant.program
    assert read.body == unit.body
    assert read.declaration.rstrip() == f"{text[: unit.element.at]}{unit.declaration}".rstrip()
    listed = tc_reader.project(files[f"yours/{plant.program}.plcproj"])
    found = {posixpath.normpath(posixpath.join("yours", path.replace("\\", "/"))) for path in listed.compiled}
    assert found == {path for path in files if not path.endswith((".plcproj", ".md"))}
    tasks = [tc_reader.task(files[path]) for path in files if path.endswith(".TcTTO")]
    assert {each.program for each in tasks} == {plant.program, *(f"TC_Fast_{line}" for line in plant.lines)}
    for line in plant.lines:
        assert f"TC_Com_{line}.TxBuffer" in read.body
        assert f"TC_Com_{line}" in files[f"yours/TC_Fast_{line}.TcPOU"]


@pytest.mark.parametrize("name", PLANTS)
def test_siemens(name: str) -> None:
    plant, files = example(name), made(name, "siemens")
    order = sorted((path for path in files if not path.endswith(".md")), key=lambda path: (_layer(path), _late(path)))
    known: dict[str, scl.Block] = {}
    for path in order:
        scl.read(files[path], known)
    block = known[plant.program.upper()]
    unit = Part("siemens", parse(meant(name, "siemens"), "siemens/Plant.st"))
    assert block.kind == "FUNCTION_BLOCK"
    assert tuple(block.tokens) == unit.tokens
    kept = {one.name for one in block.variables if one.section == "VAR RETAIN"}
    assert kept == {f"{each}_Counted" for each in plant.drives}


def _layer(path: str) -> int:
    return ("shared", "families", "yours").index(path.partition("/")[0])


def _late(path: str) -> tuple[bool, bool, bool]:
    extra = any(each in path for each in ("_Line", "_Parameters", "_Meter", "_Plant", "_Chinese"))
    return ("SI_" in path, extra, path.endswith(".scl"))


@pytest.mark.parametrize("target", ["openplc", "text"])
@pytest.mark.parametrize("name", PLANTS)
def test_text(name: str, target: str) -> None:
    text = made(name, target)[f"yours/{example(name).program}.st"]
    assert text.startswith(program.source(example(name), forms.PORTS[target]))
    assert all(len(line) <= 120 for line in text.splitlines())


@pytest.mark.parametrize("name", PLANTS)
def test_it_lints_clean(name: str) -> None:
    text = program.text(example(name))
    library = needed([parse(text, "plant.st")], known())
    assert lint_sources([*((each.path, each.text) for each in library), ("plant.st", text)]) == []


@pytest.mark.thorough
@pytest.mark.skipif(not FOUND or COMPILER is None, reason="needs matiec and a C compiler")
@pytest.mark.parametrize("tool", FOUND, ids=lambda tool: tool.iec2c.parent.name)
@pytest.mark.parametrize("target", ["openplc", "text"])
@pytest.mark.parametrize("name", PLANTS)
def test_matiec_compiles_it_without_a_warning(name: str, target: str, tool: Installation, tmp_path: Path) -> None:
    translate(tool, whole(name, target), tmp_path)
    if target == "text":
        compile_c(tool, tmp_path)


@pytest.mark.thorough
@pytest.mark.skipif(STRUCPP is None, reason="needs strucpp")
@pytest.mark.parametrize("name", PLANTS)
def test_strucpp_compiles_it(name: str, tmp_path: Path) -> None:
    (tmp_path / "all.st").write_text("\n".join(whole(name, "text")), encoding="utf-8")
    done = subprocess.run([str(STRUCPP), "all.st", "-o", "all.cpp"], cwd=tmp_path, capture_output=True, check=False)
    assert done.returncode == 0, done.stderr[-2000:]
