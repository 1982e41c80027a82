"""Where faults stand, what tracebacks show, and which lines ran."""

from __future__ import annotations

import traceback

import pytest
from tests.structured_text.engines.embedded.snippets import build

from structured_text.engines.embedded import EmbeddedEngine
from structured_text.engines.engine import ScanError, Source

TEXT = """TYPE Row : ARRAY[2..5] OF INT; END_TYPE
TYPE Grid : ARRAY[0..1, 1..3] OF INT; END_TYPE
FUNCTION Pick : INT
VAR_INPUT n : INT; END_VAR
  Pick := 100 /
          n;
END_FUNCTION
FUNCTION_BLOCK Inner
VAR_INPUT n : INT; END_VAR
VAR_OUTPUT y : INT; END_VAR
VAR a : Row; g : Grid; END_VAR
  y := a[n] + a[2];
  y := y + g[1, n];
  y := y + Pick(n - 3);
END_FUNCTION_BLOCK
FUNCTION_BLOCK Outer
VAR_INPUT n : INT; END_VAR
VAR i : Inner; b : Row; END_VAR
  IF n < 100 THEN
    i(n := n);
  ELSE
    b[n - 95] := 1;
  END_IF;
END_FUNCTION_BLOCK
"""


@pytest.mark.parametrize(
    ("n", "line", "column", "text"),
    [
        (6, 12, 10, "index 6 of a is outside 2..5"),
        (1, 12, 10, "index 1 of a is outside 2..5"),
        (-9, 12, 10, "index -9 of a is outside 2..5"),
        (5, 13, 17, "index 5 of g[...] is outside 1..3"),
        (4, 13, 17, "index 4 of g[...] is outside 1..3"),
        (3, 5, 11, "division by zero"),
        (101, 22, 7, "index 6 of b is outside 2..5"),
    ],
)
def test_place_and_text(n: int, line: int, column: int, text: str) -> None:
    """The innermost ST expression, in whatever block or function it stands."""
    made = build(TEXT).instance("Outer")
    made["n"] = n
    with pytest.raises(ScanError) as caught:
        made.scan()
    message = caught.value.message
    assert (message.path, message.line, message.column) == ("test.st", line, column)
    assert message.text in (text, text.replace("g[...]", "g"))


def test_no_index_counts_from_the_end() -> None:
    """Python's negative indices must not show through, in stores neither."""
    text = """TYPE Row : ARRAY[0..3] OF INT; END_TYPE
FUNCTION_BLOCK Test
VAR_INPUT n : INT; END_VAR VAR a : Row; END_VAR
  a[n] := 1;
END_FUNCTION_BLOCK"""
    made = build(text).instance("Test")
    for n in (-1, -4, -5, 4):
        made["n"] = n
        with pytest.raises(ScanError, match=f"index {n} of a is outside 0..3"):
            made.scan()
    assert made["a"] == [0, 0, 0, 0]


def test_tracebacks_show_lines_of_st() -> None:
    """Path, line and block of every level."""
    made = build(TEXT).instance("Outer")
    made["n"] = 3
    with pytest.raises(ScanError) as caught:
        made.scan()
    cause = caught.value.__cause__
    assert cause is not None
    frames = [(each.filename, each.lineno) for each in traceback.extract_tb(cause.__traceback__)]
    assert [line for path, line in frames if path == "test.st"] == [20, 14, 5]


class TestCoverage:
    """Counts per line, for all sources of a build."""

    OTHER = """FUNCTION Sign : INT
VAR_INPUT n : INT; END_VAR
  IF n < 0 THEN
    Sign := -1;
  ELSIF n > 0 THEN
    Sign := 1;
  END_IF;
END_FUNCTION
"""
    MAIN = """FUNCTION_BLOCK Test
VAR_INPUT n : INT; END_VAR
VAR i : INT; y : INT; END_VAR
  i := 0;
  WHILE i < n DO
    i := i + 1;
    y := Sign(i);
  END_WHILE;
  CASE n OF
    1: y := 1;
    2: y := 2; i := 3;
  END_CASE;
END_FUNCTION_BLOCK
"""

    def test_hits(self) -> None:
        """Lines that never ran are there with 0; two statements on a line count together."""
        engine = EmbeddedEngine(coverage=True)
        library = engine.build([Source("other.st", self.OTHER), Source("main.st", self.MAIN)])
        made = library.instance("Test")
        for n in (3, 2):
            made["n"] = n
            made.scan()
        assert library.coverage() == {
            "other.st": {3: 5, 4: 0, 6: 5},
            "main.st": {4: 2, 5: 2, 6: 5, 7: 5, 9: 2, 10: 0, 11: 2},
        }
