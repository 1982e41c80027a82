"""Which modules of the generator the commands execute: `python -m tests.executed FOLDER` prints what none does.

The commands run in this process, one after the other, as somebody would type them who brings in a drive, runs a program
and reads frames; every call of a function of the generator is noted with its module. Files go into the folder.
"""

import ast
import builtins
import io
import os
import pty
import socket
import subprocess
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import redirect_stderr, redirect_stdout
from dataclasses import replace
from importlib.machinery import ModuleSpec, PathFinder, SourceFileLoader
from itertools import islice
from pathlib import Path
from types import CodeType, ModuleType
from typing import TYPE_CHECKING

import pytest
from click.testing import CliRunner
from tests.rooms import ROOT, modules

if TYPE_CHECKING:  # each module of the generator is imported while calls are noted
    from driveblocks.prove.question import Question
    from driveblocks.testing.unit import Unit

PACKAGES = ("driveblocks", "structured_text")
QUESTIONS = 6
"""That are asked of each block which is proved."""
TEXT = """FUNCTION Words : STRING
VAR_INPUT n : INT; END_VAR
  Words := CONCAT(INT_TO_STRING(n), '!');
END_FUNCTION
FUNCTION_BLOCK Adds
VAR_INPUT n : INT; END_VAR
VAR_IN_OUT total : INT; END_VAR
  total := total + n;
END_FUNCTION_BLOCK
"""
BAD = """FUNCTION_BLOCK Bad
VAR x : INT; w : WORD; r : REAL; q : ARRAY[0..2] OF INT; t : TON; END_VAR
  x := w + 1.5;
  CASE x OF 1..3: q[5] := 1; END_CASE;
  t(IN := x, PX := 1);
  r := SQRT(2) + LN('a');
END_FUNCTION_BLOCK
CONFIGURATION Plant
RESOURCE Cpu ON PLC
TASK Beat(INTERVAL := T#10ms, PRIORITY := 1);
PROGRAM Main WITH Beat : Bad;
END_RESOURCE
END_CONFIGURATION
"""
# What the demo does not use of the language; after 80 scans an index is out of range.
FAILS = f"""{TEXT}PROGRAM Fails
VAR Motor : CHF_Drive; Bus : MB_ByteLine8; Slots : MB_Slots8; END_VAR
VAR RxCount, TxCount : UINT; RxChars : MB_Adu; TxChars : MB_LineFrame; ElapsedMs : UINT := 10; END_VAR
VAR said : STRING; n, total, scans : INT; span : TIME := T#1s; adds : Adds; i : INT; rows : ARRAY[0..3] OF INT; END_VAR
  said := Words(n);
  n := STRING_TO_INT('12') + n;
  span := span + T#2s;
  FOR i := 0 TO 3 DO rows[i] := rows[i] + n; END_FOR;
  adds(n := n, total := total);
  Motor(Enable := TRUE, Address := 1, MaximumHz := 50.0, FullScaleHz := 50.0, StopWithinMs := 15000, Slot := Slots[0]);
  Bus(BitRate := UDINT#19200, CharacterBits := 11, ElapsedMs := ElapsedMs, RxCount := RxCount, RxChars := RxChars,
    TxChars := TxChars, Slots := Slots, TxCount => TxCount);
  scans := scans + 1;
  rows[scans / 20] := n;
END_PROGRAM
"""


def commands(folder: Path, port: str) -> Iterator[tuple[Sequence[str], str]]:
    """Words of the command line, and what is typed; drives are simulated at the port."""
    drive, blocks, example = str(folder / "acme.yaml"), str(folder / "blocks"), str(ROOT.parents[1] / "examples")
    motor = f"{example}/one_motor.st"
    yield ("new", "ACME", "-o", drive), ""
    (folder / "bad.yaml").write_text("drive: [", encoding="utf-8")
    (folder / "bad.st").write_text(BAD, encoding="utf-8")
    (folder / "fails.st").write_text(FAILS, encoding="utf-8")
    yield ("check", drive), ""
    yield ("check", str(folder / "bad.yaml")), ""
    yield ("build", drive, "-o", blocks), ""
    yield ("lint", "--for", "all", str(folder / "bad.st")), ""
    yield ("lint", f"{blocks}/iec61131"), ""
    yield ("test", "sn300g5", "--coverage", "--junit", str(folder / "junit.xml"), "--picture", str(folder)), ""
    read = ("01 03 02 01 F4 B8 53", "--drive", "jscc", "--request", "01 03 20 00 00 01 8F CA")
    for frame in (read, ("01 03 02 F4 01 B8 53", *read[1:]), ("01 03 02 01 F4 B8 53", "--json"), ("zz",), (":0103",)):
        yield ("explain", *frame), ""
    for topic in ((), ("0026H",), ("1EH",), ("faults",), ("errors",), ("frames",), ("errata",), ("registers",)):
        yield ("show", "sn300g5", *topic), ""
    yield ("prove", "jscc", "--junit", str(folder / "proofs.xml")), ""
    yield ("diff", "sn300g5", "jscc"), ""
    yield ("import-csv", "-"), "Register;Name\n1AH;Speed\n"
    for words in ("show chf --json", "list", "counts", "schema", "doctor", "simulate --schema"):
        yield tuple(words.split()), ""
    picture = ("--trace", str(folder / "run.csv"), "--picture", str(folder / "run.svg"))
    yield ("run", "--demo", "--fast", "--for", "3s"), ""
    yield ("run", str(folder / "fails.st"), "--simulate", "chf@1", "--for", "2s", "--show", "n", *picture), ""
    yield ("run", str(folder / "bad.st")), ""
    yield ("run", motor, "--tcp", port, "--allow-run", "--for", "1s"), "Motor 1\nWIRED\n"
    kept = str(folder / "chf.csv")
    yield ("parameters", "save", "chf@1", kept, "--tcp", port), ""
    yield ("parameters", "compare", kept, kept, "--all"), ""
    found = str(folder / "site.yaml")
    yield ("commission", "chf", "--tcp", port, "--unit", "1", "--file", found), "alone\n" + 12 * "\n"
    yield ("site", found, "--html", str(folder / "site.html"), "--report", "Drive1"), ""
    yield ("listen", "chf@1", "--tcp", port, "--for", "100ms", "--log", str(folder / "line.log")), ""
    yield ("line", "chf@1", "jscc@2", "--picture", str(folder / "round.svg")), ""
    _, slave = pty.openpty()
    yield ("simulate", "chf@1", "--port", os.ttyname(slave), "--for", "4s"), ""
    yield ("simulate", "chf@1", "--pty", "--frames", "--for", "1s"), ""


