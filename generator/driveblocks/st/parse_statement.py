"""Statements: tokens -> tree (annex B.3.2), with recovery, so that one mistake does not hide the next."""

from __future__ import annotations

from collections.abc import Callable

from driveblocks.st.cursor import SyntaxProblem
from driveblocks.st.lexer import END
from driveblocks.st.parse_expression import ExpressionParser
from driveblocks.st.reserved import HARD_KEYWORDS, KEYWORDS
from driveblocks.st.tree import (
    Assign,
    Branch,
    Call,
    CallStatement,
    Case,
    CaseBranch,
    Continue,
    Empty,
    Exit,
    Expression,
    For,
    If,
    LabelRange,
    RepeatUntil,
    Return,
    Statement,
    While,
)

# Words at which a list of statements ends, whoever opened it.
_ENDS = frozenset(each for each in KEYWORDS if each.startswith("END_"))
_STOPS = _ENDS | {"ELSE", "ELSIF", "UNTIL", "FUNCTION", "FUNCTION_BLOCK", "VAR", "METHOD", "TYPE", "CONFIGURATION", END}
_STOPS |= {"INITIAL_STEP", "STEP", "TRANSITION", "ACTION", "ACTIONS", "PROPERTY", "PROGRAM"}
_SOFT = KEYWORDS - HARD_KEYWORDS
_LABELS = frozenset(["number", "typed", "-", "+", "TRUE", "FALSE", "string"])
_BEHIND_LABEL = frozenset([":", ",", ".."])
_BEHIND_VARIABLE = frozenset([":=", ".", "[", "(", "^"])
_LATCHES = {"S": "S=", "R": "R=", "REF": "REF="}


