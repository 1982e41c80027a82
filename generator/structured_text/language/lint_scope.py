"""What a portability rule sees of one POU."""

from collections.abc import Iterator
from dataclasses import dataclass, field

from structured_text.language.ranges import Ranges, ranges_of
from structured_text.language.report import Report
from structured_text.language.tree import ArrayInitial, Checked, Expression, Literal, Pou, Repeat, Statement
from structured_text.language.walk import expressions, heads, statements


@dataclass(slots=True)
class Scope:
    """A POU with what it belongs to. `statements` and `heads` are collected once, since every rule walks over them."""

    pou: Pou
    checked: Checked
    report: Report
    statements: list[Statement] = field(init=False)
    heads: list[Expression] = field(init=False)
    expressions: list[Expression] = field(init=False)
    _ranges: Ranges | None = field(default=None, init=False)

    def __post_init__(self) -> None:
        self.statements = list(statements(self.pou.body))
        self.heads = [head for statement in self.statements for head in heads(statement)]
        self.expressions = [each for head in self.heads for each in expressions(head)]

    @property
    def ranges(self) -> Ranges:
        """The ranges of the POU's variables, made when first wanted."""
        if self._ranges is None:
            self._ranges = ranges_of(self.pou, self.statements, self.expressions)
        return self._ranges

    def add(self, at: int, rule: str, text: str) -> None:
        self.report.add(at, rule, text)

    def initials(self) -> Iterator[Expression]:
        """Every initial value of the declarations, each once."""
        for block in self.pou.blocks:
            for variable in block.variables:
                if variable.initial is not None and not variable.grouped:
                    yield variable.initial


def literals_of(value: Expression) -> list[Literal]:
    """The literals of an initial value, without the counts of its repetitions."""
    made: list[Literal] = []
    stack = [value]
    while stack:
        here = stack.pop()
        if isinstance(here, Literal):
            made.append(here)
        elif isinstance(here, Repeat):
            stack.extend([] if here.value is None else [here.value])
        elif isinstance(here, ArrayInitial):
            stack.extend(here.items)
        else:
            stack.extend(each for each in expressions(here) if each is not here and isinstance(each, Literal))
    return made
