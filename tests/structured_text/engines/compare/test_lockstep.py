"""The comparison itself: it finds what differs, tells it, and takes nothing for the same that is not."""

from dataclasses import replace

import pytest
from tests.structured_text.engines.compare.cases import Case, load_cases
from tests.structured_text.engines.compare.lockstep import ABSENT, Run, alike, first_unlike, lockstep

from structured_text.engines.embedded import EmbeddedEngine
from structured_text.engines.engine import Source

CASES = load_cases()

# One small mistake per block: the corpus and its inputs are good for something if each is found.
MISTAKES = [
    ("crc_table", "WORD#16#C0C1", "WORD#16#C0C0"),
    ("crc_bitwise", "WORD#16#A001", "WORD#16#A003"),
    ("ascii_encoder", "Nibble + 55", "Nibble + 87"),
    ("ascii_decoder", "65..70", "65..69"),
    ("master_ton", "T#200ms", "T#201ms"),
    ("master_elapsed", "UDINT#4294967295", "UDINT#4294967294"),
    ("reply_parser", "Frame[Length - 1]", "Frame[Length - 2]"),
    ("timers", "PT := T#70ms", "PT := T#71ms"),
    ("structures", "Plant.Channels[2] := Spare", "Plant.Channels[2] := Plant.Channels[1]"),
    ("strings", "3..9", "3..8"),
    ("nesting", "Slope : INT := 3", "Slope : INT := 4"),
    ("real_maths", "Away := Number - 0.5", "Away := Number - 0.25"),
    ("conversions", "SHR(D, 16)", "SHR(D, 15)"),
    ("control_flow", "2, 10..19", "2, 11..19"),
    ("enums", "NOT Blocked AND Open", "Open"),
    ("bits", "ROL(D, 7)", "ROL(D, 6)"),
    ("queue", "MOD 8 + 7", "MOD 8 + 6"),
    ("two_tasks", "T#70ms", "T#80ms"),
]


@pytest.mark.parametrize(("name", "right", "wrong"), MISTAKES, ids=[name for name, _, _ in MISTAKES])
def test_a_mistake_in_a_block_is_found(name: str, right: str, wrong: str) -> None:
    """The inputs of the corpus bring every block to where a small mistake shows."""
    case = CASES[name]
    difference = lockstep(case, [Run(EmbeddedEngine(), each) for each in (case, _edited(case, right, wrong))], 2000, 7)
    assert difference is not None


def test_every_block_has_its_mistake() -> None:
    """A new block of the corpus gets a line above."""
    assert [name for name, _, _ in MISTAKES] == list(CASES)


def test_a_difference_names_block_scan_path_values_and_inputs() -> None:
    """All that is needed to look at it."""
    case = CASES["bits"]
    edited = _edited(case, "ROL(D, 7)", "ROL(D, 6)")
    runs = [Run(EmbeddedEngine(), case, "left"), Run(EmbeddedEngine(), edited, "right")]
    difference = lockstep(case, runs, 50, 7)
    assert difference is not None
    assert (difference.case, difference.path) == ("bits", "TURNEDD")
    assert difference.values["left"] != difference.values["right"]
    assert difference.inputs.keys() >= {"D", "Places"}
    assert f"bits, scan {difference.scan}, TURNEDD: left: {difference.values['left']}" in str(difference)


def test_an_error_of_one_engine_is_a_difference() -> None:
    """Where one stops and the other goes on, they are not the same."""
    case = CASES["control_flow"]
    edited = _edited(case, "Program1[Position] OF", "Program1[Position + 100] OF")
    runs = [Run(EmbeddedEngine(), each, name) for name, each in (("left", case), ("right", edited))]
    difference = lockstep(case, runs, 50, 7)
    assert difference is not None
    assert difference.values["right"] == ABSENT


def test_alike_is_to_the_bit() -> None:
    """A BOOL is no number, the zeros differ, NaN is NaN."""
    assert alike(float("nan"), -float("nan"))
    assert not alike(0.0, -0.0)
    assert not alike(True, 1)
    assert not alike(1, 1.0)
    assert first_unlike({"A": 1, "B": 2}, {"A": 1}) == "B"
    assert first_unlike({"A": 1}, {"A": 1, "B": 2}) == "B"
    assert first_unlike({"A": 1}, {"A": 1}) is None


def _edited(case: Case, right: str, wrong: str) -> Case:
    (source,) = case.sources
    assert right in source.text
    return replace(case, sources=(Source(source.path, source.text.replace(right, wrong, 1)),))
