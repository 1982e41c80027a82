"""What is at the outermost level of a file, and inside a POU: tokens -> tree (annex B.1.5)."""

from structured_text.language.grammar.cursor import Cursor, SyntaxProblem
from structured_text.language.grammar.declarations import VAR_KINDS, path, specification, type_block, var_block
from structured_text.language.grammar.expressions import arguments
from structured_text.language.grammar.statements import starts_variable, statements
from structured_text.language.lexer import END
from structured_text.language.tree import (
    Argument,
    Configuration,
    Element,
    Expression,
    Function,
    FunctionBlock,
    Pou,
    Program,
    ProgramInstance,
    Resource,
    Statement,
    Task,
    Unsupported,
)

_SKIPPED = ("METHOD", "PROPERTY", "ACTION", "ACTIONS", "TRANSITION", "STEP", "INITIAL_STEP")
_TOPS = frozenset(["TYPE", "FUNCTION", "FUNCTION_BLOCK", "PROGRAM", "CONFIGURATION", END])
_MODIFIERS = frozenset(["ABSTRACT", "FINAL", "PUBLIC", "PRIVATE", "PROTECTED", "INTERNAL", "OVERRIDE"])


def parsed_elements(cursor: Cursor) -> list[Element]:
    made: list[Element] = []
    while cursor.kinds[cursor.i] != END:
        cursor.depth = 0
        try:
            _element(cursor, made)
        except SyntaxProblem:
            _recover_element(cursor)
    return made


def _recover_element(cursor: Cursor) -> None:
    """Skip to the next word that may start an element."""
    cursor.i += cursor.kinds[cursor.i] != END
    while cursor.kinds[cursor.i] not in _TOPS:
        cursor.i += 1


def _element(cursor: Cursor, into: list[Element]) -> None:
    """One element of the file. Raises SyntaxProblem."""
    kind = cursor.kinds[cursor.i]
    if kind == "TYPE":
        cursor.type_blocks += 1
        into.extend(type_block(cursor, cursor.type_blocks))
    elif kind in _POUS:
        into.append(_pou(cursor))
    elif kind == "CONFIGURATION":
        into.append(configuration(cursor))
    elif kind in VAR_KINDS:
        into.append(var_block(cursor))
    elif kind in ("NAMESPACE", "INTERFACE", "CLASS"):
        _container(cursor, into)
    elif kind in ("END_NAMESPACE", ";") or (kind == "name" and cursor.texts[cursor.i].upper() == "USING"):
        _stray(cursor, kind)
    else:
        cursor.fail("TYPE, FUNCTION, FUNCTION_BLOCK, PROGRAM or CONFIGURATION")


def _stray(cursor: Cursor, kind: str) -> None:
    """A `;`, END_NAMESPACE or USING at the outermost level."""
    if kind == ";":
        cursor.notes.append(("stray-semicolon", cursor.ats[cursor.i]))
    if kind == "name":
        while cursor.kinds[cursor.i] not in (";", *_TOPS):
            cursor.i += 1
    cursor.i += cursor.kinds[cursor.i] not in _TOPS


def _container(cursor: Cursor, into: list[Element]) -> None:
    """NAMESPACE (what is inside is parsed too), INTERFACE or CLASS (skipped)."""
    at, kind = cursor.ats[cursor.i], cursor.kinds[cursor.i]
    if kind == "NAMESPACE":
        cursor.i += 1
        into.append(Unsupported(at, cursor.ats[cursor.i], kind, path(cursor)))
    else:
        into.append(_skipped(cursor))


def _skipped(cursor: Cursor) -> Unsupported:
    """Skip a construct to its END word, or to the end of the POU."""
    at, kind = cursor.ats[cursor.i], cursor.kinds[cursor.i]
    name = cursor.texts[cursor.i + 1]
    close = "END_STEP" if kind == "INITIAL_STEP" else "END_" + kind
    cursor.i += 1
    while cursor.kinds[cursor.i] not in (close, "END_FUNCTION_BLOCK", "END_PROGRAM", "END_FUNCTION", END):
        cursor.i += 1
    if not cursor.accept(close):
        cursor.fail(close)
    return Unsupported(at, cursor.end_of_last(), kind, name)


