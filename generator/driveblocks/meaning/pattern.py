"""Bits of a register that must have, or get, a value."""

from collections.abc import Iterable
from dataclasses import dataclass

from driveblocks.maps.form import Span, address_text, bits_text, masked_text
from driveblocks.maps.model import Condition, State

WORD = 0xFFFF


@dataclass(frozen=True)
class Pattern:
    """A register, the bits that count, and their value in its place, or with `differs` any other."""

    register: int
    mask: int
    value: int
    differs: bool = False

    def __str__(self) -> str:
        """For a person: 000FH bit 0 = 0."""
        is_, first = "<>" if self.differs else "=", (self.mask & -self.mask).bit_length() - 1
        bits = Span(first, self.mask.bit_length() - 1)
        if self.mask != bits_of([bits]):
            return masked_text(self.register, self.mask, self.value, is_)
        which = "" if self.mask == WORD else f" bit{'s' * (len(bits) > 1)} {bits_text(bits)}"
        return f"{address_text(self.register)}{which} {is_} {self.value >> first}"

    def holds(self, word: int) -> bool:
        """Whether a word of the register has the value."""
        return (word & self.mask == self.value) != self.differs

    def other(self) -> "Pattern":
        """A value with which it holds if it does not now: of those that differ, the one with the lowest bit turned."""
        return Pattern(self.register, self.mask, self.value ^ (self.mask & -self.mask))

    def excludes(self, other: "Pattern") -> bool:
        """Whether no word has both values."""
        both = self.mask & other.mask
        if self.differs:
            return self.register == other.register and both == self.mask and other.value & both == self.value
        return self.register == other.register and (self.value ^ other.value) & both != 0


def of_condition(condition: Condition | State) -> Pattern:
    """What a condition or a named state asks of its register."""
    bit = condition.bit if isinstance(condition, Condition) else None
    differs = isinstance(condition, Condition) and bool(condition.differs)
    if bit is not None:
        return Pattern(condition.register, bits_of([bit]), condition.equals << bit.first, differs)
    return Pattern(condition.register, WORD if condition.mask is None else condition.mask, condition.equals, differs)


def bits_of(spans: Iterable[Span]) -> int:
    """The word in which the bits of some spans are set."""
    return sum(1 << bit for bit in {bit for span in spans for bit in span})
