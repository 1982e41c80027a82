"""The speed reference: a frequency as the word for the drive's reference register, in exact arithmetic.

The pins are REAL: what they cannot hold exactly is rounded to single precision before anything is computed.
"""

from dataclasses import dataclass, replace
from fractions import Fraction
from functools import lru_cache
from math import floor, isnan

from driveblocks.maps.model import Drive
from driveblocks.reference.single import stored

BEYOND = Fraction(stored(1.0e30))
"""A pin above this size is taken for no number, as infinity is."""

LEAST_MAXIMUM, MOST_MAXIMUM = Fraction(stored(0.1)), Fraction(10_000)
"""A maximum in Hz outside of these is not set, or a mistake."""

MOST_PAIRS = 100
"""Pole pairs of a motor."""

MOST_COUNTS = 1_000_000
"""Counts per Hz; a word ends at 65535, so more is a mistake, and what it gives, clamped, would be full speed."""

HALF = Fraction(1, 2)

SLACK = Fraction(1, 2**21)
"""What a few roundings to single precision may change, as a part of the count."""


@dataclass(frozen=True)
class Encoded:
    """OK and the word, or why there is none."""

    result: str
    value: int = 0
    limited: bool = False
    near: frozenset[int] = frozenset({0})
    """The words that arithmetic in single precision may give: more than one only beside a half."""
    results: frozenset[str] = frozenset()
    """What it may say: more than one only beside half a count below zero."""
    at_the_end: bool = False
    """So near to the end of the word that single precision may or may not call it limited."""
    hertz: float = 0.0
    """The frequency after the limits, as single precision holds it."""


class SpeedReference:
    def __init__(self, drive: Drive) -> None:
        """Take from the map what the reference register counts. Raises ValueError if the map does not list it."""
        self.spec = drive.operation.reference
        row = drive.register_at(self.spec.register, "w")
        if row is None:
            raise ValueError("the map does not list the reference register")
        self.factor = Fraction(row.scale.factor) if row.scale else None
        self.percent = self.spec.means == "percent_of_maximum" and row.scale is not None
        if self.spec.means == "fraction_of_full_scale":
            self.percent = self.spec.full_scale_hz is None
            self.factor = Fraction(100 if self.percent else self.spec.full_scale_hz or 1) / (self.spec.full_scale or 1)
        self.turns = self.spec.means == "speed" and row.scale is not None
        self.by_sign = drive.operation.by_sign
        self.highest = row.range.max if row.range else 0x7FFF if row.signed else 0xFFFF

    @property
    def address(self) -> int:
        return self.spec.register

    def encode(
        self, hertz: float, maximum: float, full: float = 0.0, scale: float = 0.0, *, reverse: bool = False
    ) -> Encoded:
        """The word for a frequency in Hz.

        `maximum` is a limit in Hz; `full`, in Hz, is what 100 % means in the drive, and a second limit; where the
        reference is no fraction of it, 0 is none. `scale` is in counts per Hz if the map has none; of a speed in
        r/min it is the number of pole pairs.
        `reverse` makes the word negative, where that is the direction.
        """
        asked, most, whole, counts = map(_exact, (hertz, maximum, full, scale))
        if asked is None:
            return _refused("NOT_A_NUMBER")
        if most is None or not LEAST_MAXIMUM <= most <= MOST_MAXIMUM:
            return _refused("NO_MAXIMUM")
        if whole is None or not (LEAST_MAXIMUM <= whole <= MOST_MAXIMUM or (whole == 0 and not self.percent)):
            return _refused("NO_FULL_SCALE")
        if not self._scaled(counts):
            return _refused("NO_SCALE")
        limit = min(most, whole) if whole else most
        found = self._counted(self._counts(min(asked, limit), whole, counts), asked > limit)
        if found.result != "OK":
            return found
        sign = -1 if reverse and self.by_sign else 1
        near = frozenset(sign * word & 0xFFFF for word in found.near)
        return replace(found, value=sign * found.value & 0xFFFF, near=near, hertz=float(min(asked, limit)))

    def _scaled(self, counts: Fraction | None) -> bool:
        """Whether it is known what a count is."""
        if self.factor is not None and not self.turns:
            return True
        least, most = (1, MOST_PAIRS) if self.turns else (0, MOST_COUNTS)
        return counts is not None and counts > 0 and least <= counts <= most

    def _counts(self, hertz: Fraction, whole: Fraction, counts: Fraction | None) -> Fraction:
        if self.factor is None:
            assert counts is not None  # noqa: S101  (refused before)
            return hertz * counts
        if self.turns:
            return hertz * 60 / (counts or 1) / self.factor
        return (hertz / whole * 100 if self.percent else hertz) / self.factor

    def _counted(self, counts: Fraction, limited: bool) -> Encoded:
        """The count as a word; noise within half a count below zero counts as zero."""
        below = {counts * (1 + part) < -HALF for part in (-SLACK, SLACK)}
        results = frozenset("NEGATIVE" if each else "OK" for each in below)
        if counts < -HALF:
            return Encoded("NEGATIVE", results=results)
        near = {_half_up(min(counts * (1 + part), Fraction(self.highest))) for part in (-SLACK, SLACK)}
        open_ = not limited and 0 < abs(counts - self.highest) <= counts * SLACK
        limited = limited or counts > self.highest
        value = _half_up(min(counts, Fraction(self.highest)))
        words = frozenset({max(each, 0) for each in near} | {value})
        return Encoded("OK", value, limited, words, results, open_)


def _refused(result: str) -> Encoded:
    return Encoded(result, results=frozenset({result}))


@lru_cache(4096)
def _exact(number: float) -> Fraction | None:
    """What a REAL pin holds; None where that is no number."""
    held = stored(number)
    if isnan(held) or abs(held) > BEYOND:
        return None
    return Fraction(held)


def _half_up(counts: Fraction) -> int:
    return floor(counts + HALF)
