"""Calls of the functions that are written in ST, and what calls of both kinds share: stores, copies, EN and ENO.

A function becomes a Python function of its inputs and in-outs. If it has outputs, or in-outs of a scalar type, it
returns a tuple: the result, then these, and the call stores them.
"""

import ast

from structured_text.engines.embedded.functions import builtin
from structured_text.engines.embedded.parts import result_of, stored, term_of, truth_of
from structured_text.engines.embedded.scope import Scope, UnsupportedError
from structured_text.engines.embedded.shapes import is_scalar
from structured_text.engines.embedded.stores import stored_in
from structured_text.engines.embedded.terms import Floating, Term
from structured_text.language import tree
from structured_text.language.tree import Binding, Builtin, Direction, Parameter
from structured_text.language.types import Kind


def returned(function: tree.Function) -> list[Parameter]:
    """The parameters whose values a function hands back after its result."""
    return [
        each
        for each in function.parameters.values()
        if each.direction is Direction.OUTPUT or (each.direction is Direction.IN_OUT and is_scalar(each.type))
    ]


def function_name(function: tree.Function) -> str:
    """The Python function of an ST function."""
    return f"function_{function.name.upper()}"


def call_term(scope: Scope, call: tree.Call) -> Term:
    """A call of a standard function or one written in ST. UnsupportedError."""
    if isinstance(call.target, Builtin):
        term = builtin(scope, call, call.target)
    elif isinstance(call.target, tree.Function):
        term = _user_call(scope, call, call.target)
    else:
        raise UnsupportedError(call.at, "this is no function")
    return _enabled(scope, call, term) if call.en is not None or call.eno is not None else term


def _user_call(scope: Scope, call: tree.Call, function: tree.Function) -> Term:
    pen = scope.pen
    arguments = [_argument(scope, each) for each in call.bindings if each.parameter.direction is not Direction.OUTPUT]
    pen.move(call.at)
    node: ast.expr = pen.call(function_name(function), *arguments)
    if returned(function):
        node = _unpacked(scope, call, function, node)
    term = result_of(node, function.type)
    changes = any(each.direction is not Direction.INPUT for each in function.parameters.values())
    if isinstance(term, Floating) and changes:
        name = scope.fresh()
        term.node, term.other = pen.keep(name, node), pen.name(name)
    return term


def _argument(scope: Scope, binding: Binding) -> ast.expr:
    if binding.value is None:
        return default(scope, binding.parameter)
    if binding.parameter.direction is Direction.IN_OUT:
        return term_of(scope, binding.value).node
    return stored(scope, binding.value, binding.parameter.type).node


def default(scope: Scope, parameter: Parameter) -> ast.expr:
    """The value of an input that a call omits."""
    pen = scope.pen
    if is_scalar(parameter.type):
        return pen.constant(scope.shapes.scalar(parameter.type, parameter.default))
    maker = scope.shapes.maker(parameter.type, parameter.default)
    return pen.call(scope.object("make", maker), pen.constant(None))


def _unpacked(scope: Scope, call: tree.Call, function: tree.Function, node: ast.expr) -> ast.expr:
    """Store what a function hands back, all in one expression whose value is the result."""
    pen = scope.pen
    name = scope.fresh()
    steps: list[ast.expr] = [pen.keep(name, node)]
    values = {each.parameter.name.upper(): each for each in call.bindings}
    for place, parameter in enumerate(returned(function), start=1):
        binding = values[parameter.name.upper()]
        if binding.value is not None:
            got: ast.expr = pen.item(pen.name(name), pen.constant(place))
            got = pen.unary(ast.Not(), got) if binding.negated else got
            steps.append(stored_in(scope, binding.value, got))
    steps.append(pen.item(pen.name(name), pen.constant(0)))
    return pen.item(pen.row(*steps), pen.constant(-1))


def _enabled(scope: Scope, call: tree.Call, term: Term) -> Term:
    """A call under EN: not made when it is FALSE, with the initial value as result; ENO says which."""
    pen = scope.pen
    kept: ast.expr = pen.constant(True)
    node = term.node
    if call.en is not None:
        name = scope.fresh()
        kept, again = pen.keep(name, truth_of(scope, call.en)), pen.name(name)
        zero = default(scope, Parameter("", call.type)) if call.type.kind is not Kind.NONE else pen.constant(0)
        node = pen.choice(again, node, zero)
    steps = [kept, node]
    if call.eno is not None:
        flag = kept if call.en is None else pen.name(name)
        steps.append(stored_in(scope, call.eno, flag))
    pen.move(call.at)
    return result_of(pen.item(pen.row(*steps), pen.constant(1)), call.type)
