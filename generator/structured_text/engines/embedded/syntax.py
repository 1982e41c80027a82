"""Python syntax with places in Structured Text.

The compiler builds `ast` nodes, not text: every node carries the line and column of the ST that it comes from, so
that tracebacks, `sys.settrace` and coverage tools see ST lines, and a fault is traced to its column at no cost in a
scan that has none.
"""

import ast
from typing import Any

from structured_text.engines.embedded.certainty import known
from structured_text.language.tree import Unit


class Pen:
    """Writes Python nodes at the place where it was last moved to."""

    def __init__(self, unit: Unit) -> None:
        """Start at the first character of a source."""
        self.unit = unit
        self.here: dict[str, Any] = {}
        self.at = -1
        self.line = 1
        self.column = 1
        self.move(0)

    def move(self, at: int) -> None:
        """Go to an offset in the source; the nodes written from now on get that place."""
        if at == self.at:
            return
        self.at = at
        self.line, self.column = self.unit.place(at)
        left = self.column - 1
        self.here = {"lineno": self.line, "end_lineno": self.line, "col_offset": left, "end_col_offset": left + 1}

    def mark(self) -> int:
        """Where the pen is, for `back`."""
        return self.at

    def back(self, mark: int) -> None:
        self.move(mark)

    # ------------------------------------------------------------ expressions

    def name(self, name: str) -> ast.Name:
        return ast.Name(name, ast.Load(), **self.here)

    def constant(self, value: Any) -> ast.expr:
        """Write a number, bytes, text, None or a tuple of these; `compile` accepts negative numbers in a tree."""
        constant: Any = tuple(value) if isinstance(value, tuple) else value
        return ast.Constant(constant, **self.here)

    def attribute(self, base: ast.expr, name: str) -> ast.Attribute:
        """Read `base.name`."""
        return ast.Attribute(base, name, ast.Load(), **self.here)

    def item(self, base: ast.expr, index: ast.expr) -> ast.Subscript:
        """Read `base[index]`."""
        return ast.Subscript(base, index, ast.Load(), **self.here)

    def binary(self, left: ast.expr, operator: ast.operator, right: ast.expr) -> ast.BinOp:
        return ast.BinOp(left, operator, right, **self.here)

    def unary(self, operator: ast.unaryop, operand: ast.expr) -> ast.UnaryOp:
        """Put an operator before an operand."""
        return ast.UnaryOp(operator, operand, **self.here)

    def slice(self, base: ast.expr, upper: ast.expr | None = None) -> ast.Subscript:
        """Read `base[:upper]`."""
        return ast.Subscript(base, ast.Slice(None, upper, None, **self.here), ast.Load(), **self.here)

    def compare(self, left: ast.expr, *rest: tuple[ast.cmpop, ast.expr]) -> ast.Compare:
        """Chain comparisons: `left < a <= b`."""
        return ast.Compare(left, [each for each, _ in rest], [each for _, each in rest], **self.here)

    def junction(self, operator: ast.boolop, *values: ast.expr) -> ast.expr:
        """Join truth values by Python's short-circuit `and` or `or`."""
        return values[0] if len(values) == 1 else ast.BoolOp(operator, list(values), **self.here)

    def call(self, function: str, *arguments: ast.expr) -> ast.Call:
        return ast.Call(self.name(function), list(arguments), [], **self.here)

    def method(self, base: ast.expr, name: str, *arguments: ast.expr) -> ast.Call:
        """Call `base.name(...)`."""
        return ast.Call(self.attribute(base, name), list(arguments), [], **self.here)

    def choice(self, test: ast.expr, chosen: ast.expr, otherwise: ast.expr) -> ast.IfExp:
        """Write `chosen if test else otherwise`."""
        return ast.IfExp(test, chosen, otherwise, **self.here)

    def keep(self, name: str, value: ast.expr) -> ast.NamedExpr:
        """Write `name := value` inside an expression."""
        return ast.NamedExpr(ast.Name(name, ast.Store(), **self.here), value, **self.here)

    def row(self, *items: ast.expr) -> ast.Tuple:
        return ast.Tuple(list(items), ast.Load(), **self.here)

    # ------------------------------------------------------------ statements

    def assign(self, target: ast.expr, value: ast.expr) -> ast.Assign:
        """Write `target = value` for a target that was written as if to be read."""
        return ast.Assign([writable(target)], value, **self.here)

    def increment(self, target: ast.expr) -> ast.AugAssign:
        """Write `target += 1` for a subscript."""
        target = known(writable(target), ast.Subscript)
        return ast.AugAssign(target, ast.Add(), self.constant(1), **self.here)

    def statement(self, value: ast.expr) -> ast.Expr:
        """An expression as a statement; its value is not used."""
        return ast.Expr(value, **self.here)

    def branch(self, test: ast.expr, body: list[ast.stmt], otherwise: list[ast.stmt]) -> ast.If:
        """Write `if test: body else: otherwise`."""
        return ast.If(test, body or [self.nothing()], otherwise, **self.here)

    def each(self, items: ast.expr, body: list[ast.stmt], otherwise: list[ast.stmt]) -> ast.For:
        """Write `for turn in items: body else: otherwise`."""
        return ast.For(ast.Name("turn", ast.Store(), **self.here), items, body, otherwise, **self.here)

    def finish(self, body: list[ast.stmt], final: list[ast.stmt]) -> ast.Try:
        """Write `try: body finally: final`."""
        return ast.Try(body, [], [], final, **self.here)

    def leave(self, value: ast.expr | None = None) -> ast.Return:
        """Write `return value`."""
        return ast.Return(value, **self.here)

    def stop(self) -> ast.Break:
        return ast.Break(**self.here)

    def again(self) -> ast.Continue:
        """Write `continue`."""
        return ast.Continue(**self.here)

    def nothing(self) -> ast.Pass:
        return ast.Pass(**self.here)

    def function(self, name: str, parameters: list[str], body: list[ast.stmt]) -> ast.FunctionDef:
        """Write a function of positional parameters."""
        arguments = ast.arguments([], [ast.arg(each, **self.here) for each in parameters], None, [], [], None, [])
        return ast.FunctionDef(name, arguments, body or [self.nothing()], [], **self.here)


def writable(target: ast.expr) -> ast.expr:
    """The same name, attribute or subscript as the target of an assignment."""
    if isinstance(target, ast.Name):
        return ast.Name(target.id, ast.Store(), **place_of(target))
    if isinstance(target, ast.Attribute):
        return ast.Attribute(target.value, target.attr, ast.Store(), **place_of(target))
    target = known(target, ast.Subscript)
    return ast.Subscript(target.value, target.slice, ast.Store(), **place_of(target))


def place_of(node: ast.expr) -> dict[str, Any]:
    """The place of a node, as keywords of a new node."""
    line, left = node.lineno, node.col_offset
    return {"lineno": line, "end_lineno": line, "col_offset": left, "end_col_offset": left + 1}


_QUIET = (ast.Name, ast.Attribute, ast.Constant, ast.Compare, ast.BoolOp, ast.UnaryOp, ast.BinOp, ast.IfExp)
_FAULTY_OPERATORS = (ast.Div, ast.FloorDiv, ast.Mod, ast.Pow)


def is_quiet(node: ast.expr) -> bool:
    """Whether evaluating an expression can neither fail nor change anything."""
    for each in ast.walk(node):
        if isinstance(each, ast.expr) and not isinstance(each, _QUIET):
            return False
        if isinstance(each, _FAULTY_OPERATORS):
            return False
    return True
