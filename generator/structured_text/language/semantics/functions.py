"""Calls of standard functions (clause 2.5.1.5): what an overloaded name means in one call."""

from structured_text.language.semantics.arguments import sort_arguments
from structured_text.language.semantics.operators import conversion_to_bits
from structured_text.language.semantics.scope import Scope, infer
from structured_text.language.semantics.values import (
    BITS_OF_SINT,
    choose,
    default,
    fits,
    leave_open,
    mismatch,
    push,
    settle,
)
from structured_text.language.standard import Conversion, Group, Signature
from structured_text.language.tree import Argument, Binding, Builtin, Call, Expression, Parameter
from structured_text.language.types import (
    ANY,
    ANY_BIT,
    BOOL,
    DINT,
    REAL,
    UNKNOWN,
    UNTYPED_INTEGER,
    UNTYPED_REAL,
    Kind,
    Type,
    conversion,
    plain,
    same,
    untyped,
)


def standard_call(scope: Scope, value: Call, name: str, signature: Signature) -> Type:
    """An overloaded standard function."""
    formals = _formals(value, signature)
    parameters = [Parameter(each, UNKNOWN) for each, _ in formals]
    given = sort_arguments(scope, value, parameters, name)
    for each in given.values():
        if each.value is not None:
            infer(scope, each.value)
    shared = _shared_type(scope, given, formals, signature.group, name)
    if untyped(shared) and signature.result is BOOL:
        shared = REAL if shared is UNTYPED_REAL else DINT
        _leave_all_open(given)
    result = shared if signature.result == "T" else signature.result
    made: list[Parameter] = []
    for parameter, (_, wanted) in zip(parameters, formals, strict=True):
        argument = given.get(parameter.name)
        if argument is None or argument.value is None:
            scope.report.add(value.at, "call-arguments", f"expected an argument for {parameter.name} of {name}")
        else:
            _standard_argument(scope, argument, wanted, shared, name)
        parameter.type = _parameter_type(argument, wanted, shared)
        made.append(parameter)
        value.bindings.append(Binding(parameter, argument.value if argument else None))
    value.target = Builtin(name, name, tuple(made), result if isinstance(result, Type) else UNKNOWN)
    return value.target.result


def _parameter_type(argument: Argument | None, wanted: Type | Group | str, shared: Type) -> Type:
    """What a formal parameter is in this very call."""
    if isinstance(wanted, Type):
        return wanted
    if wanted == "T":
        return shared
    return plain(argument.value.type) if argument and argument.value else UNKNOWN


def _formals(value: Call, signature: Signature) -> list[tuple[str, Type | Group | str]]:
    """The formal parameters, with as many of the repeated ones as the call has arguments."""
    formals = list(signature.formals)
    extra = sum(1 for each in value.arguments if (each.name or "").upper() not in ("EN", "ENO")) - len(formals)
    if signature.extensible:
        last, wanted = formals[-1]
        first = int(last.removeprefix("IN"))
        formals += [(f"IN{first + number}", wanted) for number in range(1, extra + 1)]
    return formals


def _shared_type(
    scope: Scope, given: dict[str, Argument], formals: list[tuple[str, Type | Group | str]], group: Group, name: str
) -> Type:
    """The type that all "T" arguments have; untyped if all are numbers without prefix."""
    values = [given[each].value for each, wanted in formals if wanted == "T" and each in given]
    types = [each.type for each in values if each is not None]
    typed = [each for each in types if not untyped(each)]
    if UNKNOWN in typed or not types:
        return UNKNOWN
    if not typed:
        return _untyped_shared(scope, values, group, name)
    shared = plain(typed[0])
    if shared.kind not in group and group != ANY:
        at = next(each.at for each in values if each is not None)
        scope.report.add(at, *_wrong_group(shared, group, name))
        return UNKNOWN
    return shared


