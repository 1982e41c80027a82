"""Values for one pin: near the limits of its type, near what the POU's text names, and anything else."""

from __future__ import annotations

import struct
from collections.abc import Callable, Sequence
from hashlib import shake_128
from math import inf, isfinite, nan

from tests.blocks.compare.pou import Pin, Pou
from tests.structured_text.engines.compare.draws import Draws, single

from structured_text.engines.engine import Value
from structured_text.language.types import Kind

NOISE_BYTES = 1 << 16
REALS = (
    0.0, -0.0, 0.5, 1.0, -1.0, 49.995, 50.0, 65535.0, 65535.5, 65536.0, 1.0e6, 2147483520.0, 2147483648.0,
    -2147483648.0, 3.4028234663852886e38, -3.4028234663852886e38, 1.1754943508222875e-38, 1.401298464324817e-45,
    -1.401298464324817e-45, inf, -inf, nan,
)  # fmt: skip
"""Zeros, halves, the ends of WORD and DINT, the greatest REAL, the least normal and subnormal ones, and no numbers."""

Draw = Callable[[], Value]


class Noise:
    """Bytes without a pattern, the same on every machine; cut out of one supply, since a draw per byte is slow."""

    def __init__(self, draws: Draws, *seed: object) -> None:
        """Make the supply."""
        self.draws = draws
        self.supply = shake_128(repr(seed).encode()).digest(NOISE_BYTES)

    def octets(self, count: int) -> bytes:
        """So many bytes, at most the supply."""
        at = self.draws.whole(0, NOISE_BYTES - count)
        return self.supply[at : at + count]

    def words(self, count: int) -> list[int]:
        """So many 16-bit words."""
        return list(struct.unpack(f"<{count}H", self.octets(2 * count)))


class Values:
    """Draws the values of the pins of one POU."""

    def __init__(self, pou: Pou, draws: Draws, seed: int) -> None:
        """Take the landmarks of the POU."""
        self.draws = draws
        self.noise = Noise(draws, pou.name, seed)
        self.whole = sorted({near for one in pou.whole for near in (one - 1, one, one + 1)}) or [0]
        self.real = [*map(single, REALS), *(near for one in pou.real for near in beside(one))]
        self.longest = max((pin.length for pin in pou.arrays), default=0)

    def of(self, pin: Pin) -> Draw:
        """What draws the values of a pin."""
        if pin.length:
            return lambda: self.array(pin)
        if pin.kind.kind is Kind.BOOL:
            return lambda: self.draws.chance(0.5)
        if pin.kind.kind is Kind.REAL:
            return self.number
        low, high = pin.span
        return lambda: self.integer(low, high)

    def integer(self, low: int, high: int) -> int:
        """An integer or bit string: a landmark, a small one, a length, a single bit, an end of the range, or any."""
        draws, way = self.draws, self.draws.fraction()
        if way < 0.3:
            value = draws.one_of(self.whole)
        elif way < 0.5:
            value = draws.whole(0, 20)
        elif way < 0.65:
            value = draws.whole(0, self.longest + 2)
        elif way < 0.75:
            value = 1 << draws.whole(0, 15)
        else:
            value = draws.whole(low, high) if way < 0.9 else draws.one_of((low, low + 1, high - 1, high))
        return value if low <= value <= high else low + (value - low) % (high - low + 1)

    def number(self) -> float:
        """A REAL: 0, an edge, a landmark, a half of a hundredth, a usual frequency or below 0, or any bit pattern."""
        draws, way = self.draws, self.draws.fraction()
        if way < 0.1:
            return 0.0
        if way < 0.3:
            return draws.one_of(self.real)
        if way < 0.5:
            return single((draws.whole(0, 66000) + 0.5) / draws.one_of((1, 2, 10, 100, 200)))
        if way < 0.85:
            return single(
                draws.between(draws.one_of((0.0, 0.0, -60.0)), draws.one_of((1.0, 60.0, 400.0, 9000.0, 70000.0)))
            )
        return float(struct.unpack("<f", self.noise.octets(4))[0])

    def array(self, pin: Pin) -> Value:
        """The first elements of an array, or all: noise, or one value throughout."""
        count = pin.length if self.draws.chance(0.5) else self.draws.whole(1, pin.length)
        same = self.draws.one_of((0, 0x30, 0xFF)) if self.draws.chance(0.1) else None
        if pin.span[1] == 0xFF:
            return self.noise.octets(count) if same is None else bytes([same]) * count
        words: list[Value] = [same * 0x101] * count if same is not None else [*self.noise.words(count)]
        return words


def beside(number: float) -> Sequence[float]:
    """A number as a REAL, and the REALs on both sides of it."""
    middle = single(number)
    (bits,) = struct.unpack("<i", struct.pack("<f", middle))
    around = [struct.unpack("<f", struct.pack("<i", bits + step))[0] for step in (-1, 1)] if bits else []
    return [each for each in (middle, *around) if isfinite(each)]
