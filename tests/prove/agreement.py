"""Do the terms say what the engines do? Random calls of every block of which something is proved, full state compared.

    python -m tests.prove.agreement [--calls N] [--engine NAME]

An integer that leaves its width wraps on the embedded engine, as the terms do. What the terms leave free, a REAL that
is reckoned with, is compared with nothing; how much that is, is said.
"""

import argparse
import math
import struct
import sys
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cache
from random import Random
from typing import Any

import z3
from tests import shipped

from driveblocks.prove import prover, rules
from driveblocks.prove.facts import facts
from driveblocks.prove.model import Model, models
from driveblocks.prove.operations import Term, arithmetic, sums
from structured_text.engines.discovery import survey
from structured_text.engines.embedded.engine import EmbeddedEngine
from structured_text.engines.engine import Instance, Library, ScanError, Source
from structured_text.language.tree import Function, VarKind
from structured_text.language.types import Elementary, Kind

CALLS = 1000
SEED = 31
MOST_REFUSED = 20
"""Refused calls for one that is compared, at most."""
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
    return dict(prover.texts(shipped.sources()))


@cache
def subjects(family: str) -> list[Model]:
    """The blocks of a family of which something is proved; of those that all share the ones that leave no part free."""
    if family == prover.GENERIC:
        return models(sources()[family], [each for each in rules.shared() if not each.loose])
    drive = next(each.drive for each in shipped.sources() if each.path.stem == family)
    return models(sources()[family], rules.family(facts(drive)))


def summed(terms: Sequence[Term]) -> list[Term]:
    """Terms with their sums of REALs as they are computed, all at once."""
    whole = z3.Function("whole", *(each.sort() for each in terms), z3.BoolSort())(*terms)
    for (op, *_), (name, left, right) in reversed(sums.items()):  # what is summed was named before its sum
        whole = z3.substitute(whole, (name, arithmetic(op, left, right)))
    return list(whole.children())


def nothing(kind: Elementary) -> Any:
    """What a variable of a function is before its first assignment."""
    return False if kind.kind is Kind.BOOL else 0.0 if kind.kind is Kind.REAL else 0


def drawn(random: Random, kind: Elementary) -> Any:
    """A value of a type, near the edges more often than not."""
    if kind.kind is Kind.BOOL:
        return random.random() < 0.5
    if kind.kind is Kind.REAL:
        return struct.unpack("<f", struct.pack("<f", random.choice(REALS)))[0]
    value = random.choice(EDGES) if random.random() < 0.7 else random.getrandbits(kind.width)
    return value % (1 << kind.width) if not kind.signed else value % (1 << (kind.width - 1))


def signed(value: int, width: int) -> int:
    """A number of some bits as one with a sign."""
    return value - (1 << width) if value >> (width - 1) else value


def constant(value: Any, sort: z3.SortRef) -> Term:
    """A value as a term."""
    if isinstance(value, bool):
        return z3.BoolVal(value)
    return z3.FPVal(value, sort) if isinstance(value, float) else z3.BitVecVal(value, sort)


def known(term: Term) -> Any:
    """The value of a term that has one; None of one that is left free."""
    if z3.is_fp(term):
        bits = z3.simplify(z3.fpToIEEEBV(term))
        return struct.unpack("<f", struct.pack("<I", bits.as_long()))[0] if z3.is_bv_value(bits) else None
    if z3.is_bv_value(term):
        return term.as_long()
    return z3.is_true(term) if z3.is_true(term) or z3.is_false(term) else None


def compared(model: Model, library: Library, calls: int) -> Score:
    """Run calls of a block both ways; every second finds what the one before has left. A function remembers nothing."""
    kinds = {path: kind for path, (_, kind) in model.scalars.items()}
    function = isinstance(model.pou, Function)
    shown = {"RESULT": kinds[model.pou.name.upper()]} if function else kinds
    bounds = [each.term for each in model.obligations if each.words.startswith("the index")]
    after_call = [*summed([model.after[path] for path in shown]), z3.And(bounds)]
    whole = z3.Function("whole", *(each.sort() for each in after_call), z3.BoolSort())(*after_call)
    random, score = Random(SEED), Score()
    instance = library.instance(f"{model.pou.name}_Call" if function else model.pou.name)
    given = [path for path in kinds if not model.inputs[path].eq(model.before[path])]
    state: dict[str, Any] = {path: nothing(kind) for path, kind in kinds.items()}
    while score.calls < calls and score.refused < MOST_REFUSED * calls:
        if not function and ((score.calls + score.refused) % 2 == 0 or not state):
            state = {path: drawn(random, kind) for path, kind in kinds.items()}
        inputs = {path: drawn(random, kinds[path]) for path in given}
        names = [(model.before[path], value) for path, value in state.items()]
        names += [(model.inputs[path], value) for path, value in inputs.items()]
        terms = z3.simplify(z3.substitute(whole, *((name, constant(value, name.sort())) for name, value in names)))
        *said, within = map(known, terms.children())
        after = _run(instance, inputs if function else state | inputs, shown) if within else None
        if after is None:
            state, score.refused = state if function else {}, score.refused + 1
            continue
        for (path, kind), value in zip(shown.items(), said, strict=True):
            _compare(score, path, kind, value, after[path])
        score.calls += 1
        state = state if function else after
    return score


def wrapped(texts: list[Source], those: list[Model]) -> list[Source]:
    """The texts, and a block around each function, which calls it."""
    made = [Source(f"{each.pou.name}_Call.st", _around(each.pou)) for each in those if isinstance(each.pou, Function)]
    return [*texts, *made]


def _around(function: Function) -> str:
    """A block with the inputs of a function, and its result."""
    inputs = [each for each in function.symbols.values() if each.kind is VarKind.INPUT]
    declared = "\n".join(f"  {each.name} : {each.type};" for each in inputs)
    handed = ", ".join(f"{each.name} := {each.name}" for each in inputs)
    result = function.symbols[function.name.upper()].type
    return (
        f"FUNCTION_BLOCK {function.name}_Call\nVAR_INPUT\n{declared}\nEND_VAR\nVAR_OUTPUT\n  Result : {result};\n"
        f"END_VAR\n  Result := {function.name}({handed});\nEND_FUNCTION_BLOCK\n"
    )


def _run(instance: Instance, values: dict[str, Any], shown: Iterable[str]) -> dict[str, Any] | None:
    """A call; all that an instance remembers is given to it, so one does for all calls.

    None: a result leaves its width, or an index its array, which the rules exclude, and matiec does not notice.
    """
    for path, value in values.items():
        instance[path] = value
    try:
        instance.scan()
    except ScanError:
        return None
    return {path: instance[path] for path in shown}


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
        library = engine(options.engine).build(wrapped(texts, subjects(family)))
        for model in subjects(family):
            score = compared(model, library, options.calls)
            words = f"{score.calls} calls, {score.compared} values compared, {score.free} left free"
            words += f", {score.refused} calls beside refused" if score.refused else ""
            print(f"{model.pou.name} on {options.engine}: {words}, {len(score.wrong)} wrong", flush=True)
            print(*(f"  {each}" for each in score.wrong), sep="\n", end="\n" if score.wrong else "")
            bad = bad or bool(score.wrong)
    return int(bad)


if __name__ == "__main__":
    sys.exit(main())
