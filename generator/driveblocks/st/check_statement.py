"""Statements (clause 3.3.2) and initial values."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from driveblocks.st.check_call import CallChecker
from driveblocks.st.library import fold
from driveblocks.st.tree import (
    Array,
    ArrayInitial,
    Assign,
    Block,
    Call,
    CallStatement,
    Case,
    Continue,
    Empty,
    EnumValue,
    Exit,
    Expression,
    For,
    If,
    LabelRange,
    Literal,
    Name,
    Qualified,
    Repeat,
    RepeatUntil,
    Return,
    Statement,
    Struct,
    StructInitial,
    While,
)
from driveblocks.st.types import BOOL, INT, UNKNOWN, Kind, Type, plain, untyped


class StatementChecker(CallChecker):
    """Checks statements; `loops` counts those around the statement at hand."""

    loops = 0

    def statements(self, body: list[Statement]) -> None:
        """Check a list of statements."""
        for each in body:
            _HANDLERS[type(each)](self, each)

    def condition(self, value: Expression) -> None:
        """A condition is BOOL."""
        self.wanted(value, BOOL)

    def assign(self, statement: Assign) -> None:
        """`target := value`."""
        target, value = statement.target, statement.value
        have = self.infer(target)
        self.infer(value)
        if statement.op != ":=":
            text = f"{statement.op} is no operator of the second edition: write IF ... THEN ... END_IF or SR and RS"
            self.report.add(statement.at, "dialect-assignment", text)
        if isinstance(target, Call):
            self.report.add(target.at, "not-assignable", "expected a variable before :=, found a call")
        else:
            self.assignable(target, "before :=")
        self.fits(value, have)

    def call_statement(self, statement: CallStatement) -> None:
        """An invocation of a block."""
        call = statement.call
        call.type = self.call(call, statement=True)
        if call.target is not None and not isinstance(call.target, Block):
            self.settle(call, UNKNOWN)
            text = "a function is no statement in the second edition: assign its result"
            self.report.add(call.at, "function-as-statement", text)

    def if_(self, statement: If) -> None:
        """IF."""
        for branch in statement.branches:
            self.condition(branch.condition)
            self.statements(branch.body)
        self.statements(statement.otherwise or [])

    def while_(self, statement: While) -> None:
        """WHILE."""
        self.condition(statement.condition)
        self.loop(statement.body)

    def repeat(self, statement: RepeatUntil) -> None:
        """REPEAT."""
        self.loop(statement.body)
        self.condition(statement.condition)

    def loop(self, body: list[Statement]) -> None:
        """The body of a loop."""
        self.loops += 1
        self.statements(body)
        self.loops -= 1

    def for_(self, statement: For) -> None:
        """FOR."""
        have = self.infer(statement.variable)
        self.assignable(statement.variable, "to count with")
        if not isinstance(statement.variable, Name) and have is not UNKNOWN:
            text = "expected a variable of its own to count with, found a part of another"
            self.report.add(statement.variable.at, "type-mismatch", text)
        elif have.kind is not Kind.INTEGER and have is not UNKNOWN:
            text = f"expected an integer variable to count with, found {have}"
            self.report.add(statement.variable.at, "type-mismatch", text)
        for each in (statement.start, statement.stop, statement.step):
            if each is not None:
                self.wanted(each, plain(have))
        if statement.step is not None and fold(statement.step, self.constant) == 0:
            self.report.add(statement.step.at, "literal-range", "expected a step other than 0")
        self.loop(statement.body)

    def exit(self, statement: Exit | Continue) -> None:
        """EXIT and CONTINUE."""
        if not self.loops:
            word = type(statement).__name__.upper()
            self.report.add(statement.at, "misplaced-exit", f"expected {word} inside a loop only")

    def return_(self, statement: Return) -> None:
        """RETURN."""
        if statement.value is not None:
            self.infer(statement.value)
            self.settle(statement.value, UNKNOWN)
            text = "RETURN takes no value: assign it to the name of the function before"
            self.report.add(statement.at, "return-value", text)

    def empty(self, statement: Empty) -> None:
        """Nothing to check; the linter has an opinion."""

    def case(self, statement: Case) -> None:
        """CASE."""
        selector = statement.selector
        have = self.infer(selector)
        if untyped(have):
            self.choose(selector, INT)
            have = selector.type
        if have.kind is Kind.BITS:
            text = f"CASE on {have} is refused by matiec: write {plain(have).name}_TO_UINT(...)"
            self.report.add(selector.at, "case-selector", text)
        elif have.kind not in (Kind.INTEGER, Kind.ENUM) and have is not UNKNOWN:
            text = f"expected an integer or an enumeration behind CASE, found {have}"
            self.report.add(selector.at, "type-mismatch", text)
        taken: list[tuple[int, int, int]] = []
        for branch in statement.branches:
            for label in branch.labels:
                self.label(label, plain(have), taken)
            self.statements(branch.body)
        self.overlaps(taken)
        self.statements(statement.otherwise or [])

    def label(self, label: Expression | LabelRange, wanted: Type, taken: list[tuple[int, int, int]]) -> None:
        """One label; the numbers that it takes are added to `taken` with its place."""
        if not isinstance(label, LabelRange):
            number = self.label_value(label, wanted)
            if number is not None:
                taken.append((number, number, label.at))
            return
        low, high = self.label_value(label.low, wanted), self.label_value(label.high, wanted)
        if low is None or high is None:
            return
        if low > high:
            text = f"expected the lower limit first, found {low}..{high}"
            self.report.add(label.at, "literal-range", text)
        else:
            taken.append((low, high, label.at))

    def label_value(self, label: Expression, wanted: Type) -> int | None:
        """The number of a label."""
        self.wanted(label, wanted)
        if isinstance(label, Literal):
            return label.value if isinstance(label.value, int) else None
        symbol = label.symbol if isinstance(label, Name | Qualified) else getattr(label, "symbol", None)
        if isinstance(symbol, EnumValue):
            return symbol.number
        if label.type is not UNKNOWN:
            text = "expected a decimal literal or enumerated value: matiec refuses constants and expressions as labels"
            self.report.add(label.at, "case-label", text)
        return fold(label, self.constant)

    def overlaps(self, taken: list[tuple[int, int, int]]) -> None:
        """Tell of numbers that stand in two labels."""
        highest: int | None = None
        for low, high, at in sorted(taken):
            if highest is not None and low <= highest:
                self.report.add(at, "duplicate-label", f"{low} is in another label of this CASE already")
            highest = high if highest is None else max(high, highest)

    def initial(self, value: Expression, wanted: Type) -> None:
        """An initial value; constants and expressions are told."""
        if isinstance(value, ArrayInitial):
            self.array_initial(value, wanted)
        elif isinstance(value, StructInitial):
            self.struct_initial(value, wanted)
        else:
            self.wanted(value, wanted)
            if wanted.kind is Kind.ARRAY and value.type is not UNKNOWN:
                self.report.add(value.at, "type-mismatch", f"expected [...] for {wanted}")
            self.literal_only(value)

    def literal_only(self, value: Expression) -> None:
        """Tell of an initial value that is computed."""
        symbol = getattr(value, "symbol", None)
        if isinstance(value, Literal) or isinstance(symbol, EnumValue) or value.type is UNKNOWN:
            return
        text = "expected a literal or enumerated value: matiec refuses constants and expressions in initial values"
        self.report.add(value.at, "initial-expression", text)

    def array_initial(self, value: ArrayInitial, wanted: Type) -> None:
        """`[1, 2(0)]`."""
        if not isinstance(wanted, Array):
            self.unwanted(value, wanted, "[...]")
            return
        value.type = wanted
        count = sum(self.array_item(each, wanted.element) for each in value.items)
        if count > wanted.length:
            text = f"expected at most {wanted.length} initial values, found {count}"
            self.report.add(value.at, "literal-range", text)

    def array_item(self, item: Expression, wanted: Type) -> int:
        """An element or a repetition; how many elements it fills."""
        if not isinstance(item, Repeat):
            self.initial(item, wanted)
            return 1
        item.type = wanted
        self.wanted(item.count, INT)
        if item.value is not None:
            self.initial(item.value, wanted)
        number = fold(item.count, self.constant)
        return 1 if number is None else number

    def struct_initial(self, value: StructInitial, wanted: Type) -> None:
        """`(a := 1)` for a structure or an instance."""
        if not isinstance(wanted, Struct | Block):
            self.unwanted(value, wanted, "(...)")
            return
        value.type = wanted
        seen: set[str] = set()
        for each in value.items:
            upper = (each.name or "").upper()
            known = wanted.fields.get(upper) if isinstance(wanted, Struct) else self.block_variable(wanted, upper)
            if known is None:
                self.report.add(each.at, "undeclared-name", f"expected a member of {wanted}, found {each.name}")
            elif upper in seen:
                self.report.add(each.at, "duplicate-name", f"{each.name} has an initial value already")
            elif each.value is not None:
                self.initial(each.value, known.type)
            seen.add(upper)

    def unwanted(self, value: Expression, wanted: Type, shown: str) -> None:
        """Tell of an initialiser of the wrong shape."""
        if wanted is not UNKNOWN:
            self.report.add(value.at, "type-mismatch", f"expected a value of {wanted}, found {shown}")


_HANDLERS: dict[type[Statement], Callable[[StatementChecker, Any], None]] = {
    Assign: StatementChecker.assign,
    CallStatement: StatementChecker.call_statement,
    If: StatementChecker.if_,
    Case: StatementChecker.case,
    For: StatementChecker.for_,
    While: StatementChecker.while_,
    RepeatUntil: StatementChecker.repeat,
    Exit: StatementChecker.exit,
    Continue: StatementChecker.exit,
    Return: StatementChecker.return_,
    Empty: StatementChecker.empty,
}
