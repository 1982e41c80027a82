"""From lines of the C that iec2c wrote to lines of the ST.

iec2c puts a #line in front of each statement. A C compiler counts on from there, so that a statement of four C lines
seems to lie three lines further down, on another statement; hence the directives are taken out and kept as a table.
"""

import re
from bisect import bisect_right
from collections.abc import Mapping
from dataclasses import dataclass

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


_COUNTER = re.compile(r"^dbk_hits\[(\d+)\]\+\+;$", re.MULTILINE)


def counted_lines(c_text: str) -> set[int]:
    """The ST lines whose runs the C counts."""
    return {int(line) for line in _COUNTER.findall(c_text)}


def take_lines(c_text: str, unit_lines: Mapping[str, int], count: bool = False) -> tuple[str, LineTable]:
    """Take the #line directives out (the C keeps its own lines), and make the table.

    What stands in a unit before its first statement belongs to the line of `unit_lines` where the unit is declared.
    With `count` each directive becomes a counter of its ST line: it stands where a statement begins.
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
    instead = r"dbk_hits[\g<line>]++;" if count else ""
    return _DIRECTIVE.sub(instead, c_text), LineTable(tuple(stretches), tuple(stretches.values()))
