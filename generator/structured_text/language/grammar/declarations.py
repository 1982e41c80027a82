"""Type specifications and variable declarations: tokens -> tree (annex B.1.3, B.1.4)."""

from structured_text.language import tree
from structured_text.language.grammar.cursor import Cursor, SyntaxProblem
from structured_text.language.grammar.expressions import expression, number
from structured_text.language.lexer import END
from structured_text.language.tree import Argument, ArrayInitial, Expression, Repeat, StructInitial

VAR_KINDS = {kind.value: kind for kind in tree.VarKind if kind.value.startswith("VAR")}
QUALIFIERS = frozenset(["CONSTANT", "RETAIN", "NON_RETAIN", "PERSISTENT", "PUBLIC", "PRIVATE", "PROTECTED", "INTERNAL"])
_POINTERS = {"POINTER": True, "REFERENCE": True, "REF_TO": False}
_SYNC = frozenset([";", "END_VAR", "END_STRUCT", "END_TYPE", "TYPE", "FUNCTION", "FUNCTION_BLOCK", "PROGRAM", END])
_SYNC |= {"END_FUNCTION", "END_FUNCTION_BLOCK", "END_PROGRAM", "CONFIGURATION", "END_CONFIGURATION"} | set(VAR_KINDS)


def var_block(cursor: Cursor) -> tree.VarBlock:
    """`VAR_INPUT ... END_VAR`. Never raises SyntaxProblem."""
    leading, at = cursor.leading(), cursor.ats[cursor.i]
    kind = VAR_KINDS[cursor.kinds[cursor.i]]
    cursor.i += 1
    words: list[str] = []
    while cursor.texts[cursor.i].upper() in QUALIFIERS and cursor.kinds[cursor.i + 1] not in (":", ","):
        words.append(cursor.texts[cursor.i].upper())
        cursor.i += 1
    block = tree.VarBlock(at, 0, kind, tuple(words), [])
    block.leading = leading
    _declarations(cursor, block.variables, kind, block.qualifiers, "END_VAR")
    block.end = cursor.end_of_last()
    if cursor.accept(";"):
        cursor.notes.append(("stray-semicolon", cursor.ats[cursor.i - 1]))
    return block


def _declarations(
    cursor: Cursor, into: list[tree.VarDecl], kind: tree.VarKind, words: tuple[str, ...], close: str
) -> None:
    """Declarations up to the closing word, and that word. Never raises SyntaxProblem."""
    while cursor.kinds[cursor.i] != close:
        start = cursor.i
        try:
            _declaration(cursor, into, kind, words)
        except SyntaxProblem:
            cursor.depth = 0 if close == "END_VAR" else cursor.depth
            if not _skip_declaration(cursor, start, close):
                return
    cursor.i += 1


def _skip_declaration(cursor: Cursor, start: int, close: str) -> bool:
    """Continue after the next `;`; False if the block ends without its closing word."""
    if cursor.i == start and cursor.kinds[cursor.i] in _SYNC and cursor.kinds[cursor.i] != ";":
        cursor.problem(cursor.i, f"expected {close}, found {cursor.found(cursor.i)}")
        return False
    while cursor.kinds[cursor.i] not in _SYNC:
        cursor.i += 1
    cursor.accept(";")
    return True


def _declaration(cursor: Cursor, into: list[tree.VarDecl], kind: tree.VarKind, words: tuple[str, ...]) -> None:
    """`a, b AT %IX0.0 : INT := 1;` Raises SyntaxProblem."""
    leading = cursor.leading() if cursor.i in cursor.before else ()
    first = len(into)
    names = [_declared_name(cursor, kind)]
    while cursor.accept(","):
        names.append(_declared_name(cursor, kind))
    cursor.expect(":")
    spec = specification(cursor)
    edge = _edge(cursor)
    initial = _optional_value(cursor)
    if cursor.kinds[cursor.i] != ";":
        cursor.fail("`;`" if initial is not None else "`;` or `:=`")
    cursor.i += 1
    end = cursor.end_of_last()
    trailing = cursor.trailing() if cursor.i in cursor.before else None
    constant, retain = "CONSTANT" in words, "RETAIN" in words
    for at, name, address in names:
        made = tree.VarDecl(at, end, name, kind, spec, initial, address, constant, retain, edge, len(into) > first)
        made.trailing = trailing
        into.append(made)
    into[first].leading = leading