def _pou(cursor: Cursor) -> Function | FunctionBlock | Program:
    """FUNCTION, FUNCTION_BLOCK or PROGRAM. Raises SyntaxProblem if its head is no head."""
    leading, at = cursor.leading(), cursor.ats[cursor.i]
    make, close = _POUS[cursor.kinds[cursor.i]]
    cursor.i += 1
    while cursor.texts[cursor.i].upper() in _MODIFIERS and cursor.kinds[cursor.i + 1] == "name":
        cursor.i += 1
    name_at = cursor.ats[cursor.i]
    made = make(at, 0, cursor.name("the name of the block"), name_at, [], [], [])
    made.leading = leading
    _head(cursor, made)
    made.head = cursor.leading() if cursor.kinds[cursor.i] in VAR_KINDS else ()
    _inside(cursor, made, close)
    made.end = cursor.end_of_last()
    return made


def _starts_statement(cursor: Cursor) -> bool:
    """Whether a name is the beginning of a statement rather than a type that lacks its colon."""
    return cursor.kinds[cursor.i + 1] in (":=", "(", ".", "[")


def _head(cursor: Cursor, made: Pou) -> None:
    """What is between the name and the first VAR block."""
    if isinstance(made, Function) and cursor.accept(":"):
        made.returns = specification(cursor)
        cursor.accept(";")
    elif isinstance(made, Function) and cursor.kinds[cursor.i] == "name" and not _starts_statement(cursor):
        cursor.fail("`:` and the type of the result")
    start = cursor.i
    while cursor.texts[cursor.i].upper() in ("EXTENDS", "IMPLEMENTS"):
        cursor.i += 1
        path(cursor)
        while cursor.accept(","):
            path(cursor)
    if isinstance(made, FunctionBlock):
        made.heritage = " ".join(cursor.texts[start : cursor.i])


def _inside(cursor: Cursor, made: Pou, close: str) -> None:
    """The VAR blocks, statements and what else comes before the closing word; never raises SyntaxProblem."""
    while not cursor.accept(close):
        kind = cursor.kinds[cursor.i]
        try:
            if kind in VAR_KINDS:
                made.blocks.append(var_block(cursor))
            elif kind in _SKIPPED and not starts_variable(cursor, kind):
                made.extras.append(_skipped(cursor))
            elif kind in _TOPS and not starts_variable(cursor, kind):
                cursor.problem(cursor.i, f"expected {close}, found {cursor.found(cursor.i)}")
                return
            else:
                _body_part(cursor, made.body, close)
        except SyntaxProblem:
            continue


def _body_part(cursor: Cursor, into: list[Statement], close: str) -> None:
    """Statements up to a word that does not belong to a statement; a word that nothing opened is reported."""
    start = cursor.i
    into.extend(statements(cursor))
    kind = cursor.kinds[cursor.i]
    if cursor.i == start and kind != close:
        cursor.problem(cursor.i, f"expected a statement or {close}, found {cursor.found(cursor.i)}")
        cursor.i += 1
        cursor.accept(";")


_POUS: dict[str, tuple[type[Function] | type[FunctionBlock] | type[Program], str]] = {
    "FUNCTION": (Function, "END_FUNCTION"),
    "FUNCTION_BLOCK": (FunctionBlock, "END_FUNCTION_BLOCK"),
    "PROGRAM": (Program, "END_PROGRAM"),
}


