"""Forms of the same work in C, timed side by side in one process by `native/clock.h`."""

from dataclasses import dataclass
from pathlib import Path

from tests.bench.programs import programs
from tests.blocks.library import sources
from tests.native.driver import Driver, run

from driveblocks.host.engine import EngineError
from driveblocks.host.matiec import MatiecEngine

NATIVE = Path(__file__).with_name("native")
UNFORCED = ("-include", str(NATIVE / "unforced.h"))
ROUNDS = 1000
PROCESSES = 3
"""A process lays its memory out anew, which can cost a form some per cent: the least of some processes counts."""


@dataclass(frozen=True)
class Taken:
    """Nanoseconds of one call: the least of all rounds, and the median."""

    least: float
    median: float


def driver(text: str, options: tuple[str, ...] = ()) -> Driver:
    """C text of the bench behind the clock."""
    clock = (NATIVE / "clock.h").read_text("utf-8")
    return Driver(f'{clock}#line 1 "bench.c"\n{text}', ("-O2", *options))


def timed(
    engine: MatiecEngine, text: str, *arguments: object, options: tuple[str, ...] = (), rounds: int = ROUNDS
) -> tuple[dict[str, Taken], list[str]]:
    """Time of each form by name, and the lines that the program says besides.

    Raises EngineError if it does not compile or finds that the forms differ.
    """
    program = driver(text, options).build(engine, [*sources(), *programs()])
    least: dict[str, Taken] = {}
    for _ in range(PROCESSES if rounds == ROUNDS else 1):
        done = run(program, rounds, *arguments)
        if done.returncode:
            raise EngineError(f"{engine.name}: {done.stderr.strip() or done.returncode}")
        said = done.stdout.splitlines()
        for name, found in map(_read, (line for line in said if not line.startswith("#"))):
            before = least.get(name, found)
            least[name] = Taken(min(before.least, found.least), min(before.median, found.median))
    return least, [line[2:] for line in said if line.startswith("#")]


def _read(line: str) -> tuple[str, Taken]:
    name, least, median = line.split("\t")
    return name, Taken(float(least), float(median))
