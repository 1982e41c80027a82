"""A source file -> its tree; everything that is wrong is told at once."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Sequence

from driveblocks.st.collector import paused
from driveblocks.st.cursor import SyntaxProblem, TooManyProblemsError
from driveblocks.st.lexer import END, tokenize
from driveblocks.st.parse_configuration import ConfigurationParser
from driveblocks.st.parse_declaration import VAR_KINDS
from driveblocks.st.problems import Problem, SourceError
from driveblocks.st.tree import (
    Element,
    Function,
    FunctionBlock,
    Pou,
    Program,
    Statement,
    Unit,
    Unsupported,
    VarBlock,
    line_starts,
)

_SKIPPED = ("METHOD", "PROPERTY", "ACTION", "ACTIONS", "TRANSITION", "STEP", "INITIAL_STEP")
_TOPS = frozenset(["TYPE", "FUNCTION", "FUNCTION_BLOCK", "PROGRAM", "CONFIGURATION", END])
_MODIFIERS = frozenset(["ABSTRACT", "FINAL", "PUBLIC", "PRIVATE", "PROTECTED", "INTERNAL", "OVERRIDE"])


class ParseError(SourceError):
    """The text is no Structured Text; `unit` holds those elements of it that are whole."""

    def __init__(self, problems: Sequence[Problem], unit: Unit) -> None:
        """Keep the problems and what could be read."""
        super().__init__(problems)
        self.unit = unit


def parse(text: str, path: str) -> Unit:
    """Parse a file that messages name by `path`. Raises ParseError with every problem found, in order of place."""
    with paused():
        return _parsed(text, path)


def _parsed(text: str, path: str) -> Unit:
    """As `parse`."""
    tokens = tokenize(text)
    parser = _Parser(tokens)
    elements: list[Element] = []
    try:
        elements = parser.elements()
    except TooManyProblemsError:
        parser.problems.append((len(text), "too many problems: the rest is not shown", "syntax"))
    wrong = sorted(parser.problems)
    whole = _whole(elements, [at for at, _, _ in wrong], tokens.ats) if wrong else elements
    unit = Unit(path, text, whole, tokens.comments, line_starts(text), tokens.notes)
    for element in whole:
        if not isinstance(element, VarBlock | Unsupported) and hasattr(element, "unit"):
            element.unit = unit
    if wrong:
        raise ParseError([Problem(path, *unit.place(at), said, rule) for at, said, rule in wrong], unit)
    return unit


def _whole(elements: list[Element], wrong: list[int], ats: list[int]) -> list[Element]:
    """The elements without a mistake, which may also be noticed at the token behind them."""

    def torn(element: Element) -> bool:
        behind = ats[min(bisect_left(ats, element.end), len(ats) - 1)]
        return bisect_right(wrong, element.at) < bisect_right(wrong, behind)

    return [element for element in elements if not torn(element)]


class _Parser(ConfigurationParser):
    """Parses what stands at the outermost level."""

    __slots__ = ("types",)

    def elements(self) -> list[Element]:
        """The whole file. Raises TooManyProblemsError."""
        self.types = 0
        made: list[Element] = []
        while self.kinds[self.i] != END:
            self.depth = 0
            try:
                self.element(made)
            except SyntaxProblem:
                self.recover_element()
        return made

    def recover_element(self) -> None:
        """Skip to the next word that may start an element."""
        self.i += self.kinds[self.i] != END
        while self.kinds[self.i] not in _TOPS:
            self.i += 1

    def element(self, into: list[Element]) -> None:
        """One element of the file. Raises SyntaxProblem."""
        kind = self.kinds[self.i]
        if kind == "TYPE":
            self.types += 1
            into.extend(self.type_block(self.types))
        elif kind in _POUS:
            into.append(self.pou())
        elif kind == "CONFIGURATION":
            into.append(self.configuration())
        elif kind in VAR_KINDS:
            into.append(self.var_block())
        elif kind in ("NAMESPACE", "INTERFACE", "CLASS"):
            self.container(into)
        elif kind in ("END_NAMESPACE", ";") or (kind == "name" and self.texts[self.i].upper() == "USING"):
            self.stray(kind)
        else:
            self.fail("TYPE, FUNCTION, FUNCTION_BLOCK, PROGRAM or CONFIGURATION")

    def stray(self, kind: str) -> None:
        """A `;`, END_NAMESPACE or USING at the outermost level."""
        if kind == ";":
            self.notes.append(("stray-semicolon", self.ats[self.i]))
        if kind == "name":
            while self.kinds[self.i] not in (";", *_TOPS):
                self.i += 1
        self.i += self.kinds[self.i] not in _TOPS

    def container(self, into: list[Element]) -> None:
        """NAMESPACE (what is inside is parsed too), INTERFACE or CLASS (skipped)."""
        at, kind = self.ats[self.i], self.kinds[self.i]
        if kind == "NAMESPACE":
            self.i += 1
            into.append(Unsupported(at, self.ats[self.i], kind, self.path()))
        else:
            into.append(self.skipped())

    def skipped(self) -> Unsupported:
        """Skip a construct to its END word, or to the end of the POU."""
        at, kind = self.ats[self.i], self.kinds[self.i]
        name = self.texts[self.i + 1]
        close = "END_STEP" if kind == "INITIAL_STEP" else "END_" + kind
        self.i += 1
        while self.kinds[self.i] not in (close, "END_FUNCTION_BLOCK", "END_PROGRAM", "END_FUNCTION", END):
            self.i += 1
        if not self.accept(close):
            self.fail(close)
        return Unsupported(at, self.end_of_last(), kind, name)

    def pou(self) -> Function | FunctionBlock | Program:
        """FUNCTION, FUNCTION_BLOCK or PROGRAM. Raises SyntaxProblem if its head is no head."""
        leading, at = self.leading(), self.ats[self.i]
        make, close = _POUS[self.kinds[self.i]]
        self.i += 1
        while self.texts[self.i].upper() in _MODIFIERS and self.kinds[self.i + 1] == "name":
            self.i += 1
        name_at = self.ats[self.i]
        made = make(at, 0, self.name("the name of the block"), name_at, [], [], [])
        made.leading = leading
        self.head(made)
        made.head = self.leading() if self.kinds[self.i] in VAR_KINDS else ()
        self.inside(made, close)
        made.end = self.end_of_last()
        return made

    def starts_statement(self) -> bool:
        """Whether a name is the beginning of a statement rather than a type that lacks its colon."""
        return self.kinds[self.i + 1] in (":=", "(", ".", "[")

    def head(self, made: Pou) -> None:
        """What stands between the name and the first VAR block."""
        if isinstance(made, Function) and self.accept(":"):
            made.returns = self.spec()
            self.accept(";")
        elif isinstance(made, Function) and self.kinds[self.i] == "name" and not self.starts_statement():
            self.fail("`:` and the type of the result")
        start = self.i
        while self.texts[self.i].upper() in ("EXTENDS", "IMPLEMENTS"):
            self.i += 1
            self.path()
            while self.accept(","):
                self.path()
        if isinstance(made, FunctionBlock):
            made.heritage = " ".join(self.texts[start : self.i])

    def inside(self, made: Pou, close: str) -> None:
        """The VAR blocks, statements and what else stands before the closing word; never raises SyntaxProblem."""
        while not self.accept(close):
            kind = self.kinds[self.i]
            try:
                if kind in VAR_KINDS:
                    made.blocks.append(self.var_block())
                elif kind in _SKIPPED and not self.starts_variable(kind):
                    made.extras.append(self.skipped())
                elif kind in _TOPS and not self.starts_variable(kind):
                    self.problem(self.i, f"expected {close}, found {self.found(self.i)}")
                    return
                else:
                    self.body_part(made.body, close)
            except SyntaxProblem:
                continue

    def body_part(self, into: list[Statement], close: str) -> None:
        """Statements up to a word that does not belong to a statement; a word that nothing opened is told."""
        start = self.i
        into.extend(self.statements())
        kind = self.kinds[self.i]
        if self.i == start and kind != close:
            self.problem(self.i, f"expected a statement or {close}, found {self.found(self.i)}")
            self.i += 1
            self.accept(";")


_POUS: dict[str, tuple[type[Function] | type[FunctionBlock] | type[Program], str]] = {
    "FUNCTION": (Function, "END_FUNCTION"),
    "FUNCTION_BLOCK": (FunctionBlock, "END_FUNCTION_BLOCK"),
    "PROGRAM": (Program, "END_PROGRAM"),
}