def configuration(cursor: Cursor) -> Configuration:
    """`CONFIGURATION ... END_CONFIGURATION`. Raises SyntaxProblem."""
    leading, at = cursor.leading(), cursor.ats[cursor.i]
    cursor.i += 1
    made = Configuration(at, 0, cursor.name("the name of the configuration"), [], [])
    made.leading = leading
    while cursor.kinds[cursor.i] not in ("END_CONFIGURATION", END):
        kind = cursor.kinds[cursor.i]
        if kind in VAR_KINDS:
            made.blocks.append(var_block(cursor))
        elif kind == "RESOURCE":
            made.resources.append(_resource(cursor))
        elif kind in ("TASK", "PROGRAM"):
            _bare_resource(cursor, made)
        else:
            cursor.fail("VAR_GLOBAL, RESOURCE, TASK, PROGRAM or END_CONFIGURATION")
    cursor.expect("END_CONFIGURATION")
    made.end = cursor.end_of_last()
    return made


def _bare_resource(cursor: Cursor, made: Configuration) -> None:
    """A task or program without RESOURCE around it."""
    if not made.resources or made.resources[-1].name:
        made.resources.append(Resource(cursor.ats[cursor.i], "", "", [], [], []))
    _resource_item(cursor, made.resources[-1])


def _resource(cursor: Cursor) -> Resource:
    """`RESOURCE name ON processor ... END_RESOURCE`. Raises SyntaxProblem."""
    at = cursor.ats[cursor.i]
    cursor.i += 1
    name = cursor.name("the name of the resource")
    if not cursor.word("ON"):
        cursor.fail("ON")
    made = Resource(at, name, cursor.name("the name of the processor"), [], [], [])
    while cursor.kinds[cursor.i] not in ("END_RESOURCE", "END_CONFIGURATION", END):
        _resource_item(cursor, made)
    cursor.expect("END_RESOURCE")
    cursor.accept(";")
    return made


def _resource_item(cursor: Cursor, made: Resource) -> None:
    """Globals, a task or a program instance. Raises SyntaxProblem."""
    kind = cursor.kinds[cursor.i]
    if kind in VAR_KINDS:
        made.blocks.append(var_block(cursor))
    elif kind == "TASK":
        made.tasks.append(_task(cursor))
    elif kind == "PROGRAM":
        made.programs.append(_program_instance(cursor))
    else:
        cursor.fail("VAR_GLOBAL, TASK, PROGRAM or END_RESOURCE")


def _task(cursor: Cursor) -> Task:
    """`TASK name(INTERVAL := T#10ms, PRIORITY := 1);` Raises SyntaxProblem."""
    at = cursor.ats[cursor.i]
    cursor.i += 1
    name = cursor.name("the name of the task")
    cursor.expect("(")
    given: dict[str, Expression | None] = {"SINGLE": None, "INTERVAL": None, "PRIORITY": None}
    for argument in arguments(cursor):
        _task_setting(cursor, given, argument)
    cursor.expect(";")
    return Task(at, name, given["SINGLE"], given["INTERVAL"], given["PRIORITY"])


def _task_setting(cursor: Cursor, given: dict[str, Expression | None], argument: Argument) -> None:
    """One setting of a task. Raises SyntaxProblem."""
    upper = (argument.name or "").upper()
    if upper not in given:
        cursor.i -= 1
        cursor.problem(cursor.i, f"expected SINGLE, INTERVAL or PRIORITY, found {argument.name or 'a bare value'}")
        raise SyntaxProblem
    given[upper] = argument.value


def _program_instance(cursor: Cursor) -> ProgramInstance:
    """`PROGRAM name WITH task : TypeName(x := y);` Raises SyntaxProblem."""
    at = cursor.ats[cursor.i]
    cursor.i += 1
    retain = cursor.word("RETAIN")
    if not retain:
        cursor.word("NON_RETAIN")
    name = cursor.name("the name of the program instance")
    task = cursor.name("the name of a task") if cursor.accept("WITH") else None
    cursor.expect(":")
    type_name = cursor.name("the name of a program")
    connections = arguments(cursor) if cursor.accept("(") else []
    cursor.expect(";")
    return ProgramInstance(at, name, task, type_name, connections, retain)
