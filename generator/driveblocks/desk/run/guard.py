"""What may be sent on a real port: reads, and the stops of the maps; all else only to drives that a person let run."""

from collections import Counter
from collections.abc import Iterator, Mapping

from driveblocks.maps.form import SPACES, address_text
from driveblocks.maps.model import Drive
from driveblocks.maps.plan import write_request
from driveblocks.meaning.words import STOPS, words
from driveblocks.modbus import frame, layout

READS = frozenset({1, 2, 3, 4, 17})
IDENTIFIES = b"\x2b\x0e"
"""Function 43 with the type that reads the identification."""
WRITES = frozenset({6, 16})


def stops(drive: Drive) -> Iterator[tuple[int, int]]:
    """The register and word, or the coil and its value, of every stop of a map; bits that a stop keeps are 0."""
    for command in words(drive).commands:
        if command.does in STOPS:
            yield command.last.register, command.last.word


def stop_request(unit: int, drive: Drive) -> bytes:
    """The stop of a drive as a request without checksum."""
    last = words(drive).stop.last
    return write_request(unit, drive, last.register, last.word)


def writes(request: layout.Layout) -> tuple[int, int] | None:
    """Register and word of a request that writes just one, or a coil and its value; None for any other."""
    address, words = request.number("address"), request.words
    if request.function == 5 and address is not None:
        value = request.number("value")
        return (SPACES["coil"] + address, value // layout.COIL_ON) if value in (0, layout.COIL_ON) else None
    if address is None or request.function not in WRITES or len(words) != 1 or not request.agrees:
        return None
    return address, words[0]


def is_stop(body: bytes, units: Mapping[int, Drive]) -> bool:
    """Whether a request, without checksum, is a stop of the drive at its unit address."""
    request = layout.request(body)
    drive = units.get(body[0])
    return request is not None and drive is not None and writes(request) in set(stops(drive))


class Guard:
    """Judges each frame by its bytes, and counts what it drops."""

    def __init__(
        self, units: Mapping[int, Drive], free: frozenset[int] = frozenset(), dropped: Counter[str] | None = None
    ) -> None:
        """`units`: the drive at each unit address; `free`: those to which everything may go."""
        self._stops = {unit: frozenset(stops(drive)) for unit, drive in units.items()}
        self._free = free
        self.dropped: Counter[str] = Counter() if dropped is None else dropped
        """How many frames were not sent, by what they were."""

    def passes(self, text: bytes) -> bool:
        """Whether a frame may be sent; what is no whole, good request never is."""
        what = self._judge(text)
        if what:
            self.dropped[what] += 1
        return not what

    def _judge(self, text: bytes) -> str:
        """Why a frame must not be sent; empty if it may."""
        body = frame.opened("ascii", text) or frame.opened("rtu", text)
        request = layout.request(body or b"")
        if request is None:
            return "what is no request"
        unit, function = request.body[:2]
        if unit == 0:
            return "broadcast"
        if function in READS or request.body[1:3] == IDENTIFIES or unit in self._free:
            return ""
        write = writes(request)
        if write is not None and write in self._stops.get(unit, ()):
            return ""
        if write is None:
            return f"function {function:02X}H to unit {unit}"
        return f"write to {address_text(write[0])} of unit {unit}"
