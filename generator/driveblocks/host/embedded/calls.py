"""Calls of the functions that are written in ST, and what calls of both kinds share: stores, copies, EN and ENO.

A function becomes a Python function of its inputs and in-outs. If it has outputs, or in-outs of a scalar type, it
returns a tuple: the result, then these, and the call stores them.
"""

from __future__ import annotations

import ast

from driveblocks.host.embedded.certainty import known
from driveblocks.host.embedded.functions import Functions
from driveblocks.host.embedded.scope import UnsupportedError
from driveblocks.host.embedded.shapes import is_scalar
from driveblocks.host.embedded.terms import Floating, Term
from driveblocks.st import tree
from driveblocks.st.tree import Array, Binding, Builtin, Direction, Parameter
from driveblocks.st.types import Kind, Type, plain


def returned(function: tree.Function) -> list[Parameter]:
    """The parameters whose values a function hands back behind its result."""
    return [
        each
        for each in function.parameters.values()
        if each.direction is Direction.OUTPUT or (each.direction is Direction.IN_OUT and is_scalar(each.type))
    ]


def function_name(function: tree.Function) -> str:
    """The Python function of an ST function."""
    return f"function_{function.name.upper()}"


class Calls(Functions):
    """Compiles calls of functions."""

    def call(self, call: tree.Call) -> Term:
        """A call of a standard function or one written in ST. UnsupportedError."""
        if isinstance(call.target, Builtin):
            term = self.builtin(call, call.target)
        elif isinstance(call.target, tree.Function):
            term = self._user_call(call, call.target)
        else:
            raise UnsupportedError(call.at, "this is no function")
        return self._enabled(call, term) if call.en is not None or call.eno is not None else term

    def _user_call(self, call: tree.Call, function: tree.Function) -> Term:
        arguments = [self._argument(each) for each in call.bindings if each.parameter.direction is not Direction.OUTPUT]
        self.pen.move(call.at)
        node: ast.expr = self.pen.call(function_name(function), *arguments)
        if returned(function):
            node = self._unpacked(call, function, node)
        term = self.result(node, function.type)
        changes = any(each.direction is not Direction.INPUT for each in function.parameters.values())
        if isinstance(term, Floating) and changes and self.scope.model == "fail":
            name = self.scope.fresh()
            term.node, term.other = self.pen.keep(name, node), self.pen.name(name)
        return term

    def _argument(self, binding: Binding) -> ast.expr:
        if binding.value is None:
            return self.default(binding.parameter)
        if binding.parameter.direction is Direction.IN_OUT:
            return self.term(binding.value).node
        return self.stored(binding.value, binding.parameter.type).node

    def default(self, parameter: Parameter) -> ast.expr:
        """The value of an input that a call leaves out."""
        if is_scalar(parameter.type):
            return self.pen.constant(self.scope.shapes.scalar(parameter.type, parameter.default))
        maker = self.scope.shapes.maker(parameter.type, parameter.default)
        return self.pen.call(self.scope.object("make", maker), self.pen.constant(None))

    def _unpacked(self, call: tree.Call, function: tree.Function, node: ast.expr) -> ast.expr:
        """Store what a function hands back, all in one expression whose value is the result."""
        name = self.scope.fresh()
        steps: list[ast.expr] = [self.pen.keep(name, node)]
        values = {each.parameter.name.upper(): each for each in call.bindings}
        for place, parameter in enumerate(returned(function), start=1):
            binding = values[parameter.name.upper()]
            if binding.value is not None:
                got: ast.expr = self.pen.item(self.pen.name(name), self.pen.constant(place))
                got = self.pen.unary(ast.Not(), got) if binding.negated else got
                steps.append(self.store(binding.value, got))
        steps.append(self.pen.item(self.pen.name(name), self.pen.constant(0)))
        return self.pen.item(self.pen.row(*steps), self.pen.constant(-1))

    def _enabled(self, call: tree.Call, term: Term) -> Term:
        """A call under EN: not made when it is FALSE, with the initial value as result; ENO says which."""
        kept: ast.expr = self.pen.constant(True)
        node = term.node
        if call.en is not None:
            name = self.scope.fresh()
            kept, again = self.pen.keep(name, self.truth(call.en)), self.pen.name(name)
            zero = self.default(Parameter("", call.type)) if call.type.kind is not Kind.NONE else self.pen.constant(0)
            node = self.pen.choice(again, node, zero)
        steps = [kept, node]
        if call.eno is not None:
            flag = kept if call.en is None else self.pen.name(name)
            steps.append(self.store(call.eno, flag))
        self.pen.move(call.at)
        return self.result(self.pen.item(self.pen.row(*steps), self.pen.constant(1)), call.type)

    # ------------------------------------------------------------ stores

    def store(self, target: tree.Expression, value: ast.expr) -> ast.expr:
        """An expression that stores a value of the target's type."""
        place = self.term(target).node
        self.forget(target)
        if isinstance(place, ast.Name):
            return self.pen.keep(place.id, value)
        if not is_scalar(target.type):
            return self.copying(target.type, place, value)
        if isinstance(place, ast.Attribute):
            return self.pen.call("setattr", place.value, self.pen.constant(place.attr), value)
        place = known(place, ast.Subscript)
        return self.pen.method(place.value, "__setitem__", place.slice, value)

    def forget(self, target: tree.Expression) -> None:
        """Give up what was known about a variable that something has written."""
        if isinstance(target, tree.Name) and isinstance(target.symbol, tree.VarDecl):
            self.scope.ranges.forget([target.symbol])

    def copying(self, kind: Type, into: ast.expr, source: ast.expr) -> ast.expr:
        """An expression that copies an array or structure into another one."""
        return self.pen.call(self.scope.object("copy", self.scope.shapes.copier(plain(kind))), into, source)

    def copy(self, kind: Type, into: ast.expr, source: ast.expr) -> ast.stmt:
        """A statement that assigns a value: scalars as such, arrays and structures by copying into the target."""
        kind = plain(kind)
        if is_scalar(kind):
            return self.pen.assign(into, source)
        if isinstance(kind, Array) and len(kind.bounds) == 1 and is_scalar(kind.element):
            return self.pen.assign(self.pen.slice(into), source)
        return self.pen.statement(self.copying(kind, into, source))
