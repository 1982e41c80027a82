"""What values a variable can take, as far as its POU tells."""

import pytest

from structured_text.language.checker import check
from structured_text.language.lint_scope import Scope
from structured_text.language.parser import parse
from structured_text.language.report import Report

TEXT = """
FUNCTION_BLOCK Example
VAR_INPUT
  Given : UINT;
END_VAR
VAR CONSTANT
  LAST : UINT := 9;
END_VAR
VAR
  {names} : UINT;
  k : INT;
  w : WORD;
  b : BYTE;
  x : BOOL;
END_VAR
{body}
END_FUNCTION_BLOCK
"""


def range_of(body: str) -> tuple[int, int] | None:
    """The range of the variable `v` in a block with this body."""
    checked = check([parse(TEXT.format(names="v, s", body=body), "t.st")])
    pou = checked.blocks["EXAMPLE"]
    scope = Scope(pou, checked, Report())
    return scope.ranges.known.get(id(pou.symbols["V"]))


@pytest.mark.parametrize(
    ("body", "limits"),
    [
        ("v := 5;", (0, 5)),
        ("v := LAST;", (0, 9)),
        ("v := Given;", (0, 65535)),
        ("v := Given MOD 256;", (0, 255)),
        ("v := Given / 256;", (0, 255)),
        ("v := BYTE_TO_UINT(b);", (0, 255)),
        ("v := WORD_TO_UINT(w AND WORD#16#00FF);", (0, 255)),
        ("v := WORD_TO_UINT(SHR(w, 12) AND WORD#16#FFFF);", (0, 15)),
        ("v := (v + BYTE_TO_UINT(b)) MOD 256;", (0, 255)),
        ("v := v + 1;", (0, 65535)),
        ("v := 3; s := v * 2; v := s MOD 10;", (0, 9)),
        ("v := Given - 1;", (0, 65535)),
        ("x := TRUE;", None),
    ],
)
def test_ranges(body: str, limits: tuple[int, int] | None) -> None:
    assert range_of(body) == limits