class StatementParser(ExpressionParser):
    """Parses statements."""

    __slots__ = ()

    def statements(self, in_case: bool = False) -> list[Statement]:
        """Statements up to a word that ends them (in CASE also up to the next label); never raises SyntaxProblem."""
        made: list[Statement] = []
        kinds = self.kinds
        while True:
            kind = kinds[self.i]
            if kind in _STOPS and not self.starts_variable(kind):
                return made
            if in_case and self.at_label(kind):
                return made
            depth = self.depth
            try:
                made.append(self.statement(kind))
            except SyntaxProblem:
                self.depth = depth
                self.recover()

    def starts_variable(self, kind: str) -> bool:
        """Whether a word that is a keyword elsewhere is a variable here: `step := 1`."""
        return kind in _SOFT and self.kinds[self.i + 1] in _BEHIND_VARIABLE

    def recover(self) -> None:
        """Skip to behind the next `;`, or to a word that starts or ends something."""
        kinds = self.kinds
        while kinds[self.i] != ";":
            if kinds[self.i] in _STOPS or kinds[self.i] in _STARTS:
                return
            self.i += 1
        self.i += 1

    def statement(self, kind: str) -> Statement:
        """One statement with its comments and its `;`. Raises SyntaxProblem."""
        leading = self.leading() if self.i in self.before else ()
        self.operators = 0
        start = _STARTS.get(kind)
        if start is None:
            made = self.simple()
            if self.kinds[self.i] != ";":
                self.fail("`;`")
            self.i += 1
        else:
            made = start(self)
        made.leading = leading
        made.end = self.end_of_last()
        if self.i in self.before:
            made.trailing = self.trailing()
        return made

    def closed(self, word: str) -> None:
        """Take END_IF or the like and its `;`, which some compilers do not ask for."""
        self.expect(word)
        if not self.accept(";"):
            self.notes.append(("missing-semicolon", self.ats[self.i - 1]))

    def simple(self) -> Statement:
        """An assignment or a call."""
        kind = self.kinds[self.i]
        at = self.ats[self.i]
        if kind != "name" and kind not in _SOFT and kind != "direct":
            self.fail("a statement")
        target = self.unary() if kind == "direct" else self.variable()
        if self.kinds[self.i] == ";" and self.texts[self.i - 1].upper() == "CONTINUE":
            return Continue(at)
        if self.kinds[self.i] == ":=":
            self.i += 1
            return Assign(at, target, self.expression())
        if isinstance(target, Call):
            return CallStatement(at, target)
        return self.latch(at, target)

    def latch(self, at: int, target: Expression) -> Statement:
        """`x S= condition` and its kind."""
        op = _LATCHES.get(self.texts[self.i].upper())
        if op is None or self.kinds[self.i + 1] != "=":
            self.fail("`:=` or `(`")
        self.i += 2
        return Assign(at, target, self.expression(), op)

    def body(self, in_case: bool = False) -> list[Statement]:
        """The statements inside another one, a level deeper."""
        self.deeper()
        made = self.statements(in_case)
        self.depth -= 1
        return made

    def if_(self) -> Statement:
        """IF ... END_IF."""
        at = self.ats[self.i]
        branches = [self.branch()]
        while self.kinds[self.i] == "ELSIF":
            branches.append(self.branch())
        otherwise = self.body() if self.accept("ELSE") else None
        self.closed("END_IF")
        return If(at, branches, otherwise)

    def branch(self) -> Branch:
        """IF or ELSIF, its condition and its statements."""
        at = self.ats[self.i]
        self.i += 1
        self.operators = 0
        condition = self.expression()
        self.expect("THEN")
        return Branch(at, condition, self.body())

    def case(self) -> Statement:
        """CASE ... END_CASE."""
        at = self.ats[self.i]
        self.i += 1
        selector = self.expression()
        self.expect("OF")
        branches: list[CaseBranch] = []
        while self.at_label(self.kinds[self.i]):
            branches.append(self.case_branch())
        otherwise = None
        if self.accept("ELSE"):
            self.accept(":")
            otherwise = self.body()
        if self.kinds[self.i] != "END_CASE":
            self.fail("a label, ELSE or END_CASE")
        self.closed("END_CASE")
        return Case(at, selector, branches, otherwise)

    def at_label(self, kind: str) -> bool:
        """Whether the next token starts a label of CASE rather than a statement."""
        if kind in _LABELS:
            return True
        if kind != "name":
            return False
        here = self.i + 1
        while self.kinds[here] == "." and self.kinds[here + 1] == "name":
            here += 2
        return self.kinds[here] in _BEHIND_LABEL

    def case_branch(self) -> CaseBranch:
        """`1, 3..5: statements`."""
        leading, at = self.leading(), self.ats[self.i]
        labels = [self.label()]
        while self.accept(","):
            labels.append(self.label())
        self.expect(":")
        trailing = self.trailing()
        made = CaseBranch(at, labels, self.body(in_case=True))
        made.leading, made.trailing = leading, trailing
        return made

    def label(self) -> Expression | LabelRange:
        """A single label or `low..high`."""
        at = self.ats[self.i]
        low = self.expression(6)
        if not self.accept(".."):
            return low
        return LabelRange(at, low, self.expression(6))

    def for_(self) -> Statement:
        """FOR ... END_FOR."""
        at = self.ats[self.i]
        self.i += 1
        variable = self.unary()
        self.expect(":=")
        start = self.expression()
        self.expect("TO")
        stop = self.expression()
        step = self.expression() if self.accept("BY") else None
        self.expect("DO")
        body = self.body()
        self.closed("END_FOR")
        return For(at, variable, start, stop, step, body)

    def while_(self) -> Statement:
        """WHILE ... END_WHILE."""
        at = self.ats[self.i]
        self.i += 1
        condition = self.expression()
        self.expect("DO")
        body = self.body()
        self.closed("END_WHILE")
        return While(at, condition, body)

    def repeat(self) -> Statement:
        """REPEAT ... END_REPEAT."""
        at = self.ats[self.i]
        self.i += 1
        body = self.body()
        self.expect("UNTIL")
        condition = self.expression()
        if self.accept(";"):
            self.notes.append(("stray-semicolon", self.ats[self.i - 1]))
        self.closed("END_REPEAT")
        return RepeatUntil(at, body, condition)

    def empty(self) -> Statement:
        """A `;` with nothing before it."""
        self.i += 1
        return Empty(self.ats[self.i - 1])

    def exit(self) -> Statement:
        """EXIT."""
        self.i += 1
        return Exit(self.ats[self.expect(";") - 1])

    def return_(self) -> Statement:
        """RETURN."""
        at = self.ats[self.i]
        self.i += 1
        value = None if self.kinds[self.i] == ";" else self.expression()
        self.expect(";")
        return Return(at, value)


_STARTS: dict[str, Callable[[StatementParser], Statement]] = {
    "IF": StatementParser.if_,
    "CASE": StatementParser.case,
    "FOR": StatementParser.for_,
    "WHILE": StatementParser.while_,
    "REPEAT": StatementParser.repeat,
    ";": StatementParser.empty,
    "EXIT": StatementParser.exit,
    "RETURN": StatementParser.return_,
}
