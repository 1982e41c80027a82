"""The plain text for OpenPLC: it is the canonical text, compilers take it as it is, and first motors run."""

import functools
import re
from collections.abc import Iterable
from itertools import pairwise
from pathlib import Path

import pytest
from tests.blocks.toolchains import FOUND, translate
from tests.examples.port import Port
from tests.platforms.stock import canon, made, volumes
from tests.shipped import drives

from driveblocks.bench.simulator.drive import SimulatedDrive
from driveblocks.platforms.openplc.writer import write
from structured_text.engines.discovery import EMBEDDED
from structured_text.engines.embedded.engine import EmbeddedEngine
from structured_text.engines.engine import Engine, Library, Source
from structured_text.engines.matiec.installation import Installation
from structured_text.language.lint import lint_sources

END = re.compile(r"^END_(?:TYPE|FUNCTION|FUNCTION_BLOCK)\n", re.MULTILINE)
TOOLS = pytest.mark.parametrize(
    "tool",
    FOUND or [pytest.param(None, marks=pytest.mark.skip(reason="iec2c was not found"))],
    ids=lambda tool: tool.iec2c.parent.name if tool else "none",
)


@functools.cache
def written() -> dict[str, str]:
    """Path below the folder of the platform -> text."""
    return write(made())


def pieces(text: str) -> list[str]:
    """A library cut after each type, function and block; its own head goes before the first."""
    ends = [0, *(match.end() for match in END.finditer(text))]
    return [text[start:end] for start, end in pairwise(ends)]


def library(*prefixes: str) -> list[str]:
    """The texts that a first motor of some families needs, without a port."""
    return [written()[f"{path}.st"] for path in ("shared/DriveBlocks", *(f"families/{each}" for each in prefixes))]


def test_the_files_are_the_canonical_texts_each_once_and_nothing_else() -> None:
    meant = volumes(made(), [(part.folder, part.name, part.text) for part in canon().values()])
    for name, wanted in meant.items():
        head, *rest = pieces(written()[f"{name}.st"])
        comment, _, first = head.partition("*)\n\n")
        assert [first, *(text.removeprefix("\n") for text in rest)] == wanted, name
        types, others = (sum(text.count(f"\n{word}") for text in wanted) for word in ("TYPE\n", "FUNCTION"))
        assert f"{types} types, {others} functions and blocks" in comment
    port = {"shared/LX_Port", "shared/LX_Port_Line2", "shared/LX_Port_Line32"}
    assert {path for path in written() if not path.startswith("yours/")} == {
        *(f"{name}.st" for name in {*meant, *port}), "README.md", "Port.md"
    }  # fmt: skip


def builds(texts: Iterable[str]) -> None:
    """The embedded engine refuses a name that is not there."""
    EmbeddedEngine().build([Source(str(at), text) for at, text in enumerate(texts)])


@pytest.mark.parametrize("family", sorted(drives()))
def test_a_first_motor_needs_no_extra(family: str) -> None:
    builds([*library(family), programs(family, "MotorBytes")])


NEEDS = {"Line2": (), "Line32": (), "Parameters": (), "Meter": ("Parameters",), "Frames": (), "Chinese": ()}
"""Extra -> the others that go before it, as the page says."""


@pytest.mark.parametrize("name", [pytest.param(name, marks=pytest.mark.thorough) for name in NEEDS] + ["all"])
def test_an_extra_goes_after_what_the_page_says(name: str) -> None:
    families = ("CHF", "ATV312") if name == "all" else tuple(drives())
    wanted = [*NEEDS] if name == "all" else [*NEEDS[name], name]
    extras = [written()[f"shared/DriveBlocks_{each}.st"] for each in wanted]
    own = [written().get(f"families/{each}_{one}.st", "") for each in families for one in wanted]
    builds([*library(*families), *extras, *filter(None, own)])


def test_a_text_has_no_mark_no_cr_and_ends_with_its_last_line() -> None:
    for path, text in written().items():
        assert text.isascii() or "families" in path or "Chinese" in path or path.endswith(".md"), path
        assert "\r" not in text, path
        assert "\ufeff" not in text, path
        assert text.endswith("\n"), path


def test_a_first_motor_after_its_library_is_one_program_that_lints_clean() -> None:
    for drive in made().drives.values():
        texts = [*library(drive.prefix), written()[f"yours/{drive.prefix}_MotorBytes.st"]]
        sources = [(f"{at}.st", text) for at, text in enumerate(texts)]
        assert [str(each) for each in lint_sources(sources) if each.rule != "configuration-inside"] == []


