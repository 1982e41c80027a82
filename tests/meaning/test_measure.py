"""Measures, and the numbers that registers hold."""

from dataclasses import replace
from decimal import Decimal

from tests import shipped

from driveblocks.maps.form import Span
from driveblocks.maps.model import Condition, OtherScale, Register, Scale
from driveblocks.meaning.measure import measures
from driveblocks.meaning.pattern import Pattern
from driveblocks.meaning.quantity import of_row, quantity

MX2 = shipped.drives()["MX2"]
TWICE = Scale(
    factor=Decimal("0.01"),
    source="page 1",
    when=Condition(register=3, bit=Span(4, 5), equals=0),
    otherwise=(OtherScale(factor=Decimal(1), when=Condition(register=3, bit=Span(4, 5), equals=2), source="page 2"),),
)
ROW = Register(address=Span(8, 9), name="Current", unit="A", scale=TWICE, words=2, order="low_first", signed=True)


def test_of_several_scales_each_has_what_it_holds_for() -> None:
    found = of_row(ROW, 8)
    assert [(each.value, each.when) for each in found.factors] == [
        (Decimal("0.01"), Pattern(3, 0x30, 0)),
        (Decimal(1), Pattern(3, 0x30, 0x20)),
    ]
    assert [each.said.source for each in found.factors] == ["page 1", "page 2"]
    assert found.factor == Decimal("0.01")


def test_a_number_of_two_registers() -> None:
    low, high = of_row(ROW, 8), of_row(replace(ROW, order="high_first"), 8)
    assert (low.high, low.low, low.pair, low.signed) == (9, 8, True, True)
    assert (high.high, high.low) == (8, 9)


def test_a_register_that_no_row_describes_is_a_plain_word() -> None:
    plain = quantity(MX2, 0xEEEE)
    assert (plain.high, plain.low, plain.signed, plain.unit, plain.factor) == (0xEEEE, 0xEEEE, False, None, None)


def test_a_scale_in_another_unit_than_the_pin_s_is_none() -> None:
    section, row = next((section, row) for section, row in MX2.registers() if row.unit == "A" and row.scale)
    drive = replace(MX2, sections=(replace(section, registers=(replace(row, unit="W"),)),))
    one = replace(MX2.operation.measures[0], shows="output_current", register=row.address.first)
    drive = replace(drive, operation=replace(drive.operation, measures=(one,)))
    assert quantity(drive, one.register).factors
    assert measures(drive)[0].quantity.factors == ()
