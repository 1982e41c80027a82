"""Words of registers on hand-typed cases, engineering values against IEEE arithmetic by struct."""

import struct
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from driveblocks.maps.form import Span
from driveblocks.maps.model import Drive, Register
from driveblocks.reference import register
from driveblocks.reference.single import nearest, stored

pytestmark = pytest.mark.every_family


def row(drives: dict[str, Drive], prefix: str, address: int) -> Register:
    """A row of a map."""
    found = drives[prefix].register_at(address)
    assert found is not None
    return found


def true_ones(decoded: dict[str, bool | int]) -> dict[str, bool | int]:
    """The outputs that are TRUE or not 0."""
    return {name: value for name, value in decoded.items() if value}


@pytest.mark.parametrize(
    ("prefix", "address", "word", "outputs"),
    [
        ("SN300G5", 0x0010, 0x0000, {}),
        ("SN300G5", 0x0010, 0x0022, {"ZeroSpeed": True, "Ready": True}),
        ("SN300G5", 0x0010, 0x0100, {}),
        ("SN300G5", 0x0014, 0x8001, {"FuseBlown": True, "BrakingResistorOverheat": True}),
        ("JSCC", 0x1000, 3, {"Stop": True}),
        ("JSCC", 0x1000, 4, {"Unknown": True}),
        ("JSCC", 0x2001, 1, {"RunningForward": True}),
        ("JSCC", 0x2001, 9, {"RunningForward": True, "Fault": True}),
        ("JSCC", 0x2001, 0, {"Unknown": True}),
        ("JSCC", 0x2001, 0x11, {"RunningForward": True, "Unknown": True}),
        ("JSCC", 0x3000, 12, {"AutoTuningFailed": True}),
        ("CHF", 0x1001, 3, {"Standby": True}),
        ("CHF", 0x1001, 5, {"Unknown": True}),
        ("EX100", 0x0000, 0x0101, {"RunForward": True, "RampSelection": 1, "Ramp2": True}),
        ("EX100", 0x0000, 0x0300, {"RampSelection": 3}),
    ],
)
def test_outputs_that_are_on(
    drives: dict[str, Drive], prefix: str, address: int, word: int, outputs: dict[str, bool | int]
) -> None:
    assert true_ones(register.decode(row(drives, prefix, address), word)) == outputs


def test_a_field_is_a_number_and_its_values(drives: dict[str, Drive]) -> None:
    decoded = register.decode(row(drives, "SN300G5", 0x0011), 0x0018)
    device = row(drives, "SN300G5", 0x0011).bits[3]
    assert device.bit == Span(3, 4)
    assert [value for value in decoded.values() if type(value) is int] == [3]
    assert list(true_ones(decoded).values()) == [3, True]


def test_unused_bits_have_no_output(drives: dict[str, Drive]) -> None:
    assert list(register.decode(row(drives, "EX100", 0x0015), 0xFFFF)) == ["Overspeed", "ExternalFault1"]


@pytest.mark.parametrize(
    ("prefix", "address", "word", "value"),
    [
        ("JSCC", 0x2000, 0x01F4, "50"),
        ("JSCC", 0x2000, 0xFFFF, "6553.5"),
        ("SN300G5", 0x0021, 5000, "50"),
        ("CHF", 0x2000, 10000, "100"),
        ("CHF", 0x2000, 0xD8F0, "-100"),
        ("CHF", 0x2000, 0xFFFF, "-0.01"),
        ("EX100", 0x0023, 5488, "548.8"),
    ],
)
def test_engineering_values(drives: dict[str, Drive], prefix: str, address: int, word: int, value: str) -> None:
    known = row(drives, prefix, address)
    assert register.exact(known, word) == Fraction(value)
    assert register.engineering(known, word) == struct.unpack("f", struct.pack("f", float(value)))[0]


def test_a_register_without_scale_has_no_value(drives: dict[str, Drive]) -> None:
    with pytest.raises(ValueError, match="no scale"):
        register.exact(row(drives, "CHF", 0x3000), 1)


@given(st.integers(0, 0xFFFF), st.integers(0, 15), st.integers(1, 16))
def test_the_number_of_some_bits(word: int, first: int, width: int) -> None:
    last = min(first + width - 1, 15)
    assert register.number(word, Span(first, last)) == word >> first & (1 << last - first + 1) - 1


@given(st.floats(width=32, allow_nan=False, allow_infinity=False))
def test_a_single_is_stored_as_it_is(number: float) -> None:
    assert stored(number) == number


@given(st.floats(min_value=-3.4e38, max_value=3.4e38))
def test_a_double_is_rounded_as_its_exact_value_is(number: float) -> None:
    assert stored(number) == nearest(Fraction(number))


@given(st.fractions(min_value=-70000, max_value=70000))
def test_no_single_is_nearer(value: Fraction) -> None:
    found = nearest(value)
    (bits,) = struct.unpack("I", struct.pack("f", found))
    beside = [struct.unpack("f", struct.pack("I", other))[0] for other in (max(bits & 0x7FFFFFFF, 1) - 1, bits + 1)]
    assert all(abs(Fraction(found) - value) <= abs(Fraction(abs(other)) - abs(value)) for other in beside)


def test_beyond_the_largest_single_is_infinity() -> None:
    assert nearest(Fraction(10) ** 39) == float("inf")
    assert nearest(-(Fraction(10) ** 39)) == float("-inf")
