"""Calls of the standard functions (IEC 61131-3 clause 2.5.1.5), as Python expressions.

Arguments are cut and rounded to the types of their parameters first: C casts them.
"""

import ast
from collections.abc import Callable
from itertools import pairwise

from structured_text.engines.embedded.certainty import known
from structured_text.engines.embedded.operators import comparison, inverse, number, operation, span
from structured_text.engines.embedded.parts import fitted, result_of, stored, term_of
from structured_text.engines.embedded.reals import EXACT_SINGLE, MATHEMATICS
from structured_text.engines.embedded.scope import Scope, UnsupportedError
from structured_text.engines.embedded.syntax import is_quiet
from structured_text.engines.embedded.terms import (
    C_UNSIGNED,
    CInteger,
    Floating,
    Plain,
    Term,
    Whole,
    elementary,
    is_integral,
    promoted,
)
from structured_text.language import tree
from structured_text.language.tree import Builtin
from structured_text.language.types import LREAL, REAL, TEMPORAL, Elementary, Kind, Type, plain

_OPERATORS = {"ADD": "+", "SUB": "-", "MUL": "*", "DIV": "/", "MOD": "MOD", "AND": "AND", "OR": "OR", "XOR": "XOR"}
_TIME_OPERATORS = {"MULTIME": "*", "DIVTIME": "/", "CONCAT_DATE_TOD": "+"}
_COMPARISONS = {"GT": ">", "GE": ">=", "EQ": "=", "LE": "<=", "LT": "<", "NE": "<>"}
_STRINGS = ("LEFT", "RIGHT", "MID", "CONCAT", "INSERT", "DELETE", "REPLACE")
_SHIFTS = {"SHL": "shift_left", "SHR": "shift_right", "ROL": "rotate_left", "ROR": "rotate_right"}

_DATES = (Kind.DATE, Kind.TIME_OF_DAY, Kind.DATE_AND_TIME)

Emitter = Callable[[Scope, Builtin, list[Term]], Term]


def builtin(scope: Scope, call: tree.Call, target: Builtin) -> Term:
    emit = _EMITTERS.get(target.family)
    if emit is None and target.family.startswith(("ADD_", "SUB_")):
        emit = _time_function
    if emit is None:
        raise UnsupportedError(call.at, f"the embedded engine does not have {target.name}")
    arguments = []
    for binding in call.bindings:
        if binding.value is None:
            raise UnsupportedError(call.at, f"{target.name} needs a value for {binding.parameter.name}")
        raw = target.family == "NOT"
        arguments.append(term_of(scope, binding.value) if raw else stored(scope, binding.value, binding.parameter.type))
    scope.pen.move(call.at)
    return emit(scope, target, arguments)


def _operator(scope: Scope, target: Builtin, arguments: list[Term]) -> Term:
    """ADD, MUL, AND ...: from left to right, each step in the type of the function."""
    total = arguments[0]
    for each in arguments[1:]:
        total = _step(scope, target, total, each)
    return total


def _step(scope: Scope, target: Builtin, left: Term, right: Term) -> Term:
    operator, kind = _OPERATORS[target.family], target.result
    if kind.kind is Kind.BOOL:
        return Plain(_strict_logic(scope, left.node, operator, right.node), kind)
    if isinstance(left, Whole) and not left.type.signed and left.type.width < C_UNSIGNED.width:
        left = Whole(left.node, left.low, left.high, left.type, C_UNSIGNED)
    return fitted(scope, operation(scope, left, operator, right, kind), kind)


def _strict_logic(scope: Scope, left: ast.expr, operator: str, right: ast.expr) -> ast.expr:
    """A function has all of its arguments before it runs: no short circuit."""
    if operator == "XOR":
        return scope.pen.compare(left, (ast.NotEq(), right))
    return scope.pen.binary(left, ast.BitAnd() if operator == "AND" else ast.BitOr(), right)


def _comparison_function(scope: Scope, target: Builtin, arguments: list[Term]) -> Term:
    operator = _COMPARISONS[target.family]
    tests = [comparison(scope, left, operator, right) for left, right in pairwise(arguments)]
    return Plain(scope.pen.junction(ast.And(), *tests), target.result)


