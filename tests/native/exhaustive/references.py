"""Every REAL through the speed references: against exact arithmetic in the driver, and that against the model."""

import itertools
import random
import struct
import tempfile
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path

from tests.blocks.library import NAMES
from tests.native.exhaustive.bench import Bench, Finding
from tests.native.exhaustive.standstills import families

from driveblocks.maps.model import Drive
from driveblocks.reference.single import nearest, stored
from driveblocks.reference.speed import SpeedReference

SPEED, MAXIMUM, FULL, SCALE = range(4)
"""The pins, as the driver counts them."""

Patterns = tuple[int, int, int, int]
"""The bits of all pins."""

REAL_BITS, DOUBLE_BITS = 24, 53
"""Digits of the significands, IEEE 754."""
WORD_BITS = 17
"""Of twice a word and one."""

ALL = (0, 0xFFFFFFFF, 1)
INFINITY = 0x7F800000


@dataclass(frozen=True)
class Sweep:
    """A pin that goes through all REALs while the others keep their values in Hz, and the last in counts per Hz."""

    prefix: str
    pin: int
    speed: float = 0.0
    maximum: float = 10000.0
    full: float = 0.0
    scale: float = 0.0

    def run(self, bench: Bench, first: int, last: int, step: int) -> Finding:
        """Bit patterns `first` to `last`, each `step`-th."""
        pins = [f"{pattern(value):08X}" for value in (self.speed, self.maximum, self.full, self.scale)]
        return bench.command("sweep", self.prefix, self.pin, *pins, f"{first:X}", f"{last:X}", f"{step:X}")


SWEEPS = {
    "reference-SN300G5-speed": Sweep("SN300G5", SPEED),
    "reference-SN300G5-maximum": Sweep("SN300G5", MAXIMUM, speed=37.21),
    "reference-SN300G5-full": Sweep("SN300G5", FULL, speed=37.21),
    "reference-CHF-speed": Sweep("CHF", SPEED, full=50.0),
    "reference-CHF-maximum": Sweep("CHF", MAXIMUM, speed=37.21, full=50.0),
    "reference-CHF-full": Sweep("CHF", FULL, speed=37.21),
    "reference-JSCC-speed": Sweep("JSCC", SPEED, scale=100.0),
    "reference-JSCC-maximum": Sweep("JSCC", MAXIMUM, speed=37.21, scale=16.7),
    "reference-JSCC-full": Sweep("JSCC", FULL, speed=37.21, scale=16.7),
    "reference-JSCC-scale": Sweep("JSCC", SCALE, speed=37.21),
}


def pattern(value: float) -> int:
    """The bits of a REAL."""
    (bits,) = struct.unpack("=I", struct.pack("=f", value))
    assert isinstance(bits, int)
    return bits


def real(bits: int) -> float:
    """The REAL of some bits."""
    (value,) = struct.unpack("=f", struct.pack("=I", bits))
    assert isinstance(value, float)
    return value


def defines(drive: Drive) -> dict[str, object]:
    """What the driver's rule needs of a map. Raises ValueError if a double would not hold its numbers exactly."""
    model = SpeedReference(drive)
    times = (100 if model.percent else 1) / model.factor if model.factor else Fraction(1)
    room = DOUBLE_BITS - 2 * REAL_BITS if model.factor is None else DOUBLE_BITS - REAL_BITS
    if times.numerator.bit_length() > room or times.denominator.bit_length() > DOUBLE_BITS - REAL_BITS - WORD_BITS:
        raise ValueError(f"{drive.prefix}: {times} is not exact in the driver")
    return {
        "TIMES": times.numerator,
        "BY": times.denominator,
        "HAS_SCALE": int(model.factor is None),
        "PERCENT": int(model.percent),
        "HIGHEST": model.highest,
        "REGISTER": model.address,
    }


def sweeping(name: str) -> Callable[[Sequence[Bench], bool], Iterator[Finding]]:
    """The check of a sweep: all 2^32 patterns; short: each 65537th, and all around the limits."""
    sweep = SWEEPS[name]

    def check(benches: Sequence[Bench], short: bool) -> Iterator[Finding]:
        for bench in benches:
            for part in _parts() if short else (ALL,):
                yield sweep.run(bench, *part)

    return check


def _parts() -> Iterator[tuple[int, int, int]]:
    yield (0, 0xFFFFFFFF, 65537)
    for value in (0.0, 0.0025, 0.005, 0.1, 1.0e30, 50.0, 37.21, 655.35, 10000.0, 1.0e6):
        for near in (pattern(value), pattern(-value)):
            yield (max(near - 2000, 0), near + 2000, 1)
    yield (INFINITY - 500, INFINITY + 500, 1)
    yield (INFINITY + 0x80000000 - 500, INFINITY + 0x80000000 + 500, 1)


# ---------------------------------------------------------------- every word


def words(benches: Sequence[Bench], short: bool) -> Iterator[Finding]:
    """Every word of each reference register is reached: by the REAL that is nearest to it and those beside."""
    for prefix, drive in families().items():
        model = SpeedReference(drive)
        counts = range(0, model.highest + 1, 29 if short else 1)
        pins = [*itertools.chain.from_iterable(_around(model, count) for count in counts)]
        yield from _judged(benches, prefix, pins, [*counts])


