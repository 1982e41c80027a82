"""Statements (clause 3.3.2) and initial values."""

from collections.abc import Callable
from typing import Any

from structured_text.language import tree
from structured_text.language.library import fold
from structured_text.language.semantics.calls import call_type
from structured_text.language.semantics.scope import Scope, expect, infer
from structured_text.language.semantics.targets import assignable
from structured_text.language.semantics.values import choose, fits, settle
from structured_text.language.types import BOOL, INT, UNKNOWN, Kind, Type, plain, untyped


def check_statements(scope: Scope, body: list[tree.Statement]) -> None:
    """Check a list of statements."""
    for each in body:
        _CHECKS[type(each)](scope, each)


def _condition(scope: Scope, value: tree.Expression) -> None:
    """A condition is BOOL."""
    expect(scope, value, BOOL)


def _assign(scope: Scope, statement: tree.Assign) -> None:
    """`target := value`."""
    target, value = statement.target, statement.value
    have = infer(scope, target)
    infer(scope, value)
    if statement.op != ":=":
        text = f"{statement.op} is no operator of the second edition: write IF ... THEN ... END_IF or SR and RS"
        scope.report.add(statement.at, "dialect-assignment", text)
    if isinstance(target, tree.Call):
        scope.report.add(target.at, "not-assignable", "expected a variable before :=, found a call")
    else:
        assignable(scope, target, "before :=")
    fits(scope.report, value, have)


def _call_statement(scope: Scope, statement: tree.CallStatement) -> None:
    """An invocation of a block."""
    call = statement.call
    call.type = call_type(scope, call, statement=True)
    if call.target is not None and not isinstance(call.target, tree.Block):
        settle(scope.report, call, UNKNOWN)
        text = "a function is no statement in the second edition: assign its result"
        scope.report.add(call.at, "function-as-statement", text)


def _if(scope: Scope, statement: tree.If) -> None:
    """IF."""
    for branch in statement.branches:
        _condition(scope, branch.condition)
        check_statements(scope, branch.body)
    check_statements(scope, statement.otherwise or [])


def _while(scope: Scope, statement: tree.While) -> None:
    """WHILE."""
    _condition(scope, statement.condition)
    _loop(scope, statement.body)


def _repeat(scope: Scope, statement: tree.RepeatUntil) -> None:
    """REPEAT."""
    _loop(scope, statement.body)
    _condition(scope, statement.condition)


def _loop(scope: Scope, body: list[tree.Statement]) -> None:
    """The body of a loop."""
    check_statements(scope.inside_loop(), body)


def _for(scope: Scope, statement: tree.For) -> None:
    """FOR."""
    have = infer(scope, statement.variable)
    assignable(scope, statement.variable, "to count with")
    if not isinstance(statement.variable, tree.Name) and have is not UNKNOWN:
        text = "expected a variable of its own to count with, found a part of another"
        scope.report.add(statement.variable.at, "type-mismatch", text)
    elif have.kind is not Kind.INTEGER and have is not UNKNOWN:
        text = f"expected an integer variable to count with, found {have}"
        scope.report.add(statement.variable.at, "type-mismatch", text)
    for each in (statement.start, statement.stop, statement.step):
        if each is not None:
            expect(scope, each, plain(have))
    if statement.step is not None and fold(statement.step, scope.constant) == 0:
        scope.report.add(statement.step.at, "literal-range", "expected a step other than 0")
    _loop(scope, statement.body)


def _exit(scope: Scope, statement: tree.Exit | tree.Continue) -> None:
    """EXIT and CONTINUE."""
    if not scope.in_loop:
        word = type(statement).__name__.upper()
        scope.report.add(statement.at, "misplaced-exit", f"expected {word} inside a loop only")


def _return(scope: Scope, statement: tree.Return) -> None:
    """RETURN."""
    if statement.value is not None:
        infer(scope, statement.value)
        settle(scope.report, statement.value, UNKNOWN)
        text = "RETURN takes no value: assign it to the name of the function before"
        scope.report.add(statement.at, "return-value", text)


def _empty(scope: Scope, statement: tree.Empty) -> None:
    """Nothing to check; the linter has an opinion."""


def _case(scope: Scope, statement: tree.Case) -> None:
    """CASE."""
    selector = statement.selector
    have = infer(scope, selector)
    if untyped(have):
        choose(scope.report, selector, INT)
        have = selector.type
    if have.kind is Kind.BITS:
        text = f"CASE on {have} is refused by matiec: write {plain(have).name}_TO_UINT(...)"
        scope.report.add(selector.at, "case-selector", text)
    elif have.kind not in (Kind.INTEGER, Kind.ENUM) and have is not UNKNOWN:
        text = f"expected an integer or an enumeration after CASE, found {have}"
        scope.report.add(selector.at, "type-mismatch", text)
    taken: list[tuple[int, int, int]] = []
    for branch in statement.branches:
        for label in branch.labels:
            _label(scope, label, plain(have), taken)
        check_statements(scope, branch.body)
    _overlaps(scope, taken)
    check_statements(scope, statement.otherwise or [])


def _label(
    scope: Scope, label: tree.Expression | tree.LabelRange, wanted: Type, taken: list[tuple[int, int, int]]
) -> None:
    """One label; the numbers that it takes are added to `taken` with its place."""
    if not isinstance(label, tree.LabelRange):
        number = _label_value(scope, label, wanted)
        if number is not None:
            taken.append((number, number, label.at))
        return
    low, high = _label_value(scope, label.low, wanted), _label_value(scope, label.high, wanted)
    if low is None or high is None:
        return
    if low > high:
        text = f"expected the lower limit first, found {low}..{high}"
        scope.report.add(label.at, "literal-range", text)
    else:
        taken.append((low, high, label.at))


def _label_value(scope: Scope, label: tree.Expression, wanted: Type) -> int | None:
    """The number of a label."""
    expect(scope, label, wanted)
    if isinstance(label, tree.Literal):
        return label.value if isinstance(label.value, int) else None
    symbol = label.symbol if isinstance(label, tree.Name | tree.Qualified) else getattr(label, "symbol", None)
    if isinstance(symbol, tree.EnumValue):
        return symbol.number
    if label.type is not UNKNOWN:
        text = "expected a decimal literal or enumerated value: matiec refuses constants and expressions as labels"
        scope.report.add(label.at, "case-label", text)
    return fold(label, scope.constant)


def _overlaps(scope: Scope, taken: list[tuple[int, int, int]]) -> None:
    """Report numbers that are in two labels."""
    highest: int | None = None
    for low, high, at in sorted(taken):
        if highest is not None and low <= highest:
            scope.report.add(at, "duplicate-label", f"{low} is in another label of this CASE already")
        highest = high if highest is None else max(high, highest)


_CHECKS: dict[type[tree.Statement], Callable[[Scope, Any], None]] = {
    tree.Assign: _assign, tree.CallStatement: _call_statement, tree.If: _if, tree.Case: _case, tree.For: _for,
    tree.While: _while, tree.RepeatUntil: _repeat, tree.Exit: _exit, tree.Continue: _exit, tree.Return: _return,
    tree.Empty: _empty,
}  # fmt: skip
