"""Requests: what a drive can be asked, and the bytes that ask it.

Bytes by the MODBUS Application Protocol V1.1b3, 6.3, 6.4, 6.6, 6.8 and 6.12.
"""

from collections.abc import Iterator
from dataclasses import dataclass

from driveblocks.maps.model import Drive
from driveblocks.reference.permission import most, readable, writable

READS = frozenset({3, 4})
COUNTED = frozenset({3, 4, 16})
BUILDABLE = frozenset({3, 4, 6, 8, 16})
READ_INPUTS, INPUTS = 4, 0x60000
"""The function of input registers, and where a map has these: a request names holding registers alone."""


@dataclass(frozen=True)
class Asked:
    """A request: what the request block gets, and what a reply is compared with."""

    function: int
    unit: int = 1
    address: int = 0
    quantity: int = 1
    value: int = 0
    """Function 6: the word to write; function 8: the data word."""
    sub_function: int = 0
    words: tuple[int, ...] = ()
    """Function 16: the words to write."""
    ascii: bool = False


@dataclass(frozen=True)
class Built:
    """OK and the body, or why the drive cannot be asked this."""

    result: str
    body: bytes = b""


def body(asked: Asked) -> bytes:
    """Unit address, function code and data of a request that is right."""
    pairs = {
        3: (asked.address, asked.quantity),
        4: (asked.address, asked.quantity),
        6: (asked.address, asked.value),
        8: (asked.sub_function, asked.value),
        16: (asked.address, asked.quantity),
    }[asked.function]
    head = bytes([asked.unit, asked.function]) + _words(pairs)
    if asked.function != 16:
        return head
    return head + bytes([2 * asked.quantity]) + _words(asked.words[: asked.quantity])


def _words(words: tuple[int, ...]) -> bytes:
    return b"".join(word.to_bytes(2, "big") for word in words)


class Requests:
    def __init__(self, drive: Drive) -> None:
        self.drive = drive
        inputs = any(row.address.first >= INPUTS for _, row in drive.registers())
        self.functions = {one.code: one for one in drive.functions if not (inputs and one.code == READ_INPUTS)}
        self.readable, self.writable = readable(drive), writable(drive)
        self.rtu, self.ascii = most(drive, ascii_mode=False), most(drive, ascii_mode=True)

    def build(self, asked: Asked) -> Built:
        """The body of a request, or the first thing that is wrong with it."""
        wrong = next(self.wrongs(asked), None)
        return Built(wrong) if wrong is not None else Built("OK", body(asked))

    def wrongs(self, asked: Asked) -> Iterator[str]:
        """Everything that is wrong with a request, in the order in which the block looks for it."""
        if ("ascii" if asked.ascii else "rtu") not in self.drive.serial.mode.modes:
            yield "MODE"
        if asked.function not in self.functions or asked.function not in BUILDABLE:
            yield "FUNCTION"
            return
        yield from self._unit(asked)
        if asked.function in COUNTED:
            yield from self._quantity(asked)
        yield from self._addresses(asked)
        if asked.function == 8 and asked.sub_function not in {s.code for s in self.functions[8].sub_functions}:
            yield "SUB_FUNCTION"

    def _unit(self, asked: Asked) -> Iterator[str]:
        unit = self.drive.serial.unit
        if asked.unit == 0:
            cast = self.drive.serial.broadcast
            starts = cast.start_addresses if cast else ()
            if cast is None or asked.function not in {6, 16} or (starts and asked.address not in starts):
                yield "NO_BROADCAST"
        elif not unit.min <= asked.unit <= unit.max:
            yield "UNIT"

    def _quantity(self, asked: Asked) -> Iterator[str]:
        use = "read" if asked.function in READS else "write"
        if not 1 <= asked.quantity <= getattr(self.rtu, use):
            yield "QUANTITY"
        if asked.ascii and asked.quantity > getattr(self.ascii, use):
            yield "ASCII_LIMIT"
        if asked.address + asked.quantity > 0x10000:
            yield "WRAP"

    def _addresses(self, asked: Asked) -> Iterator[str]:
        count = asked.quantity if asked.function in COUNTED else 1
        if asked.function in READS and not self.all(asked.address, count, self.readable):
            yield "NOT_READABLE"
        if asked.function in {6, 16} and not self.all(asked.address, count, self.writable):
            yield "NOT_WRITABLE"

    def all(self, address: int, count: int, allowed: frozenset[int]) -> bool:
        """Whether some registers are all among these, and in one group."""
        group = self.drive.limits.group
        crosses = group is not None and address // group.value != (address + count - 1) // group.value
        return not crosses and all(one in allowed for one in range(address, address + count))
