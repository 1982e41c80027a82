"""Statements: tokens -> tree (annex B.3.2), with recovery, so that one mistake does not hide the next."""

from collections.abc import Callable

from structured_text.language import tree
from structured_text.language.grammar.cursor import Cursor, SyntaxProblem
from structured_text.language.grammar.expressions import expression, unary, variable
from structured_text.language.lexer import END
from structured_text.language.reserved import HARD_KEYWORDS, KEYWORDS

# Words at which a list of statements ends, whoever opened it.
_ENDS = frozenset(each for each in KEYWORDS if each.startswith("END_"))
_STOPS = _ENDS | {"ELSE", "ELSIF", "UNTIL", "FUNCTION", "FUNCTION_BLOCK", "VAR", "METHOD", "TYPE", "CONFIGURATION", END}
_STOPS |= {"INITIAL_STEP", "STEP", "TRANSITION", "ACTION", "ACTIONS", "PROPERTY", "PROGRAM"}
_SOFT = KEYWORDS - HARD_KEYWORDS
_LABELS = frozenset(["number", "typed", "-", "+", "TRUE", "FALSE", "string"])
_BEHIND_LABEL = frozenset([":", ",", ".."])
_BEHIND_VARIABLE = frozenset([":=", ".", "[", "(", "^"])
_LATCHES = {"S": "S=", "R": "R=", "REF": "REF="}


def statements(cursor: Cursor, in_case: bool = False) -> list[tree.Statement]:
    """Statements up to a word that ends them (in CASE also up to the next label); never raises SyntaxProblem."""
    made: list[tree.Statement] = []
    kinds = cursor.kinds
    while True:
        kind = kinds[cursor.i]
        if kind in _STOPS and not starts_variable(cursor, kind):
            return made
        if in_case and _at_label(cursor, kind):
            return made
        depth = cursor.depth
        try:
            made.append(_statement(cursor, kind))
        except SyntaxProblem:
            cursor.depth = depth
            _recover(cursor)


def starts_variable(cursor: Cursor, kind: str) -> bool:
    """Whether a word that is a keyword elsewhere is a variable here: `step := 1`."""
    return kind in _SOFT and cursor.kinds[cursor.i + 1] in _BEHIND_VARIABLE


def _recover(cursor: Cursor) -> None:
    """Skip past the next `;`, or to a word that starts or ends something."""
    kinds = cursor.kinds
    while kinds[cursor.i] != ";":
        if kinds[cursor.i] in _STOPS or kinds[cursor.i] in _STARTS:
            return
        cursor.i += 1
    cursor.i += 1


def _statement(cursor: Cursor, kind: str) -> tree.Statement:
    """One statement with its comments and its `;`. Raises SyntaxProblem."""
    leading = cursor.leading() if cursor.i in cursor.before else ()
    cursor.operators = 0
    start = _STARTS.get(kind)
    if start is None:
        made = _simple(cursor)
        if cursor.kinds[cursor.i] != ";":
            cursor.fail("`;`")
        cursor.i += 1
    else:
        made = start(cursor)
    made.leading = leading
    made.end = cursor.end_of_last()
    if cursor.i in cursor.before:
        made.trailing = cursor.trailing()
    return made


def _closed(cursor: Cursor, word: str) -> None:
    """Take END_IF or the like and its `;`, which some compilers do not ask for."""
    cursor.expect(word)
    if not cursor.accept(";"):
        cursor.notes.append(("missing-semicolon", cursor.ats[cursor.i - 1]))


def _simple(cursor: Cursor) -> tree.Statement:
    kind = cursor.kinds[cursor.i]
    at = cursor.ats[cursor.i]
    if kind != "name" and kind not in _SOFT and kind != "direct":
        cursor.fail("a statement")
    target = unary(cursor) if kind == "direct" else variable(cursor)
    if cursor.kinds[cursor.i] == ";" and cursor.texts[cursor.i - 1].upper() == "CONTINUE":
        return tree.Continue(at)
    if cursor.kinds[cursor.i] == ":=":
        cursor.i += 1
        return tree.Assign(at, target, expression(cursor))
    if isinstance(target, tree.Call):
        return tree.CallStatement(at, target)
    return _latch(cursor, at, target)


def _latch(cursor: Cursor, at: int, target: tree.Expression) -> tree.Statement:
    """`x S= condition` and its kind."""
    op = _LATCHES.get(cursor.texts[cursor.i].upper())
    if op is None or cursor.kinds[cursor.i + 1] != "=":
        cursor.fail("`:=` or `(`")
    cursor.i += 2
    return tree.Assign(at, target, expression(cursor), op)


def _body(cursor: Cursor, in_case: bool = False) -> list[tree.Statement]:
    """The statements inside another one, a level deeper."""
    cursor.deeper()
    made = statements(cursor, in_case)
    cursor.depth -= 1
    return made


