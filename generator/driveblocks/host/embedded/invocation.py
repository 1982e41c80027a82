"""Calls of function block instances.

Inputs are copied into the instance. In-outs of arrays and structures are handed over by reference (in C's model they
are copied in and out, as matiec does, so that the instance keeps its copy); in-outs of scalars are copied in and out
in every model, which is the same as long as nothing is bound twice.
"""

from __future__ import annotations

import ast
from dataclasses import dataclass

from driveblocks.host.embedded.aliases import Overlap, overlaps
from driveblocks.host.embedded.certainty import present
from driveblocks.host.embedded.loops import Loops
from driveblocks.host.embedded.shapes import is_scalar
from driveblocks.host.embedded.syntax import place_of
from driveblocks.st import tree
from driveblocks.st.tree import Binding, Block, Direction
from driveblocks.st.types import plain


def body_name(block: Block) -> str:
    """The Python function that is the body of a block."""
    return f"body_{block.name.upper()}"


@dataclass(slots=True)
class _InOut:
    """An in-out of a call: what the caller binds, and the variable of the instance."""

    binding: Binding
    mine: ast.expr
    theirs: ast.expr

    @property
    def by_value(self) -> bool:
        """Whether it is a scalar."""
        return is_scalar(self.binding.parameter.type)


class Invocation(Loops):
    """Compiles calls of instances."""

    def invoke(self, call: tree.Call, block: Block) -> list[ast.stmt]:
        """A call of an instance, as statements."""
        before, instance = self._instance(call)
        in_outs = self._in_outs(call, instance, before)
        before += self._no_aliases(in_outs)
        for binding in call.bindings:
            before += self._input(binding, instance)
        before += [self._hand_over(each) for each in in_outs]
        self.pen.move(call.at)
        run = self._run(call, block, instance)
        after = [each for in_out in in_outs for each in self._hand_back(in_out)]
        for binding in call.bindings:
            after += self._output(binding, instance)
        return [*before, *run, *after]

    def _instance(self, call: tree.Call) -> tuple[list[ast.stmt], ast.expr]:
        """The instance, in a Python variable."""
        node = self.term(call.callee).node
        if isinstance(node, ast.Name):
            return [], node
        name = self.scope.fresh()
        return [self.pen.assign(self.pen.name(name), node)], self.pen.name(name)

    def _slot(self, binding: Binding, instance: ast.expr) -> ast.expr:
        return self.pen.attribute(instance, binding.parameter.name.upper())

    def _run(self, call: tree.Call, block: Block, instance: ast.expr) -> list[ast.stmt]:
        """The call of the body, under EN where there is one."""
        run: list[ast.stmt] = [self.pen.statement(self.pen.call(body_name(block), instance))]
        flag: ast.expr = self.pen.constant(True)
        if call.en is not None:
            name = self.scope.fresh()
            kept = self.pen.assign(self.pen.name(name), self.truth(call.en))
            flag = self.pen.name(name)
            run = [kept, self.pen.branch(flag, run, [])]
        if call.eno is not None:
            run.append(self.pen.assign(self.term(call.eno).node, flag))
        return run

    # ------------------------------------------------------------ inputs and outputs

    def _input(self, binding: Binding, instance: ast.expr) -> list[ast.stmt]:
        if binding.parameter.direction is not Direction.INPUT or binding.value is None:
            return []
        value = self.stored(binding.value, binding.parameter.type).node
        return [self.copy(binding.parameter.type, self._slot(binding, instance), value)]

    def _output(self, binding: Binding, instance: ast.expr) -> list[ast.stmt]:
        if binding.parameter.direction is not Direction.OUTPUT or binding.value is None:
            return []
        place = self.term(binding.value).node
        self.pen.move(binding.value.at)
        value = self._slot(binding, instance)
        self.forget(binding.value)
        if binding.negated:
            value = self.pen.unary(ast.Not(), value)
        return [self.copy(binding.parameter.type, place, value)]

    # ------------------------------------------------------------ in-outs

    def _in_outs(self, call: tree.Call, instance: ast.expr, before: list[ast.stmt]) -> list[_InOut]:
        found = []
        for binding in call.bindings:
            if binding.parameter.direction is Direction.IN_OUT and binding.value is not None:
                mine = self._settled(self.term(binding.value).node, before)
                found.append(_InOut(binding, mine, self._slot(binding, instance)))
        return found

    def _settled(self, place: ast.expr, before: list[ast.stmt]) -> ast.expr:
        """The same place, its array and index evaluated once, before the call."""
        if not isinstance(place, ast.Subscript) or isinstance(place.slice, ast.Constant):
            return place
        name, index = self.scope.fresh(), self.scope.fresh()
        before.append(self.pen.assign(self.pen.name(name), place.value))
        before.append(self.pen.assign(self.pen.name(index), place.slice))
        return ast.Subscript(self.pen.name(name), self.pen.name(index), ast.Load(), **place_of(place))

    def _hand_over(self, in_out: _InOut) -> ast.stmt:
        if in_out.by_value or self.scope.model != "c":
            return self.pen.assign(in_out.theirs, in_out.mine)
        return self.copy(in_out.binding.parameter.type, in_out.theirs, in_out.mine)

    def _hand_back(self, in_out: _InOut) -> list[ast.stmt]:
        value = in_out.binding.value
        value = present(value)
        if in_out.by_value:
            self.forget(value)
            return [self.pen.assign(in_out.mine, in_out.theirs)]
        if self.scope.model == "c":
            return [self.copy(plain(value.type), in_out.mine, in_out.theirs)]
        return []

    def _no_aliases(self, in_outs: list[_InOut]) -> list[ast.stmt]:
        """Fail where one variable is bound twice."""
        if self.scope.model != "fail":
            return []
        targets = [each.binding.value for each in in_outs if each.binding.value is not None]
        return [self._alias_check(each) for each in overlaps(targets)]

    def _alias_check(self, overlap: Overlap) -> ast.stmt:
        pen = self.pen
        tests = [pen.compare(self.exact(one).node, (ast.Eq(), self.exact(two).node)) for one, two in overlap.indices]
        pen.move(overlap.right.at)
        complaint: ast.stmt = pen.statement(pen.call("aliased"))
        return pen.branch(pen.junction(ast.And(), *tests), [complaint], []) if tests else complaint