def _time_function(scope: Scope, target: Builtin, arguments: list[Term]) -> Term:
    operator = _TIME_OPERATORS.get(target.family) or ("+" if target.family.startswith("ADD_") else "-")
    return Plain(span(scope, arguments[0], operator, arguments[1]), target.result)


def _not(scope: Scope, _: Builtin, arguments: list[Term]) -> Term:
    return inverse(scope, arguments[0])


def _move(_scope: Scope, _target: Builtin, arguments: list[Term]) -> Term:
    return arguments[0]


def _abs(scope: Scope, target: Builtin, arguments: list[Term]) -> Term:
    term = arguments[0]
    node = scope.pen.call("abs", term.node)
    if isinstance(term, Floating):
        return Floating(node, term.type, term.c)
    term = known(term, Whole)
    if term.low >= 0:
        return term
    ends = abs(term.low), abs(term.high)
    low = 0 if term.high >= 0 else min(ends)
    return scope.widths.stored(Whole(node, low, max(ends), term.type, term.c), target.result)


def _mathematics(scope: Scope, target: Builtin, arguments: list[Term]) -> Term:
    return _rounded(scope, scope.pen.call(f"std_{target.family}", arguments[0].node), target.result)


def _expt(scope: Scope, target: Builtin, arguments: list[Term]) -> Term:
    base, exponent = (number(scope, each) for each in arguments)
    return _rounded(scope, scope.pen.call("power", base, exponent), target.result)


def _rounded(scope: Scope, node: ast.expr, kind: Type) -> Floating:
    """A double as the result of a function of type REAL or LREAL."""
    if plain(kind) is REAL:
        return Floating(scope.pen.call("single", node), REAL, "single")
    return Floating(node, LREAL, "double")


def _shift(scope: Scope, target: Builtin, arguments: list[Term]) -> Term:
    value, places = arguments
    if isinstance(value, Plain):
        return _shifted_bool(scope, target, value, places)
    value = known(value, Whole)
    places = known(places, Whole)
    kind = elementary(target.result)
    if places.low == places.high and 0 <= places.low < kind.width and target.family in ("SHL", "SHR"):
        return _constant_shift(scope, target.family, value, places.low, kind)
    high = value.high if target.family == "SHR" else kind.high
    node = scope.pen.call(_SHIFTS[target.family], value.node, places.node, scope.pen.constant(kind.width))
    return Whole(node, 0, high, kind, promoted(kind))


def _constant_shift(scope: Scope, family: str, value: Whole, places: int, kind: Elementary) -> Whole:
    """A shift by a literal: Python's own, and wrapped only if bits can be lost."""
    pen = scope.pen
    c = promoted(kind)
    if family == "SHR":
        node = pen.binary(value.node, ast.RShift(), pen.constant(places))
        return Whole(node, value.low >> places, value.high >> places, kind, c)
    node = pen.binary(value.node, ast.LShift(), pen.constant(places))
    return scope.widths.wrapped(Whole(node, value.low << places, value.high << places, kind, c), _kind(kind))


def _shifted_bool(scope: Scope, target: Builtin, value: Plain, places: Term) -> Plain:
    """One bit: a shift by anything but 0 clears it, a rotation keeps it."""
    pen = scope.pen
    if target.family in ("ROL", "ROR"):
        return value
    none = pen.compare(places.node, (ast.Eq(), pen.constant(0)))
    return Plain(pen.junction(ast.And(), value.node, none), value.type)


def _bcd(scope: Scope, target: Builtin, arguments: list[Term]) -> Term:
    pen = scope.pen
    source, result = elementary(arguments[0].type), elementary(target.result)
    width = source.width if target.family == "BCD_TO" else result.width
    name = "from_bcd" if target.family == "BCD_TO" else "to_bcd"
    node = pen.call(name, arguments[0].node, pen.constant(width))
    return scope.widths.stored(Whole(node, 0, (1 << width) - 1, result, promoted(result)), result)


