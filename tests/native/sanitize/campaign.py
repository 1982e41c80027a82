"""Runs of many inputs per block: shares of them side by side in processes of their own."""

import os
import subprocess
import time
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path

from tests.native.driver import Driver, run
from tests.native.sanitize.pins import Pou, pous
from tests.native.sanitize.program import text
from tests.native.sanitize.sanitizers import Checked

from structured_text.engines.engine import Source
from structured_text.engines.matiec import MatiecEngine

PARSER_INPUTS = 10_000_000
"""Blocks that take apart what comes from outside."""
OTHER_INPUTS = 1_000_000
SHARE = 2_500_000
"""The most that one process runs, so that every core has work to the end."""
SECONDS = 3600.0
EVERY = "*"
"""The name that means every block."""


def inputs(pou: Pou) -> int:
    """How many inputs a block deserves in the long form."""
    parses = pou.c_name.endswith("_REPLY") or pou.c_name.startswith("MB_UNPACK")
    return PARSER_INPUTS if parses or pou.c_name in PARSERS else OTHER_INPUTS


PARSERS = ("MB_PARSEREPLY", "MB_RTUOPEN", "MB_ASCIIDECODE")


@dataclass(frozen=True)
class Program:
    """The compiled drivers of one line and compiler."""

    label: str
    path: Path
    pous: tuple[Pou, ...]


@dataclass
class Outcome:
    """What came of one block: the finds as the program printed them, and how often each ErrorID was given."""

    label: str
    name: str
    inputs: int = 0
    seconds: float = 0.0
    finds: list[str] = field(default_factory=list)
    results: Counter[int] = field(default_factory=Counter)


@dataclass(frozen=True)
class Share:
    """A number of inputs to one block, by a seed of its own; `seconds`: the time limit."""

    program: Program
    name: str
    seed: int
    inputs: int
    seconds: float = SECONDS


def build(engine: MatiecEngine, checked: Checked, texts: Sequence[Source] = (), only: Iterable[str] = ()) -> Program:
    """Compile the drivers of all blocks or of some, by upper-case name. Raises what Driver.build raises."""
    chosen = set(only)
    library = pous(engine, list(texts))
    found = tuple(pou for pou in library if not chosen or pou.c_name in chosen)
    driver = Driver(text(found, library), checked.options, checked.command)
    return Program(f"{engine.name} {checked.name}", driver.build(engine, texts), found)


def at_once(program: Program, seed: int, count: int) -> Outcome:
    """This many inputs to each block, one after the other in one process; ends at the first find."""
    return execute(Share(program, EVERY, seed, count))


def shares(program: Program, pou: Pou, count: int, seed: int) -> Iterator[Share]:
    """Divide a block's inputs."""
    number = 0
    while number * SHARE < count:
        yield Share(program, pou.name, seed + number, min(SHARE, count - number * SHARE))
        number += 1


def execute(share: Share) -> Outcome:
    """Run one share; one that takes too long is a find. Raises RuntimeError if the program is called wrongly."""
    start = time.perf_counter()
    outcome = Outcome(share.program.label, share.name, share.inputs)
    try:
        done = run(share.program.path, share.name, share.seed, share.inputs, seconds=share.seconds)
    except subprocess.TimeoutExpired as error:
        outcome.finds.append(f"seed {share.seed}: {error}")
        return outcome
    outcome.seconds = time.perf_counter() - start
    if done.returncode == 2:
        raise RuntimeError(f"no driver {share.name}")
    if done.returncode:
        outcome.finds.append(f"{done.stdout}{done.stderr[:4000]}")
    else:
        for counts in read(done.stdout).values():
            outcome.results.update(counts)
    return outcome


def read(said: str) -> dict[str, dict[int, int]]:
    """How often each block gave which ErrorID, from what a program prints."""
    rows = (line.split() for line in said.splitlines())
    return {name: {int(code): int(number) for code, _, number in _pairs(words)} for name, *words in rows}


def _pairs(words: Iterable[str]) -> Iterator[tuple[str, str, str]]:
    return (word.partition(":") for word in words)


def campaign(programs: Sequence[Program], scale: float, seed: int, workers: int | None = None) -> Iterator[Outcome]:
    """Run every block of the programs; one outcome per program and block, in order, as soon as it is known."""
    with ThreadPoolExecutor(workers or os.cpu_count()) as pool:
        work = [
            (program, pou, [pool.submit(execute, share) for share in shares(program, pou, _scaled(pou, scale), seed)])
            for program in programs
            for pou in program.pous
        ]
        for program, pou, parts in work:
            whole = Outcome(program.label, pou.name)
            for part in (future.result() for future in parts):
                whole.inputs += part.inputs
                whole.seconds += part.seconds
                whole.finds += part.finds
                whole.results += part.results
            yield whole


def _scaled(pou: Pou, scale: float) -> int:
    return max(1, round(inputs(pou) * scale))
