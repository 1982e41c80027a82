"""What the functions of the checker share: the declarations that an expression sees, and the list of problems."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from typing import Any

from structured_text.language.library import Library
from structured_text.language.report import Report
from structured_text.language.semantics.values import fits
from structured_text.language.tree import Expression, VarDecl
from structured_text.language.types import Type

# How the type of each kind of expression is found; the functions find the types of the parts by `infer`.
Inference = Mapping[type[Expression], Callable[["Scope", Any], Type]]


@dataclass(frozen=True, slots=True)
class Scope:
    """What is around a piece of text: a POU, a declared type, a block of globals or a configuration.

    `called` collects the functions that it calls, `written` the variables that it writes to, both in upper case.
    """

    library: Library
    report: Report
    inference: Inference
    symbols: dict[str, VarDecl] = field(default_factory=dict)
    called: set[str] = field(default_factory=set)
    written: set[str] = field(default_factory=set)
    in_loop: bool = False

    def around(self, symbols: dict[str, VarDecl]) -> "Scope":
        """Another piece of text, with variables of its own."""
        return replace(self, symbols=symbols, called=set(), written=set())

    def inside_loop(self) -> "Scope":
        """The same piece of text, inside a loop of it."""
        return replace(self, in_loop=True)

    def constant(self, name: str) -> Expression | None:
        """The initial value of a constant in scope."""
        symbol = self.symbols.get(name.upper())
        return symbol.initial if symbol is not None and symbol.constant else None


def infer(scope: Scope, value: Expression) -> Type:
    """The type of an expression, left in its slot; a number without prefix may still be untyped."""
    made: Type = scope.inference[type(value)](scope, value)
    value.type = made
    return made


def expect(scope: Scope, value: Expression, wanted: Type) -> None:
    """Check an expression that must be of the type `wanted`."""
    infer(scope, value)
    fits(scope.report, value, wanted)
