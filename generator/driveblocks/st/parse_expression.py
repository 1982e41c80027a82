"""Expressions and initialisers: tokens -> tree, by precedence climbing (annex B.3.1; `-` and NOT bind tighter than **).

Accepts what real sources hold beyond the second edition (`w.3`, `p^`, `AND(a, b)`), for the linter to name.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NoReturn

from driveblocks.st import literals
from driveblocks.st.cursor import MOST_OPERATORS, Cursor, SyntaxProblem
from driveblocks.st.lexer import END
from driveblocks.st.reserved import HARD_KEYWORDS, KEYWORDS
from driveblocks.st.tree import (
    Argument,
    ArrayInitial,
    Binary,
    BitAccess,
    Call,
    Dereference,
    Direct,
    Expression,
    Index,
    Literal,
    LiteralKind,
    Member,
    Name,
    Qualified,
    Repeat,
    StructInitial,
    Unary,
)

POWERS = {"OR": 1, "XOR": 2, "AND": 3, "&": 3, "=": 4, "<>": 4, "<": 5, ">": 5, "<=": 5, ">=": 5}
POWERS |= {"+": 6, "-": 6, "*": 7, "/": 7, "MOD": 7, "**": 8}
_POSTFIX = frozenset([".", "[", "(", "^"])
# Operators that some dialects also write as functions.
_FUNCTION_OPERATORS = frozenset(["AND", "OR", "XOR", "MOD"])
_SOFT = KEYWORDS - HARD_KEYWORDS


class ExpressionParser(Cursor):
    """Parses expressions; every method starts at the next token and raises SyntaxProblem."""

    __slots__ = ()

    def expression(self, floor: int = 1) -> Expression:
        """An expression whose operators bind at least as tightly as `floor`."""
        kinds = self.kinds
        at = self.ats[self.i]
        left = self.unary()
        while True:
            op = kinds[self.i]
            power = POWERS.get(op, 0)
            if power < floor:
                return left
            self.i += 1
            self.operators += 1
            if self.operators > MOST_OPERATORS:
                self.too_long()
            right = self.expression(power + 1) if power < 8 else self.unary()
            left = Binary(at, "AND" if op == "&" else op, left, right)

    def unary(self) -> Expression:
        """A primary with the signs before it."""
        here = self.i
        kind = self.kinds[here]
        if kind == "name":
            return self.variable()
        if kind not in ("-", "NOT", "+"):
            return self.primary(kind)
        self.i = here + 1
        if kind == "-" and self.kinds[here + 1] == "number":
            return self.number("-")
        self.deeper()
        operand = self.unary()
        self.depth -= 1
        return Unary(self.ats[here], kind, operand)

    def primary(self, kind: str) -> Expression:
        """A literal, a parenthesis, or a name that looks like a keyword."""
        here = self.i
        if kind in _MAKERS:
            return self.literal(kind)
        if kind == "number":
            return self.number("")
        if kind == "(":
            return self.parenthesis()
        if kind == "direct":
            self.i = here + 1
            return self.postfix(Direct(self.ats[here], self.texts[here]))
        if kind in _SOFT or (kind in _FUNCTION_OPERATORS and self.kinds[here + 1] == "("):
            return self.variable()
        return self.fail("an expression")

    def number(self, sign: str) -> Literal:
        """A number without prefix, with the minus before it."""
        here = self.i
        self.i = here + 1
        text = self.texts[here]
        at = self.ats[here - 1] if sign else self.ats[here]
        try:
            made = literals.number(at, text)
        except ValueError as error:
            self.bad_literal(here, error)
        if sign and not isinstance(made.value, (bytes, str)):
            made.value, made.text = -made.value, sign + text
        return made

    def literal(self, kind: str) -> Literal | Qualified:
        """TRUE, FALSE, a literal with prefix, or a string."""
        here = self.i
        self.i = here + 1
        try:
            return _MAKERS[kind](self.ats[here], self.texts[here])
        except ValueError as error:
            self.bad_literal(here, error)

    def bad_literal(self, index: int, error: ValueError) -> NoReturn:
        """Note a literal without value. Raises SyntaxProblem."""
        said = str(error) if isinstance(error, literals.LiteralError) else "expected a shorter literal"
        self.problem(index, said if len(said) < 200 else said[:197] + "...")
        raise SyntaxProblem

    def parenthesis(self) -> Expression:
        """`( expression )`, and what may stand behind it."""
        self.i += 1
        self.deeper()
        inner = self.expression()
        self.depth -= 1
        self.expect(")")
        inner.parentheses += 1
        return inner

    def variable(self) -> Expression:
        """A name with its members, indices and arguments."""
        here = self.i
        self.i = here + 1
        name = Name(self.ats[here], self.texts[here])
        return self.postfix(name) if self.kinds[here + 1] in _POSTFIX else name

    def postfix(self, base: Expression) -> Expression:
        """Members, indices, arguments and `^` behind `base`."""
        before = self.depth
        while True:
            kind = self.kinds[self.i]
            if kind not in _POSTFIX:
                self.depth = before
                return base
            self.i += 1
            self.deeper()
            if kind == ".":
                base = self.member(base)
            elif kind == "[":
                base = Index(base.at, base, self.indices())
            elif kind == "(":
                base = Call(base.at, base, self.arguments())
            else:
                base = Dereference(base.at, base)

    def member(self, base: Expression) -> Expression:
        """What stands behind a dot: a field, or the number of a bit."""
        here = self.i
        kind, text = self.kinds[here], self.texts[here]
        if kind == "number" and text.isdigit() and len(text) < 4:
            self.i = here + 1
            return BitAccess(base.at, base, int(text), "X")
        if kind == "direct" and text[2:].isdigit() and text[1].upper() in "XBWD":
            self.i = here + 1
            return BitAccess(base.at, base, int(text[2:]), text[1].upper())
        if kind != "name" and kind not in KEYWORDS:
            self.fail("the name of a member")
        self.i = here + 1
        return Member(base.at, base, text)

    def indices(self) -> list[Expression]:
        """`i, j]`."""
        made = [self.expression()]
        while self.kinds[self.i] == ",":
            self.i += 1
            made.append(self.expression())
        self.expect("]")
        return made

    def arguments(self) -> list[Argument]:
        """`a := 1, b => c)`, behind the opening parenthesis."""
        made: list[Argument] = []
        if self.accept(")"):
            return made
        while True:
            made.append(self.argument())
            if self.kinds[self.i] != ",":
                break
            self.i += 1
        if self.kinds[self.i] != ")":
            self.fail("`,` or `)`")
        self.i += 1
        return made

    def argument(self) -> Argument:
        """One argument, formal or positional."""
        here = self.i
        at, kinds = self.ats[here], self.kinds
        negated = kinds[here] == "NOT" and kinds[here + 1] == "name" and kinds[here + 2] == "=>"
        first = here + 1 if negated else here
        sign = kinds[first + 1] if kinds[first] != END else ""
        if sign not in (":=", "=>") or (kinds[first] != "name" and kinds[first] not in KEYWORDS):
            return Argument(at, None, self.expression())
        self.i = first + 2
        value = None if kinds[self.i] in (",", ")") else self.expression()
        return Argument(at, self.texts[first], value, sign == "=>", negated)

    def initial(self) -> Expression:
        """What stands behind `:=` in a declaration: an expression, `[...]` or `(a := 1)`."""
        kind = self.kinds[self.i]
        self.operators = 0
        if kind == "[":
            return self.array_initial()
        if kind == "(" and self.kinds[self.i + 2] == ":=":
            return self.struct_initial()
        return self.expression()

    def array_initial(self) -> ArrayInitial:
        """`[1, 2(0), 3]`."""
        at = self.ats[self.i]
        self.i += 1
        self.deeper()
        items: list[Expression] = []
        while self.kinds[self.i] != "]":
            items.append(self.array_item())
            if not self.accept(","):
                break
        self.expect("]")
        self.depth -= 1
        return ArrayInitial(at, items)

    def array_item(self) -> Expression:
        """An initial value, or `count(value)`."""
        here = self.i
        if self.kinds[here] != "number" or self.kinds[here + 1] != "(":
            return self.initial()
        count = self.number("")
        self.i += 1
        value = None if self.kinds[self.i] == ")" else self.initial()
        self.expect(")")
        return Repeat(self.ats[here], count, value)

    def struct_initial(self) -> StructInitial:
        """`(a := 1, b := [2, 3])`."""
        at = self.ats[self.i]
        self.i += 1
        self.deeper()
        items: list[Argument] = []
        while True:
            here = self.ats[self.i]
            name = self.name("the name of a field")
            self.expect(":=")
            items.append(Argument(here, name, self.initial()))
            if not self.accept(","):
                break
        self.expect(")")
        self.depth -= 1
        return StructInitial(at, items)


def _boolean(at: int, text: str) -> Literal:
    """TRUE or FALSE."""
    return Literal(at, text, LiteralKind.BOOL, text.upper() == "TRUE")


_MAKERS: dict[str, Callable[[int, str], Literal | Qualified]] = {
    "TRUE": _boolean,
    "FALSE": _boolean,
    "typed": literals.typed,
    "string": literals.string,
    "wstring": literals.wide_string,
}
