"""Statements of ST as Python statements."""

import ast
from dataclasses import dataclass
from itertools import chain, repeat

from structured_text.engines.coverage import case_outcome
from structured_text.engines.embedded.calls import call_term, returned
from structured_text.engines.embedded.certainty import present
from structured_text.engines.embedded.invocation import invoke
from structured_text.engines.embedded.loops import for_loop, leave_loop, next_turn, repeat_loop, while_loop
from structured_text.engines.embedded.parts import assume, body_of, counted, stored, supposing, term_of, truth_of
from structured_text.engines.embedded.ranges import Ranges
from structured_text.engines.embedded.scope import Scope, Statements, UnsupportedError
from structured_text.engines.embedded.stores import copy_statement, forget
from structured_text.engines.embedded.syntax import place_of
from structured_text.engines.embedded.terms import Whole
from structured_text.language import tree
from structured_text.language.tree import Block

# How many branches Python nests in one another; 40 levels of ST in the last of each must still go in its stack.
_LONGEST_CHAIN = 16


@dataclass(slots=True)
class _Link:
    """One branch of a chain, and what happens before the next one is tested."""

    branch: ast.If
    before_next: list[ast.stmt]


def _assign(scope: Scope, statement: tree.Assign) -> list[ast.stmt]:
    if statement.op != ":=":
        raise UnsupportedError(statement.at, f"the embedded engine does not run {statement.op}")
    target = statement.target
    value = stored(scope, statement.value, target.type)
    place = term_of(scope, target).node
    scope.pen.move(statement.at)
    forget(scope, target)
    if isinstance(value, Whole) and isinstance(target, tree.Name) and isinstance(target.symbol, tree.VarDecl):
        scope.ranges.set(target.symbol, value.low, value.high)
    return [copy_statement(scope, target.type, place, value.node)]


def _call_statement(scope: Scope, statement: tree.CallStatement) -> list[ast.stmt]:
    call = statement.call
    if isinstance(call.target, Block):
        return invoke(scope, call, call.target)
    return [scope.pen.statement(call_term(scope, call).node)]


def _return(scope: Scope, statement: tree.Return) -> list[ast.stmt]:
    if statement.value is not None:
        raise UnsupportedError(statement.at, "the embedded engine does not run RETURN with a value")
    leave = scope.pen.leave(returned_value(scope))
    scope.ranges.dead = True
    return [leave]


def returned_value(scope: Scope) -> ast.expr | None:
    """What the Python function of this POU returns."""
    pen = scope.pen
    function = scope.pou
    if not isinstance(function, tree.Function):
        return None
    result = pen.constant(0) if function.result is None else pen.name(function.result.name.upper())
    handed = [pen.name(each.name.upper()) for each in returned(function)]
    return pen.row(result, *handed) if handed else result


def _if(scope: Scope, statement: tree.If) -> list[ast.stmt]:
    """IF and its ELSIFs; what is known after it is what all branches have in common."""
    pen = scope.pen
    ranges = scope.ranges
    links: list[_Link] = []
    taken: list[Ranges] = []
    for keyword, each in zip(chain(["IF"], repeat("ELSIF")), statement.branches, strict=False):
        pen.move(each.condition.at)
        test = truth_of(scope, each.condition)
        refuted = supposing(scope, each.condition, False)
        assume(scope, each.condition, True)
        body = body_of(scope, each.body)
        taken.append(ranges.copy())
        ranges.become(refuted)
        yes, no = (counted(scope, each.condition.at, f"{keyword} {word}") for word in ("TRUE", "FALSE"))
        pen.move(each.at)
        links.append(_Link(pen.branch(test, [*yes, *body], []), no))
    rest = body_of(scope, statement.otherwise) if statement.otherwise else []
    for known in reversed(taken):
        ranges.join(known)
    pen.move(statement.at)
    return _chain(scope, links, rest)


