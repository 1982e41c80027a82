"""Forms of the same work in C, timed side by side in one process by `native/clock.h`."""

from pathlib import Path

from tests.bench.programs import programs
from tests.bench.turns import Taken
from tests.blocks.library import alone
from tests.native.driver import PRELUDE, Driver, run

from structured_text.engines.engine import EngineError, Source
from structured_text.engines.matiec import MatiecEngine

NATIVE = Path(__file__).with_name("native")
FOLDERS = ("types/", "modbus/", "jscc/")
ROUNDS = 500
PROCESSES = 3
"""A process lays its memory out anew, which can cost a form some per cent: the least of some processes counts."""


def driver(text: str, *, forced: bool = True) -> Driver:
    """C text of the bench after the clock; unless `forced`, variables are written without asking a debugger."""
    start = "" if forced else (NATIVE / "unforced.h").read_text("utf-8")
    clock = (NATIVE / "clock.h").read_text("utf-8")
    return Driver(f'{start}#include "{PRELUDE}"\n{clock}#line 1 "bench.c"\n{text}', ("-O2",), prelude=False)


def texts() -> list[Source]:
    """The blocks of the library that the forms are made of, and after them the bench's own ST."""
    return [*(source for source in alone() if source.path.startswith(FOLDERS)), *programs()]


def timed(
    engine: MatiecEngine, text: str, *arguments: object, forced: bool = True, rounds: int = ROUNDS
) -> tuple[dict[str, Taken], list[str]]:
    """Time of each form by name, and the lines that the program says besides.

    Raises EngineError if it does not compile or finds that the forms differ.
    """
    program = driver(text, forced=forced).build(engine, texts())
    return timed_program(program, engine.name, rounds, *arguments)


def timed_program(program: Path, name: str, rounds: int, *arguments: object) -> tuple[dict[str, Taken], list[str]]:
    """The same for a program that is there, in some processes; `name` is in front of an error."""
    least: dict[str, Taken] = {}
    for _ in range(PROCESSES):
        done = run(program, rounds, *arguments)
        if done.returncode:
            raise EngineError(f"{name}: {done.stderr.strip() or done.returncode}")
        said = done.stdout.splitlines()
        for form, found in map(_read, (line for line in said if not line.startswith("#"))):
            before = least.get(form, found)
            least[form] = Taken(min(before.least, found.least), min(before.median, found.median))
    return least, [line[2:] for line in said if line.startswith("#")]


def _read(line: str) -> tuple[str, Taken]:
    name, least, median = line.split("\t")
    return name, Taken(float(least), float(median))
