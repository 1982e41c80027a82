"""A second, naive engine for a small part of ST: it walks random programs and wraps after every single operation.

It shares nothing with the compiler, above all not its reasoning about ranges. Programs are tuples:
`("set", name, expression)`, `("if", condition, then, else)`, `("while", counter, turns, body)`, `("exit",)`.
Expressions are an int, a name, or `(operator, left, right)`.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

# Name -> (type, bits, signed). Counters are UINTs that only WHILE writes.
VARIABLES = {
    "a": ("UINT", 16, False),
    "b": ("UINT", 16, False),
    "c": ("INT", 16, True),
    "d": ("INT", 16, True),
    "e": ("USINT", 8, False),
    "f": ("SINT", 8, True),
    "g": ("UDINT", 32, False),
    "h": ("DINT", 32, True),
}
COMPARISONS = ("<", "<=", ">", ">=", "=", "<>")
TABLE = tuple((7 * place + 3) % 16 for place in range(16))


class _ExitError(Exception):
    """EXIT on its way to its loop."""


def wrap(number: int, name: str) -> int:
    """The value of a variable's type."""
    _, bits, signed = VARIABLES[name]
    number %= 1 << bits
    return number - (1 << bits) if signed and number >= 1 << (bits - 1) else number


class Interpreter:
    """Runs a program on the given values; `values` holds what is left."""

    def __init__(self, values: dict[str, int]) -> None:
        """Start from these."""
        self.values = dict(values)

    def run(self, program: Sequence[Any]) -> None:
        """Run statements."""
        for statement in program:
            if statement[0] == "set":
                _, name, expression = statement
                self.values[name] = wrap(self.evaluate(expression, name), name)
            elif statement[0] == "if":
                _, condition, then, otherwise = statement
                self.run(then if self.holds(condition) else otherwise)
            elif statement[0] == "while":
                self._loop(statement)
            else:
                raise _ExitError

    def _loop(self, statement: Any) -> None:
        _, counter, turns, step, body = statement
        self.values[counter] = 0
        try:
            while self.values[counter] < turns:
                self.values[counter] += step
                self.run(body)
        except _ExitError:
            pass

    def holds(self, condition: Any) -> bool:
        """The truth of a comparison, or of a junction of two."""
        operator, left, right = condition
        if operator in ("AND", "OR"):
            one, two = self.holds(left), self.holds(right)
            return (one and two) if operator == "AND" else (one or two)
        # Both sides have the type of the variable on the left.
        mine, other = self.evaluate(left, left), self.evaluate(right, left)
        answers = (mine < other, mine <= other, mine > other, mine >= other, mine == other, mine != other)
        return dict(zip(COMPARISONS, answers, strict=True))[operator]

    def evaluate(self, expression: Any, name: str) -> int:
        """A value of the type of variable `name`."""
        if isinstance(expression, int):
            return expression
        if isinstance(expression, str):
            return self.values[expression]
        operator, left, right = expression
        one, two = self.evaluate(left, name), self.evaluate(right, name)
        if operator == "row":
            return TABLE[one % 16]
        if operator in ("/", "MOD"):
            quotient = abs(one) // abs(two) * (1 if (one < 0) == (two < 0) else -1)
            return wrap(quotient if operator == "/" else one - two * quotient, name)
        return wrap({"+": one + two, "-": one - two, "*": one * two}[operator], name)


def text_of(expression: Any, kind: str) -> str:
    """An expression in ST; literals carry their type."""
    if isinstance(expression, int):
        return f"{kind}#{expression}" if expression >= 0 else f"({kind}#0 - {kind}#{-expression})"
    if isinstance(expression, str):
        return expression
    operator, left, right = expression
    if operator == "row":
        return f"rows_{kind}[{text_of(left, kind)} MOD {kind}#16]"
    return f"({text_of(left, kind)} {operator} {text_of(right, kind)})"


def condition_text(condition: Any) -> str:
    """A condition in ST."""
    operator, left, right = condition
    if operator in ("AND", "OR"):
        return f"({condition_text(left)}) {operator} ({condition_text(right)})"
    return f"{left} {operator} {text_of(right, VARIABLES[left][0])}"


def lines_of(program: Sequence[Any]) -> list[str]:
    """A program in ST, one statement per line."""
    lines: list[str] = []
    for statement in program:
        if statement[0] == "set":
            lines.append(f"{statement[1]} := {text_of(statement[2], VARIABLES[statement[1]][0])};")
        elif statement[0] == "if":
            lines += [f"IF {condition_text(statement[1])} THEN", *lines_of(statement[2])]
            lines += ["ELSE", *lines_of(statement[3]), "END_IF;"] if statement[3] else ["END_IF;"]
        elif statement[0] == "while":
            _, counter, turns, step, body = statement
            lines += [f"{counter} := 0;", f"WHILE {counter} < {turns} DO", f"{counter} := {counter} + {step};"]
            lines += [*lines_of(body), "END_WHILE;"]
        else:
            lines.append("EXIT;")
    return lines or [";"]
