"""Calls of function block instances.

Inputs are copied into the instance. In-outs of arrays and structures are handed over by reference, those of scalars are
copied in and out: the same, and the same as on matiec, which copies all, as long as nothing is bound twice.
"""

import ast
from dataclasses import dataclass
from itertools import combinations

from structured_text.engines.embedded.certainty import present
from structured_text.engines.embedded.parts import exact_of, stored, term_of, truth_of
from structured_text.engines.embedded.scope import Scope
from structured_text.engines.embedded.shapes import is_scalar
from structured_text.engines.embedded.stores import copy_statement, forget
from structured_text.engines.embedded.syntax import place_of
from structured_text.engines.embedded.usage import root
from structured_text.language import tree
from structured_text.language.tree import Binding, Block, Direction


@dataclass(slots=True)
class Overlap:
    """Two in-outs that overlap if every pair of indices is equal; without pairs they always do."""

    left: tree.Expression
    right: tree.Expression
    indices: list[tuple[tree.Expression, tree.Expression]]


def overlaps(targets: list[tree.Expression]) -> list[Overlap]:
    """Every pair of in-outs that overlaps or may overlap."""
    found = (_overlap(left, right) for left, right in combinations(targets, 2))
    return [each for each in found if each is not None]


def _overlap(left: tree.Expression, right: tree.Expression) -> Overlap | None:
    if root(left) is None or root(left) is not root(right):
        return None
    pairs: list[tuple[tree.Expression, tree.Expression]] = []
    for mine, other in zip(_steps(left), _steps(right), strict=False):
        if isinstance(mine, tree.Member) and isinstance(other, tree.Member):
            if mine.name.upper() != other.name.upper():
                return None
        elif isinstance(mine, tree.Index) and isinstance(other, tree.Index):
            for one, two in zip(mine.indices, other.indices, strict=True):
                if isinstance(one, tree.Literal) and isinstance(two, tree.Literal):
                    if one.value != two.value:
                        return None
                else:
                    pairs.append((one, two))
    return Overlap(left, right, pairs)


def _steps(expression: tree.Expression) -> list[tree.Expression]:
    """The fields and indices from the variable inwards."""
    steps: list[tree.Expression] = []
    while isinstance(expression, tree.Member | tree.Index):
        steps.append(expression)
        expression = expression.base
    return steps[::-1]


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


def invoke(scope: Scope, call: tree.Call, block: Block) -> list[ast.stmt]:
    """A call of an instance, as statements."""
    before, instance = _instance(scope, call)
    in_outs = _in_outs(scope, call, instance, before)
    before += _no_aliases(scope, in_outs)
    for binding in call.bindings:
        before += _input(scope, binding, instance)
    before += [scope.pen.assign(each.theirs, each.mine) for each in in_outs]
    scope.pen.move(call.at)
    run = _run(scope, call, block, instance)
    after = [each for in_out in in_outs for each in _hand_back(scope, in_out)]
    for binding in call.bindings:
        after += _output(scope, binding, instance)
    return [*before, *run, *after]


def _instance(scope: Scope, call: tree.Call) -> tuple[list[ast.stmt], ast.expr]:
    """The instance, in a Python variable."""
    pen = scope.pen
    node = term_of(scope, call.callee).node
    if isinstance(node, ast.Name):
        return [], node
    name = scope.fresh()
    return [pen.assign(pen.name(name), node)], pen.name(name)


def _slot(scope: Scope, binding: Binding, instance: ast.expr) -> ast.expr:
    return scope.pen.attribute(instance, binding.parameter.name.upper())


def _run(scope: Scope, call: tree.Call, block: Block, instance: ast.expr) -> list[ast.stmt]:
    """The call of the body, under EN where there is one."""
    pen = scope.pen
    run: list[ast.stmt] = [pen.statement(pen.call(body_name(block), instance))]
    flag: ast.expr = pen.constant(True)
    if call.en is not None:
        name = scope.fresh()
        kept = pen.assign(pen.name(name), truth_of(scope, call.en))
        flag = pen.name(name)
        run = [kept, pen.branch(flag, run, [])]
    if call.eno is not None:
        run.append(pen.assign(term_of(scope, call.eno).node, flag))
    return run


def _input(scope: Scope, binding: Binding, instance: ast.expr) -> list[ast.stmt]:
    if binding.parameter.direction is not Direction.INPUT or binding.value is None:
        return []
    value = stored(scope, binding.value, binding.parameter.type).node
    return [copy_statement(scope, binding.parameter.type, _slot(scope, binding, instance), value)]


def _output(scope: Scope, binding: Binding, instance: ast.expr) -> list[ast.stmt]:
    if binding.parameter.direction is not Direction.OUTPUT or binding.value is None:
        return []
    place = term_of(scope, binding.value).node
    scope.pen.move(binding.value.at)
    value = _slot(scope, binding, instance)
    forget(scope, binding.value)
    if binding.negated:
        value = scope.pen.unary(ast.Not(), value)
    return [copy_statement(scope, binding.parameter.type, place, value)]


def _in_outs(scope: Scope, call: tree.Call, instance: ast.expr, before: list[ast.stmt]) -> list[_InOut]:
    found = []
    for binding in call.bindings:
        if binding.parameter.direction is Direction.IN_OUT and binding.value is not None:
            mine = _settled(scope, term_of(scope, binding.value).node, before)
            found.append(_InOut(binding, mine, _slot(scope, binding, instance)))
    return found


def _settled(scope: Scope, place: ast.expr, before: list[ast.stmt]) -> ast.expr:
    """The same place, its array and index evaluated once, before the call."""
    pen = scope.pen
    if not isinstance(place, ast.Subscript) or isinstance(place.slice, ast.Constant):
        return place
    name, index = scope.fresh(), scope.fresh()
    before.append(pen.assign(pen.name(name), place.value))
    before.append(pen.assign(pen.name(index), place.slice))
    return ast.Subscript(pen.name(name), pen.name(index), ast.Load(), **place_of(place))


def _hand_back(scope: Scope, in_out: _InOut) -> list[ast.stmt]:
    if not in_out.by_value:
        return []
    forget(scope, present(in_out.binding.value))
    return [scope.pen.assign(in_out.mine, in_out.theirs)]


def _no_aliases(scope: Scope, in_outs: list[_InOut]) -> list[ast.stmt]:
    """Fail where one variable is bound twice."""
    targets = [each.binding.value for each in in_outs if each.binding.value is not None]
    return [_alias_check(scope, each) for each in overlaps(targets)]


def _alias_check(scope: Scope, overlap: Overlap) -> ast.stmt:
    pen = scope.pen
    tests = [
        pen.compare(exact_of(scope, one).node, (ast.Eq(), exact_of(scope, two).node)) for one, two in overlap.indices
    ]
    pen.move(overlap.right.at)
    complaint: ast.stmt = pen.statement(pen.call("aliased"))
    return pen.branch(pen.junction(ast.And(), *tests), [complaint], []) if tests else complaint
