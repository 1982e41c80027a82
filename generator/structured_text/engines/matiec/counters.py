"""Counters in the C of iec2c, one for each statement of the ST, and what they say of lines and decisions.

iec2c puts a #line before each statement and keeps the order of those of one line, so that the n-th #line of a line
belongs to its n-th statement. What ran shows which way each decision took: a branch as often as its first statement,
the missing ELSE as often as the rest. A scan that a signal ends may so be counted for a way that it did not go.
"""

from collections import defaultdict
from collections.abc import Callable, Iterator, Sequence

from structured_text.engines.coverage import Branches, Lines, Outcome, case_outcome
from structured_text.engines.engine import EngineError
from structured_text.engines.matiec.text import Listing
from structured_text.language import tree
from structured_text.language.parser import ParseError, parse
from structured_text.language.walk import bodies, statements

COUNTS = ("dbk_hits", "dbk_begun")
"""The tables in the C: how often each statement ran; of those that are loops, how often it came to a first turn."""

Counts = Sequence[int]
"""What the counters have come to, by their numbers."""

_Way = tuple[int, str, int]
"""Offset of a decision, text of its outcome, how often."""


class Counters:
    """The counters of a build. `lines`: the line of the joined text of each #line, in the order of the C."""

    def __init__(self, listing: Listing, lines: Sequence[int]) -> None:
        """Find the statement of each counter; if that fails, `problem` says why, and lines alone are counted."""
        self.listing, self.lines = listing, lines
        self.numbers: dict[tree.Statement, int] = {}
        self.units: list[tree.Unit] = []
        self.problem = ""
        try:
            self.units = [parse(source.text, source.path) for source in listing.sources]
            self._match()
        except (ParseError, EngineError) as error:
            self.problem = str(error)
            self.numbers.clear()
        loops = [each for each in self.numbers if isinstance(each, tree.While | tree.For)]
        self._turns = {self.numbers[each.body[0]]: self.numbers[each] for each in loops}

    def _match(self) -> None:
        """Give each statement its number. Raises EngineError."""
        numbers, found = defaultdict(list), defaultdict(list)
        for number, line in enumerate(self.lines):
            numbers[line].append(number)
        for line, statement in self._statements():
            found[line].append(statement)
        for line in sorted(numbers.keys() | found.keys()):
            if len(numbers[line]) != len(found[line]):
                path, own = self.listing.place(line)
                raise EngineError(
                    f"{path}:{own}: iec2c has {len(numbers[line])} statements here, the source {len(found[line])}"
                )
            self.numbers |= zip(found[line], numbers[line], strict=True)

    def _statements(self) -> Iterator[tuple[int, tree.Statement]]:
        """All statements of all sources with their lines in the joined text."""
        for unit, first in zip(self.units, self.listing.starts, strict=True):
            for pou in unit.elements:
                for each in statements(pou.body) if isinstance(pou, tree.Pou) else ():
                    if not isinstance(each, tree.Empty):
                        yield first + unit.line(each.at) - 1, each

    def mark(self, number: int) -> str:
        """The C in place of a #line."""
        loop = self._turns.get(number)
        begun = "" if loop is None else f" DBK_TURN({loop})"
        fresh = f" DBK_LOOP({number})" if number in self._turns.values() else ""
        return f"DBK_STATEMENT({number}, {self.lines[number]}){begun}{fresh}"

    def hits(self, counts: Counts) -> Lines:
        """How often each line ran, by how often the statements that begin on it did."""
        found: Lines = {}
        for number, line in sorted(enumerate(self.lines), key=lambda each: each[1]):
            path, own = self.listing.place(line)
            hits = found.setdefault(path, {})
            hits[own] = hits.get(own, 0) + counts[number]
        return found

    def branches(self, counts: Counts, begun: Counts) -> Branches:
        """How often each outcome of each decision came about; `begun`: how often a loop came to a first turn.

        Raises EngineError where the statements are not known.
        """
        if self.problem:
            raise EngineError(f"branches cannot be counted: {self.problem}")
        ways = Ways(lambda each: counts[self.numbers[each]], lambda each: begun[self.numbers[each]])
        found: Branches = {}
        for unit in self.units:
            inside = [each for pou in unit.elements if isinstance(pou, tree.Pou) for each in statements(pou.body)]
            outcomes = [(Outcome(*unit.place(at), text), n) for each in inside for at, text, n in ways.of(each)]
            if outcomes:
                found[unit.path] = dict(sorted(outcomes))
        return found


class Ways:
    """Which way decisions took, by how often statements ran."""

    def __init__(self, runs: Callable[[tree.Statement], int], begun: Callable[[tree.Statement], int]) -> None:
        """Take how often a statement ran, and how often a loop came to a first turn."""
        self.runs, self.begun = runs, begun

    def of(self, statement: tree.Statement) -> Iterator[_Way]:
        """The outcomes of one statement."""
        match statement:
            case tree.If():
                yield from self._if(statement)
            case tree.Case():
                yield from self._case(statement)
            case tree.While():
                yield from self._loop(statement, statement.condition.at, "WHILE")
            case tree.For():
                yield from self._loop(statement, statement.at, "FOR")
            case tree.RepeatUntil():
                yield statement.condition.at, "UNTIL TRUE", self._left(statement)
                again = self.runs(statement.body[0]) - self.runs(statement)
                yield statement.condition.at, "UNTIL FALSE", again

    def _if(self, statement: tree.If) -> Iterator[_Way]:
        rest, keyword = self.runs(statement), "IF"
        for branch in statement.branches:
            taken = self.runs(branch.body[0])
            rest -= taken
            yield branch.condition.at, f"{keyword} TRUE", taken
            yield branch.condition.at, f"{keyword} FALSE", rest
            keyword = "ELSIF"

    def _case(self, statement: tree.Case) -> Iterator[_Way]:
        rest = self.runs(statement)
        for branch in statement.branches:
            taken = self.runs(branch.body[0])
            rest -= taken
            yield branch.at, case_outcome(branch), taken
        yield statement.at, "CASE ELSE", rest

    def _loop(self, statement: tree.While | tree.For, at: int, keyword: str) -> Iterator[_Way]:
        yield at, f"{keyword} TRUE", self.runs(statement.body[0])
        yield at, f"{keyword} FALSE", self._left(statement)
        yield at, f"{keyword} without a turn", self.runs(statement) - self.begun(statement)

    def _left(self, loop: tree.Statement) -> int:
        """How often a loop ended by its condition: neither by EXIT nor by RETURN."""
        return self.runs(loop) - sum(self.runs(each) for each in _ends(loop))


def _ends(loop: tree.Statement) -> Iterator[tree.Statement]:
    """Each RETURN in a loop, and each EXIT but those of loops inside it."""
    for body in bodies(loop):
        for each in body:
            if isinstance(each, tree.Exit | tree.Return):
                yield each
            elif isinstance(each, tree.While | tree.For | tree.RepeatUntil):
                yield from (end for end in _ends(each) if isinstance(end, tree.Return))
            else:
                yield from _ends(each)
