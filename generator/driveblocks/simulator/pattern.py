"""Bits of a register that must have, or get, a value."""

from dataclasses import dataclass

from driveblocks.maps.form import Span
from driveblocks.maps.model import Condition, State
from driveblocks.meaning.words import Write

WORD = 0xFFFF


@dataclass(frozen=True)
class Pattern:
    """A register, the bits that count, and their value in its place, or with `differs` any other."""

    register: int
    mask: int
    value: int
    differs: bool = False

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
        return Pattern(condition.register, _mask((bit,)), condition.equals << bit.first, differs)
    return Pattern(condition.register, WORD if condition.mask is None else condition.mask, condition.equals, differs)


def of_write(write: Write) -> Pattern:
    """What is in its register after a write of a command; bits that it keeps do not count."""
    return Pattern(write.register, WORD & ~write.keeps, write.word)


def _mask(bits: tuple[Span, ...]) -> int:
    return sum({1 << bit for span in bits for bit in span})
