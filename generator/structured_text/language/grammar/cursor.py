"""A place in a list of tokens, with the errors and comments that belong there."""

from typing import NoReturn

from structured_text.language.lexer import END, MOST_PROBLEMS, Tokens
from structured_text.language.reserved import HARD_KEYWORDS, KEYWORDS
from structured_text.language.tree import Comment

# Deeper nesting of parentheses, statements or initialisers is taken for an accident; Python's own stack ends at 1000.
DEEPEST = 40
# More operators in one statement than anyone writes by hand; several compilers die of some thousands.
MOST_OPERATORS = 250


class SyntaxProblem(Exception):  # noqa: N818 - control flow within the parser, never seen outside
    """The parser cannot go on here; the problem is already noted."""


class TooManyProblemsError(Exception):
    """The number of problems after which more of them help nobody."""


class Cursor:
    """Walks over tokens: all that the functions of the grammar share. `i` is the index of the next token."""

    __slots__ = (
        "ats", "before", "depth", "i", "kinds", "notes", "operators", "problems", "texts", "tokens", "type_blocks",
    )  # fmt: skip

    def __init__(self, tokens: Tokens) -> None:
        self.tokens = tokens
        self.kinds, self.texts, self.ats = tokens.kinds, tokens.texts, tokens.ats
        self.before, self.notes = tokens.before, tokens.notes
        self.problems: list[tuple[int, str, str]] = [(at, text, "syntax") for at, text in tokens.problems]
        self.i = 0
        self.depth = 0
        self.operators = 0
        self.type_blocks = 0

    def problem(self, index: int, text: str, rule: str = "syntax") -> None:
        """Note a problem at a token; a second one at the same place is an echo of the first. TooManyProblemsError."""
        at = self.ats[index]
        if self.problems and self.problems[-1][0] == at:
            return
        self.problems.append((at, text, rule))
        if len(self.problems) > MOST_PROBLEMS:
            raise TooManyProblemsError

    def found(self, index: int) -> str:
        """How a message names a token."""
        kind, text = self.kinds[index], self.texts[index]
        if kind == END:
            return "the end of the file"
        return text if len(text) <= 40 else text[:37] + "..."

    def fail(self, expected: str) -> NoReturn:
        """Note that something else was expected here. Raises SyntaxProblem."""
        self.problem(self.i, f"expected {expected}, found {self.found(self.i)}")
        raise SyntaxProblem

    def accept(self, kind: str) -> bool:
        """Step over a token of this kind if it is the next."""
        if self.kinds[self.i] != kind:
            return False
        self.i += 1
        return True

    def expect(self, kind: str) -> int:
        """Step over a token of this kind and give its index. Raises SyntaxProblem."""
        here = self.i
        if self.kinds[here] != kind:
            self.fail(kind)
        self.i = here + 1
        return here

    def word(self, upper: str) -> bool:
        """Step over a word that is no keyword of the grammar (`CONSTANT`, `ON`) if it is the next."""
        if self.kinds[self.i] != "name" or self.texts[self.i].upper() != upper:
            return False
        self.i += 1
        return True

    def name(self, what: str) -> str:
        """Take an identifier. Raises SyntaxProblem; a keyword in its place is reported as a reserved name."""
        here, kind = self.i, self.kinds[self.i]
        if kind == "name" or (kind in KEYWORDS and kind not in HARD_KEYWORDS):
            self.i = here + 1
            return self.texts[here]
        if kind in HARD_KEYWORDS and self.kinds[here + 1] in _BEHIND_NAMES:
            text = self.texts[here]
            self.problem(here, f"{text} is a reserved word: choose another name", "reserved-name")
            self.i = here + 1
            return text
        return self.fail(what)

    def end_of_last(self) -> int:
        """The offset after the token that was taken last."""
        last = self.i - 1
        return self.ats[last] + len(self.texts[last])

    def deeper(self) -> None:
        """Count a level of nesting. Raises SyntaxProblem when there are too many."""
        self.depth += 1
        if self.depth > DEEPEST:
            self.problem(self.i, f"expected at most {DEEPEST} levels of nesting, found more")
            raise SyntaxProblem

    def too_long(self) -> NoReturn:
        """Report an expression with too many operators. Raises SyntaxProblem."""
        text = f"expected at most {MOST_OPERATORS} operators in one statement: put parts into variables first"
        self.problem(self.i, text, "long-expression")
        raise SyntaxProblem

    def leading(self) -> tuple[Comment, ...]:
        """Take the comments in front of the next token."""
        return tuple(self.before.pop(self.i, ()))

    def trailing(self) -> Comment | None:
        """Take the comment after the last token on its line; the rest is left for what follows."""
        comments = self.before.get(self.i)
        if not comments or comments[0].own_line:
            return None
        return comments.pop(0)


_BEHIND_NAMES = frozenset([":", ",", ";", ":=", "=>", "AT"])
