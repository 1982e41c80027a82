"""Tasks and program instances (clause 2.7)."""

from structured_text.language.semantics.arguments import check_argument
from structured_text.language.semantics.scope import Scope, expect
from structured_text.language.tree import Configuration, Name, Program, ProgramInstance, Resource, Task
from structured_text.language.types import BOOL, INT, TIME


def check_configuration(scope: Scope, configuration: Configuration) -> None:
    for resource in configuration.resources:
        tasks = _tasks(scope, resource)
        names: set[str] = set()
        for instance in resource.programs:
            if instance.name.upper() in names:
                scope.report.add(instance.at, "duplicate-name", f"{instance.name} is declared already")
            names.add(instance.name.upper())
            _program_instance(scope, instance, tasks)


def _tasks(scope: Scope, resource: Resource) -> dict[str, Task]:
    """The tasks of a resource by upper-case name."""
    made: dict[str, Task] = {}
    for task in resource.tasks:
        if made.setdefault(task.name.upper(), task) is not task:
            scope.report.add(task.at, "duplicate-name", f"the task {task.name} is declared already")
        for value, wanted in ((task.single, BOOL), (task.interval, TIME), (task.priority, INT)):
            if value is not None:
                expect(scope, value, wanted)
        if task.single is None and task.interval is None:
            scope.report.add(task.at, "call-arguments", f"expected SINGLE or INTERVAL for the task {task.name}")
    return made


def _program_instance(scope: Scope, instance: ProgramInstance, tasks: dict[str, Task]) -> None:
    """One program instance and what its variables are connected to."""
    found = scope.library.find(instance.type_name)
    if not isinstance(found, Program):
        text = f"expected the name of a program, found {instance.type_name}"
        scope.report.add(instance.at, "undeclared-name", text)
        return
    instance.target = found
    if instance.task is not None:
        instance.task_target = tasks.get(instance.task.upper())
        if instance.task_target is None:
            text = f"expected the name of a task of this resource, found {instance.task}"
            scope.report.add(instance.at, "undeclared-name", text)
    parameters = found.type.parameters if found.type else {}
    for argument in instance.connections:
        parameter = parameters.get((argument.name or "").upper())
        if parameter is None or argument.value is None:
            shown = argument.name or "a bare value"
            text = f"expected an input or output of {found.name}, found {shown}"
            scope.report.add(argument.at, "call-arguments", text)
        elif isinstance(argument.value, Name) or not argument.output:
            check_argument(scope, argument, parameter)
