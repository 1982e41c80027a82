"""Patterns of bits, made from conditions of a map, and as a person reads them."""

import pytest

from driveblocks.maps.form import Span
from driveblocks.maps.model import Condition
from driveblocks.meaning.pattern import Pattern, of_condition


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


def test_a_pattern_holds_for_words_with_its_bits() -> None:
    pattern = Pattern(1, 0x006F, 0x0023)
    assert pattern.holds(0xFF33)
    assert not pattern.holds(0x0027)
    assert Pattern(1, 0xFFFF, 0, "<>").holds(7)
