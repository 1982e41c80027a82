"""A line of a plant in virtual time: its drives, its meters, a cable that may be cut, another master that asks."""

from collections.abc import Collection, Iterator, Sequence

from driveblocks.bench.simulator.drive import SimulatedDrive
from driveblocks.desk.bus import Bus
from driveblocks.maps.form import Span
from driveblocks.maps.model import Drive
from driveblocks.maps.plan import plan, read_request
from driveblocks.meaning.serial import character
from driveblocks.modbus import frame
from driveblocks.plant.model import Line

METER_US = 5000
"""From the end of a request to the reply of a meter."""
READS = (3, 4)


class Wire(Bus):
    """A line, its units by their addresses."""

    def __init__(self, line: Line, drives: Sequence[SimulatedDrive], meters: Collection[int]) -> None:
        """As it is wired: nothing is cut, and the PLC is alone."""
        way = line.way
        super().__init__(drives, way.rate, character(way.form).bits, ascii_mode=way.mode == "ascii")
        self._meters = meters
        self.cut: Collection[int] = ()
        """Units that no frame reaches."""

    def replies(self, body: bytes) -> Iterator[tuple[int, bytes]]:
        """What the units reply that a request reaches; a meter shows zeros."""
        if body[0] in self.cut:
            return
        if body[0] in self._meters and body[1] in READS:
            count = 2 * int.from_bytes(body[4:6], "big")
            yield METER_US, frame.seal(self._mode, body[:2] + bytes([count, *bytes(count)]))
        else:
            yield from super().replies(body)

    def ask(self, unit: int, drive: Drive, now_us: int) -> bool:
        """Another master reads a word of a drive; everybody hears both. Whether the line was free for that."""
        if self._said or self._asked or self._asked_us > now_us:
            return False
        first = plan(drive).readable[0].first
        body = read_request(unit, drive, Span(first, first))
        request = frame.seal(self._mode, body)
        self._asked_us = now_us + len(request) * self._character_us
        self._pass(now_us)
        self._said.append((now_us, request))
        self._said.extend((self._asked_us + turn_us, reply) for turn_us, reply in self.replies(body))
        return True
