"""Loops of ST as Python loops over an iterator that is the budget of the scan.

`for turn in run.budget: if not condition: break ...` counts turns at almost no cost; a loop that uses the budget up
falls into `else`, which raises. All loops of a scan share one iterator.
"""

from __future__ import annotations

import ast
from collections.abc import Callable
from dataclasses import dataclass, field

from driveblocks.host.coverage import Outcome
from driveblocks.host.embedded.calls import Calls
from driveblocks.host.embedded.certainty import known
from driveblocks.host.embedded.ranges import Ranges
from driveblocks.host.embedded.scope import Scope, UnsupportedError
from driveblocks.host.embedded.shapes import is_scalar
from driveblocks.host.embedded.terms import Whole, is_integral
from driveblocks.host.embedded.usage import reads, writes
from driveblocks.st import tree
from driveblocks.st.tree import VarKind

# Deeper than this, variables that a loop writes are taken to hold anything: analysis would cost a power of the depth.
_ANALYSED_DEPTH = 2
_ROUNDS = 6
# CPython has room for 20 loops and `try` in one another; around the outermost loop stands a `try`.
DEEPEST_LOOPS = 19
_HOISTED = (VarKind.LOCAL, VarKind.INPUT, VarKind.OUTPUT, VarKind.IN_OUT, VarKind.STAT)


@dataclass(slots=True)
class _Loop:
    """An open loop: what CONTINUE has to do first, and what is known at every EXIT and CONTINUE."""

    before_continue: Callable[[], list[ast.stmt]]
    exits: list[Ranges] = field(default_factory=list)
    continues: list[Ranges] = field(default_factory=list)


class LoopCount:
    """The statements that count what becomes of a WHILE or FOR; none unless coverage is asked for."""

    def __init__(self, loops: Loops, at: int, keyword: str) -> None:
        """Count at the decision at `at`."""
        self.loops, self.at, self.keyword = loops, at, keyword
        self.fresh = loops.scope.fresh() if loops.scope.options.coverage else ""

    def begin(self) -> list[ast.stmt]:
        """Before the loop: no turn so far."""
        return self._note(True)

    def turn(self) -> list[ast.stmt]:
        """At the head of a turn."""
        return [*self.loops.outcome(self.at, f"{self.keyword} TRUE"), *self._note(False)]

    def end(self) -> list[ast.stmt]:
        """Where no turn follows: behind some, or at once."""
        counted = self.loops.outcome(self.at, f"{self.keyword} FALSE")
        at_once = self.loops.outcome(self.at, f"{self.keyword} without a turn")
        if at_once:
            counted.append(self.loops.pen.branch(self.loops.pen.name(self.fresh), at_once, []))
        return counted

    def _note(self, fresh: bool) -> list[ast.stmt]:
        pen = self.loops.pen
        return [pen.assign(pen.name(self.fresh), pen.constant(fresh))] if self.fresh else []


