"""Expressions and initialisers: tokens -> tree, by precedence climbing (annex B.3.1; `-` and NOT bind tighter than **).

Accepts what real sources hold beyond the second edition (`w.3`, `p^`, `AND(a, b)`), for the linter to name.
"""

from collections.abc import Callable
from typing import NoReturn

from structured_text.language import literals, tree
from structured_text.language.grammar.cursor import MOST_OPERATORS, Cursor, SyntaxProblem
from structured_text.language.lexer import END
from structured_text.language.reserved import HARD_KEYWORDS, KEYWORDS

POWERS = {"OR": 1, "XOR": 2, "AND": 3, "&": 3, "=": 4, "<>": 4, "<": 5, ">": 5, "<=": 5, ">=": 5}
POWERS |= {"+": 6, "-": 6, "*": 7, "/": 7, "MOD": 7, "**": 8}
_POSTFIX = frozenset([".", "[", "(", "^"])
# Operators that some dialects also write as functions.
_FUNCTION_OPERATORS = frozenset(["AND", "OR", "XOR", "MOD"])
_SOFT = KEYWORDS - HARD_KEYWORDS


def expression(cursor: Cursor, floor: int = 1) -> tree.Expression:
    """An expression whose operators bind at least as tightly as `floor`."""
    kinds = cursor.kinds
    at = cursor.ats[cursor.i]
    left = unary(cursor)
    while True:
        op = kinds[cursor.i]
        power = POWERS.get(op, 0)
        if power < floor:
            return left
        cursor.i += 1
        cursor.operators += 1
        if cursor.operators > MOST_OPERATORS:
            cursor.too_long()
        right = expression(cursor, power + 1) if power < 8 else unary(cursor)
        left = tree.Binary(at, "AND" if op == "&" else op, left, right)


def unary(cursor: Cursor) -> tree.Expression:
    """A primary with the signs before it."""
    here = cursor.i
    kind = cursor.kinds[here]
    if kind == "name":
        return variable(cursor)
    if kind not in ("-", "NOT", "+"):
        return _primary(cursor, kind)
    cursor.i = here + 1
    if kind == "-" and cursor.kinds[here + 1] == "number":
        return number(cursor, "-")
    cursor.deeper()
    operand = unary(cursor)
    cursor.depth -= 1
    return tree.Unary(cursor.ats[here], kind, operand)


def _primary(cursor: Cursor, kind: str) -> tree.Expression:
    """A literal, a parenthesis, or a name that looks like a keyword."""
    here = cursor.i
    if kind in _MAKERS:
        return _literal(cursor, kind)
    if kind == "number":
        return number(cursor, "")
    if kind == "(":
        return _parenthesis(cursor)
    if kind == "direct":
        cursor.i = here + 1
        return _postfix(cursor, tree.Direct(cursor.ats[here], cursor.texts[here]))
    if kind in _SOFT or (kind in _FUNCTION_OPERATORS and cursor.kinds[here + 1] == "("):
        return variable(cursor)
    return cursor.fail("an expression")


def number(cursor: Cursor, sign: str) -> tree.Literal:
    """A number without prefix, with the minus before it."""
    here = cursor.i
    cursor.i = here + 1
    text = cursor.texts[here]
    at = cursor.ats[here - 1] if sign else cursor.ats[here]
    try:
        made = literals.number(at, text)
    except ValueError as error:
        _bad_literal(cursor, here, error)
    if sign and not isinstance(made.value, (bytes, str)):
        made.value, made.text = -made.value, sign + text
    return made


def _literal(cursor: Cursor, kind: str) -> tree.Literal | tree.Qualified:
    """TRUE, FALSE, a literal with prefix, or a string."""
    here = cursor.i
    cursor.i = here + 1
    try:
        return _MAKERS[kind](cursor.ats[here], cursor.texts[here])
    except ValueError as error:
        _bad_literal(cursor, here, error)


def _bad_literal(cursor: Cursor, index: int, error: ValueError) -> NoReturn:
    """Note a literal without value. Raises SyntaxProblem."""
    said = str(error) if isinstance(error, literals.LiteralError) else "expected a shorter literal"
    cursor.problem(index, said if len(said) < 200 else said[:197] + "...")
    raise SyntaxProblem


