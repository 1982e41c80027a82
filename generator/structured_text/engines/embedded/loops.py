"""Loops of ST as Python loops over an iterator that is the budget of the scan.

`for turn in run.budget: if not condition: break ...` counts turns at almost no cost; a loop that uses the budget up
falls into `else`, which raises. All loops of a scan share one iterator.
"""

import ast
from collections.abc import Callable

from structured_text.engines.embedded.certainty import known
from structured_text.engines.embedded.operators import comparison, operation
from structured_text.engines.embedded.parts import (
    assume,
    body_of,
    counted,
    exact_of,
    fitted,
    stored,
    supposing,
    term_of,
    truth_of,
    whole_of,
)
from structured_text.engines.embedded.scope import OpenLoop, Scope, UnsupportedError
from structured_text.engines.embedded.shapes import is_scalar
from structured_text.engines.embedded.terms import Whole, is_integral
from structured_text.engines.embedded.usage import reads, writes
from structured_text.language import tree
from structured_text.language.tree import VarKind

# Deeper than this, variables that a loop writes are taken to hold anything: analysis would cost a power of the depth.
_ANALYSED_DEPTH = 2
_ROUNDS = 6
# CPython has room for 20 loops and `try` in one another; around the outermost loop there is a `try`.
DEEPEST_LOOPS = 19
_HOISTED = (VarKind.LOCAL, VarKind.INPUT, VarKind.OUTPUT, VarKind.IN_OUT, VarKind.STAT)


class LoopCount:
    """The statements that count what becomes of a WHILE or FOR; none unless coverage is asked for."""

    def __init__(self, scope: Scope, at: int, keyword: str) -> None:
        """Count at the decision at `at`."""
        self.scope, self.at, self.keyword = scope, at, keyword
        self.fresh = scope.fresh() if scope.coverage else ""

    def begin(self) -> list[ast.stmt]:
        """Before the loop: no turn so far."""
        return self._note(True)

    def turn(self) -> list[ast.stmt]:
        """At the head of a turn."""
        return [*counted(self.scope, self.at, f"{self.keyword} TRUE"), *self._note(False)]

    def end(self) -> list[ast.stmt]:
        """Where no turn follows: after some, or at once."""
        made = counted(self.scope, self.at, f"{self.keyword} FALSE")
        at_once = counted(self.scope, self.at, f"{self.keyword} without a turn")
        if at_once:
            made.append(self.scope.pen.branch(self.scope.pen.name(self.fresh), at_once, []))
        return made

    def _note(self, fresh: bool) -> list[ast.stmt]:
        pen = self.scope.pen
        return [pen.assign(pen.name(self.fresh), pen.constant(fresh))] if self.fresh else []


def while_loop(scope: Scope, statement: tree.While) -> list[ast.stmt]:
    """WHILE: the condition is tested before each turn."""

    count = LoopCount(scope, statement.condition.at, "WHILE")

    def turn() -> list[ast.stmt]:
        test = _leave_unless(scope, truth_of(scope, statement.condition), count)
        scope.loops[-1].exits.append(supposing(scope, statement.condition, False))
        assume(scope, statement.condition, True)
        return [*test, *body_of(scope, statement.body)]

    return [*count.begin(), *_loop(scope, statement, turn, list)]


def repeat_loop(scope: Scope, statement: tree.RepeatUntil) -> list[ast.stmt]:
    """REPEAT: the condition is tested after each turn, also one that CONTINUE cuts short."""

    pen = scope.pen

    def until() -> list[ast.stmt]:
        pen.move(statement.condition.at)
        truth = truth_of(scope, statement.condition)
        ended, again = (counted(scope, statement.condition.at, f"UNTIL {word}") for word in ("TRUE", "FALSE"))
        test = pen.branch(truth, [*ended, pen.stop()], again)
        scope.loops[-1].exits.append(supposing(scope, statement.condition, True))
        assume(scope, statement.condition, False)
        return [test]

    def turn() -> list[ast.stmt]:
        return [*body_of(scope, statement.body), *until()]

    return _loop(scope, statement, turn, until)


