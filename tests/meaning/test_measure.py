"""Measures, and the numbers that registers hold."""

from decimal import Decimal

from tests import shipped

from driveblocks.meaning.measure import measures
from driveblocks.meaning.quantity import quantity

DRIVES = shipped.drives()


def test_a_scale_in_another_unit_than_the_pin_s_is_none() -> None:
    for drive in DRIVES.values():
        for one in measures(drive):
            row = drive.register_at(one.register)
            assert row is not None
            units = {"output_power": "kW", "output_frequency": "Hz", "output_current": "A"}
            if row.scale and row.unit != units.get(one.name, row.unit):
                assert one.quantity.factors == ()


def test_of_several_scales_each_has_what_it_holds_for() -> None:
    several = [one for drive in DRIVES.values() for one in measures(drive) if one.quantity.factors[1:]]
    assert several
    assert all(factor.when for one in several for factor in one.quantity.factors)


def test_a_register_that_no_row_describes_is_a_plain_word() -> None:
    plain = quantity(DRIVES["JSCC"], 0xEEEE)
    assert (plain.high, plain.low, plain.signed, plain.unit, plain.factor) == (0xEEEE, 0xEEEE, False, None, None)


def test_a_number_of_two_registers() -> None:
    pairs = {
        (drive.prefix, row.address.first): (drive, row)
        for drive in DRIVES.values()
        for _, row in drive.registers()
        if row.words and drive.is_read(row)
    }
    for (_, first), (drive, row) in pairs.items():
        found = quantity(drive, first)
        assert {found.high, found.low} == {first, first + 1}
        assert (found.low == first) == (row.order == "low_first")
        assert found.factor == (row.scale.factor if row.scale else None) or isinstance(found.factor, Decimal)