def _parenthesis(cursor: Cursor) -> tree.Expression:
    """`( expression )`, and what may follow it."""
    cursor.i += 1
    cursor.deeper()
    inner = expression(cursor)
    cursor.depth -= 1
    cursor.expect(")")
    inner.parentheses += 1
    return inner


def variable(cursor: Cursor) -> tree.Expression:
    """A name with its members, indices and arguments."""
    here = cursor.i
    cursor.i = here + 1
    name = tree.Name(cursor.ats[here], cursor.texts[here])
    return _postfix(cursor, name) if cursor.kinds[here + 1] in _POSTFIX else name


def _postfix(cursor: Cursor, base: tree.Expression) -> tree.Expression:
    """Members, indices, arguments and `^` after `base`."""
    before = cursor.depth
    while True:
        kind = cursor.kinds[cursor.i]
        if kind not in _POSTFIX:
            cursor.depth = before
            return base
        cursor.i += 1
        cursor.deeper()
        if kind == ".":
            base = _member(cursor, base)
        elif kind == "[":
            base = tree.Index(base.at, base, _indices(cursor))
        elif kind == "(":
            base = tree.Call(base.at, base, arguments(cursor))
        else:
            base = tree.Dereference(base.at, base)


def _member(cursor: Cursor, base: tree.Expression) -> tree.Expression:
    """What follows a dot: a field, or the number of a bit."""
    here = cursor.i
    kind, text = cursor.kinds[here], cursor.texts[here]
    if kind == "number" and text.isdigit() and len(text) < 4:
        cursor.i = here + 1
        return tree.BitAccess(base.at, base, int(text), "X")
    if kind == "direct" and text[2:].isdigit() and text[1].upper() in "XBWD":
        cursor.i = here + 1
        return tree.BitAccess(base.at, base, int(text[2:]), text[1].upper())
    if kind != "name" and kind not in KEYWORDS:
        cursor.fail("the name of a member")
    cursor.i = here + 1
    return tree.Member(base.at, base, text)


def _indices(cursor: Cursor) -> list[tree.Expression]:
    """`i, j]`."""
    made = [expression(cursor)]
    while cursor.kinds[cursor.i] == ",":
        cursor.i += 1
        made.append(expression(cursor))
    cursor.expect("]")
    return made


def arguments(cursor: Cursor) -> list[tree.Argument]:
    """`a := 1, b => c)`, after the opening parenthesis."""
    made: list[tree.Argument] = []
    if cursor.accept(")"):
        return made
    while True:
        made.append(_argument(cursor))
        if cursor.kinds[cursor.i] != ",":
            break
        cursor.i += 1
    if cursor.kinds[cursor.i] != ")":
        cursor.fail("`,` or `)`")
    cursor.i += 1
    return made


def _argument(cursor: Cursor) -> tree.Argument:
    """One argument, formal or positional."""
    here = cursor.i
    at, kinds = cursor.ats[here], cursor.kinds
    negated = kinds[here] == "NOT" and kinds[here + 1] == "name" and kinds[here + 2] == "=>"
    first = here + 1 if negated else here
    sign = kinds[first + 1] if kinds[first] != END else ""
    if sign not in (":=", "=>") or (kinds[first] != "name" and kinds[first] not in KEYWORDS):
        return tree.Argument(at, None, expression(cursor))
    cursor.i = first + 2
    value = None if kinds[cursor.i] in (",", ")") else expression(cursor)
    return tree.Argument(at, cursor.texts[first], value, sign == "=>", negated)


def _boolean(at: int, text: str) -> tree.Literal:
    return tree.Literal(at, text, tree.LiteralKind.BOOL, text.upper() == "TRUE")


_MAKERS: dict[str, Callable[[int, str], tree.Literal | tree.Qualified]] = {
    "TRUE": _boolean,
    "FALSE": _boolean,
    "typed": literals.typed,
    "string": literals.string,
    "wstring": literals.wide_string,
}