class Noting(SourceFileLoader):
    """Loads a module whose functions note its file when they begin: a trace function would double the time of all."""

    def get_code(self, fullname: str) -> CodeType:
        """The code of the source with a statement more in each function."""
        tree = ast.parse(self.get_data(self.get_filename(fullname)))
        for each in ast.walk(tree):
            if isinstance(each, ast.FunctionDef):
                (note,) = ast.parse("__executed__.add(__file__)").body
                each.body.insert(ast.get_docstring(each) is not None, note)
        return compile(ast.fix_missing_locations(tree), self.path, "exec")


class Finder:
    """Finds the modules of both packages, and leaves the others to those that come after it."""

    @staticmethod
    def find_spec(name: str, path: Sequence[str] | None = None, target: ModuleType | None = None) -> ModuleSpec | None:
        """The usual place of a module, with another loader."""
        found = PathFinder.find_spec(name, path, target) if name.partition(".")[0] in PACKAGES else None
        if found is not None and isinstance(found.loader, SourceFileLoader):
            found.loader = Noting(name, found.loader.path)
        return found


def invoke(words: Sequence[str], typed: str) -> None:
    """Run a command. What is no exit is raised."""
    from driveblocks.cli import app

    result = CliRunner().invoke(app, list(words), input=typed)
    if result.exception is not None and not isinstance(result.exception, SystemExit):
        raise result.exception


def few_programs(units: Callable[..., list["Unit"]]) -> Callable[..., list["Unit"]]:
    """Units of which one program of each group runs: it takes the way of all."""

    def made(*arguments: object) -> list["Unit"]:
        found = []
        for unit in units(*arguments):
            shortest = sorted(unit.suite.programs, key=lambda each: -sum(each.scans))
            one_of_each = {each.group: each for each in shortest}.values()
            found.append(replace(unit, suite=replace(unit.suite, programs=tuple(one_of_each))))
        return found

    return made


def few_questions(questions: Callable[..., Iterator["Question"]]) -> Callable[..., Iterator["Question"]]:
    """The first questions that are asked of a block."""
    return lambda *arguments: islice(questions(*arguments), QUESTIONS)


def executed(folder: Path) -> set[str]:
    """The files of the generator of which a function was called."""
    seen = set[str]()
    vars(builtins)["__executed__"] = seen
    sys.meta_path.insert(0, Finder)
    from driveblocks.output import units
    from driveblocks.prove import prover, question
    from driveblocks.site import hunt

    patch = pytest.MonkeyPatch()
    patch.setattr(hunt, "QUIET_US", 100_000)
    patch.setattr(units, "units", few_programs(units.units))
    patch.setattr(prover, "questions", few_questions(question.questions))
    with socket.create_server(("127.0.0.1", 0)) as free:
        port = f"127.0.0.1:{free.getsockname()[1]}"
    arguments = [sys.executable, "-m", "driveblocks", "simulate", "chf@1", "--tcp", port]
    with subprocess.Popen(arguments, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as drives:
        try:
            for words, typed in commands(folder, port):
                invoke(words, typed)
        finally:
            drives.terminate()
    from structured_text.cli import main

    with redirect_stdout(io.StringIO()), redirect_stderr(io.StringIO()):
        for word in ("lint", "run"):
            main([word, str(folder / "bad.st")])
    return seen | {str(ROOT / "__main__.py")}  # the way in: the simulated drives above are run by it


def has_functions(path: Path) -> bool:
    """Whether a module has a function that does something: those of a protocol only say what there is."""
    tree = ast.parse(path.read_text("utf-8"))
    protocols = [each for each in ast.walk(tree) if isinstance(each, ast.ClassDef) and "Protocol" in ast.dump(each)]
    stated = {id(inner) for each in protocols for inner in ast.walk(each)}
    return any(isinstance(each, ast.FunctionDef) and id(each) not in stated for each in ast.walk(tree))


def idle(folder: Path) -> list[str]:
    """The modules of which no command executes a function; `test --engine matiec` would take a C compiler minutes."""
    found = executed(folder)
    return [
        name
        for name, path in modules().items()
        if str(path) not in found and has_functions(path) and ".engines.matiec" not in name
    ]


if __name__ == "__main__":
    print("\n".join(idle(Path(sys.argv[1]))))