def for_loop(scope: Scope, statement: tree.For) -> list[ast.stmt]:
    """FOR: limits are taken once."""
    head, stop, step = _limits(scope, statement)
    head += _not_once(scope, statement, stop(), step())
    count = LoopCount(scope, statement.at, "FOR")
    head += count.begin()

    def advance() -> list[ast.stmt]:
        scope.pen.move(statement.at)
        return _set(scope, statement.variable, _sum(scope, statement.variable, step()))

    def turn() -> list[ast.stmt]:
        scope.pen.move(statement.at)
        last, by = stop(), step()
        test = _leave_unless(scope, _goes_on(scope, whole_of(scope, statement.variable), last, by), count)
        scope.loops[-1].exits.append(scope.ranges.copy())
        if by.low > 0:
            scope.ranges.narrow(statement.variable, "<=", (last.low, last.high))
        elif by.high < 0:
            scope.ranges.narrow(statement.variable, ">=", (last.low, last.high))
        return [*test, *body_of(scope, statement.body), *advance()]

    return [*head, *_loop(scope, statement, turn, advance)]


def _limits(scope: Scope, statement: tree.For) -> tuple[list[ast.stmt], Callable[[], Whole], Callable[[], Whole]]:
    """The assignment of the start, and how to read the end and the step."""
    kind = statement.variable.type
    head = _set(scope, statement.variable, stored(scope, statement.start, kind))
    head_stop, stop = _limit_reader(scope, statement, statement.stop)
    if statement.step is None:
        one = whole_of(scope, statement.variable)
        return head + head_stop, stop, lambda: Whole(scope.pen.constant(1), 1, 1, one.type, one.c)
    head_step, step = _limit_reader(scope, statement, statement.step)
    return head + head_stop + head_step, stop, step


def _limit_reader(
    scope: Scope, statement: tree.For, limit: tree.Expression
) -> tuple[list[ast.stmt], Callable[[], Whole]]:
    pen = scope.pen
    term = exact_of(scope, limit)
    if isinstance(term.node, ast.Constant):
        return [], lambda: exact_of(scope, limit)
    pen.move(statement.at)
    name = scope.fresh()
    kept = pen.assign(pen.name(name), term.node)
    return [kept], lambda: Whole(pen.name(name), term.low, term.high, term.type, term.c)


def _set(scope: Scope, variable: tree.Expression, value: object) -> list[ast.stmt]:
    value = known(value, Whole)
    place = term_of(scope, variable).node
    if isinstance(variable, tree.Name) and isinstance(variable.symbol, tree.VarDecl):
        scope.ranges.set(variable.symbol, value.low, value.high)
    return [scope.pen.assign(place, value.node)]


def _sum(scope: Scope, variable: tree.Expression, step: Whole) -> object:
    now = whole_of(scope, variable)
    return fitted(scope, operation(scope, now, "+", step, now.type), variable.type)


def _goes_on(scope: Scope, now: Whole, stop: Whole, step: Whole) -> ast.expr:
    """Whether a value of the control variable is still on the near side of the end."""
    pen = scope.pen
    up, down = comparison(scope, now, "<=", stop), comparison(scope, now, ">=", stop)
    if step.low > 0:
        return up
    if step.high <= 0:
        return down
    return pen.choice(pen.compare(step.node, (ast.Gt(), pen.constant(0))), up, down)


def _not_once(scope: Scope, statement: tree.For, stop: Whole, step: Whole) -> list[ast.stmt]:
    """Fail if the loop would run exactly once, which Beremiz' compiler turns into not at all."""
    pen = scope.pen
    pen.move(statement.at)
    now = whole_of(scope, statement.variable).node
    return [pen.statement(pen.call("not_once", now, stop.node, step.node))]


def leave_loop(scope: Scope, _: tree.Exit) -> list[ast.stmt]:
    """EXIT."""
    scope.loops[-1].exits.append(scope.ranges.copy())
    scope.ranges.dead = True
    return [scope.pen.stop()]


