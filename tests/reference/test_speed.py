"""The speed reference: halves, and that every number gives a word or a reason."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from driveblocks.maps.model import Drive
from driveblocks.reference.speed import SpeedReference

pytestmark = pytest.mark.every_family


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