def _declared_name(cursor: Cursor, kind: tree.VarKind) -> tuple[int, str, str | None]:
    """Where, the name, and the address after AT; a dotted path in VAR_CONFIG and VAR_ACCESS."""
    at = cursor.ats[cursor.i]
    if kind in (tree.VarKind.CONFIG, tree.VarKind.ACCESS) or cursor.kinds[cursor.i] == "direct":
        return at, path(cursor), _address(cursor)
    if cursor.kinds[cursor.i] == "AT":
        return at, "", _address(cursor)
    return at, cursor.name("the name of a variable or END_VAR"), _address(cursor)


def path(cursor: Cursor) -> str:
    """`resource.program.variable` or a direct address, as text."""
    parts = [cursor.texts[cursor.i]]
    if not cursor.accept("direct"):
        parts = [cursor.name("a path")]
    while cursor.accept("."):
        parts.append(cursor.name("a path"))
    return ".".join(parts)


def _address(cursor: Cursor) -> str | None:
    """The address after AT; None without AT."""
    if not cursor.accept("AT"):
        return None
    here = cursor.i
    if cursor.kinds[here] != "direct":
        cursor.fail("a direct address such as %IX0.0")
    cursor.i = here + 1
    return cursor.texts[here]


def _edge(cursor: Cursor) -> str:
    return next((each for each in ("R_EDGE", "F_EDGE") if cursor.word(each)), "")


def _optional_value(cursor: Cursor) -> tree.Expression | None:
    """`:= value`, if there is one."""
    return initial_value(cursor) if cursor.accept(":=") else None


def specification(cursor: Cursor) -> tree.Spec:
    """What follows the colon. Raises SyntaxProblem."""
    kind, at = cursor.kinds[cursor.i], cursor.ats[cursor.i]
    if kind == "ARRAY":
        return _array_spec(cursor)
    if kind == "STRUCT":
        return _struct_spec(cursor)
    if kind in ("STRING", "WSTRING"):
        return _string_spec(cursor)
    if kind == "(":
        return _enum_spec(cursor, None)
    name = cursor.name("a type")
    if name.upper() in _POINTERS and (cursor.kinds[cursor.i] == "TO" or not _POINTERS[name.upper()]):
        return _pointer_spec(cursor, at, name.upper())
    while cursor.accept("."):
        name += "." + cursor.name("a type")
    return _bracketed_spec(cursor, at, name) if cursor.kinds[cursor.i] == "(" else tree.NamedSpec(at, name)


def _bracketed_spec(cursor: Cursor, at: int, name: str) -> tree.Spec:
    """`INT (0..9)` or `INT (A, B)`, after the name."""
    if cursor.kinds[cursor.i + 1] == "name" and cursor.kinds[cursor.i + 2] in (",", ")", ":="):
        made = _enum_spec(cursor, name)
        made.at = at
        return made
    cursor.i += 1
    here = cursor.ats[cursor.i]
    low = expression(cursor)
    cursor.expect("..")
    high = expression(cursor)
    cursor.expect(")")
    return tree.SubrangeSpec(at, name, tree.Range(here, low, high))


def _pointer_spec(cursor: Cursor, at: int, word: str) -> tree.Spec:
    """What a pointer points to."""
    cursor.accept("TO")
    cursor.deeper()
    target = specification(cursor)
    cursor.depth -= 1
    return tree.PointerSpec(at, word, target)


