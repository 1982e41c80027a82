"""Many expressions in one source, their values on an engine, and what differs."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from tests.structured_text.engines.compare.draws import Draws, single
from tests.structured_text.engines.compare.expressions.grammar import (
    BITS,
    ELEMENTS,
    REALS,
    TYPES,
    VARIABLES,
    WHOLE,
    Grammar,
    array,
    elements,
    function,
    limits,
    variable,
)
from tests.structured_text.engines.compare.expressions.productions import PRODUCTIONS
from tests.structured_text.engines.compare.expressions.terms import Term
from tests.structured_text.engines.compare.lockstep import alike

from structured_text.engines.engine import Engine, Instance, ScanError, Source, Value

# Statements per function block: C compilers take more than twice as long for twice as many.
PER_BLOCK = 100
# One each, so that an expression that fails does not stop the others.
ALONE = 1
# Most bugs show in small expressions, and large ones cost the C compiler most of its time.
DEPTHS = (1, 1, 1, 2, 2, 2, 3, 4)

Inputs = dict[str, Value]


@dataclass(frozen=True)
class Batch:
    """Expressions, the inputs to evaluate each of them with, and how many go into a function block."""

    terms: tuple[Term, ...]
    vectors: tuple[Inputs, ...]
    per_block: int = PER_BLOCK

    @property
    def text(self) -> str:
        """The source: what every expression may use, then blocks E0, E1 ... with one statement per expression."""
        blocks = [self.terms[at : at + self.per_block] for at in range(0, len(self.terms), self.per_block)]
        return PRELUDE + "".join(_block(number, terms) for number, terms in enumerate(blocks))

    def place(self, line: int) -> int:
        """The number of the expression on a line of the text; of another line, that of the block's first."""
        lines = self.text.splitlines()[:line]
        blocks = sum(each.startswith("FUNCTION_BLOCK ") for each in lines)
        statement, assigned, _ = lines[-1].partition(" := ")
        own = int(statement.strip().removeprefix("o")) if assigned else 0
        return (blocks - 1) * self.per_block + own


def _prelude(kind: str) -> str:
    """An array type and a function of a type: stores into its parameters cut what they are given."""
    return f"""TYPE
  {array(kind)} : ARRAY[0..{ELEMENTS - 1}] OF {kind};
END_TYPE
FUNCTION {function(kind)} : {kind}
VAR_INPUT
  First : {kind};
  Second : {kind};
END_VAR
  {function(kind)} := Second;
END_FUNCTION
"""


PRELUDE = "".join(_prelude(kind) for kind in TYPES)


def _block(number: int, terms: Sequence[Term]) -> str:
    inputs = [f"  {', '.join(variable(kind, n) for n in range(VARIABLES))} : {kind};" for kind in TYPES]
    arrays = [f"  {elements(kind)} : {array(kind)};" for kind in TYPES]
    outputs = [f"  o{n} : {term.type};" for n, term in enumerate(terms)]
    body = [f"  o{n} := {term.text};" for n, term in enumerate(terms)]
    lines = [f"FUNCTION_BLOCK E{number}", "VAR_INPUT", *inputs, "END_VAR", "VAR_OUTPUT", *outputs, "END_VAR"]
    return "\n".join([*lines, "VAR", *arrays, "END_VAR", *body, "END_FUNCTION_BLOCK", ""])


def make_batch(seed: object, count: int, vectors: int, without: Sequence[str] = ()) -> Batch:
    """This many random expressions with this many random inputs."""
    draws = Draws("expressions", seed)
    grammar = Grammar(draws, [each for each in PRODUCTIONS if each.rule not in without])
    terms = tuple(grammar.expression(draws.one_of(TYPES), draws.one_of(DEPTHS)) for _ in range(count))
    return Batch(terms, tuple(dict(_vector(draws)) for _ in range(vectors)))


def _vector(draws: Draws) -> Iterator[tuple[str, Value]]:
    for kind in TYPES:
        for number in range(VARIABLES):
            yield variable(kind, number), _value(draws, kind)
        yield elements(kind), [_value(draws, kind) for _ in range(ELEMENTS)]


def _value(draws: Draws, kind: str) -> Value:
    if kind == "BOOL":
        return draws.chance(0.5)
    if kind in WHOLE or kind in BITS:
        return _integer(draws, *limits(kind))
    if kind in REALS:
        number = _number(draws)
        return single(number) if kind == "REAL" else number
    if kind == "TIME":
        return _duration(draws)
    return _text(draws)


