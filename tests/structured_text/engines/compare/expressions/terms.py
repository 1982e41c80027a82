"""Random ST expressions as trees, so that a failing one can be made smaller."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

# How tightly operators bind (IEC 61131-3 table 55), tightest first; an atom needs no parentheses anywhere.
ATOM, UNARY, POWER, PRODUCT, SUM, ORDER, EQUAL, AND, XOR, OR = range(10)
PRECEDENCE = {
    "**": POWER,
    "*": PRODUCT,
    "/": PRODUCT,
    "MOD": PRODUCT,
    "+": SUM,
    "-": SUM,
    "<": ORDER,
    ">": ORDER,
    "<=": ORDER,
    ">=": ORDER,
    "=": EQUAL,
    "<>": EQUAL,
    "AND": AND,
    "&": AND,
    "XOR": XOR,
    "OR": OR,
}


@dataclass(frozen=True)
class Term:
    """An expression of an ST type. `rule` names the production that made it; `level` how tightly it binds."""

    type: str
    rule: str
    pieces: tuple[str | Term, ...]
    level: int = ATOM

    @cached_property
    def text(self) -> str:
        """The expression as ST."""
        return "".join(piece if isinstance(piece, str) else piece.text for piece in self.pieces)

    @property
    def children(self) -> list[Term]:
        """The expressions it is made of."""
        return [piece for piece in self.pieces if isinstance(piece, Term)]

    def walk(self) -> Iterator[Term]:
        """It and everything below it, outermost first."""
        yield self
        for child in self.children:
            yield from child.walk()


def atom(kind: str, rule: str, text: str) -> Term:
    """A variable or literal."""
    return Term(kind, rule, (text,))


def call(kind: str, rule: str, name: str, *arguments: Term, formals: Sequence[str] = ()) -> Term:
    """`name(a, b, ...)`, or with `formals` `name(formal := a, ...)`."""
    pieces: list[str | Term] = [name, "("]
    for number, argument in enumerate(arguments):
        pieces += [", " if number else "", f"{formals[number]} := " if formals else "", argument]
    return Term(kind, rule, (*pieces, ")"))


def unary(kind: str, rule: str, operator: str, operand: Term) -> Term:
    """`-x`, `NOT x`; what is no atom gets parentheses, for matiec takes no second sign."""
    spaced = operator + " " if operator.isalpha() else operator
    bare = operand.level == ATOM and not operand.text.startswith("-")
    return Term(kind, rule, (spaced, *((operand,) if bare else ("(", operand, ")"))), UNARY)


def binary(kind: str, rule: str, parts: tuple[Term, str, Term], spare: bool = False) -> Term:
    """`a op b` with the parentheses that the tree needs, and with `spare` ones that it does not."""
    left, operator, right = parts
    level = PRECEDENCE[operator]
    first = _within(left, left.level > level or spare)
    second = _within(right, right.level >= level or spare)
    return Term(kind, rule, (*first, f" {operator} ", *second), level)


def _within(term: Term, parentheses: bool) -> tuple[str | Term, ...]:
    return ("(", term, ")") if parentheses and term.level != ATOM else (term,)
