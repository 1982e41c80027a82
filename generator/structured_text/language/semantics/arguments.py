"""Which argument belongs to which parameter (clauses 2.5.1.3, 3.3.2.2)."""

from structured_text.language.report import nearest
from structured_text.language.semantics.scope import Scope, expect, infer
from structured_text.language.semantics.targets import assignable
from structured_text.language.semantics.values import fits, settle
from structured_text.language.tree import Argument, Binding, Block, Call, Direction, Parameter
from structured_text.language.types import BOOL, UNKNOWN, Kind, plain, untyped

NAMED = 4
"""Parameters that a message names, where a call names none of them; more would not be read."""


def infer_argument(scope: Scope, argument: Argument) -> None:
    """Check the value of an argument that has no parameter to go to."""
    if argument.value is not None:
        infer(scope, argument.value)
        settle(scope.report, argument.value, UNKNOWN)


def bind(scope: Scope, value: Call, parameters: list[Parameter], name: str) -> None:
    """Give every parameter its argument, by name or by place."""
    given = sort_arguments(scope, value, parameters, name)
    block = isinstance(value.target, Block)
    for parameter in parameters:
        argument = given.get(parameter.name.upper())
        made = Binding(parameter, argument.value if argument else None, bool(argument and argument.negated))
        value.bindings.append(made)
        if argument is not None and argument.value is not None:
            check_argument(scope, argument, parameter)
        elif parameter.direction is Direction.IN_OUT:
            scope.report.add(
                value.at, "call-arguments", f"expected an argument for the in-out {parameter.name} of {name}"
            )
        elif not block and parameter.direction is Direction.INPUT and _positional(value):
            text = f"expected an argument for {parameter.name} of {name}: give all, or name each"
            scope.report.add(value.at, "call-arguments", text)


def _positional(value: Call) -> bool:
    """Whether a call gives its arguments by place."""
    return bool(value.arguments) and value.arguments[0].name is None


def sort_arguments(scope: Scope, value: Call, parameters: list[Parameter], name: str) -> dict[str, Argument]:
    """Arguments by the upper-case name of their parameter; what has no place is reported."""
    given: dict[str, Argument] = {}
    places = parameters if _positional(value) else []
    for number, argument in enumerate(value.arguments):
        if argument.name is None and number < len(places):
            given[places[number].name.upper()] = argument
        elif argument.name is None:
            _unplaced(scope, argument, len(places), name)
        elif not _implicit(scope, value, argument):
            _named(scope, given, argument, parameters, name)
    return given


def _unplaced(scope: Scope, argument: Argument, places: int, name: str) -> None:
    """Report an argument by place that has none."""
    infer_argument(scope, argument)
    what = f"expected at most {places} arguments for {name}, found more" if places else None
    scope.report.add(argument.at, "call-arguments", what or f"expected `name := value` for {name}, found a bare value")


def _named(
    scope: Scope, given: dict[str, Argument], argument: Argument, parameters: list[Parameter], name: str
) -> None:
    """Place an argument by its name."""
    upper = (argument.name or "").upper()
    known = {each.name.upper() for each in parameters}
    if upper not in known:
        infer_argument(scope, argument)
        names = [each.name for each in parameters]
        hint = nearest(upper, names)
        right = f"{', '.join(names)} of {name}" if 0 < len(names) <= NAMED and not hint else f"a parameter of {name}"
        scope.report.add(argument.at, "call-arguments", f"expected {right}, found {argument.name}{hint}")
    elif upper in given:
        infer_argument(scope, argument)
        scope.report.add(argument.at, "call-arguments", f"expected {argument.name} of {name} once, found it twice")
    else:
        given[upper] = argument


def _implicit(scope: Scope, value: Call, argument: Argument) -> bool:
    """Take EN and ENO, which every function and block has."""
    upper = (argument.name or "").upper()
    if upper == "EN" and not argument.output and argument.value is not None:
        expect(scope, argument.value, BOOL)
        value.en = argument.value
        return True
    if upper == "ENO" and argument.output and argument.value is not None:
        expect(scope, argument.value, BOOL)
        assignable(scope, argument.value, "to receive ENO")
        value.eno = argument.value
        return True
    return False


def check_argument(scope: Scope, argument: Argument, parameter: Parameter) -> None:
    """Type and direction of one argument."""
    value = argument.value
    if value is None:
        return
    infer(scope, value)
    output = parameter.direction is Direction.OUTPUT
    if argument.name is not None and argument.output != output:
        sign = "=>" if output else ":="
        text = f"expected {sign} for the {parameter.direction.value} {parameter.name}"
        scope.report.add(argument.at, "call-arguments", text)
    if parameter.direction is not Direction.INPUT:
        _by_reference(scope, argument, parameter)
    elif argument.negated:
        scope.report.add(argument.at, "call-arguments", "expected NOT before an output only")
    fits(scope.report, value, parameter.type)


def _by_reference(scope: Scope, argument: Argument, parameter: Parameter) -> None:
    """An output or in-out takes a variable of exactly its type."""
    value = argument.value
    if value is None or untyped(value.type):
        what = f"for {parameter.name}"
        scope.report.add(argument.at, "not-assignable", f"expected a variable {what}, found a value")
        return
    if parameter.type.kind is not Kind.BLOCK:
        assignable(scope, value, f"for {parameter.name}")
    if isinstance(parameter.type, type(value.type)) and plain(value.type) is not value.type:
        scope.report.add(value.at, "type-mismatch", f"expected {parameter.type}, found the subrange {value.type}")
