"""Do the terms say what the engines do? Random calls of every block of which something is proved, full state compared.

    python -m tests.prove.agreement [--calls N] [--engine NAME]

An integer that leaves its width wraps on the embedded engine, as the terms do. What the terms leave free, a REAL that
is reckoned with, is compared with nothing; how much that is, is said.
"""

import argparse
import math
import struct
import sys
from dataclasses import dataclass
from functools import cache
from random import Random
from typing import Any

from tests.prove.evaluate import Program, signed

from driveblocks.maps import catalog, collection
from driveblocks.prove import prover, rules
from driveblocks.prove.facts import facts
from driveblocks.prove.model import BEFORE, Model, models
from driveblocks.prove.replay import known_paths
from structured_text.engines.discovery import survey
from structured_text.engines.embedded.engine import EmbeddedEngine
from structured_text.engines.engine import Library, ScanError, Source
from structured_text.language.tree import Function
from structured_text.language.types import Elementary, Kind

CALLS = 10_000
SEED = 31
EDGES = (0, 0, 1, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 20, 40, 54, 255, 500, 3000, 10_000, 65_534, 65_535)
REALS = (0.0, 0.0, 1.0, 50.0, 49.5, -1.0, 0.1, 1e6, 1e30, -1e30, 3e38, math.inf, -math.inf, math.nan, 100.0, 0.01)


@dataclass
class Score:
    """How many values were compared, left free, and differed."""

    calls: int = 0
    refused: int = 0
    """Calls that the engine ends, since a result leaves its width."""
    compared: int = 0
    free: int = 0
    wrong: tuple[str, ...] = ()


@cache
def sources() -> dict[str, list[Source]]:
    """The texts of each family with what every drive shares."""
    return dict(prover.texts(collection.read(catalog.shipped())))


@cache
def subjects(family: str) -> list[Model]:
    """The blocks of a family of which something is proved; of every drive those that all share."""
    if family == prover.GENERIC:
        return models(sources()[family], rules.shared())
    drive = next(each.drive for each in collection.read(catalog.shipped()) if each.path.stem == family)
    return models(sources()[family], rules.family(facts(drive)))


def drawn(random: Random, kind: Elementary) -> Any:
    """A value of a type, near the edges more often than not."""
    if kind.kind is Kind.BOOL:
        return random.random() < 0.5
    if kind.kind is Kind.REAL:
        return struct.unpack("<f", struct.pack("<f", random.choice(REALS)))[0]
    value = random.choice(EDGES) if random.random() < 0.7 else random.getrandbits(kind.width)
    return value % (1 << kind.width) if not kind.signed else value % (1 << (kind.width - 1))


def compared(model: Model, library: Library, calls: int) -> Score:
    """Run calls of a block both ways; every second finds what the one before has left."""
    paths = known_paths(model)
    program = Program(model.after[path] for path in paths)
    random, score = Random(SEED), Score()
    given = [path for path in paths if not model.inputs[path].eq(model.before[path])]
    state: dict[str, Any] = {}
    for call in range(calls):
        if call % 2 == 0 or not state:
            state = {path: drawn(random, kind) for path, (_, kind) in paths.items()}
        inputs = {path: drawn(random, paths[path][1]) for path in given}
        try:
            after = _run(model, library, state | inputs)
        except ScanError:  # a result leaves its width, which no memory that the rules allow brings about: matiec wraps
            state, score.refused = {}, score.refused + 1
            continue
        said = program.run({BEFORE + path: value for path, value in state.items()} | inputs)
        for path, (_, kind) in paths.items():
            _compare(score, path, kind, said[model.after[path].get_id()], after[path])
        score.calls += 1
        state = after
    return score


def _run(model: Model, library: Library, values: dict[str, Any]) -> dict[str, Any]:
    instance = library.instance(model.pou.name)
    for path, value in values.items():
        instance[path] = value
    instance.scan()
    return {path: instance[path] for path in values}


def _compare(score: Score, path: str, kind: Elementary, said: Any, found: Any) -> None:
    if said is None:
        score.free += 1
        return
    score.compared += 1
    if kind.signed and kind.kind is Kind.INTEGER:
        said = signed(said, kind.width)
    if said != found and not (isinstance(found, float) and math.isnan(found) and math.isnan(said)):
        score.wrong = (*score.wrong[:9], f"{path}: the terms say {said}, the engine {found}")


def engine(name: str) -> Any:
    """The embedded engine, or one of matiec."""
    if name == "embedded":
        return EmbeddedEngine()
    return next(each.engine for each in survey().candidates() if each.name == name)


def main() -> int:
    """Compare all of them."""
    parser = argparse.ArgumentParser(description="The terms against an engine.")
    parser.add_argument("--calls", type=int, default=CALLS)
    parser.add_argument("--engine", default="embedded")
    options = parser.parse_args()
    bad = False
    for family, texts in sources().items():
        library = engine(options.engine).build(texts)
        for model in subjects(family):
            if isinstance(model.pou, Function) or model.subject.exact:
                continue
            score = compared(model, library, options.calls)
            words = f"{score.calls} calls, {score.compared} values compared, {score.free} left free"
            print(f"{model.pou.name} on {options.engine}: {words}, {len(score.wrong)} wrong", flush=True)
            print(*(f"  {each}" for each in score.wrong), sep="\n", end="\n" if score.wrong else "")
            bad = bad or bool(score.wrong)
    return int(bad)


if __name__ == "__main__":
    sys.exit(main())
