"""The one thing that all parts of the compiler share while they work on one POU."""

import ast
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

from structured_text.engines.coverage import Outcome
from structured_text.engines.embedded.certainty import present
from structured_text.engines.embedded.faults import Access, Accesses
from structured_text.engines.embedded.floats import Floats
from structured_text.engines.embedded.ranges import Ranges
from structured_text.engines.embedded.shapes import Shapes
from structured_text.engines.embedded.syntax import Pen
from structured_text.engines.embedded.terms import Term
from structured_text.engines.embedded.widths import Widths
from structured_text.language import tree
from structured_text.language.tree import VarKind

# The Python variable that holds the instance in a block's body, and the slot of an instance that holds the globals.
SELF = "s"
GLOBALS = "globals_"


class UnsupportedError(Exception):
    """A construct that the engine does not run, with its offset in the source."""

    def __init__(self, at: int, text: str) -> None:
        self.at = at
        super().__init__(text)


@dataclass(slots=True)
class OpenLoop:
    """A loop that is being compiled: what CONTINUE has to do first, and what is known at every EXIT and CONTINUE."""

    before_continue: Callable[[], list[ast.stmt]]
    exits: list[Ranges] = field(default_factory=list)
    continues: list[Ranges] = field(default_factory=list)


# How each kind of expression and of statement is compiled; the functions compile the parts by `parts`.
Terms = Mapping[type[tree.Expression], Callable[["Scope", Any], Term]]
Statements = Mapping[type[tree.Statement], Callable[["Scope", Any], list[ast.stmt]]]


@dataclass(slots=True)
class Scope:
    """The state of compiling one POU."""

    pou: tree.Pou | None
    coverage: bool
    strict: bool
    pen: Pen
    shapes: Shapes
    accesses: Accesses
    ranges: Ranges
    objects: dict[str, Any]
    terms: Terms
    statements: Statements
    hoisted: set[tree.VarDecl] = field(default_factory=set)
    loops: list[OpenLoop] = field(default_factory=list)
    temporaries: int = 0
    widths: Widths = field(init=False)
    floats: Floats = field(init=False)

    def __post_init__(self) -> None:
        self.widths = Widths(self.pen, self.fresh)
        self.floats = Floats(self.pen, self.strict)

    def fresh(self) -> str:
        """A name for a temporary variable."""
        self.temporaries += 1
        return f"t{self.temporaries}"

    def is_function(self) -> bool:
        """Whether variables live in Python variables rather than in an instance."""
        return isinstance(self.pou, tree.Function)

    def is_local(self, variable: tree.VarDecl) -> bool:
        """Whether a variable is, here and now, a Python variable."""
        return self.is_function() or variable.kind is VarKind.TEMP or variable in self.hoisted

    def slot(self, variable: tree.VarDecl) -> ast.expr:
        """Where an instance keeps a variable."""
        if variable.kind is VarKind.EXTERNAL:
            instance = self.pen.attribute(self.pen.name(SELF), GLOBALS)
            return self.pen.attribute(instance, self.shapes.global_slot(present(variable.target)))
        return self.pen.attribute(self.pen.name(SELF), variable.name.upper())

    def variable(self, variable: tree.VarDecl) -> ast.expr:
        """A variable, to be read or turned into a target."""
        if self.is_local(variable):
            return self.pen.name(variable.name.upper())
        return self.slot(variable)

    def object(self, prefix: str, value: Any) -> str:
        """The global name under which compiled ST finds a Python object."""
        name = f"{prefix}_{len(self.objects)}"
        self.objects[name] = value
        return name

    def counter(self, kind: str, what: int | Outcome) -> int:
        """The place in `counts` of what counts a line (`hits`) or an outcome (`outcomes`) of this source."""
        counts = self.objects.setdefault("counts", [])
        places: dict[int | Outcome, int] = self.objects.setdefault(f"{kind}_{self.pen.unit.path}", {})
        if what not in places:
            places[what] = len(counts)
            counts.append(0)
        return places[what]

    def note_access(self, name: str, low: int, high: int, offset: ast.expr) -> None:
        """Remember an array access at the place of the pen, for the message if it fails."""
        key = self.pen.unit.path, self.pen.line, self.pen.column
        self.accesses.table[key] = Access(name, low, high, offset)