def _untyped_shared(scope: Scope, values: list[Expression | None], group: Group, name: str) -> Type:
    """What numbers without prefix share; reported if the function is not for numbers."""
    given = [each for each in values if each is not None]
    reals = [each for each in given if each.type is UNTYPED_REAL]
    numbers = group & {Kind.INTEGER, Kind.REAL, Kind.BITS}
    if reals == given and Kind.REAL in group:
        return UNTYPED_REAL
    if not reals and numbers - {Kind.REAL}:
        return UNTYPED_INTEGER
    if Kind.REAL in group:
        for each in given:
            settle(scope.report, each, REAL)
        return UNKNOWN
    what = "another type" if not numbers else "a bit string" if group == ANY_BIT else "an integer"
    at = (reals or given)[0]
    scope.report.add(at.at, "type-mismatch", f"expected {what} for {name}, found {at.type}")
    for each in given:
        push(scope.report, each, default(each))
    return UNKNOWN


def _wrong_group(shared: Type, group: Group, name: str) -> tuple[str, str]:
    """Rule and text for an argument that an overloaded function does not take."""
    if shared.kind is Kind.BITS and Kind.INTEGER in group:
        text = f"expected a number for {name}, found {shared}: convert it to an integer first"
        return "bit-string-arithmetic", text
    if shared.kind is Kind.INTEGER and Kind.BITS in group:
        text = f"expected a bit string for {name}, found {shared}: write {conversion_to_bits(shared)}(...)"
        return "implicit-conversion", text
    if shared.kind is Kind.INTEGER and Kind.REAL in group:
        text = f"expected REAL or LREAL for {name}, found {shared}: write {conversion(shared, REAL)}(...)"
        return "implicit-conversion", text
    shown = "a bit string" if Kind.BITS in group and Kind.INTEGER not in group else "another type"
    return "type-mismatch", f"expected {shown} for {name}, found {shared}"


def _standard_argument(scope: Scope, argument: Argument, wanted: Type | Group | str, shared: Type, name: str) -> None:
    """Type of one argument of a standard function."""
    value = argument.value
    if value is None:
        return
    if argument.output:
        scope.report.add(argument.at, "call-arguments", f"expected := for an input of {name}, found =>")
    if isinstance(wanted, Type):
        fits(scope.report, value, wanted)
    elif wanted == "T":
        if not untyped(shared):
            _shared_argument(scope, argument, shared)
    elif isinstance(wanted, frozenset):
        choose(scope.report, value, bits=BITS_OF_SINT)
        if value.type.kind not in wanted and value.type is not UNKNOWN:
            rule = "implicit-conversion" if value.type.kind is Kind.BITS else "type-mismatch"
            scope.report.add(value.at, rule, f"expected an integer for {argument.name or name}, found {value.type}")


def _leave_all_open(given: dict[str, Argument]) -> None:
    """Mark the arguments of a comparison in which nothing gives a type."""
    for each in given.values():
        if each.value is not None:
            leave_open(each.value, BITS_OF_SINT)


def _shared_argument(scope: Scope, argument: Argument, shared: Type) -> None:
    """An argument that has the type of its fellows."""
    value = argument.value
    if value is None:
        return
    if untyped(value.type):
        settle(scope.report, value, shared)
    elif shared is not UNKNOWN and not same(shared, value.type):
        mismatch(scope.report, value, shared)


def type_conversion(scope: Scope, value: Call, name: str, found: Conversion) -> Type:
    """The type of a conversion, such as INT_TO_REAL(x) or TO_REAL(x)."""
    parameter = Parameter("IN", found.source or UNKNOWN)
    given = sort_arguments(scope, value, [parameter], name)
    argument = given.get("IN")
    source = argument.value if argument else None
    if source is None:
        scope.report.add(value.at, "call-arguments", f"expected an argument for IN of {name}")
    else:
        infer(scope, source)
        if found.source is not None:
            fits(scope.report, source, found.source)
        else:
            choose(scope.report, source)
            parameter.type = source.type
    if name.startswith("TO_"):
        text = f"{name} is of the third edition: name the source too, as in {parameter.type.name}_{name}"
        scope.report.add(value.at, "generic-conversion", text)
    if name == "TRUNC" and parameter.type.kind is not Kind.REAL and parameter.type is not UNKNOWN:
        scope.report.add(value.at, "type-mismatch", f"expected REAL or LREAL for TRUNC, found {parameter.type}")
    value.bindings.append(Binding(parameter, source))
    value.target = Builtin(name, found.family, (parameter,), found.result)
    return found.result
