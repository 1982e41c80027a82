"""CONFIGURATION, RESOURCE, TASK and program instances: tokens -> tree (annex B.1.7)."""

from structured_text.language.grammar.cursor import Cursor, SyntaxProblem
from structured_text.language.grammar.declarations import VAR_KINDS, var_block
from structured_text.language.grammar.expressions import arguments
from structured_text.language.lexer import END
from structured_text.language.tree import Argument, Configuration, Expression, ProgramInstance, Resource, Task


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