def _string_spec(cursor: Cursor) -> tree.Spec:
    """`STRING`, `STRING[20]`, `STRING(20)`."""
    at, wide = cursor.ats[cursor.i], cursor.kinds[cursor.i] == "WSTRING"
    cursor.i += 1
    bracket = cursor.kinds[cursor.i]
    if bracket not in ("[", "("):
        return tree.StringSpec(at, wide, None)
    cursor.i += 1
    length = expression(cursor)
    cursor.expect("]" if bracket == "[" else ")")
    return tree.StringSpec(at, wide, length)


def _array_spec(cursor: Cursor) -> tree.Spec:
    """`ARRAY[0..9, 1..2] OF element`."""
    at = cursor.ats[cursor.i]
    cursor.i += 1
    cursor.expect("[")
    ranges = [_limits(cursor)]
    while cursor.accept(","):
        ranges.append(_limits(cursor))
    cursor.expect("]")
    cursor.expect("OF")
    cursor.deeper()
    element = specification(cursor)
    cursor.depth -= 1
    return tree.ArraySpec(at, ranges, element)


def _limits(cursor: Cursor) -> tree.Range | None:
    """`low..high`, or None for `*`."""
    if cursor.accept("*"):
        return None
    at = cursor.ats[cursor.i]
    low = expression(cursor)
    cursor.expect("..")
    return tree.Range(at, low, expression(cursor))


def _struct_spec(cursor: Cursor) -> tree.Spec:
    """`STRUCT ... END_STRUCT`."""
    at = cursor.ats[cursor.i]
    cursor.i += 1
    cursor.deeper()
    made = tree.StructSpec(at, [])
    _declarations(cursor, made.fields, tree.VarKind.FIELD, (), "END_STRUCT")
    cursor.depth -= 1
    return made


def _enum_spec(cursor: Cursor, base: str | None) -> tree.Spec:
    """`(A, B := 2)`."""
    at = cursor.ats[cursor.i]
    cursor.i += 1
    items: list[tree.EnumItem] = []
    while True:
        leading, here = cursor.leading(), cursor.ats[cursor.i]
        item = tree.EnumItem(here, cursor.name("the name of a value"), _optional_value(cursor))
        item.leading = leading
        items.append(item)
        more = cursor.accept(",")
        item.trailing = cursor.trailing()
        if not more:
            break
    cursor.expect(")")
    return tree.EnumSpec(at, items, base)


def type_block(cursor: Cursor, number: int) -> list[tree.TypeDecl]:
    """`TYPE ... END_TYPE`. Never raises SyntaxProblem."""
    block_comments = cursor.leading()
    cursor.i += 1
    made: list[tree.TypeDecl] = []
    while cursor.kinds[cursor.i] != "END_TYPE":
        start, depth = cursor.i, cursor.depth
        try:
            made.append(_type_declaration(cursor, number))
        except SyntaxProblem:
            cursor.depth = depth
            if not _skip_declaration(cursor, start, "END_TYPE"):
                return made
            cursor.accept("END_STRUCT")
            cursor.accept(";")
    cursor.i += 1
    if made:
        made[0].leading = block_comments + made[0].leading
    return made


def _type_declaration(cursor: Cursor, number: int) -> tree.TypeDecl:
    """`Name : spec := initial;` Raises SyntaxProblem."""
    leading, at = cursor.leading(), cursor.ats[cursor.i]
    name = cursor.name("the name of a type or END_TYPE")
    cursor.expect(":")
    spec = specification(cursor)
    if isinstance(spec, tree.NamedSpec) and cursor.kinds[cursor.i] == "(":
        cursor.fail("`;` or `:=`")
    initial = _optional_value(cursor)
    terminated = cursor.accept(";")
    if not terminated and not (isinstance(spec, tree.StructSpec) and cursor.kinds[cursor.i] in ("END_TYPE", "name")):
        cursor.fail("`;`" if initial is not None else "`;` or `:=`")
    made = tree.TypeDecl(at, cursor.end_of_last(), name, spec, initial, number, terminated)
    made.leading, made.trailing = leading, cursor.trailing()
    return made


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