def test_a_first_motor_says_what_its_line_is_and_how_often_it_comes() -> None:
    port = written()["shared/LX_Port.st"]
    assert re.findall(r"^(?:FUNCTION_BLOCK|PROGRAM) (\w+)", port, re.M) == ["LX_Port", "LX_Line8"]
    for drive in made().drives.values():
        linux, other = (written()[f"yours/{drive.prefix}_{form}.st"] for form in ("Motor", "MotorBytes"))
        assert re.findall(r"^(?:FUNCTION_BLOCK|PROGRAM) (\w+)", linux, re.M) == [f"{drive.prefix}_Motor"]
        assert re.findall(r"^(?:FUNCTION_BLOCK|PROGRAM) (\w+)", other, re.M) == [f"{drive.prefix}_MotorBytes"]
        assert re.findall(r"^  Bus : (\w+);", linux + other, re.M) == ["LX_Line8", "MB_ByteLine8"]
        for text in (linux, other):
            assert text.count("INTERVAL := T#10ms") == 1
            assert re.search(r"^CONFIGURATION Config0\n  RESOURCE Res0 ON PLC\n", text, re.M)
            assert text.index("  Motor(Enable") < text.rindex("  Bus(")
            assert text.count("Restart := FirstScan") == 2


def programs(prefix: str, form: str) -> str:
    """A first motor without its task: there is one CONFIGURATION in a text."""
    return written()[f"yours/{prefix}_{form}.st"].partition("CONFIGURATION")[0]


_BUILT: dict[str, Library] = {}


def built(engine: Engine) -> Library:
    """What is shared, two families, the first motors of CHF; what is in C only where the engine takes it."""
    if engine.name not in _BUILT:
        linux = "" if engine.name == EMBEDDED else written()["shared/LX_Port.st"] + programs("CHF", "Motor")
        text = "\n".join([*library("CHF", "PF525"), linux, written()["yours/CHF_MotorBytes.st"]])
        _BUILT[engine.name] = engine.build([Source("motor.st", text)])
    return _BUILT[engine.name]


def test_the_first_motor_starts_and_stops_a_simulated_drive(engine: Engine) -> None:
    program = built(engine).instance("CHF_MotorBytes")
    drive = SimulatedDrive(made().drives["invt_chf"], 1)
    port = Port(program, [drive], 10 / 9.6)
    program["ElapsedMs"] = 10

    def run(ms: int) -> list[object]:
        for _ in range(ms // 10):
            port.scan()
        return [program[path] for path in ("Motor.StopConfirmed", "Motor.Running", "HardStopOk")]

    program["HardStopClosed"] = program["NotStop"] = True
    assert run(3500) == [True, False, False]
    program["ResetButton"] = True
    assert run(10) == [True, False, True]
    program["ResetButton"] = False
    program["Hertz"], program["StartButton"] = 30.0, True
    run(100)
    program["StartButton"] = False
    assert run(6000) == [False, True, True]
    assert drive.hertz == 30
    program["NotStop"] = False
    assert run(6000) == [True, False, True]
    assert drive.hertz == 0


def test_it_knows_its_first_scan(engine: Engine) -> None:
    motor = built(engine).instance("CHF_MotorBytes")
    assert motor["FirstScan"] is True
    motor.scan()
    assert motor["FirstScan"] is False


def test_the_first_motor_on_linux_runs_and_says_that_its_port_is_missing(matiec: Engine) -> None:
    program = built(matiec).instance("CHF_Motor")
    for _ in range(3):
        program.scan()
    assert program["Bus.PortErrorID"] == 2
    assert program["Motor.CommOk"] is False


def with_addresses(text: str) -> str:
    """A first motor after step 4.2 of the page."""
    section = re.search(r"^   VAR\n.*?END_VAR\n", written()["README.md"], re.MULTILINE | re.DOTALL)
    assert section is not None
    names = re.findall(r"(\w+) AT %", section[0])
    assert all(len(re.findall(f"^  {name} : BOOL;", text, re.MULTILINE)) == 1 for name in names)
    rest = re.sub(rf"^  (?:{'|'.join(names)}) : BOOL;.*\n", "", text, flags=re.MULTILINE)
    return rest.replace("END_VAR\n", f"END_VAR\n{section[0]}", 1)


@TOOLS
def test_every_first_motor_compiles_with_addresses_as_the_page_says(tool: Installation, tmp_path: Path) -> None:
    prefixes = [drive.prefix for drive in made().drives.values()]
    port = written()["shared/LX_Port.st"]
    linux = [programs(prefix, "Motor") for prefix in prefixes]
    others = [programs(prefix, "MotorBytes") for prefix in prefixes]
    located = [with_addresses(text) for text in [*linux, *others]]
    translate(tool, [*library(*prefixes), port, *located], tmp_path)
    assert "__IX0_0" in (tmp_path / "LOCATED_VARIABLES.h").read_text(encoding="utf-8")


@TOOLS
def test_an_upload_compiles_as_it_is(tool: Installation, tmp_path: Path) -> None:
    shared, family = library("CHF")
    translate(tool, [shared, written()["shared/LX_Port.st"], family, written()["yours/CHF_Motor.st"]], tmp_path)
    assert {"Config0.c", "Res0.c"} <= {path.name for path in tmp_path.iterdir()}
