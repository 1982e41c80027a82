"""Measurement of every block and function with its typical input: bytes, instructions, nanoseconds."""

import functools
import re
import shutil
import subprocess
import tempfile
from collections.abc import Iterable
from pathlib import Path

from tests.bench.forms import timed_program
from tests.bench.inputs import pins
from tests.bench.record import Rows
from tests.bench.turns import Work, side_by_side
from tests.bench.units import program, units
from tests.blocks.library import sources
from tests.native.driver import run

from structured_text.engines.embedded import EmbeddedEngine
from structured_text.engines.engine import EngineError, Instance, Library
from structured_text.engines.matiec import MatiecEngine
from structured_text.language.tree import Function, FunctionBlock

IEC = "IEC"
"""Column of the sum of IEC widths, as `blocks/README.md` prints it."""
NOTHING = "nothing"
DUMP = re.compile(r"^desc: Trigger: Client Request: (\w+)$.*?^totals: (\d+)$", re.MULTILINE | re.DOTALL)
"""One dump of callgrind: the name that the program gave it, and the instructions since the dump before."""


def memory(engines: Iterable[MatiecEngine]) -> Rows:
    """Bytes of one instance of each block: by the C compiler for each line of matiec, and the sum of the IEC widths."""
    rows: Rows = {unit.name: {IEC: unit.type.size} for unit in units() if isinstance(unit, FunctionBlock) and unit.type}
    for engine in engines:
        for line in run(program().build(engine, sources())).stdout.splitlines():
            name, size = line.split("\t")
            rows[name][engine.name] = int(size)
    return rows


def instructions(engines: Iterable[MatiecEngine]) -> Rows:
    """Instructions of one scan by callgrind, call and return included; of the second of two equal scans.

    Raises EngineError if valgrind is missing or cannot count, or if a second count gives another number.
    """
    rows: Rows = {}
    for engine in engines:
        path = program().build(engine, sources())
        first, second = _counted(path), _counted(path)
        if first != second:
            changed = sorted(name for name in first if first[name] != second.get(name))
            raise EngineError(f"{engine.name}: another count in a second run: {', '.join(changed)}")
        for unit in units():
            rows.setdefault(unit.name, {})[engine.name] = first[unit.name] - first[NOTHING]
    return rows


def _counted(path: Path) -> dict[str, int]:
    valgrind = shutil.which("valgrind")
    if valgrind is None:
        raise EngineError("there is no valgrind")
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "counts"
        options = ["--tool=callgrind", "--combine-dumps=yes", f"--callgrind-out-file={out}"]
        done = subprocess.run([valgrind, *options, str(path), "count"], capture_output=True, text=True, check=False)
        if done.returncode:
            raise EngineError(f"callgrind does not count: {done.stderr.strip().splitlines()[-1:]}")
        found = DUMP.findall(out.read_text("utf-8"))
    return {name: int(count) for name, count in found}


def times(engines: Iterable[MatiecEngine], rounds: int = 300) -> Rows:
    """Nanoseconds of one scan of every block, or one call of a function, with nothing else in between."""
    rows: Rows = {}
    for engine in engines:
        taken, _ = timed_program(program().build(engine, sources()), engine.name, rounds)
        for name, one in taken.items():
            rows.setdefault(name, {})[engine.name] = one.least
            rows[name][f"{engine.name} median"] = one.median
    return rows


def all_times(engines: Iterable[MatiecEngine]) -> Rows:
    """The same on matiec and on the embedded engine. Raises EngineError if a typical input is refused."""
    rows = times(engines)
    for name, columns in embedded().items():
        rows.setdefault(name, {}).update(columns)
    return rows


def embedded(rounds: int = 100) -> Rows:
    """Nanoseconds on the embedded engine. Raises EngineError if a typical input is refused."""
    library = EmbeddedEngine().build(sources())
    works = {unit.name: work(library, unit) for unit in units()}
    return {
        name: {"embedded": one.least, "embedded median": one.median}
        for name, one in side_by_side(works, rounds).items()
    }


def work(library: Library, unit: Function | FunctionBlock) -> Work:
    """One scan of a block, one call of a function. Raises EngineError if the block refuses its input."""
    if isinstance(unit, Function):
        return functools.partial(library.call, unit.name, _arguments(unit))
    instance = library.instance(unit.name)
    prepare(instance, unit)
    instance.scan()
    if "ErrorID" in {variable.name for group in unit.blocks for variable in group.variables} and instance["ErrorID"]:
        raise EngineError(f"{unit.name} refuses its typical input: {instance['ErrorID']!r}")
    return instance.scan


def prepare(instance: Instance, unit: FunctionBlock) -> None:
    """Give an instance its typical input."""
    for name, value in pins(unit).items():
        if isinstance(value, dict):
            for field, number in value.items():
                instance[f"{name}.{field}"] = number
        else:
            instance[name] = [*value] if isinstance(value, list) else value


def _arguments(unit: Function) -> dict[str, bool | int | float]:
    return {name: value for name, value in pins(unit).items() if isinstance(value, bool | int | float)}
