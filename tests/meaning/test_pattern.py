"""Patterns of bits, made from conditions of a map, and as a person reads them."""

import pytest

from driveblocks.maps.form import Span
from driveblocks.maps.model import Condition, Register
from driveblocks.meaning.pattern import Pattern, of_condition
from driveblocks.reference.standstill import holds as oracle


@pytest.mark.parametrize(
    ("condition", "pattern", "text"),
    [
        (Condition(register=0x000F, bit=Span(0, 0), equals=1), Pattern(15, 1, 1), "000FH bit 0 = 1"),
        (Condition(register=0x211F, bit=Span(8, 15), equals=2), Pattern(0x211F, 0xFF00, 0x200), "211FH bits 8-F = 2"),
        (Condition(register=0x3000, equals=3), Pattern(0x3000, 0xFFFF, 3), "3000H = 3"),
        (
            Condition(register=0x3000, equals=0, differs=True),
            Pattern(0x3000, 0xFFFF, 0, is_="<>"),
            "3000H <> 0",
        ),
        (
            Condition(register=0x2100, mask=0x006F, equals=0x0023),
            Pattern(0x2100, 0x006F, 0x0023),
            "2100H AND 006FH = 0023H",
        ),
    ],
)
def test_a_condition_as_a_pattern(condition: Condition, pattern: Pattern, text: str) -> None:
    assert of_condition(condition) == pattern
    assert str(pattern) == text


SIGNED = Register(address=Span(0x20, 0x20), signed=True)
BELOW, NEGATIVE = Condition(register=0x20, below=5), Condition(register=0x20, below=0)


@pytest.mark.parametrize(
    ("condition", "row", "text", "holds", "not_"),
    [
        (BELOW, None, "0020H < 5", (0, 4), (5, 0xFFFF)),
        (BELOW, SIGNED, "0020H < 5", (0, 4, 0xFFFF, 0x8000), (5, 0x7FFF)),
        (NEGATIVE, SIGNED, "0020H < 0", (0x8000, 0xFFFF), (0, 0x7FFF)),
        (Condition(register=0x20, above=-5), SIGNED, "0020H > -5", (0xFFFC, 0, 0x7FFF), (0xFFFB, 0x8000)),
        (Condition(register=0x20, above=5), None, "0020H > 5", (6, 0xFFFF), (0, 5)),
        (Condition(register=0x20, bit=Span(4, 7), above=2), None, "0020H bits 4-7 > 2", (0x30, 0xFFFF), (0x2F, 0xFF0F)),
        (Condition(register=0x20, bit=Span(4, 7), below=2), SIGNED, "0020H bits 4-7 < 2", (0x1F, 0xFF0F), (0x20, 0xF0)),
    ],
)
def test_a_number_below_or_above_another(
    condition: Condition, row: Register | None, text: str, holds: tuple[int, ...], not_: tuple[int, ...]
) -> None:
    pattern = of_condition(condition, row)
    assert str(pattern) == text
    assert [pattern.holds(word) for word in (*holds, *not_)] == [True] * len(holds) + [False] * len(not_)
    assert pattern.holds(pattern.word)
    signed = row is not None and row.signed
    assert [oracle(condition, word, signed=signed) for word in (*holds, *not_)] == [True] * len(holds) + [False] * len(
        not_
    )


@pytest.mark.parametrize(
    ("one", "other", "apart"),
    [
        (Pattern(1, 0xFFFF, 20, "<"), Pattern(1, 0xFFFF, 19, ">"), True),
        (Pattern(1, 0xFFFF, 20, "<"), Pattern(1, 0xFFFF, 18, ">"), False),
        (Pattern(1, 0xFFFF, 0, "<>"), Pattern(1, 0xFFFF, 0), True),
        (Pattern(1, 0xFFFF, 3), Pattern(1, 0xFFFF, 0, "<>"), False),
        (Pattern(1, 0xFFFF, 0, "<>"), Pattern(1, 0xFFFF, 1, "<"), True),
        (Pattern(1, 0xFFFF, 0, "<>"), Pattern(1, 0xFFFF, 2, "<"), False),
        (Pattern(1, 0xFFFF, 0, "<>"), Pattern(1, 0xFFFF, 7, "<>"), False),
        (Pattern(1, 0xF0, 0x20, "<"), Pattern(1, 0xF0, 0x10, ">"), True),
        (Pattern(1, 0xF0, 0x20, "<"), Pattern(1, 0xF3, 0x31), True),
        (Pattern(1, 0xF0, 0x20, "<"), Pattern(1, 0x10, 0x10), False),
        (Pattern(1, 0xFFFF, 0xFFF6, ">", signed=True), Pattern(1, 0xFFFF, 0xFFF7, "<", signed=True), True),
        (Pattern(1, 0xFFFF, 0xFFF6, ">", signed=True), Pattern(1, 0xFFFF, 10, "<", signed=True), False),
        (Pattern(1, 0xFFFF, 20, "<"), Pattern(2, 0xFFFF, 19, ">"), False),
    ],
)
def test_patterns_that_never_hold_at_once(one: Pattern, other: Pattern, apart: bool) -> None:
    assert one.excludes(other) == other.excludes(one) == apart


def test_numbers_exclude_each_other_as_a_count_of_all_words_says() -> None:
    values = (0, 1, 2, 5, 0x7FFE, 0x7FFF, 0x8000, 0x8001, 0xFFFE, 0xFFFF)
    asked = [
        Pattern(1, 0xFFFF, at, is_, signed=sign) for at in values for is_ in ("<", ">", "<>") for sign in (False, True)
    ]
    words = sorted({(each + more) & 0xFFFF for each in values for more in (-3, -2, -1, 0, 1, 2, 3)})
    held = {one: {word for word in words if one.holds(word)} for one in asked}
    assert [(one, two) for one in asked for two in asked if one.excludes(two) == bool(held[one] & held[two])] == []


def test_a_pattern_holds_for_words_with_its_bits() -> None:
    pattern = Pattern(1, 0x006F, 0x0023)
    assert pattern.holds(0xFF33)
    assert not pattern.holds(0x0027)
    assert Pattern(1, 0xFFFF, 0, "<>").holds(7)
