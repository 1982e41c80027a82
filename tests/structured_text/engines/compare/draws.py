"""Random draws that come out the same on every Python and every machine."""

import struct
from collections.abc import Sequence
from random import Random
from typing import TypeVar
from zlib import crc32

T = TypeVar("T")


class Draws:
    """A stream of draws from a seed. Only `Random.random` is used: its sequence alone is promised."""

    def __init__(self, *seed: object) -> None:
        """Seed by any values that print the same everywhere."""
        self.fraction = Random(crc32(repr(seed).encode())).random

    def chance(self, probability: float) -> bool:
        """TRUE with this probability."""
        return self.fraction() < probability

    def whole(self, low: int, high: int) -> int:
        """An integer of low..high, both inclusive; even over spans wider than a double's 53 bits."""
        span = high - low + 1
        if span <= 1 << 32:
            return low + int(self.fraction() * span)
        upper = int(self.fraction() * (1 << 32)) << 32
        return low + (upper + int(self.fraction() * (1 << 32))) % span

    def one_of(self, choices: Sequence[T]) -> T:
        """One of a sequence that is not empty."""
        return choices[int(self.fraction() * len(choices))]

    def between(self, low: float, high: float) -> float:
        """A double of low..high."""
        return low + self.fraction() * (high - low)


def single(value: float) -> float:
    """The IEEE single nearest to a double."""
    return float(struct.unpack("<f", struct.pack("<f", value))[0])