def _if(cursor: Cursor) -> tree.Statement:
    """IF ... END_IF."""
    at = cursor.ats[cursor.i]
    branches = [_branch(cursor)]
    while cursor.kinds[cursor.i] == "ELSIF":
        branches.append(_branch(cursor))
    otherwise = _body(cursor) if cursor.accept("ELSE") else None
    _closed(cursor, "END_IF")
    return tree.If(at, branches, otherwise)


def _branch(cursor: Cursor) -> tree.Branch:
    """IF or ELSIF, its condition and its statements."""
    at = cursor.ats[cursor.i]
    cursor.i += 1
    cursor.operators = 0
    condition = expression(cursor)
    cursor.expect("THEN")
    return tree.Branch(at, condition, _body(cursor))


def _case(cursor: Cursor) -> tree.Statement:
    """CASE ... END_CASE."""
    at = cursor.ats[cursor.i]
    cursor.i += 1
    selector = expression(cursor)
    cursor.expect("OF")
    branches: list[tree.CaseBranch] = []
    while _at_label(cursor, cursor.kinds[cursor.i]):
        branches.append(_case_branch(cursor))
    otherwise = None
    if cursor.accept("ELSE"):
        cursor.accept(":")
        otherwise = _body(cursor)
    if cursor.kinds[cursor.i] != "END_CASE":
        cursor.fail("a label, ELSE or END_CASE")
    _closed(cursor, "END_CASE")
    return tree.Case(at, selector, branches, otherwise)


def _at_label(cursor: Cursor, kind: str) -> bool:
    """Whether the next token starts a label of CASE rather than a statement."""
    if kind in _LABELS:
        return True
    if kind != "name":
        return False
    here = cursor.i + 1
    while cursor.kinds[here] == "." and cursor.kinds[here + 1] == "name":
        here += 2
    return cursor.kinds[here] in _BEHIND_LABEL


def _case_branch(cursor: Cursor) -> tree.CaseBranch:
    """`1, 3..5: statements`."""
    leading, at = cursor.leading(), cursor.ats[cursor.i]
    labels = [_label(cursor)]
    while cursor.accept(","):
        labels.append(_label(cursor))
    cursor.expect(":")
    trailing = cursor.trailing()
    made = tree.CaseBranch(at, labels, _body(cursor, in_case=True))
    made.leading, made.trailing = leading, trailing
    return made


def _label(cursor: Cursor) -> tree.Expression | tree.LabelRange:
    """A single label or `low..high`."""
    at = cursor.ats[cursor.i]
    low = expression(cursor, 6)
    if not cursor.accept(".."):
        return low
    return tree.LabelRange(at, low, expression(cursor, 6))


def _for(cursor: Cursor) -> tree.Statement:
    """FOR ... END_FOR."""
    at = cursor.ats[cursor.i]
    cursor.i += 1
    variable = unary(cursor)
    cursor.expect(":=")
    start = expression(cursor)
    cursor.expect("TO")
    stop = expression(cursor)
    step = expression(cursor) if cursor.accept("BY") else None
    cursor.expect("DO")
    body = _body(cursor)
    _closed(cursor, "END_FOR")
    return tree.For(at, variable, start, stop, step, body)


def _while(cursor: Cursor) -> tree.Statement:
    """WHILE ... END_WHILE."""
    at = cursor.ats[cursor.i]
    cursor.i += 1
    condition = expression(cursor)
    cursor.expect("DO")
    body = _body(cursor)
    _closed(cursor, "END_WHILE")
    return tree.While(at, condition, body)


def _repeat(cursor: Cursor) -> tree.Statement:
    """REPEAT ... END_REPEAT."""
    at = cursor.ats[cursor.i]
    cursor.i += 1
    body = _body(cursor)
    cursor.expect("UNTIL")
    condition = expression(cursor)
    if cursor.accept(";"):
        cursor.notes.append(("stray-semicolon", cursor.ats[cursor.i - 1]))
    _closed(cursor, "END_REPEAT")
    return tree.RepeatUntil(at, body, condition)


def _empty(cursor: Cursor) -> tree.Statement:
    """A `;` with nothing before it."""
    cursor.i += 1
    return tree.Empty(cursor.ats[cursor.i - 1])


def _exit(cursor: Cursor) -> tree.Statement:
    """EXIT."""
    cursor.i += 1
    return tree.Exit(cursor.ats[cursor.expect(";") - 1])


def _return(cursor: Cursor) -> tree.Statement:
    """RETURN."""
    at = cursor.ats[cursor.i]
    cursor.i += 1
    value = None if cursor.kinds[cursor.i] == ";" else expression(cursor)
    cursor.expect(";")
    return tree.Return(at, value)


_STARTS: dict[str, Callable[[Cursor], tree.Statement]] = {
    "IF": _if, "CASE": _case, "FOR": _for, "WHILE": _while, "REPEAT": _repeat, ";": _empty, "EXIT": _exit,
    "RETURN": _return,
}  # fmt: skip
