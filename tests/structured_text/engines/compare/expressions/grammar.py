"""What a random expression can be made of: one method per production, each with the rule name by which it is left out.

What the generator never makes, because C leaves it undefined and compilers differ, or the processor stops there: a
divisor that can be zero; a signed dividend over -1; a literal number of places of 32 or more in a shift; a conversion
to an integer of a REAL that came from an integer and does not fit; a position before the first character of a string;
the text of NaN; BCD of more than sixteen digits.
And what matiec refuses: an operation of literals alone, a sign before a sign. Everything else goes: overflows, shifts
by a variable beyond the width or below zero, conversions of any other REAL, NaN.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from tests.structured_text.engines.compare.draws import Draws
from tests.structured_text.engines.compare.expressions.terms import Term, atom, binary, call

SIGNED = {"SINT": 8, "INT": 16, "DINT": 32, "LINT": 64}
UNSIGNED = {"USINT": 8, "UINT": 16, "UDINT": 32, "ULINT": 64}
BITS = {"BYTE": 8, "WORD": 16, "DWORD": 32, "LWORD": 64}
WHOLE = {**SIGNED, **UNSIGNED}
REALS = ("REAL", "LREAL")
NUMBERS = (*WHOLE, *REALS)
TYPES = ("BOOL", *BITS, *WHOLE, *REALS, "TIME", "STRING")
VARIABLES = 3  # of each type
ELEMENTS = 4  # of the array of each type
WIDTH = {**WHOLE, **BITS}

TEXTS = {
    "BOOL": ["TRUE", "FALSE"],
    "TIME": ["T#0s", "T#20ms", "T#1s", "T#1m30s", "T#2.5s", "T#500ms", "T#1d"],
    "STRING": ["'a'", "'abc'", "'TRUE'", "'12'", "'-7'", "'b'", "'12.5'", "'16#1F'"],
}

Make = Callable[["Grammar", str, int], Term]


@dataclass(frozen=True)
class Production:
    """A way to make an expression: the name of its rule, the types that it can make, and how."""

    rule: str
    kinds: tuple[str, ...]
    make: Make


def limits(kind: str) -> tuple[int, int]:
    """The least and the greatest value of an integer type or bit string."""
    width = WIDTH[kind]
    return (-(1 << (width - 1)), (1 << (width - 1)) - 1) if kind in SIGNED else (0, (1 << width) - 1)


def variable(kind: str, number: int) -> str:
    """The name of one of the input variables of a type."""
    return f"v{kind}{number}"


def array(kind: str) -> str:
    """The name of the array type of a type."""
    return f"Some{kind}"


def elements(kind: str) -> str:
    """The name of the array variable of a type."""
    return f"a{kind}"


def function(kind: str) -> str:
    """The name of the function that takes two values of a type and returns the second."""
    return f"Second{kind}"


class Grammar:
    """Draws expressions of any type from a stream by productions."""

    def __init__(self, draws: Draws, productions: Sequence[Production]) -> None:
        """Take what is to be made, and the stream."""
        self.draws = draws
        self.productions = {kind: [each.make for each in productions if kind in each.kinds] for kind in TYPES}

    def expression(self, kind: str, depth: int) -> Term:
        """An expression of a type, at most `depth` operations deep."""
        if depth <= 0:
            return self.leaf(kind)
        return self.draws.one_of(self.productions[kind])(self, kind, depth - 1)

    def leaf(self, kind: str) -> Term:
        """A variable, or at times a literal."""
        if self.draws.chance(0.75):
            return self.variable(kind)
        return self.literal(kind)

    def variable(self, kind: str) -> Term:
        """One of the variables of a type."""
        return atom(kind, "variable", variable(kind, self.draws.whole(0, VARIABLES - 1)))

    def anchored(self, kind: str, depth: int) -> Term:
        """An expression that is no literal."""
        term = self.expression(kind, depth)
        return self.variable(kind) if term.rule == "literal" else term

    def typed(self, kind: str, depth: int) -> Term:
        """An expression whose type does not depend on where it stands."""
        term = self.expression(kind, depth)
        return term if is_typed(term) else self.variable(kind)

    def pair(self, kind: str, depth: int) -> tuple[Term, Term]:
        """Two operands of which at least one says the type of both."""
        left, right = self.typed(kind, depth), self.expression(kind, depth)
        return (left, right) if self.draws.chance(0.5) else (right, left)

    def several(self, kind: str, depth: int) -> list[Term]:
        """Two to four arguments; the first says the type of all."""
        return [self.typed(kind, depth), *(self.expression(kind, depth) for _ in range(self.draws.whole(1, 3)))]

    def join(self, kind: str, rule: str, left: Term, operator: str, right: Term) -> Term:
        """An operation, at times with parentheses that it does not need."""
        return binary(kind, rule, (left, operator, right), spare=self.draws.chance(0.2))

    def formals(self, *names: str) -> tuple[str, ...]:
        """The names of the parameters of a call, or none for a call by position."""
        return names if self.draws.chance(0.2) else ()

    # ------------------------------------------------------------ literals

    def literal(self, kind: str) -> Term:
        """A literal; integers and bit strings with and without their prefix."""
        return atom(kind, "literal", self._literal(kind))

    def _literal(self, kind: str) -> str:
        draws = self.draws
        if kind in REALS:
            text = draws.one_of(["0.0", "1.0", "0.5", "2.0", "0.1", "3.7", "1.0E10", "-1.5", "-0.1", "100.0"])
            return f"{kind}#{text}" if draws.chance(0.3) else text
        if kind in TEXTS:
            return draws.one_of(TEXTS[kind])
        number = draws.one_of(_edges(kind)) if draws.chance(0.3) else draws.whole(0, min(limits(kind)[1], 300))
        if kind in BITS:
            return f"{kind}#16#{number:X}" if draws.chance(0.7) else f"16#{number:X}"
        if number >= 0 and draws.chance(0.2):
            return draws.one_of([f"16#{number:X}", f"2#{number:b}", f"8#{number:o}"])
        return f"{kind}#{number}" if draws.chance(0.3) else str(number)

    def divisor(self, kind: str, depth: int) -> Term:
        """An integer that is neither zero nor minus one."""
        low, high = limits(kind)
        if self.draws.chance(0.5):
            number = self.draws.one_of([2, 3, 7, 10, 100, high, *([-2, -3, low] if low else [1])])
            return atom(kind, "literal", str(number))
        return call(kind, "extreme", "MAX", self.typed(kind, depth), atom(kind, "literal", "1"))


def is_typed(term: Term) -> bool:
    """Whether an expression has one type only: not a literal, nor LEN, FIND or TRUNC of whatever the context wants."""
    if term.rule in ("literal", "string-length", "string-find", "truncation"):
        return term.type not in (*WHOLE, *BITS, *REALS)
    if term.rule in ("minus", "absolute", "move", "arithmetic", "division", "modulo", "arithmetic-function"):
        return any(is_typed(child) for child in term.children)
    if term.rule in ("select", "multiplex"):
        return any(is_typed(child) for child in term.children[1:])
    return True


def _edges(kind: str) -> list[int]:
    low, high = limits(kind)
    return [0, 1, 2, high, high - 1, *([low + 1, -1, -2] if low else [])]
