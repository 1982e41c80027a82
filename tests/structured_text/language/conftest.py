"""Fragments of ST as tests and docs/lint.md show them, made whole."""

import re
from collections.abc import Callable
from pathlib import Path

import pytest

HERE = Path(__file__).parent
WHOLE = re.compile(
    r"\ufeff|\(\* nothing yet|(FUNCTION|FUNCTION_BLOCK|PROGRAM|TYPE|CONFIGURATION|VAR_GLOBAL|NAMESPACE)\b"
)
# What the page says about the variables of its examples.
VARIABLES = """
VAR
  b : BYTE;
  w : WORD;
  w2 : WORD;
  i : INT;
  n : INT;
  u : UINT;
  u2 : UINT;
  d : DINT;
  elapsed : UDINT;
  r : REAL;
  x : BOOL;
  y : BOOL;
  t1 : TIME;
  text : STRING;
  timer : TON;
  a : ARRAY[0..9] OF INT;
  frame : ARRAY[0..255] OF BYTE;
END_VAR
"""


def complete(fragment: str) -> str:
    """Whole source text for a fragment: statements, VAR blocks with statements, or whole text already."""
    if WHOLE.match(fragment):
        return fragment + "\n"
    variables = "" if fragment.startswith("VAR") else VARIABLES
    return f"FUNCTION_BLOCK Example{variables}\n{fragment}\nEND_FUNCTION_BLOCK\n"


@pytest.fixture(name="complete")
def completer() -> Callable[[str], str]:
    """Make a fragment whole."""
    return complete


@pytest.fixture
def here() -> Path:
    """The folder of these tests."""
    return HERE