def _around(model: SpeedReference, count: int) -> Iterator[Patterns]:
    """The REAL nearest to a count, then those on both sides of the half below and of the half above it."""
    full, scale = (50.0 if model.percent else 0.0), (100.0 if model.factor is None else 0.0)
    step = (model.factor or Fraction(1, 100)) * (Fraction(full) / 100 if model.percent else 1)
    for part in (Fraction(0), Fraction(-1, 2), Fraction(1, 2)):
        at = pattern(nearest(max(step * (count + part), Fraction(0))))
        for near in range(max(at - 2, 0), at + 3) if part else (at,):
            yield near, pattern(10000.0), pattern(full), pattern(scale)


def _judged(benches: Sequence[Bench], prefix: str, pins: list[Patterns], counts: list[int]) -> Iterator[Finding]:
    """The driver's judgement, and whether every count was given at all."""
    for bench in benches:
        found, answers = _patterns(bench, prefix, pins)
        missing = sorted({*counts} - {block[1] for block, _ in answers})
        wrong = tuple(f"{prefix}: no REAL gives {count}" for count in missing[:5])
        yield Finding(bench.line, found.cases, found.wrong + len(missing), found.examples + wrong, found.note)


Answered = tuple[int, int, bool, bool]
"""Error, word, limited, and whether the register is right."""


def _patterns(bench: Bench, prefix: str, pins: list[Patterns]) -> tuple[Finding, list[tuple[Answered, Answered]]]:
    """What the block and what the driver's rule answer."""
    with tempfile.TemporaryDirectory() as folder:
        given, answered = Path(folder, "in"), Path(folder, "out")
        given.write_bytes(b"".join(struct.pack("=4I", *each) for each in pins))
        finding = bench.command("patterns", prefix, given, answered)
        rows = struct.iter_unpack("=HH??HH??", answered.read_bytes())
        return finding, [(row[:4], row[4:]) for row in rows]


# ---------------------------------------------------------------- the rule itself


def rules(benches: Sequence[Bench], short: bool) -> Iterator[Finding]:
    """The driver's rule against the reference model, at the limits, beside halves and at random."""
    for prefix, drive in families().items():
        pins = [*_tried(SpeedReference(drive), 100 if short else 4000)]
        for bench in benches:
            yield _ruled(bench, SpeedReference(drive), prefix, pins)


def _ruled(bench: Bench, model: SpeedReference, prefix: str, pins: list[Patterns]) -> Finding:
    finding, answers = _patterns(bench, prefix, pins)
    wrong = []
    for each, (_, rule) in zip(pins, answers, strict=True):
        wanted = model.encode(*map(real, each))
        if (NAMES[rule[0]], rule[1], rule[2]) != (wanted.result, wanted.value, wanted.limited):
            wrong.append(f"{prefix} {[real(bits) for bits in each]}: the rule says {rule}, the model {wanted}")
    return Finding(bench.line, len(pins), len(wrong) + finding.wrong, (*finding.examples, *wrong[:5]), finding.note)


def _tried(model: SpeedReference, several: int) -> Iterator[Patterns]:
    edges = [
        0.0,
        1.0e-45,
        0.0025,
        0.005,
        0.1,
        10000.0,
        0.5,
        37.21,
        50.0,
        100.0,
        327.675,
        655.345,
        655.35,
        655.36,
        1.0e6,
        1.0e30,
    ]
    near = [pattern(stored(edge)) + step for edge in edges for step in (-1, 0, 1) if edge or step >= 0]
    near += [INFINITY - 1, INFINITY, INFINITY + 1]
    both = [*near, *(bits | 0x80000000 for bits in near)]
    scales = near[::3] if model.factor is None else [0]
    yield from itertools.product(both, [*near[::6], pattern(-1.0)], [0, pattern(50.0)], scales)
    yield from itertools.product(near[::5], near[::6], [*near[::4], pattern(-0.0), pattern(-1.0)], scales[-12::4])
    chance = random.Random(model.address)
    for _ in range(several):
        yield chance.randrange(1 << 32), chance.randrange(1 << 32), chance.randrange(1 << 32), chance.randrange(1 << 32)
        yield from _around_half(model, chance)


def _around_half(model: SpeedReference, chance: random.Random) -> Iterator[Patterns]:
    """A frequency within two REALs of a half between two words, with a maximum, a full scale and a scale at random."""
    maximum, full = stored(chance.uniform(10.0, 400.0)), stored(chance.uniform(10.0, 400.0))
    scale = stored(chance.uniform(0.5, 150.0))
    half = chance.randrange(model.highest) + Fraction(1, 2)
    unit = model.factor if model.factor is not None else 1 / Fraction(scale)
    at = nearest(half * unit * (Fraction(full) / 100 if model.percent else 1))
    for step in (-2, -1, 0, 1, 2):
        yield pattern(at) + step, pattern(maximum), pattern(full), pattern(scale)
