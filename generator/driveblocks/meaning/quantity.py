"""The number that a register holds, or two registers together, and what a count of it is."""

from dataclasses import dataclass
from decimal import Decimal

from driveblocks.maps.model import Drive, Register, Use
from driveblocks.maps.pair import places, whole
from driveblocks.meaning.citation import Citation, cited
from driveblocks.meaning.pattern import Pattern, of_condition


@dataclass(frozen=True)
class Factor:
    """Engineering units in a count, and what has to hold for it."""

    said: Citation
    value: Decimal
    when: Pattern | None


@dataclass(frozen=True)
class Quantity:
    """A number: the registers of its high and of its low word, the same where it has 16 bits, and its scale."""

    high: int
    low: int
    signed: bool
    unit: str | None
    factors: tuple[Factor, ...]
    """None: the manual gives no scale. Of several one holds at a time; simulated drives have the first."""

    @property
    def pair(self) -> bool:
        """Whether it has 32 bits."""
        return self.high != self.low

    @property
    def factor(self) -> Decimal | None:
        """Engineering units in a count, as far as they are known."""
        return self.factors[0].value if self.factors else None


def of_row(row: Register, first: int) -> Quantity:
    """The number of a row, or of the register, or the first of a pair, that is named of several."""
    high, low = places(row, first) if row.words else (first, first)
    scales = row.scale.choices if row.scale else ()
    factors = (Factor(cited(one), one.factor, of_condition(one.when) if one.when else None) for one in scales)
    return Quantity(high, low, row.signed, row.unit, tuple(factors))


def quantity(drive: Drive, address: int, use: Use = "r") -> Quantity:
    """The number at an address; one of a register that no row describes is a plain word."""
    row = drive.register_at(address, use)
    return of_row(row, whole(drive, address)[0]) if row else Quantity(address, address, False, None, ())
