"""What the loader makes of a text with libyaml and with PyYAML's own parser, and texts that are nearly YAML."""

from hypothesis import strategies as st

from driveblocks.maps import nodes
from driveblocks.maps.nodes import Node
from driveblocks.maps.problem import MapError, Problem, Report

PIECES = (
    "a", "b", "0", ".", "。", "€", " ", "  ", "\n", "\n ", "\n  ", "-", "- ", "\n- ", "a: ", "b: ", ":", ": ", ",",
    ", ", "[", "]", "{", "}", "#", " #", '"', "'", "|", ">", "|\n  ", ">-\n ", "|2", "---", "...", "\n---\n",
    "?", "? ", "%", "!", "![", "!!", "&", "*", "@", "`", "~", "=", "<", "<<: ", "+", ";", "\\", "\\x", "\\U", "\r",
    "\r\n", "\t", "\0", "\x7f", "\x85", "\xa0", "\u2028", "\ufeff", "\ud800", "😀",
)  # fmt: skip
LINES = (
    "a:", "b: c", "- d", "- e: f", "-", "  ", "# c", "g: [h, i]", "j: {k: l, m: n}", 'o: "p', 'q"', "r: 's", "t'",
    "u: |", "v: >-", "w: |+", "x: |2-", "y z", ": aa", "bb : cc", "---", "...", "- - dd", "[ee,", "]", "{ff: gg,", "}",
    "hh,", 'kk: "l\\"m"', '"ii": jj', "'kk':ll", "- [", 'nn: [a:b, "c":d, e: f, :g]', "pp: }", "qq: !x y", "rr: &s t",
    "uu: *v", "ww: @x", "- |", "- >", "zz: 50 % # c", '"a', "{a, b: , : c}", "[a: b, c]", "- {a: b}", "--- a", "--- |",
    "... #x", "-a", "a:b", "::", "- : a", "- :",
)  # fmt: skip
_INDENTED = st.builds(
    lambda blanks, line: " " * blanks + line + "\n", st.sampled_from((0, 0, 2)), st.sampled_from(LINES)
)
TEXTS = st.lists(st.sampled_from(PIECES), max_size=30).map("".join) | st.lists(_INDENTED, max_size=9).map("".join)

Outcome = tuple[Node | None, tuple[Problem, ...]]


def outcome(text: str, *, libyaml: bool) -> Outcome:
    """What the loader makes of a text: nodes with their places, and messages."""
    report = Report("map.yaml")
    try:
        root = nodes.parse(text, report, quick=libyaml)
    except MapError as error:
        return None, error.problems
    return root, tuple(report.problems)
