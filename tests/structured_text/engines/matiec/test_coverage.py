"""Which lines of the ST have run on matiec."""

from dataclasses import replace

import pytest

from structured_text.engines.engine import Source
from structured_text.engines.matiec import BadCError, Flags, MatiecEngine

FRONT = Source("front.st", "FUNCTION One : INT\n  VAR_INPUT\n    A : INT;\n  END_VAR\n  One := A;\nEND_FUNCTION\n")


def test_a_library_counts_from_its_build_on(matiec: MatiecEngine) -> None:
    """Its C is loaded once, and all that were built from the same sources count together."""
    counting = replace(matiec, flags=Flags(coverage=True))
    first = counting.build([FRONT])
    first.call("One", {"A": 1})
    second = counting.build([FRONT])
    second.call("One", {"A": 1})
    assert (first.coverage(), second.coverage()) == ({"front.st": {5: 2}}, {"front.st": {5: 1}})


def test_global_without_configuration_is_bad_c_and_no_broken_library(matiec: MatiecEngine) -> None:
    text = "PROGRAM Wanting\n  VAR_EXTERNAL\n    G : INT;\n  END_VAR\n  G := 1;\nEND_PROGRAM\n"
    with pytest.raises(BadCError, match="__GET_GLOBAL_G"):
        matiec.build([Source("p.st", text)])
