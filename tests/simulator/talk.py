"""A conversation with a simulated drive: commands by their name, registers by their address."""

from dataclasses import dataclass
from decimal import Decimal

from tests.shipped import drives

from driveblocks.bench.simulator.drive import SimulatedDrive
from driveblocks.bench.simulator.habits import Habits
from driveblocks.maps.form import Span
from driveblocks.maps.model import Command, Drive, Frame, Step
from driveblocks.maps.plan import read_request, write_request
from driveblocks.modbus.layout import reply_size

MAPS = drives()


@dataclass
class Talk:
    """A drive at unit 1 and what is asked of it."""

    map: Drive
    drive: SimulatedDrive
    asked: float = 0.0

    def ask(self, text: str) -> str:
        """A request and its reply in hexadecimal, without checksum; empty for silence."""
        reply = self.drive.reply(bytes.fromhex(text))
        return "" if reply is None else reply.hex(" ")

    def read(self, address: int) -> int:
        """One register."""
        request = read_request(1, self.map, Span(address, address))
        reply = self.drive.reply(request)
        assert reply is not None
        assert reply[:3] == bytes([1, request[1], reply_size(request) - 3]), reply.hex(" ")
        return int.from_bytes(reply[3:], "big")

    def write(self, address: int, word: int) -> bytes | None:
        """One register or coil, by the function that the map has for it."""
        request = write_request(1, self.map, address, word & 0xFFFF)
        reply = self.drive.reply(request)
        single = request[1] != 16
        assert reply is None or not single or reply[:4] != request[:4] or reply == request
        return reply

    def put(self, write: Command | Step) -> None:
        """The word of a command or a step; bits that it does not name are kept."""
        word = self.drive.memory[write.register] if write.value is None else write.value
        for bit in (bit for span in write.set for bit in span):
            word |= 1 << bit
        for bit in (bit for span in write.clear for bit in span):
            word &= ~(1 << bit)
        assert self.write(write.register, word) is not None

    def command(self, does: str) -> int:
        """The words of a command, each for its time; how long that took, ms."""
        one = next(each for each in self.map.operation.commands if each.does == does)
        if does.startswith("run") and any(each.negative for each in self.map.operation.commands):
            self._refer(-self.asked if one.negative else self.asked)
        for write in one.writes:
            self.put(write)
            self.drive.step(getattr(write, "for_ms", None) or 0)
        return sum(each.for_ms or 0 for each in one.first)

    def hertz(self, hz: float) -> None:
        """The speed reference, on the map's scale, or of a drive whose scale is 0.01 Hz, or whose 100 % is 50 Hz."""
        self.asked = hz
        self._refer(hz)

    def _refer(self, hz: float) -> None:
        reference = self.map.operation.reference
        row = self.map.register_at(reference.register)
        if reference.means == "percent_of_maximum":
            hz *= 2
        elif reference.full_scale:
            hz *= reference.full_scale / 5000
        elif row and row.scale:
            hz *= 0.01 / float(row.scale.factor)
        if row and row.words:
            place = reference.register.to_bytes(2, "big")
            self.drive.reply(b"\x01\x10" + place + b"\0\2\4" + round(hz * 100).to_bytes(4, "big"))
        else:
            self.write(reference.register, round(hz * 100))

    def at(self, hz: float, does: str = "run_forward") -> "Talk":
        """Give a reference, run, and wait until it is reached."""
        self.hertz(hz)
        self.command(does)
        self.drive.step(10_000)
        return self


def talk(family: str | Drive, habits: Habits | None = None, **words: int) -> Talk:
    """A conversation with a drive of a family; words as `x0203=5000`."""
    found = MAPS[family] if isinstance(family, str) else family
    begin = {int(name[1:], 16): word for name, word in words.items()}
    return Talk(found, SimulatedDrive(found, 1, habits, words=begin))


PREPARED = {
    "MX2 read_trip_request": (Habits(), {0x12: 4, 0x14: 1234, 0x15: 300, 0x16: 2840}),
    "ATV312 read_limits_request": (Habits(), {0x0C1E: 40, 0x0C1F: 600, 0x0C20: 500}),
    # 0026H holds 589, 0027H 0: the manual gives no scale, so one count is one volt here
    "SN300G5 read_dc_bus_request": (Habits(bus_volts=589, scales={0x26: Decimal(1)}), {}),
    "JSCC read_frequency_rtu_request": (Habits(), {}),
    "JSCC read_frequency_ascii_request": (Habits(), {}),
    "CHF read_ascii_request": (Habits(), {4: 2}),
    "GD200A read_rtu_request": (Habits(), {4: 5000}),
    "GD200A read_ascii_request": (Habits(), {4: 5000}),
    "V20 maximum_request": (Habits(), {15: 5000}),
    "FC51 read_request": (Habits(), {0x0D5C: 3}),
    "FC51 maximum_request": (Habits(), {0x0BD6: 50000}),
    "FC102 maximum_request": (Habits(), {0x0BD6: 50000}),
}
"""What the drives of the manuals' examples had in their registers."""


def pairs() -> list[tuple[str, Frame, Frame]]:
    """Every request with its reply."""
    found = []
    for prefix, drive in MAPS.items():
        frames = {frame.id: frame for frame in drive.frames}
        found += [(prefix, frames[each.answers], each) for each in frames.values() if each.answers]
    return found


def body(frame: Frame) -> bytes:
    """A frame without its checksum."""
    return frame.correct[:-2] if frame.mode == "rtu" else bytes.fromhex(frame.correct[1:-4].decode("ascii"))


def prepared(prefix: str, request: Frame, reply: Frame) -> SimulatedDrive:
    """A drive that stands as that of the example did."""
    habits, words = PREPARED.get(f"{prefix} {request.id}", (Habits(), {}))
    drive = SimulatedDrive(MAPS[prefix], body(request)[0], habits, words=words)
    place = (MAPS[prefix].faults.present or 0) - (request.means.address or 0)
    if place in range(len(reply.means.values)) and reply.means.values[place]:
        drive.trip(reply.means.values[place])
    if 500 in reply.means.values:  # 50.0 Hz
        drive.keypad_run(50)
        drive.step(5000)
    return drive
