"""Statements of ST as Python statements."""

from __future__ import annotations

import ast
from collections.abc import Callable
from dataclasses import dataclass
from itertools import chain, repeat

from driveblocks.host.coverage import case_outcome
from driveblocks.host.embedded.calls import returned
from driveblocks.host.embedded.certainty import present
from driveblocks.host.embedded.invocation import Invocation
from driveblocks.host.embedded.ranges import Ranges
from driveblocks.host.embedded.scope import Scope, UnsupportedError
from driveblocks.host.embedded.syntax import place_of
from driveblocks.host.embedded.terms import Whole
from driveblocks.st import tree
from driveblocks.st.tree import Block

# How many branches Python nests in one another; 40 levels of ST in the last of each must still go in its stack.
_LONGEST_CHAIN = 16


@dataclass(slots=True)
class _Link:
    """One branch of a chain, and what happens before the next one is looked at."""

    branch: ast.If
    before_next: list[ast.stmt]


class Statements(Invocation):
    """Compiles the statements of one POU."""

    def __init__(self, scope: Scope) -> None:
        """Compile within a scope."""
        super().__init__(scope)
        self._kinds: dict[type[tree.Statement], Callable[..., list[ast.stmt]]] = {
            tree.Assign: self._assign,
            tree.CallStatement: self._call_statement,
            tree.If: self._if,
            tree.Case: self._case,
            tree.While: self.while_loop,
            tree.RepeatUntil: self.repeat_loop,
            tree.For: self.for_loop,
            tree.Exit: lambda _: self.leave_loop(),
            tree.Continue: lambda _: self.next_turn(),
            tree.Return: self._return,
            tree.Empty: lambda _: [],
        }

    def body(self, statements: list[tree.Statement]) -> list[ast.stmt]:
        """A list of statements; each stands at its ST line and, if asked for, counts itself. UnsupportedError."""
        written: list[ast.stmt] = []
        for each in statements:
            self.pen.move(each.at)
            if self.scope.options.coverage and not isinstance(each, tree.Empty):
                written.append(self._count())
            written += self._kinds[type(each)](each)
        return written or [self.pen.nothing()]

    def _count(self) -> ast.stmt:
        name = self.scope.hits(self.pen.line)
        return self.pen.increment(self.pen.item(self.pen.name(name), self.pen.constant(self.pen.line)))

    def _assign(self, statement: tree.Assign) -> list[ast.stmt]:
        if statement.op != ":=":
            raise UnsupportedError(statement.at, f"the embedded engine does not run {statement.op}")
        target = statement.target
        value = self.stored(statement.value, target.type)
        place = self.term(target).node
        self.pen.move(statement.at)
        self.forget(target)
        if isinstance(value, Whole) and isinstance(target, tree.Name) and isinstance(target.symbol, tree.VarDecl):
            self.scope.ranges.set(target.symbol, value.low, value.high)
        return [self.copy(target.type, place, value.node)]

    def _call_statement(self, statement: tree.CallStatement) -> list[ast.stmt]:
        call = statement.call
        if isinstance(call.target, Block):
            return self.invoke(call, call.target)
        return [self.pen.statement(self.call(call).node)]

    def _return(self, statement: tree.Return) -> list[ast.stmt]:
        if statement.value is not None:
            raise UnsupportedError(statement.at, "the embedded engine does not run RETURN with a value")
        leave = self.pen.leave(self.returned_value())
        self.scope.ranges.dead = True
        return [leave]

    def returned_value(self) -> ast.expr | None:
        """What the Python function of this POU returns."""
        function = self.scope.pou
        if not isinstance(function, tree.Function):
            return None
        result = self.pen.constant(0) if function.result is None else self.pen.name(function.result.name.upper())
        handed = [self.pen.name(each.name.upper()) for each in returned(function)]
        return self.pen.row(result, *handed) if handed else result

    # ------------------------------------------------------------ choices

    def _if(self, statement: tree.If) -> list[ast.stmt]:
        """IF and its ELSIFs; what is known behind it is what all ways have in common."""
        ranges = self.scope.ranges
        links: list[_Link] = []
        taken: list[Ranges] = []
        for keyword, each in zip(chain(["IF"], repeat("ELSIF")), statement.branches, strict=False):
            self.pen.move(each.condition.at)
            test = self.truth(each.condition)
            refuted = self.supposing(each.condition, False)
            ranges.assume(each.condition, True, self.interval)
            body = self.body(each.body)
            taken.append(ranges.copy())
            ranges.become(refuted)
            yes, no = (self.outcome(each.condition.at, f"{keyword} {word}") for word in ("TRUE", "FALSE"))
            self.pen.move(each.at)
            links.append(_Link(self.pen.branch(test, [*yes, *body], []), no))
        rest = self.body(statement.otherwise) if statement.otherwise else []
        for known in reversed(taken):
            ranges.join(known)
        self.pen.move(statement.at)
        return self._chain(links, rest)

    def _chain(self, links: list[_Link], rest: list[ast.stmt]) -> list[ast.stmt]:
        """Branches of which the first that fits is taken, or else `rest`.

        Python nests every `elif` in the one before it, and its compiler cannot go deep: a long chain is cut into
        several, one behind the other, of which the next runs where the one before has found nothing.
        """
        parts = [links[start : start + _LONGEST_CHAIN] for start in range(0, len(links), _LONGEST_CHAIN)]
        if len(parts) == 1:
            return _chained(links, rest)
        pen, name = self.pen, self.scope.fresh()
        searching: ast.stmt = pen.assign(pen.name(name), pen.constant(True))
        found: ast.stmt = pen.assign(pen.name(name), pen.constant(False))
        made = [searching]
        for part in parts:
            behind = rest if part is parts[-1] else [searching]
            made.append(pen.branch(pen.name(name), [found, *_chained(part, behind)], []))
        return made

    def _case(self, statement: tree.Case) -> list[ast.stmt]:
        selector = self.term(statement.selector)
        if isinstance(selector, Whole):
            selector = self.widths.exact(selector)
        self.pen.move(statement.at)
        name = self.scope.fresh()
        kept = self.pen.assign(self.pen.name(name), selector.node)
        before = self.scope.ranges.copy()
        ends: list[Ranges] = []
        links: list[_Link] = []
        for branch in statement.branches:
            test, body = self._case_branch(statement, branch, name, before)
            links.append(_Link(ast.If(test, body, [], **place_of(test)), []))
            ends.append(self.scope.ranges.copy())
        self.scope.ranges.become(before)
        rest = self.outcome(statement.at, "CASE ELSE")
        rest += self.body(statement.otherwise) if statement.otherwise else []
        for each in ends:
            self.scope.ranges.join(each)
        return [kept, *self._chain(links, rest)]

    def _case_branch(
        self, statement: tree.Case, branch: tree.CaseBranch, name: str, before: Ranges
    ) -> tuple[ast.expr, list[ast.stmt]]:
        """The test of a branch and its statements, compiled from what is known before the CASE."""
        self.scope.ranges.become(before)
        self.pen.move(branch.at)
        bounds = [self._label(each, statement.selector) for each in branch.labels]
        if isinstance(statement.selector, tree.Name):
            lows, highs = zip(*bounds, strict=True)
            self._narrow_selector(statement.selector, min(lows), max(highs))
        tests = [self._matches(name, low, high) for low, high in bounds]
        test = self.pen.junction(ast.Or(), *tests)
        return test, [*self.outcome(branch.at, case_outcome(branch)), *self.body(branch.body)]

    def _narrow_selector(self, selector: tree.Name, low: int, high: int) -> None:
        if isinstance(self.term(selector), Whole):
            self.scope.ranges.narrow(selector, ">=", (low, low))
            self.scope.ranges.narrow(selector, "<=", (high, high))

    def _matches(self, name: str, low: int, high: int) -> ast.expr:
        pen = self.pen
        if low == high:
            return pen.compare(pen.name(name), (ast.Eq(), pen.constant(low)))
        return pen.compare(pen.constant(low), (ast.LtE(), pen.name(name)), (ast.LtE(), pen.constant(high)))

    def _label(self, label: tree.Expression | tree.LabelRange, selector: tree.Expression) -> tuple[int, int]:
        """The values that a label stands for."""
        evaluate = self.scope.shapes.evaluate
        evaluate = present(evaluate)
        if isinstance(label, tree.LabelRange):
            return evaluate(label.low, selector.type), evaluate(label.high, selector.type)
        value = evaluate(label, selector.type)
        return value, value


def _chained(links: list[_Link], rest: list[ast.stmt]) -> list[ast.stmt]:
    """Branches, each as what stands behind the `else` of the one before it."""
    for each in reversed(links):
        each.branch.orelse = [*each.before_next, *rest]
        rest = [each.branch]
    return rest
