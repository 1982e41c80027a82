"""Bits of a register that must have, or get, a value; or the number in them, which must be below or above another."""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Literal

from driveblocks.maps.form import Span, address_text, bits_text, masked_text
from driveblocks.maps.model import Condition, Register, State

WORD = 0xFFFF
Is = Literal["=", "<>", "<", ">"]


@dataclass(frozen=True)
class Pattern:
    """A register, the bits that count, and what they are compared with, in its place."""

    register: int
    mask: int
    value: int
    is_: Is = "="
    signed: bool = False
    """Of `<` and `>`: the whole word is a number with a sign."""

    def __str__(self) -> str:
        """For a person: 000FH bit 0 = 0."""
        bits = Span(self.unit.bit_length() - 1, self.mask.bit_length() - 1)
        if self.mask != bits_of([bits]):
            return masked_text(self.register, self.mask, self.value, self.is_)
        which = "" if self.mask == WORD else f" bit{'s' * (len(bits) > 1)} {bits_text(bits)}"
        return f"{address_text(self.register)}{which} {self.is_} {self.number(self.value) >> bits.first}"

    @property
    def unit(self) -> int:
        """The lowest of its bits."""
        return self.mask & -self.mask

    @property
    def word(self) -> int:
        """A value of its bits with which it holds: 0 where that does, else the nearest."""
        if self.is_ == "=" or self.holds(0):
            return self.value if self.is_ == "=" else 0
        near = {"<>": self.value ^ self.unit, "<": self.value - self.unit, ">": self.value + self.unit}
        return near[self.is_] & self.mask

    @property
    def other(self) -> "Pattern":
        """One with which it does not hold: its bits are 0 where that does, else what is nearest."""
        near = self.unit if self.is_ == "=" else self.value
        return Pattern(self.register, self.mask, near if self.holds(0) else 0)

    def number(self, word: int) -> int:
        """The number in its bits, in their place."""
        found = word & self.mask
        return found - (WORD + 1) if self.signed and found >> 15 else found

    def holds(self, word: int) -> bool:
        """Whether a word of the register is so."""
        if self.is_ in ("=", "<>"):
            return (word & self.mask == self.value) == (self.is_ == "=")
        found, than = self.number(word), self.number(self.value)
        return found < than if self.is_ == "<" else found > than

    def excludes(self, other: "Pattern") -> bool:
        """Whether both never hold at once; of numbers only where both count the same bits."""
        if self.register != other.register:
            return False
        if self.is_ == other.is_ == "=":
            return (self.value ^ other.value) & self.mask & other.mask != 0
        for one, two in ((self, other), (other, self)):
            if one.is_ == "=" and two.mask & ~one.mask == 0:
                return not two.holds(one.value)
        ends = (0, self.mask, 0x7FFF, 0x8000, self.value, other.value)
        near = (each + times * self.unit for each in ends for times in (-2, -1, 0, 1, 2))
        return self.mask == other.mask and not any(self.holds(word) and other.holds(word) for word in near)


def of_condition(condition: Condition | State, row: Register | None = None) -> Pattern:
    """What a condition or a named state asks of its register, whose row says whether its number has a sign."""
    if isinstance(condition, State):
        return Pattern(condition.register, WORD if condition.mask is None else condition.mask, condition.equals)
    is_, number = asked(condition)
    bit, signed = condition.bit, row is not None and row.signed and condition.bit is None
    if bit is not None:
        return Pattern(condition.register, bits_of([bit]), number << bit.first, is_)
    mask = WORD if condition.mask is None else condition.mask
    return Pattern(condition.register, mask, number & WORD, is_, signed and is_ in ("<", ">"))


def asked(condition: Condition | State) -> tuple[Is, int]:
    """How a condition compares, and with what number."""
    if isinstance(condition, Condition) and condition.equals is None:
        return ("<", condition.below) if condition.below is not None else (">", condition.above or 0)
    differs = isinstance(condition, Condition) and condition.differs
    return "<>" if differs else "=", condition.equals or 0


def bits_of(spans: Iterable[Span]) -> int:
    """The word in which the bits of some spans are set."""
    return sum(1 << bit for bit in {bit for span in spans for bit in span})