def _select(scope: Scope, target: Builtin, arguments: list[Term]) -> Term:
    pen = scope.pen
    test, off, on = arguments
    if is_quiet(off.node) and is_quiet(on.node):
        node: ast.expr = pen.choice(test.node, on.node, off.node)
    else:
        node = pen.item(pen.row(off.node, on.node), test.node)
    return _between(node, target.result, [off, on])


def _between(node: ast.expr, kind: Type, terms: list[Term]) -> Term:
    """The result of a function that returns one of its arguments."""
    wholes = [each for each in terms if isinstance(each, Whole)]
    if wholes:
        return result_of(node, kind, min(each.low for each in wholes), max(each.high for each in wholes))
    return result_of(node, kind)


def _mux(scope: Scope, target: Builtin, arguments: list[Term]) -> Term:
    zero = scope.shapes.zero(target.result)
    nodes = [each.node for each in arguments[1:]]
    node = scope.pen.call("mux", arguments[0].node, scope.pen.constant(zero), *nodes)
    return result_of(node, target.result)


def _limit(scope: Scope, target: Builtin, arguments: list[Term]) -> Term:
    node = scope.pen.call("limit", *(each.node for each in arguments))
    low, value, high = arguments
    if isinstance(low, Whole) and isinstance(value, Whole) and isinstance(high, Whole):
        least = min(max(value.low, low.low), high.low)
        most = max(min(max(value.high, low.high), high.high), low.high)
        return result_of(node, target.result, least, most)
    return result_of(node, target.result)


def _extreme(scope: Scope, target: Builtin, arguments: list[Term]) -> Term:
    node = scope.pen.call(target.family.lower(), *(each.node for each in arguments))
    return _between(node, target.result, arguments)


def _length(scope: Scope, target: Builtin, arguments: list[Term]) -> Term:
    return result_of(scope.pen.call("len", arguments[0].node), target.result, 0, 255)


def _find(scope: Scope, target: Builtin, arguments: list[Term]) -> Term:
    node = scope.pen.call("std_FIND", *(each.node for each in arguments))
    return result_of(node, target.result, 0, 255)


def _string_function(scope: Scope, target: Builtin, arguments: list[Term]) -> Term:
    return Plain(scope.pen.call(f"std_{target.family}", *(each.node for each in arguments)), target.result)


def _convert(scope: Scope, target: Builtin, arguments: list[Term]) -> Term:
    term, result = arguments[0], plain(target.result)
    source = plain(target.parameters[0].type)
    if source is result or source.kind is result.kind is Kind.STRING:
        return fitted(scope, term, result)
    if Kind.STRING in (source.kind, result.kind):
        return _text(scope, term.node, source, result)
    if source.kind in TEMPORAL or result.kind in TEMPORAL:
        return _temporal(scope, term, source, result)
    if isinstance(term, Whole):
        return _from_whole(scope, term, result)
    if isinstance(term, Floating):
        return _from_real(scope, term, result)
    return _from_bool(scope, term.node, result)


def _from_whole(scope: Scope, term: Whole, result: Type) -> Term:
    pen = scope.pen
    if is_integral(result):
        return scope.widths.stored(term, result)
    if result.kind is Kind.BOOL:
        return Plain(pen.compare(term.node, (ast.NotEq(), pen.constant(0))), result)
    if result is REAL and not term.within(-EXACT_SINGLE, EXACT_SINGLE):
        return Floating(pen.call("whole_to_single", term.node), REAL, "single")
    node = pen.binary(term.node, ast.Mult(), pen.constant(1.0))
    return Floating(node, elementary(result), "single" if result is REAL else "double")


def _from_bool(scope: Scope, node: ast.expr, result: Type) -> Term:
    pen = scope.pen
    if is_integral(result):
        chosen = pen.choice(node, pen.constant(1), pen.constant(0))
        return result_of(chosen, result, 0, 1)
    return result_of(pen.choice(node, pen.constant(1.0), pen.constant(0.0)), result)


