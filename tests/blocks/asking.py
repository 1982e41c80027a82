"""Requests that try every limit of a drive, against the reference model: the same bytes, or the same result."""

import random
from collections.abc import Iterator

from tests.blocks import wire
from tests.blocks.library import Blocks

from driveblocks.maps.model import Drive
from driveblocks.reference.request import Asked, Requests

FUNCTIONS = (0, 1, 2, 3, 4, 5, 6, 7, 8, 15, 16, 17, 22, 23, 131, 255, 259)


class Asking:
    """Draws requests that stand near a drive's limits."""

    def __init__(self, drive: Drive, seed: str = "") -> None:
        """Take the limits from the reference model."""
        self.drive = drive
        self.model = Requests(drive)
        self.chance = random.Random(f"{drive.prefix} {seed}")
        edges = {address for allowed in (self.model.readable, self.model.writable) for address in borders(allowed)}
        self.addresses = sorted({*edges, 0, 0xFFFF, 0xFF00, 0x7FFF, 0x8000})
        cast = drive.serial.broadcast
        named = cast.start_addresses if cast else ()
        self.starts = sorted({*self.addresses[:8], *(one + beside for one in named for beside in (0, 1))})
        unit = drive.serial.unit
        self.units = sorted({0, 1, unit.min - 1, unit.min, unit.max, unit.max + 1, 247, 248, 255, 256, 65535} - {-1})
        counts = {self.model.rtu.read, self.model.rtu.write, self.model.ascii.read, self.model.ascii.write}
        near = {count + more for count in counts for more in (-1, 0, 1)}
        self.counts = sorted({0, 1, 2, 123, 124, 125, 126, 255, 256, 65535} | {n for n in near if n >= 0})
        self.subs = sorted({0, 1, 2, 0xFFFF, *(s.code for f in drive.functions for s in f.sub_functions)})

    def plain(self) -> Asked:
        """A request that most drives take."""
        pick = self.chance.choice
        known = sorted(set(self.model.functions) & {3, 4, 6, 8, 16}) or [3]
        return Asked(
            function=pick(known),
            unit=pick([self.drive.serial.unit.min, self.drive.serial.unit.max, 0]),
            address=pick(self.addresses),
            quantity=pick([1, 2, *self.counts[:6]]),
            value=self.chance.randrange(0x10000),
            sub_function=pick(self.subs),
            words=tuple(self.chance.randrange(0x10000) for _ in range(125)),
            ascii=self.chance.random() < 0.5,
        )

    def any(self) -> Asked:
        """A plain request with none, one or several pins off."""
        base, pick, off = self.plain(), self.chance.choice, self.chance.random
        return Asked(
            function=pick(FUNCTIONS) if off() < 0.15 else base.function,
            unit=pick(self.units) if off() < 0.2 else base.unit,
            address=self.chance.randrange(0x10000) if off() < 0.1 else base.address,
            quantity=pick(self.counts) if off() < 0.3 else base.quantity,
            value=base.value,
            sub_function=self.chance.randrange(0x10000) if off() < 0.1 else base.sub_function,
            words=base.words,
            ascii=base.ascii,
        )

    def limits(self) -> Iterator[Asked]:
        """Every function at every address that borders on what is allowed, alone and with every count."""
        unit = self.drive.serial.unit.min
        modes = [False, True]
        for function in (3, 4, 6, 16):
            for address in self.addresses:
                for in_ascii in modes:
                    yield Asked(function, unit, address, 1, words=tuple(range(125)), ascii=in_ascii)
            for count in self.counts:
                for address in self.addresses[:: max(1, len(self.addresses) // 4)]:
                    for in_ascii in modes:
                        yield Asked(function, unit, address, count, words=tuple(range(125)), ascii=in_ascii)
        for address in self.starts:
            for function in (6, 16):
                yield Asked(function, 0, address, 1, words=(1,), ascii="rtu" not in self.drive.serial.mode.modes)
        for sub_function in self.subs:
            yield Asked(8, unit, 0, 1, 0xA55A, sub_function, ascii="rtu" not in self.drive.serial.mode.modes)


def borders(allowed: frozenset[int]) -> Iterator[int]:
    """First and last address of each run of allowed addresses, and their neighbours outside."""
    for address in allowed:
        for beside in (address - 1, address + 1):
            if beside not in allowed and 0 <= beside <= 0xFFFF:
                yield address
                yield beside


def assert_request(blocks: Blocks, asking: Asking, asked: Asked) -> str:
    """One request against the reference; answers the result's name."""
    sent = wire.build(blocks, asking.drive.prefix, asked)
    wanted = asking.model.build(asked)
    assert sent.built == wanted, (asked, sent.built, wanted)
    if wanted.result != "OK":
        assert sent.request["FunctionCode"] == 0, asked
        return wanted.result
    counted = asked.function in {3, 4, 16}
    told = {
        "UnitAddress": asked.unit,
        "FunctionCode": asked.function,
        "Address": 0 if asked.function == 8 else asked.address,
        "Quantity": asked.quantity if counted else 1,
        "SubFunction": asked.sub_function if asked.function == 8 else 0,
        "Value": asked.value if asked.function in {6, 8} else 0,
    }
    assert sent.request == told, asked
    return "OK"
