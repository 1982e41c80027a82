"""Calls of the standard functions (IEC 61131-3 clause 2.5.1.5), as Python expressions.

Arguments are cut and rounded to the types of their parameters first, in every model: C casts them.
"""

from __future__ import annotations

import ast
from collections.abc import Callable
from itertools import pairwise

from driveblocks.host.embedded.certainty import known
from driveblocks.host.embedded.expressions import Expressions
from driveblocks.host.embedded.reals import EXACT_SINGLE, MATHEMATICS
from driveblocks.host.embedded.scope import Scope, UnsupportedError
from driveblocks.host.embedded.syntax import is_quiet
from driveblocks.host.embedded.terms import (
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
from driveblocks.st import tree
from driveblocks.st.tree import Builtin
from driveblocks.st.types import LREAL, REAL, TEMPORAL, Elementary, Kind, Type, plain

_OPERATORS = {"ADD": "+", "SUB": "-", "MUL": "*", "DIV": "/", "MOD": "MOD", "AND": "AND", "OR": "OR", "XOR": "XOR"}
_TIME_OPERATORS = {"MULTIME": "*", "DIVTIME": "/", "CONCAT_DATE_TOD": "+"}
_COMPARISONS = {"GT": ">", "GE": ">=", "EQ": "=", "LE": "<=", "LT": "<", "NE": "<>"}
_STRINGS = ("LEFT", "RIGHT", "MID", "CONCAT", "INSERT", "DELETE", "REPLACE")
_SHIFTS = {"SHL": "shift_left", "SHR": "shift_right", "ROL": "rotate_left", "ROR": "rotate_right"}

_DATES = (Kind.DATE, Kind.TIME_OF_DAY, Kind.DATE_AND_TIME)

Emitter = Callable[[Builtin, list[Term]], Term]


class Functions(Expressions):
    """Compiles calls of standard functions."""

    def __init__(self, scope: Scope) -> None:
        """Compile within a scope."""
        super().__init__(scope)
        emitters: dict[str, Emitter] = dict.fromkeys(_OPERATORS, self._operator)
        emitters |= dict.fromkeys(_COMPARISONS, self._comparison_function)
        emitters |= dict.fromkeys(MATHEMATICS, self._mathematics)
        emitters |= dict.fromkeys(_STRINGS, self._string_function)
        emitters |= dict.fromkeys(_SHIFTS, self._shift)
        emitters |= dict.fromkeys(_TIME_OPERATORS, self._time_function)
        emitters |= {"CONVERT": self._convert, "TRUNC": self._trunc, "BCD_TO": self._bcd, "TO_BCD": self._bcd}
        emitters |= {"ABS": self._abs, "EXPT": self._expt, "MOVE": self._move, "NOT": self._not}
        emitters |= {"SEL": self._select, "MUX": self._mux, "LIMIT": self._limit}
        emitters |= {"MAX": self._extreme, "MIN": self._extreme, "LEN": self._length, "FIND": self._find}
        self._emitters = emitters

    def builtin(self, call: tree.Call, target: Builtin) -> Term:
        """A call of a standard function. UnsupportedError."""
        emit = self._emitters.get(target.family)
        if emit is None and target.family.startswith(("ADD_", "SUB_")):
            emit = self._time_function
        if emit is None:
            raise UnsupportedError(call.at, f"the embedded engine does not have {target.name}")
        arguments = []
        for binding in call.bindings:
            if binding.value is None:
                raise UnsupportedError(call.at, f"{target.name} needs a value for {binding.parameter.name}")
            raw = target.family == "NOT"
            arguments.append(self.term(binding.value) if raw else self.stored(binding.value, binding.parameter.type))
        self.pen.move(call.at)
        return emit(target, arguments)

    # ------------------------------------------------------------ arithmetic

    def _operator(self, target: Builtin, arguments: list[Term]) -> Term:
        """ADD, MUL, AND ...: from left to right, each step in the type of the function."""
        total = arguments[0]
        for each in arguments[1:]:
            total = self._step(target, total, each)
        return total

    def _step(self, target: Builtin, left: Term, right: Term) -> Term:
        operator, kind = _OPERATORS[target.family], target.result
        if kind.kind is Kind.BOOL:
            return Plain(self._strict_logic(left.node, operator, right.node), kind)
        if target.family in ("DIV", "MOD") and self.scope.model == "c" and isinstance(right, Whole | Floating):
            return self._or_zero(left, operator, right, kind)
        if isinstance(left, Whole) and not left.type.signed and left.type.width < C_UNSIGNED.width:
            left = Whole(left.node, left.low, left.high, left.type, C_UNSIGNED)
        return self.fitted(self.operation(left, operator, right, kind), kind)

    def _or_zero(self, left: Term, operator: str, right: Whole | Floating, kind: Type) -> Term:
        """matiec's DIV(x, 0) is 0, unlike its x / 0."""
        name = self.scope.fresh()
        kept = self.pen.keep(name, right.node)
        right.node = self.pen.name(name)
        value = self.fitted(self.operation(left, operator, right, kind), kind)
        zero = self.pen.constant(0.0 if isinstance(right, Floating) else 0)
        return self._like(value, self.pen.choice(self.pen.compare(kept, (ast.NotEq(), zero)), value.node, zero))

    def _like(self, term: Term, node: ast.expr) -> Term:
        """Another node with what is known of a term; of an integer only its type."""
        return self.result(node, term.type)

    def _strict_logic(self, left: ast.expr, operator: str, right: ast.expr) -> ast.expr:
        """A function has all of its arguments before it runs: no short circuit in any model."""
        if operator == "XOR":
            return self.pen.compare(left, (ast.NotEq(), right))
        return self.pen.binary(left, ast.BitAnd() if operator == "AND" else ast.BitOr(), right)

    def _comparison_function(self, target: Builtin, arguments: list[Term]) -> Term:
        operator = _COMPARISONS[target.family]
        tests = [self.comparison(left, operator, right) for left, right in pairwise(arguments)]
        return Plain(self.pen.junction(ast.And(), *tests), target.result)

    def _time_function(self, target: Builtin, arguments: list[Term]) -> Term:
        operator = _TIME_OPERATORS.get(target.family) or ("+" if target.family.startswith("ADD_") else "-")
        return Plain(self.span(arguments[0], operator, arguments[1]), target.result)

    def _not(self, _: Builtin, arguments: list[Term]) -> Term:
        return self.inverse(arguments[0])

    def _move(self, _: Builtin, arguments: list[Term]) -> Term:
        return arguments[0]

    def _abs(self, target: Builtin, arguments: list[Term]) -> Term:
        term = arguments[0]
        node = self.pen.call("abs", term.node)
        if isinstance(term, Floating):
            function = "c_abs" if self.scope.model == "c" else "abs"
            return Floating(self.pen.call(function, term.node), term.type, term.c)
        term = known(term, Whole)
        if term.low >= 0:
            return term
        ends = abs(term.low), abs(term.high)
        low = 0 if term.high >= 0 else min(ends)
        return self.widths.stored(Whole(node, low, max(ends), term.type, term.c), target.result)

    def _mathematics(self, target: Builtin, arguments: list[Term]) -> Term:
        return self._rounded(self.pen.call(f"std_{target.family}", arguments[0].node), target.result)

    def _expt(self, target: Builtin, arguments: list[Term]) -> Term:
        base, exponent = (self.number(each) for each in arguments)
        return self._rounded(self.pen.call("power", base, exponent), target.result)

    def _rounded(self, node: ast.expr, kind: Type) -> Floating:
        """A double as the result of a function of type REAL or LREAL."""
        if plain(kind) is REAL:
            return Floating(self.pen.call("single", node), REAL, "single")
        return Floating(node, LREAL, "double")

    # ------------------------------------------------------------ bits

    def _shift(self, target: Builtin, arguments: list[Term]) -> Term:
        value, places = arguments
        if isinstance(value, Plain):
            return self._shifted_bool(target, value, places)
        value = known(value, Whole)
        places = known(places, Whole)
        kind = elementary(target.result)
        if places.low == places.high and 0 <= places.low < kind.width and target.family in ("SHL", "SHR"):
            return self._constant_shift(target.family, value, places.low, kind)
        high = value.high if target.family == "SHR" else kind.high
        node = self.pen.call(_SHIFTS[target.family], value.node, places.node, self.pen.constant(kind.width))
        return Whole(node, 0, high, kind, promoted(kind))

    def _constant_shift(self, family: str, value: Whole, places: int, kind: Elementary) -> Whole:
        """A shift by a literal: Python's own, and wrapped only if bits can leave."""
        c = promoted(kind)
        if family == "SHR":
            node = self.pen.binary(value.node, ast.RShift(), self.pen.constant(places))
            return Whole(node, value.low >> places, value.high >> places, kind, c)
        node = self.pen.binary(value.node, ast.LShift(), self.pen.constant(places))
        return self.widths.wrapped(Whole(node, value.low << places, value.high << places, kind, c), _kind(kind))

    def _shifted_bool(self, target: Builtin, value: Plain, places: Term) -> Plain:
        """One bit: a shift by anything but 0 empties it, a rotation leaves it."""
        if target.family in ("ROL", "ROR"):
            return value
        none = self.pen.compare(places.node, (ast.Eq(), self.pen.constant(0)))
        return Plain(self.pen.junction(ast.And(), value.node, none), value.type)

    def _bcd(self, target: Builtin, arguments: list[Term]) -> Term:
        source, result = elementary(arguments[0].type), elementary(target.result)
        width = source.width if target.family == "BCD_TO" else result.width
        name = "from_bcd" if target.family == "BCD_TO" else "to_bcd"
        strict = self.pen.constant(self.scope.model != "c")
        node = self.pen.call(name, arguments[0].node, self.pen.constant(width), strict)
        return self.widths.stored(Whole(node, 0, (1 << width) - 1, result, promoted(result)), result)

    # ------------------------------------------------------------ selection

    def _select(self, target: Builtin, arguments: list[Term]) -> Term:
        test, off, on = arguments
        if is_quiet(off.node) and is_quiet(on.node):
            node: ast.expr = self.pen.choice(test.node, on.node, off.node)
        else:
            node = self.pen.item(self.pen.row(off.node, on.node), test.node)
        return self._between(node, target.result, [off, on])

    def _between(self, node: ast.expr, kind: Type, terms: list[Term]) -> Term:
        """The result of a function that returns one of its arguments."""
        wholes = [each for each in terms if isinstance(each, Whole)]
        if wholes:
            return self.result(node, kind, min(each.low for each in wholes), max(each.high for each in wholes))
        return self.result(node, kind)

    def _mux(self, target: Builtin, arguments: list[Term]) -> Term:
        zero = self.scope.shapes.zero(target.result)
        nodes = [each.node for each in arguments[1:]]
        node = self.pen.call("mux", arguments[0].node, self.pen.constant(zero), *nodes)
        return self.result(node, target.result)

    def _limit(self, target: Builtin, arguments: list[Term]) -> Term:
        node = self.pen.call(self._ordered("limit", target), *(each.node for each in arguments))
        low, value, high = arguments
        if isinstance(low, Whole) and isinstance(value, Whole) and isinstance(high, Whole):
            least = min(max(value.low, low.low), high.low)
            most = max(min(max(value.high, low.high), high.high), low.high)
            return self.result(node, target.result, least, most)
        return self.result(node, target.result)

    def _extreme(self, target: Builtin, arguments: list[Term]) -> Term:
        node = self.pen.call(self._ordered(target.family.lower(), target), *(each.node for each in arguments))
        return self._between(node, target.result, arguments)

    def _ordered(self, function: str, target: Builtin) -> str:
        """The variant of a function for pairs of seconds and nanoseconds, or for strings where a line has its own."""
        if self.scope.model == "c" and target.result.kind in TEMPORAL:
            return f"time_{function}"
        own = target.result.kind is Kind.STRING and self.scope.options.line == "openplc"
        return f"string_{function}" if own else function

    # ------------------------------------------------------------ strings

    def _length(self, target: Builtin, arguments: list[Term]) -> Term:
        return self.result(self.pen.call("len", arguments[0].node), target.result, 0, 255)

    def _find(self, target: Builtin, arguments: list[Term]) -> Term:
        node = self.pen.call("std_FIND", *(each.node for each in arguments))
        return self.result(node, target.result, 0, 255)

    def _string_function(self, target: Builtin, arguments: list[Term]) -> Term:
        return Plain(self.pen.call(f"std_{target.family}", *(each.node for each in arguments)), target.result)

    # ------------------------------------------------------------ conversions

    def _convert(self, target: Builtin, arguments: list[Term]) -> Term:
        term, result = arguments[0], plain(target.result)
        source = plain(target.parameters[0].type)
        if source is result or source.kind is result.kind is Kind.STRING:
            return self.fitted(term, result)
        if Kind.STRING in (source.kind, result.kind):
            return self._text(term.node, source, result)
        if source.kind in TEMPORAL or result.kind in TEMPORAL:
            return self._temporal(term, source, result)
        if isinstance(term, Whole):
            return self._from_whole(term, result)
        if isinstance(term, Floating):
            return self._from_real(term, result)
        return self._from_bool(term.node, result)

    def _from_whole(self, term: Whole, result: Type) -> Term:
        if is_integral(result):
            return self.widths.stored(term, result)
        if result.kind is Kind.BOOL:
            return Plain(self.pen.compare(term.node, (ast.NotEq(), self.pen.constant(0))), result)
        if result is REAL and not term.within(-EXACT_SINGLE, EXACT_SINGLE):
            return Floating(self.pen.call("whole_to_single", term.node), REAL, "single")
        node = self.pen.binary(term.node, ast.Mult(), self.pen.constant(1.0))
        return Floating(node, elementary(result), "single" if result is REAL else "double")

    def _from_bool(self, node: ast.expr, result: Type) -> Term:
        if is_integral(result):
            chosen = self.pen.choice(node, self.pen.constant(1), self.pen.constant(0))
            return self.result(chosen, result, 0, 1)
        return self.result(self.pen.choice(node, self.pen.constant(1.0), self.pen.constant(0.0)), result)

    def _from_real(self, term: Floating, result: Type) -> Term:
        if result.kind is Kind.BOOL:
            return Plain(self.pen.compare(term.node, (ast.NotEq(), self.pen.constant(0.0))), result)
        if result.kind is Kind.REAL:
            return self._rounded(term.node, result)
        return self._to_whole("round_to_whole", term.node, elementary(result))

    def _trunc(self, target: Builtin, arguments: list[Term]) -> Term:
        return self._to_whole("cut_to_whole", arguments[0].node, elementary(target.result))

    def _to_whole(self, function: str, node: ast.expr, result: Elementary) -> Whole:
        """A REAL as an integer: the function of the model gets the type that it must fit."""
        pen = self.pen
        signed = result.signed and result.kind is Kind.INTEGER
        facts = (pen.constant(result.name), pen.constant(result.width), pen.constant(signed))
        return Whole(pen.call(function, node, *facts), result.low, result.high, result, promoted(result))

    def _text(self, node: ast.expr, source: Type, result: Type) -> Term:
        """To and from STRING."""
        if result.kind is Kind.STRING:
            which = [self.pen.constant(source.name)] if source.kind in _DATES else []
            return Plain(self.pen.call(_to_string(source), node, *which), result)
        if result.kind is Kind.BOOL:
            return Plain(self.pen.call("string_to_bool", node), result)
        if result.kind is Kind.REAL:
            return self._rounded(self.pen.call("string_to_real", node), result)
        if is_integral(result):
            kind = elementary(result)
            facts = (self.pen.constant(kind.name), self.pen.constant(kind.width), self.pen.constant(kind.signed))
            return self.result(self.pen.call("string_to_whole", node, *facts), result)
        return Plain(self.pen.call("string_to_time", node, self.pen.constant(result.name)), result)

    def _temporal(self, term: Term, source: Type, result: Type) -> Term:
        """Durations and dates: to each other, and to and from numbers, where the unit is everybody's own."""
        if source.kind in TEMPORAL and result.kind in TEMPORAL:
            names = {Kind.DATE: "date_of", Kind.TIME_OF_DAY: "time_of_day"}
            name = names.get(result.kind) if source.kind is Kind.DATE_AND_TIME else None
            return Plain(self.pen.call(name, term.node) if name else term.node, result)
        if result.kind in TEMPORAL:
            return Plain(self.pen.call("time_from_number", term.node), result)
        if result.kind is Kind.BOOL:
            return Plain(self.pen.call("time_to_bool", term.node), result)
        if result.kind is Kind.REAL:
            return self._rounded(self.pen.call("time_to_real", term.node), result)
        whole = self.pen.call("time_to_whole", term.node)
        kind = elementary(result)
        bound = 1 << 63
        return self.widths.wrapped(Whole(whole, -bound, bound - 1, kind, promoted(kind)), _kind(kind))


def _kind(each: Elementary) -> CInteger:
    return CInteger(each.width, each.signed)


def _to_string(source: Type) -> str:
    """The function that writes a value of a type as a string."""
    names = {Kind.BOOL: "string_from_bool", Kind.BITS: "string_from_bits", Kind.REAL: "string_from_real"}
    names |= {Kind.INTEGER: "string_from_whole", Kind.TIME: "string_from_time"}
    return names.get(source.kind, "string_from_date")