def next_turn(scope: Scope, _: tree.Continue) -> list[ast.stmt]:
    """CONTINUE."""
    before = scope.loops[-1].before_continue()
    scope.loops[-1].continues.append(scope.ranges.copy())
    scope.ranges.dead = True
    return [*before, scope.pen.again()]


def _leave_unless(scope: Scope, test: ast.expr, count: LoopCount) -> list[ast.stmt]:
    pen = scope.pen
    leave = pen.branch(pen.unary(ast.Not(), test), [*count.end(), pen.stop()], [])
    return [leave, *count.turn()]


def _loop(
    scope: Scope,
    statement: tree.Statement,
    turn: Callable[[], list[ast.stmt]],
    before_continue: Callable[[], list[ast.stmt]],
) -> list[ast.stmt]:
    pen = scope.pen
    if len(scope.loops) == DEEPEST_LOOPS:
        text = f"the embedded engine runs at most {DEEPEST_LOOPS} loops in one another: put some into a block"
        raise UnsupportedError(statement.at, text)
    fetch, put_back, hoisted = _hoist(scope, statement)
    _settle(scope, statement, turn, before_continue)
    body, loop = _turn(scope, turn, before_continue)
    scope.ranges.dead = True
    for each in loop.exits:
        scope.ranges.join(each)
    pen.move(statement.at)
    endless = pen.statement(pen.call("endless"))
    budget = pen.attribute(pen.name("run"), "budget")
    node: ast.stmt = pen.each(budget, body, [endless])
    scope.hoisted -= hoisted
    return [*fetch, pen.finish([node], put_back)] if put_back else [*fetch, node]


def _turn(
    scope: Scope, turn: Callable[[], list[ast.stmt]], before_continue: Callable[[], list[ast.stmt]]
) -> tuple[list[ast.stmt], OpenLoop]:
    """Compile one turn from what is known now; then the state after it is known."""
    loop = OpenLoop(before_continue)
    scope.loops.append(loop)
    body = turn()
    scope.loops.pop()
    for each in loop.continues:
        scope.ranges.join(each)
    return body, loop


def _settle(
    scope: Scope,
    statement: tree.Statement,
    turn: Callable[[], list[ast.stmt]],
    before_continue: Callable[[], list[ast.stmt]],
) -> None:
    """Find what holds before every turn: compile turns for the sake of analysis until nothing moves any more."""
    ranges = scope.ranges
    written = [each for each in writes([statement]) if is_integral(each.type)]
    if len(scope.loops) < _ANALYSED_DEPTH:
        for _ in range(_ROUNDS):
            head = ranges.copy()
            _turn(scope, turn, before_continue)
            after = ranges.copy()
            ranges.become(head)
            if not ranges.widen(after, written):
                return
    ranges.forget(written)


def _hoist(scope: Scope, statement: tree.Statement) -> tuple[list[ast.stmt], list[ast.stmt], set[tree.VarDecl]]:
    """Take variables of the instance into Python variables around an outermost loop, and put them back after it.

    That is legal because nothing else reaches them meanwhile: in-outs of scalars are copied at calls.
    """
    pen = scope.pen
    if scope.is_function() or scope.loops:
        return [], [], set()
    inside = [each for each in reads([statement]) if _can_hoist(scope, each)]
    changed = set(writes([statement]))
    pen.move(statement.at)
    fetch: list[ast.stmt] = []
    back: list[ast.stmt] = []
    for each in inside:
        mine, theirs = pen.name(each.name.upper()), scope.slot(each)
        fetch.append(pen.assign(mine, theirs))
        if each in changed and not _is_reference(each):
            back.append(pen.assign(theirs, mine))
    scope.hoisted |= set(inside)
    return fetch, back, set(inside)


def _can_hoist(scope: Scope, variable: tree.VarDecl) -> bool:
    if variable.kind not in _HOISTED or scope.is_local(variable):
        return False
    return not (variable.constant and not _is_reference(variable))


def _is_reference(variable: tree.VarDecl) -> bool:
    return not is_scalar(variable.type)