def _integer(draws: Draws, low: int, high: int) -> int:
    if draws.chance(0.4):
        return draws.one_of([0, 1, high, high - 1, low, low + 1, high // 2, *([-1, -2] if low else [])])
    if draws.chance(0.5):
        return draws.whole(max(low, -20), 40)
    return draws.whole(low, high)


def _number(draws: Draws) -> float:
    if draws.chance(0.3):
        special = [0.0, -0.0, 0.5, -0.5, 1.5, 2.5, 1.0, float("nan"), float("inf"), float("-inf"), 1e30, -1e30, 1e-30]
        return draws.one_of(special)
    return draws.between(-10.0, 10.0) if draws.chance(0.6) else draws.between(-1e10, 1e10)


def _duration(draws: Draws) -> int:
    """Nanoseconds: whole milliseconds, seconds, or anything up to some days."""
    unit = draws.one_of([1, 1_000_000, 1_000_000_000])
    return unit * draws.one_of([0, 1, 500, draws.whole(-1000, 100_000)])


def _text(draws: Draws) -> bytes:
    if draws.chance(0.3):
        return draws.one_of([b"", b"a", b"TRUE", b"false", b"1", b"-12", b"16#FF", b"2#101", b"8#17", b"3.75", b"abc"])
    return bytes(draws.whole(32, 126) for _ in range(draws.one_of([1, 2, 3, 5, 10, 60, 126])))


@dataclass(frozen=True)
class Mismatch:
    """An expression on which two engines differ, with the inputs that show it."""

    term: Term
    inputs: Inputs
    values: Mapping[str, Value]

    def __str__(self) -> str:
        """Print the expression, its values and the inputs that it reads."""
        values = ", ".join(f"{engine}: {value!r}" for engine, value in self.values.items())
        used = {name: value for name, value in self.inputs.items() if name in self.term.text}
        return f"{self.term.type} {self.term.text}\n  {values}\n  with {used}"


class Trap(Exception):  # noqa: N818 - not an error of the test, but of one expression
    """A scan stopped at an expression; `number` says which, as far as the engine knows."""

    def __init__(self, number: int) -> None:
        """Keep the number."""
        super().__init__(number)
        self.number = number


def evaluate(engine: Engine, batch: Batch) -> list[list[Value]]:
    """The values of all expressions, one list per vector. Raises Trap, BuildError."""
    library = engine.build([Source("expressions.st", batch.text)])
    instances = [library.instance(f"E{number}") for number in range(-(-len(batch.terms) // batch.per_block))]
    results = []
    for vector in batch.vectors:
        values: list[Value] = []
        for instance in instances:
            for name, value in vector.items():
                instance[name] = value
            try:
                instance.scan(0)
            except ScanError as error:
                raise Trap(batch.place(error.message.line)) from error
            state = instance.state()
            values += [state[f"O{n}"] for n in range(min(batch.per_block, len(batch.terms) - len(values)))]
        results.append(values)
    return results


def where_all_agree(embedded: Engine, batch: Batch) -> tuple[Batch, list[list[Value]]]:
    """The expressions to which the embedded engine gives a value with all inputs, and these; at others it stops."""
    library = embedded.build([Source("expressions.st", replace(batch, per_block=ALONE).text)])
    values = [
        [_alone(library.instance(f"E{number}"), vector) for number in range(len(batch.terms))]
        for vector in batch.vectors
    ]
    kept = [number for number in range(len(batch.terms)) if all(each[number] is not None for each in values)]
    terms = tuple(batch.terms[number] for number in kept)
    given = [[value for number in kept if (value := each[number]) is not None] for each in values]
    return replace(batch, terms=terms), given


def _alone(instance: Instance, vector: Inputs) -> Value | None:
    for name, value in vector.items():
        instance[name] = value
    try:
        instance.scan(0)
    except ScanError:
        return None
    return instance["o0"]


def mismatches(
    batch: Batch, names: tuple[str, str], left: list[list[Value]], right: list[list[Value]]
) -> list[Mismatch]:
    """Every expression whose values differ, once each, with the first inputs that show it."""
    found: dict[int, Mismatch] = {}
    for vector, first, second in zip(batch.vectors, left, right, strict=True):
        for number, (one, other) in enumerate(zip(first, second, strict=True)):
            if not alike(one, other) and number not in found:
                found[number] = Mismatch(batch.terms[number], vector, {names[0]: one, names[1]: other})
    return list(found.values())
