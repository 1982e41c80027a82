"""From lines of the C that iec2c wrote to lines of the ST.

iec2c puts a #line in front of each statement. A C compiler counts on from there, so that a statement of four C lines
seems to lie three lines further down, on another statement; hence the directives are taken out and kept as a table.
"""

import re
from bisect import bisect_right
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from itertools import count

_DIRECTIVE = re.compile(r'^#line (?P<line>\d+) "[^"\n]*"$', re.MULTILINE)
_START = re.compile(r"^(?:void (?P<block>\w+)_(?:init|body)__\(.*|\w+ (?P<function>\w+)\()$", re.MULTILINE)


@dataclass(frozen=True)
class LineTable:
    """Starts of stretches of C lines, and the ST line that each belongs to."""

    starts: tuple[int, ...] = ()
    lines: tuple[int, ...] = ()

    def line(self, c_line: int) -> int:
        """The 1-based ST line of a 1-based C line; 0 in front of all code."""
        place = bisect_right(self.starts, c_line) - 1
        return self.lines[place] if place >= 0 else 0


_COUNTER = re.compile(r"^DBK_STATEMENT\(\d+, (\d+)\)", re.MULTILINE)


def directives(c_text: str) -> list[int]:
    """The ST line of each #line directive, in the order of the C."""
    return [int(match["line"]) for match in _DIRECTIVE.finditer(c_text)]


def counted(c_text: str) -> list[int]:
    """The ST line of each counter that `take_lines` has put in place of a directive, in the order of the C."""
    return [int(line) for line in _COUNTER.findall(c_text)]


def take_lines(
    c_text: str, unit_lines: Mapping[str, int], mark: Callable[[int], str] | None = None
) -> tuple[str, LineTable]:
    """Take the #line directives out (the C keeps its own lines), and make the table.

    What is in a unit before its first statement belongs to the line of `unit_lines` where the unit is declared.
    `mark` gives the C that replaces a directive, by its number from 0: a statement begins there.
    """
    stretches = {}
    number, at = 1, 0
    for match in sorted([*_START.finditer(c_text), *_DIRECTIVE.finditer(c_text)], key=lambda each: each.start()):
        number += c_text.count("\n", at, match.start())
        at = match.start()
        groups = match.groupdict()
        if groups.get("line"):
            stretches[number] = int(groups["line"])
        else:
            stretches[number] = unit_lines.get(groups["block"] or groups["function"], 0)
    numbers = count()
    text = _DIRECTIVE.sub(lambda _: mark(next(numbers)) if mark else "", c_text)
    return text, LineTable(tuple(stretches), tuple(stretches.values()))