def _from_real(scope: Scope, term: Floating, result: Type) -> Term:
    if result.kind is Kind.BOOL:
        return Plain(scope.pen.compare(term.node, (ast.NotEq(), scope.pen.constant(0.0))), result)
    if result.kind is Kind.REAL:
        return _rounded(scope, term.node, result)
    return _to_whole(scope, "round_to_whole", term.node, elementary(result))


def _trunc(scope: Scope, target: Builtin, arguments: list[Term]) -> Term:
    return _to_whole(scope, "cut_to_whole", arguments[0].node, elementary(target.result))


def _to_whole(scope: Scope, function: str, node: ast.expr, result: Elementary) -> Whole:
    """A REAL as an integer: the function gets the type that it must fit."""
    pen = scope.pen
    signed = result.signed and result.kind is Kind.INTEGER
    facts = (pen.constant(result.name), pen.constant(result.width), pen.constant(signed))
    return Whole(pen.call(function, node, *facts), result.low, result.high, result, promoted(result))


def _text(scope: Scope, node: ast.expr, source: Type, result: Type) -> Term:
    """To and from STRING."""
    pen = scope.pen
    if result.kind is Kind.STRING:
        which = [pen.constant(source.name)] if source.kind in _DATES else []
        return Plain(pen.call(_to_string(source), node, *which), result)
    if result.kind is Kind.BOOL:
        return Plain(pen.call("string_to_bool", node), result)
    if result.kind is Kind.REAL:
        return _rounded(scope, pen.call("string_to_real", node), result)
    if is_integral(result):
        kind = elementary(result)
        facts = (pen.constant(kind.name), pen.constant(kind.width), pen.constant(kind.signed))
        return result_of(pen.call("string_to_whole", node, *facts), result)
    return Plain(pen.call("string_to_time", node, pen.constant(result.name)), result)


def _temporal(scope: Scope, term: Term, source: Type, result: Type) -> Term:
    """Durations and dates: to each other, and to and from numbers, where the unit is everybody's own."""
    pen = scope.pen
    if source.kind in TEMPORAL and result.kind in TEMPORAL:
        names = {Kind.DATE: "date_of", Kind.TIME_OF_DAY: "time_of_day"}
        name = names.get(result.kind) if source.kind is Kind.DATE_AND_TIME else None
        return Plain(pen.call(name, term.node) if name else term.node, result)
    if result.kind in TEMPORAL:
        return Plain(pen.call("time_from_number", term.node), result)
    if result.kind is Kind.BOOL:
        return Plain(pen.call("time_to_bool", term.node), result)
    if result.kind is Kind.REAL:
        return _rounded(scope, pen.call("time_to_real", term.node), result)
    whole = pen.call("time_to_whole", term.node)
    kind = elementary(result)
    bound = 1 << 63
    return scope.widths.wrapped(Whole(whole, -bound, bound - 1, kind, promoted(kind)), _kind(kind))


def _kind(each: Elementary) -> CInteger:
    return CInteger(each.width, each.signed)


def _to_string(source: Type) -> str:
    """The function that writes a value of a type as a string."""
    names = {Kind.BOOL: "string_from_bool", Kind.BITS: "string_from_bits", Kind.REAL: "string_from_real"}
    names |= {Kind.INTEGER: "string_from_whole", Kind.TIME: "string_from_time"}
    return names.get(source.kind, "string_from_date")


_EMITTERS: dict[str, Emitter] = {
    **dict.fromkeys(_OPERATORS, _operator),
    **dict.fromkeys(_COMPARISONS, _comparison_function),
    **dict.fromkeys(MATHEMATICS, _mathematics),
    **dict.fromkeys(_STRINGS, _string_function),
    **dict.fromkeys(_SHIFTS, _shift),
    **dict.fromkeys(_TIME_OPERATORS, _time_function),
    "CONVERT": _convert,
    "TRUNC": _trunc,
    "BCD_TO": _bcd,
    "TO_BCD": _bcd,
    "ABS": _abs,
    "EXPT": _expt,
    "MOVE": _move,
    "NOT": _not,
    "SEL": _select,
    "MUX": _mux,
    "LIMIT": _limit,
    "MAX": _extreme,
    "MIN": _extreme,
    "LEN": _length,
    "FIND": _find,
}
