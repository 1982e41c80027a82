"""The speed reference on the scales of the shipped drives, typed by hand, and its refusals in order."""

from math import inf, nan

import pytest
from hypothesis import given
from hypothesis import strategies as st

from driveblocks.maps.model import Drive
from driveblocks.reference.speed import SpeedReference

pytestmark = pytest.mark.every_family


@pytest.mark.parametrize(
    ("prefix", "pins", "expected"),
    [
        # SN300G5: 0.01 Hz per count
        ("SN300G5", (50.0, 0.0), ("NO_MAXIMUM", 0, False)),
        ("SN300G5", (50.0, 60.0), ("OK", 5000, False)),
        ("SN300G5", (60.0, 50.0), ("OK", 5000, True)),
        ("SN300G5", (0.004, 50.0), ("OK", 0, False)),
        ("SN300G5", (0.006, 50.0), ("OK", 1, False)),
        ("SN300G5", (35.75, 50.0), ("OK", 3575, False)),
        ("SN300G5", (700.0, 800.0), ("OK", 65535, True)),
        ("SN300G5", (1.0e30, 10000.0), ("OK", 65535, True)),
        ("SN300G5", (nan, 0.0), ("NOT_A_NUMBER", 0, False)),
        ("SN300G5", (inf, 0.0), ("NOT_A_NUMBER", 0, False)),
        ("SN300G5", (-inf, 0.0), ("NOT_A_NUMBER", 0, False)),
        ("SN300G5", (2.0e30, 0.0), ("NOT_A_NUMBER", 0, False)),
        ("SN300G5", (-0.01, 50.0), ("NEGATIVE", 0, False)),
        ("SN300G5", (-0.004, 50.0), ("OK", 0, False)),
        ("SN300G5", (-0.0, 50.0), ("OK", 0, False)),
        ("SN300G5", (1.0, nan), ("NO_MAXIMUM", 0, False)),
        ("SN300G5", (1.0, 0.09), ("NO_MAXIMUM", 0, False)),
        ("SN300G5", (0.05, 0.1), ("OK", 5, False)),
        ("SN300G5", (1.0, 10001.0), ("NO_MAXIMUM", 0, False)),
        # JSCC: the manual gives no scale
        ("JSCC", (50.0, 60.0), ("NO_SCALE", 0, False)),
        ("JSCC", (50.0, 60.0, 0.0, 10.0), ("OK", 500, False)),
        ("JSCC", (50.0, 60.0, 0.0, -10.0), ("NO_SCALE", 0, False)),
        ("JSCC", (50.0, 60.0, 0.0, nan), ("NO_SCALE", 0, False)),
        ("JSCC", (50.0, 60.0, 0.0, inf), ("NO_SCALE", 0, False)),
        ("JSCC", (50.0, 60.0, 0.0, 1.0e6), ("OK", 65535, True)),
        ("JSCC", (50.0, 60.0, 0.0, 2.0e6), ("NO_SCALE", 0, False)),
        ("JSCC", (-1.0, 0.0, 0.0, 0.0), ("NO_MAXIMUM", 0, False)),
        ("JSCC", (-1.0, 60.0, 0.0, 0.0), ("NO_SCALE", 0, False)),
        ("JSCC", (-1.0, 60.0, 0.0, 1.0), ("NEGATIVE", 0, False)),
        ("JSCC", (-0.25, 60.0, 0.0, 1.0), ("OK", 0, False)),
        ("JSCC", (50.0, 40.0, 0.0, 10.0), ("OK", 400, True)),
        # CHF: percent of the maximum frequency, 0.01 % per count, up to 10000
        ("CHF", (25.0, 50.0, 50.0), ("OK", 5000, False)),
        ("CHF", (50.0, 50.0, 50.0), ("OK", 10000, False)),
        ("CHF", (51.0, 50.0, 50.0), ("OK", 10000, True)),
        ("CHF", (1.0, 3.0, 3.0), ("OK", 3333, False)),
        ("CHF", (2.0, 3.0, 3.0), ("OK", 6667, False)),
        ("CHF", (25.0, 0.0, 50.0), ("NO_MAXIMUM", 0, False)),
        ("CHF", (25.0, -50.0, 50.0), ("NO_MAXIMUM", 0, False)),
        ("CHF", (25.0, 50.0, 0.0), ("NO_FULL_SCALE", 0, False)),
        ("CHF", (25.0, 50.0, nan), ("NO_FULL_SCALE", 0, False)),
        ("CHF", (30.0, 40.0, 50.0), ("OK", 6000, False)),
        ("CHF", (45.0, 40.0, 50.0), ("OK", 8000, True)),
        ("CHF", (45.0, 50.0, 40.0), ("OK", 10000, True)),
        ("SN300G5", (45.0, 50.0, 40.0), ("OK", 4000, True)),
        ("SN300G5", (45.0, 50.0, -1.0), ("NO_FULL_SCALE", 0, False)),
        ("CHF", (-0.0024, 50.0, 50.0), ("OK", 0, False)),
        ("CHF", (-0.0026, 50.0, 50.0), ("NEGATIVE", 0, False)),
    ],
)
def test_words(drives: dict[str, Drive], prefix: str, pins: tuple[float, ...], expected: tuple[str, int, bool]) -> None:
    found = SpeedReference(drives[prefix]).encode(*pins)
    assert (found.result, found.value, found.limited) == expected
    assert found.near == {expected[1]}


def test_a_half_is_rounded_up(drives: dict[str, Drive]) -> None:
    assert SpeedReference(drives["JSCC"]).encode(0.5, 50.0, 0.0, 1.0).value == 1
    assert SpeedReference(drives["JSCC"]).encode(2.5, 50.0, 0.0, 1.0).value == 3


def test_beside_a_half_single_precision_may_give_either(drives: dict[str, Drive]) -> None:
    assert SpeedReference(drives["SN300G5"]).encode(327.685, 400.0).near == {32768, 32769}


def test_half_a_count_below_zero_single_precision_may_say_either(drives: dict[str, Drive]) -> None:
    reference = SpeedReference(drives["SN300G5"])
    assert reference.encode(-0.005, 50.0).results == {"OK", "NEGATIVE"}
    assert reference.encode(-0.0051, 50.0).results == {"NEGATIVE"}


@pytest.mark.parametrize("prefix", ["SN300G5", "JSCC", "CHF", "EX100"])
@given(pins=st.tuples(*[st.floats(width=32)] * 4))
def test_every_pin_gives_a_word_or_a_reason(
    drives: dict[str, Drive], prefix: str, pins: tuple[float, float, float, float]
) -> None:
    reference = SpeedReference(drives[prefix])
    found = reference.encode(*pins)
    if found.result == "OK":
        assert 0 <= found.value <= reference.highest
    else:
        assert (found.value, found.limited, found.near) == (0, False, frozenset({0}))


@pytest.mark.parametrize("prefix", ["SN300G5", "CHF"])
@given(pair=st.tuples(st.floats(0, 1000, width=32), st.floats(0, 1000, width=32)))
def test_more_hertz_is_never_a_smaller_word(drives: dict[str, Drive], prefix: str, pair: tuple[float, float]) -> None:
    reference = SpeedReference(drives[prefix])
    low, high = (reference.encode(hertz, 400.0, 400.0).value for hertz in sorted(pair))
    assert low <= high