class Loops(Calls):
    """Compiles loops; other statements are left to a subclass."""

    def __init__(self, scope: Scope) -> None:
        """Compile within a scope."""
        super().__init__(scope)
        self._open: list[_Loop] = []

    def body(self, statements: list[tree.Statement]) -> list[ast.stmt]:
        """A list of statements."""
        raise NotImplementedError

    # ------------------------------------------------------------ the three loops

    def while_loop(self, statement: tree.While) -> list[ast.stmt]:
        """WHILE: the condition is tested before each turn."""

        count = LoopCount(self, statement.condition.at, "WHILE")

        def turn() -> list[ast.stmt]:
            test = self._leave_unless(self.truth(statement.condition), count)
            self._open[-1].exits.append(self.supposing(statement.condition, False))
            self.scope.ranges.assume(statement.condition, True, self.interval)
            return [*test, *self.body(statement.body)]

        return [*count.begin(), *self._loop(statement, turn, list)]

    def repeat_loop(self, statement: tree.RepeatUntil) -> list[ast.stmt]:
        """REPEAT: the condition is tested behind each turn, also one that CONTINUE cuts short."""

        def until() -> list[ast.stmt]:
            self.pen.move(statement.condition.at)
            truth = self.truth(statement.condition)
            ended, again = (self.outcome(statement.condition.at, f"UNTIL {word}") for word in ("TRUE", "FALSE"))
            test = self.pen.branch(truth, [*ended, self.pen.stop()], again)
            self._open[-1].exits.append(self.supposing(statement.condition, True))
            self.scope.ranges.assume(statement.condition, False, self.interval)
            return [test]

        def turn() -> list[ast.stmt]:
            return [*self.body(statement.body), *until()]

        return self._loop(statement, turn, until)

    def for_loop(self, statement: tree.For) -> list[ast.stmt]:
        """FOR: limits are taken once, except in C's model, which looks at them before each turn."""
        head, stop, step = self._limits(statement)
        if self.scope.model == "fail":
            head += self._not_once(statement, stop(), step())
        count = LoopCount(self, statement.at, "FOR")
        head += count.begin()
        if self.scope.options.line == "beremiz":
            return [*head, *self._beremiz_loop(statement, stop, step, count)]

        def advance() -> list[ast.stmt]:
            self.pen.move(statement.at)
            return self._set(statement.variable, self._sum(statement.variable, step()))

        def turn() -> list[ast.stmt]:
            self.pen.move(statement.at)
            last, by = stop(), step()
            test = self._leave_unless(self._goes_on(self.whole(statement.variable), last, by), count)
            self._open[-1].exits.append(self.scope.ranges.copy())
            if by.low > 0:
                self.scope.ranges.narrow(statement.variable, "<=", (last.low, last.high))
            elif by.high < 0:
                self.scope.ranges.narrow(statement.variable, ">=", (last.low, last.high))
            return [*test, *self.body(statement.body), *advance()]

        return [*head, *self._loop(statement, turn, advance)]

    # ------------------------------------------------------------ FOR in parts

    def _limits(self, statement: tree.For) -> tuple[list[ast.stmt], Callable[[], Whole], Callable[[], Whole]]:
        """The assignment of the start, and how to read the end and the step."""
        kind = statement.variable.type
        head = self._set(statement.variable, self.stored(statement.start, kind))
        head_stop, stop = self._limit_reader(statement, statement.stop)
        if statement.step is None:
            one = self.whole(statement.variable)
            return head + head_stop, stop, lambda: Whole(self.pen.constant(1), 1, 1, one.type, one.c)
        head_step, step = self._limit_reader(statement, statement.step)
        return head + head_stop + head_step, stop, step

    def _limit_reader(self, statement: tree.For, limit: tree.Expression) -> tuple[list[ast.stmt], Callable[[], Whole]]:
        term = self.exact(limit)
        if self.scope.model == "c" or isinstance(term.node, ast.Constant):
            return [], lambda: self.exact(limit)
        self.pen.move(statement.at)
        name = self.scope.fresh()
        kept = self.pen.assign(self.pen.name(name), term.node)
        return [kept], lambda: Whole(self.pen.name(name), term.low, term.high, term.type, term.c)

    def _set(self, variable: tree.Expression, value: object) -> list[ast.stmt]:
        value = known(value, Whole)
        place = self.term(variable).node
        if isinstance(variable, tree.Name) and isinstance(variable.symbol, tree.VarDecl):
            self.scope.ranges.set(variable.symbol, value.low, value.high)
        return [self.pen.assign(place, value.node)]

    def _sum(self, variable: tree.Expression, step: Whole) -> object:
        now = self.whole(variable)
        return self.fitted(self.operation(now, "+", step, now.type), variable.type)

    def _goes_on(self, now: Whole, stop: Whole, step: Whole) -> ast.expr:
        """Whether a value of the control variable is still on the near side of the end."""
        up, down = self.comparison(now, "<=", stop), self.comparison(now, ">=", stop)
        if step.low > 0:
            return up
        if step.high <= 0:
            return down
        return self.pen.choice(self.pen.compare(step.node, (ast.Gt(), self.pen.constant(0))), up, down)

    def _not_once(self, statement: tree.For, stop: Whole, step: Whole) -> list[ast.stmt]:
        """Fail if the loop would run exactly once, which Beremiz' compiler turns into not at all."""
        self.pen.move(statement.at)
        now = self.whole(statement.variable).node
        return [self.pen.statement(self.pen.call("not_once", now, stop.node, step.node))]

    def _beremiz_loop(
        self, statement: tree.For, stop: Callable[[], Whole], step: Callable[[], Whole], count: LoopCount
    ) -> list[ast.stmt]:
        """FOR as Beremiz' compiler has it: it looks one step ahead, and so leaves out a single turn."""
        started = self.scope.fresh()

        def turn() -> list[ast.stmt]:
            self.pen.move(statement.at)
            by = step()
            now = self.whole(statement.variable)
            ahead = self.operation(now, "+", by, now.type)
            ahead = known(ahead, Whole)
            test = self._leave_unless(self._goes_on(ahead, stop(), by), count)
            self._open[-1].exits.append(self.scope.ranges.copy())
            advance = self._set(statement.variable, self._sum(statement.variable, by))
            self.forget(statement.variable)
            first = self.pen.assign(self.pen.name(started), self.pen.constant(True))
            return [*test, self.pen.branch(self.pen.name(started), advance, [first]), *self.body(statement.body)]

        return [self.pen.assign(self.pen.name(started), self.pen.constant(False)), *self._loop(statement, turn, list)]

    # ------------------------------------------------------------ what loops share

    def leave_loop(self) -> list[ast.stmt]:
        """EXIT."""
        self._open[-1].exits.append(self.scope.ranges.copy())
        self.scope.ranges.dead = True
        return [self.pen.stop()]

    def next_turn(self) -> list[ast.stmt]:
        """CONTINUE."""
        before = self._open[-1].before_continue()
        self._open[-1].continues.append(self.scope.ranges.copy())
        self.scope.ranges.dead = True
        return [*before, self.pen.again()]

    def outcome(self, at: int, text: str) -> list[ast.stmt]:
        """A statement that counts an outcome of the decision at `at`; nothing unless coverage is asked for."""
        if not self.scope.options.coverage:
            return []
        outcome = Outcome(*self.pen.unit.place(at), text)
        counters = self.pen.name(self.scope.outcomes(outcome))
        return [self.pen.increment(self.pen.item(counters, self.pen.constant(tuple(outcome))))]

    def _leave_unless(self, test: ast.expr, count: LoopCount) -> list[ast.stmt]:
        leave = self.pen.branch(self.pen.unary(ast.Not(), test), [*count.end(), self.pen.stop()], [])
        return [leave, *count.turn()]

    def supposing(self, condition: tree.Expression, truth: bool) -> Ranges:
        """What would be known if a condition were so."""
        now = self.scope.ranges.copy()
        self.scope.ranges.assume(condition, truth, self.interval)
        then = self.scope.ranges.copy()
        self.scope.ranges.become(now)
        return then

    def _loop(
        self,
        statement: tree.Statement,
        turn: Callable[[], list[ast.stmt]],
        before_continue: Callable[[], list[ast.stmt]],
    ) -> list[ast.stmt]:
        if len(self._open) == DEEPEST_LOOPS:
            text = f"the embedded engine runs at most {DEEPEST_LOOPS} loops in one another: put some into a block"
            raise UnsupportedError(statement.at, text)
        fetch, put_back, hoisted = self._hoist(statement)
        self._settle(statement, turn, before_continue)
        body, loop = self._turn(turn, before_continue)
        self.scope.ranges.dead = True
        for each in loop.exits:
            self.scope.ranges.join(each)
        self.pen.move(statement.at)
        endless = self.pen.statement(self.pen.call("endless"))
        budget = self.pen.attribute(self.pen.name("run"), "budget")
        node: ast.stmt = self.pen.each(budget, body, [endless])
        self.scope.hoisted -= hoisted
        return [*fetch, self.pen.finish([node], put_back)] if put_back else [*fetch, node]

    def _turn(
        self, turn: Callable[[], list[ast.stmt]], before_continue: Callable[[], list[ast.stmt]]
    ) -> tuple[list[ast.stmt], _Loop]:
        """Compile one turn from what is known now; afterwards the state behind it is known."""
        loop = _Loop(before_continue)
        self._open.append(loop)
        body = turn()
        self._open.pop()
        for each in loop.continues:
            self.scope.ranges.join(each)
        return body, loop

    def _settle(
        self,
        statement: tree.Statement,
        turn: Callable[[], list[ast.stmt]],
        before_continue: Callable[[], list[ast.stmt]],
    ) -> None:
        """Find what holds before every turn: compile turns for the sake of analysis until nothing moves any more."""
        ranges = self.scope.ranges
        written = [each for each in writes([statement]) if is_integral(each.type)]
        if len(self._open) < _ANALYSED_DEPTH:
            for _ in range(_ROUNDS):
                head = ranges.copy()
                self._turn(turn, before_continue)
                after = ranges.copy()
                ranges.become(head)
                if not ranges.widen(after, written):
                    return
        ranges.forget(written)

    # ------------------------------------------------------------ variables of an instance inside loops

    def _hoist(self, statement: tree.Statement) -> tuple[list[ast.stmt], list[ast.stmt], set[tree.VarDecl]]:
        """Take variables of the instance into Python variables around an outermost loop, and put them back behind it.

        That is legal because nothing else reaches them meanwhile: in-outs of scalars are copied at calls.
        """
        if self.scope.is_function() or self._open:
            return [], [], set()
        inside = [each for each in reads([statement]) if self._can_hoist(each)]
        changed = set(writes([statement]))
        self.pen.move(statement.at)
        fetch: list[ast.stmt] = []
        back: list[ast.stmt] = []
        for each in inside:
            mine, theirs = self.pen.name(each.name.upper()), self.scope.slot(each)
            fetch.append(self.pen.assign(mine, theirs))
            if each in changed and not self._is_reference(each):
                back.append(self.pen.assign(theirs, mine))
        self.scope.hoisted |= set(inside)
        return fetch, back, set(inside)

    def _can_hoist(self, variable: tree.VarDecl) -> bool:
        if variable.kind not in _HOISTED or self.scope.is_local(variable):
            return False
        return not (variable.constant and not self._is_reference(variable))

    def _is_reference(self, variable: tree.VarDecl) -> bool:
        return not is_scalar(variable.type)
