"""Initial values: tokens -> tree (annex B.1.4)."""

from structured_text.language.grammar.cursor import Cursor
from structured_text.language.grammar.expressions import expression, number
from structured_text.language.tree import Argument, ArrayInitial, Expression, Repeat, StructInitial


def initial_value(cursor: Cursor) -> Expression:
    """What follows `:=` in a declaration: an expression, `[...]` or `(a := 1)`."""
    kind = cursor.kinds[cursor.i]
    cursor.operators = 0
    if kind == "[":
        return _array_initial(cursor)
    if kind == "(" and cursor.kinds[cursor.i + 2] == ":=":
        return _struct_initial(cursor)
    return expression(cursor)


def _array_initial(cursor: Cursor) -> ArrayInitial:
    """`[1, 2(0), 3]`."""
    at = cursor.ats[cursor.i]
    cursor.i += 1
    cursor.deeper()
    items: list[Expression] = []
    while cursor.kinds[cursor.i] != "]":
        items.append(_array_item(cursor))
        if not cursor.accept(","):
            break
    cursor.expect("]")
    cursor.depth -= 1
    return ArrayInitial(at, items)


def _array_item(cursor: Cursor) -> Expression:
    """An initial value, or `count(value)`."""
    here = cursor.i
    if cursor.kinds[here] != "number" or cursor.kinds[here + 1] != "(":
        return initial_value(cursor)
    count = number(cursor, "")
    cursor.i += 1
    value = None if cursor.kinds[cursor.i] == ")" else initial_value(cursor)
    cursor.expect(")")
    return Repeat(cursor.ats[here], count, value)


def _struct_initial(cursor: Cursor) -> StructInitial:
    """`(a := 1, b := [2, 3])`."""
    at = cursor.ats[cursor.i]
    cursor.i += 1
    cursor.deeper()
    items: list[Argument] = []
    while True:
        here = cursor.ats[cursor.i]
        name = cursor.name("the name of a field")
        cursor.expect(":=")
        items.append(Argument(here, name, initial_value(cursor)))
        if not cursor.accept(","):
            break
    cursor.expect(")")
    cursor.depth -= 1
    return StructInitial(at, items)
