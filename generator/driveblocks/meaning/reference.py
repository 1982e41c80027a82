"""The speed reference of a drive: how many counts are a hertz, or all of it."""

from dataclasses import dataclass
from fractions import Fraction
from typing import Literal

from driveblocks.maps.model import Drive, kept
from driveblocks.meaning.citation import Citation, cited
from driveblocks.meaning.quantity import Quantity, quantity


@dataclass(frozen=True)
class Reference:
    """How a speed becomes a word."""

    said: Citation
    register: int
    quantity: Quantity
    part: bool
    """It is a part of what 100 % is."""
    percent: bool
    """... and its scale is known, so that it needs FullScaleHz, which is 100 %."""
    maximum: str
    """What is 100 %."""
    lower_limit: str | None
    """The parameter of the lower limit of the speed, with its name; None: the manual does not say."""
    scaled: bool
    """How many counts there are is known."""
    ratio: Fraction
    """Counts per hertz, or of 100 %; where they are not known, of a scale of 1."""
    in_rpm: bool
    """It counts in r/min, which are 60 per Hz of a motor with one pole pair."""
    signed: bool
    """A negative word is what reverses a run."""
    reverses: bool
    """A negative word turns the motor the other way."""
    highest: int
    ranged: bool
    """The range of the register ends there, not the word."""
    pair: Literal["high_first", "low_first"] | None
    """Of a reference of 32 bits, the word that comes first; its high word is 0."""

    @property
    def registers(self) -> tuple[int, ...]:
        """All that it is written to."""
        return tuple(sorted({self.quantity.high, self.quantity.low}))


@kept
def reference(drive: Drive) -> Reference:
    """How a speed becomes a word."""
    spec, has = drive.operation.reference, quantity(drive, drive.operation.reference.register, "w")
    row = drive.register_at(spec.register, "w")
    bounds = row.range if row else None
    part = spec.means == "percent_of_maximum" or (spec.full_scale is not None and spec.full_scale_hz is None)
    in_rpm = spec.means == "speed" and has.factor is not None
    ratio = (100 if part else 60 if in_rpm else 1) / Fraction(has.factor or 1)
    if spec.full_scale is not None:
        ratio = spec.full_scale / Fraction(spec.full_scale_hz or 1)
    scaled = has.factor is not None or spec.full_scale is not None
    return Reference(
        said=cited(spec),
        register=spec.register,
        quantity=has,
        part=part,
        percent=part and scaled,
        maximum=spec.maximum or "the maximum frequency",
        lower_limit=_parameter(drive, drive.operation.lower_limit),
        scaled=scaled,
        ratio=ratio,
        in_rpm=in_rpm,
        signed=drive.operation.by_sign,
        reverses=spec.negative_reverses,
        highest=bounds.max if bounds else 0x7FFF if has.signed else 0xFFFF,
        ranged=bounds is not None,
        pair=("low_first" if has.low < has.high else "high_first") if has.pair else None,
    )


def _parameter(drive: Drive, id_: str | None) -> str | None:
    """A parameter as its manual names it."""
    names = {row.id: row.name for _, row in drive.registers()} | {one.id: one.name for one in drive.settings}
    return None if id_ is None else f"{id_} ({name})" if (name := names.get(id_)) else id_
