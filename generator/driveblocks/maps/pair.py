"""Values of 32 bits, which two registers hold: how a condition on one is one on each of its words."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Any

from driveblocks.maps.model import Condition, Drive, Register


def words(row: Register, value: int) -> tuple[int, int]:
    high, low = value >> 16 & 0xFFFF, value & 0xFFFF
    return (low, high) if row.order == "low_first" else (high, low)


def number_of(row: Register, carried: Sequence[int]) -> int:
    """The number that one word or two carry, in the order of their registers."""
    high_first = carried if row.order != "low_first" else tuple(reversed(carried))
    raw = sum((word & 0xFFFF) << 16 * place for place, word in enumerate(reversed(high_first)))
    bits = 16 * len(carried)
    return raw - (1 << bits) if row.signed and raw >> bits - 1 else raw


def places(row: Register, address: int) -> tuple[int, int]:
    """The addresses of the high and the low word of the value whose first register this is."""
    return (address + 1, address) if row.order == "low_first" else (address, address + 1)


def is_first(row: Register, address: int) -> bool:
    """Whether an address is the first of a pair, or a value of its own."""
    return (address - row.address.first) % row.size == 0


def whole(drive: Drive, address: int) -> tuple[int, ...]:
    """All registers of the value at an address: two of a pair."""
    row = drive.register_at(address)
    if row is None or row.size == 1:
        return (address,)
    first = address - (address - row.address.first) % row.size
    return first, first + 1


def apart(drive: Drive) -> Drive:
    """The same map where a condition on a pair that must hold is one on each of its registers.

    One of several that may hold cannot be parted, and stays, for the rules to refuse.
    """
    operation = drive.operation
    said = {
        "standstill": _all(drive, operation.standstill),
        "commanded_by": _all(drive, operation.commanded_by),
        "reference": replace(operation.reference, verify=tuple(_parted(drive, operation.reference.verify))),
    }
    return replace(drive, operation=replace(operation, **said), identity=_all(drive, drive.identity))


def _all(drive: Drive, one: Any) -> Any:
    return one if one is None else replace(one, all=tuple(_parted(drive, one.all)))


def _parted(drive: Drive, conditions: tuple[Condition, ...]) -> Iterator[Condition]:
    for one in conditions:
        row, equals = drive.register_at(one.register), one.equals
        plain = one.bit is None and one.mask is None and not one.differs and 0 <= (equals or 0) < 1 << 32
        if row is None or row.size == 1 or not is_first(row, one.register) or not plain or equals is None:
            yield one
        else:
            for register, value in zip(whole(drive, one.register), words(row, equals), strict=True):
                yield replace(one, register=register, equals=value)