def _chain(scope: Scope, links: list[_Link], rest: list[ast.stmt]) -> list[ast.stmt]:
    """Branches of which the first that fits is taken, or else `rest`.

    Python nests every `elif` in the one before it, and its compiler cannot go deep: a long chain is cut into
    several, one after the other, of which the next runs where the one before has found nothing.
    """
    parts = [links[start : start + _LONGEST_CHAIN] for start in range(0, len(links), _LONGEST_CHAIN)]
    if len(parts) == 1:
        return _chained(links, rest)
    pen, name = scope.pen, scope.fresh()
    searching: ast.stmt = pen.assign(pen.name(name), pen.constant(True))
    found: ast.stmt = pen.assign(pen.name(name), pen.constant(False))
    made = [searching]
    for part in parts:
        behind = rest if part is parts[-1] else [searching]
        made.append(pen.branch(pen.name(name), [found, *_chained(part, behind)], []))
    return made


def _case(scope: Scope, statement: tree.Case) -> list[ast.stmt]:
    pen = scope.pen
    selector = term_of(scope, statement.selector)
    if isinstance(selector, Whole):
        selector = scope.widths.exact(selector)
    pen.move(statement.at)
    name = scope.fresh()
    kept = pen.assign(pen.name(name), selector.node)
    before = scope.ranges.copy()
    ends: list[Ranges] = []
    links: list[_Link] = []
    for branch in statement.branches:
        test, body = _case_branch(scope, statement, branch, name, before)
        links.append(_Link(ast.If(test, body, [], **place_of(test)), []))
        ends.append(scope.ranges.copy())
    scope.ranges.become(before)
    rest = counted(scope, statement.at, "CASE ELSE")
    rest += body_of(scope, statement.otherwise) if statement.otherwise else []
    for each in ends:
        scope.ranges.join(each)
    return [kept, *_chain(scope, links, rest)]


def _case_branch(
    scope: Scope, statement: tree.Case, branch: tree.CaseBranch, name: str, before: Ranges
) -> tuple[ast.expr, list[ast.stmt]]:
    """The test of a branch and its statements, compiled from what is known before the CASE."""
    scope.ranges.become(before)
    scope.pen.move(branch.at)
    bounds = [_label(scope, each, statement.selector) for each in branch.labels]
    if isinstance(statement.selector, tree.Name):
        lows, highs = zip(*bounds, strict=True)
        _narrow_selector(scope, statement.selector, min(lows), max(highs))
    tests = [_matches(scope, name, low, high) for low, high in bounds]
    test = scope.pen.junction(ast.Or(), *tests)
    return test, [*counted(scope, branch.at, case_outcome(branch)), *body_of(scope, branch.body)]


def _narrow_selector(scope: Scope, selector: tree.Name, low: int, high: int) -> None:
    if isinstance(term_of(scope, selector), Whole):
        scope.ranges.narrow(selector, ">=", (low, low))
        scope.ranges.narrow(selector, "<=", (high, high))


def _matches(scope: Scope, name: str, low: int, high: int) -> ast.expr:
    pen = scope.pen
    if low == high:
        return pen.compare(pen.name(name), (ast.Eq(), pen.constant(low)))
    return pen.compare(pen.constant(low), (ast.LtE(), pen.name(name)), (ast.LtE(), pen.constant(high)))


def _label(scope: Scope, label: tree.Expression | tree.LabelRange, selector: tree.Expression) -> tuple[int, int]:
    """The values that a label covers."""
    evaluate = present(scope.shapes.evaluate)
    if isinstance(label, tree.LabelRange):
        return evaluate(label.low, selector.type), evaluate(label.high, selector.type)
    value = evaluate(label, selector.type)
    return value, value


def _chained(links: list[_Link], rest: list[ast.stmt]) -> list[ast.stmt]:
    """Branches, each as what follows the `else` of the one before it."""
    for each in reversed(links):
        each.branch.orelse = [*each.before_next, *rest]
        rest = [each.branch]
    return rest


STATEMENTS: Statements = {
    tree.Assign: _assign,
    tree.CallStatement: _call_statement,
    tree.If: _if,
    tree.Case: _case,
    tree.While: while_loop,
    tree.RepeatUntil: repeat_loop,
    tree.For: for_loop,
    tree.Exit: leave_loop,
    tree.Continue: next_turn,
    tree.Return: _return,
    tree.Empty: lambda _scope, _statement: [],
}
