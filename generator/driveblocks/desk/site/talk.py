"""Reads on a line that nobody else should speak on, and what ends the steps there."""

from dataclasses import dataclass, replace

from driveblocks.bench.simulator.refusal import codes
from driveblocks.desk.exchange import LATE_US, Said
from driveblocks.desk.master import Reply
from driveblocks.desk.site.found import Fault, Line, Trouble, Way
from driveblocks.maps.form import Span
from driveblocks.maps.model import Drive
from driveblocks.maps.plan import read_request
from driveblocks.meaning.serial import serial

LOOK = {
    "silent": "drive switched on? A and B swapped? its keypad: address, bit rate, format, RTU or ASCII",
    "half": "termination at both ends, a common wire, another device with this address; an adapter that switches "
    "its direction too late",
    "echo": "the adapter hears itself and no drive: A and B, the wires to the drive, the drive's own address and rate",
    "damaged": "A and B, termination, the common wire between adapter and drive, parity on the keypad, motor cables "
    "beside the line",
    "family": "the plate: is it this family? Take its own map; nothing is written to this drive",
    "identity": "the plate: is it this family? Nothing is written to this drive",
    "two": "disconnect all drives but one, and give each an address of its own at the keypad; a repeater on the way",
    "foreign": "disconnect the PLC, and every other master",
    "noise": "nothing is sent: look at A and B, bias resistors, shield, motor cables beside the line",
    "slow": "the drive's own reply delay at the keypad; an adapter or a gateway on the way (PortLateMs)",
    "refused": "the edition of the manual; the firmware of the drive",
    "lost": "the adapter and its plug, the drive's supply",
    "bound": "name --unit, --rate or --format as the keypad has them",
}


TRIES = 12
"""A line that spoils every second exchange still lets one of these pass."""


SILENT = 5
"""How often one is asked that says nothing, on a line that spoils nothing."""


class EndedError(Exception):
    """The steps must not go on."""

    def __init__(self, fault: Fault, unit: int | None = None) -> None:
        """For this reason; `unit` is the one whose reply came late."""
        super().__init__(fault.text)
        self.fault, self.unit = fault, unit


def ended(kind: Trouble, text: str) -> EndedError:
    """The end for a trouble."""
    return EndedError(Fault(kind, text, LOOK[kind]))


@dataclass(frozen=True)
class Talk:
    """A line, a drive's dialect, and a unit on it; it reads and nothing else."""

    line: Line
    drive: Drive
    way: Way
    unit: int = 1

    def read(self, span: Span, patience_us: int | None = None, pause_us: int | None = None) -> Reply:
        """A read, once, after silence. Raises EndedError where somebody else speaks, OSError where there is no port."""
        return self.ask(read_request(self.unit, self.drive, span), patience_us, pause_us)

    def ask(self, body: bytes, patience_us: int | None = None, pause_us: int | None = None) -> Reply:
        """The same with any request that reads."""
        master = self.line.master
        master.said.anyone = self.drive
        unlike = master.said.unlike
        self._look(master.quiet(pause_us))
        reply = master.ask(body, patience_us, pause_us)
        if master.error:
            raise OSError(master.error)
        if master.said.unlike > unlike:
            raise ended("two", f"unit {self.unit} gives two different replies to one request")
        return reply

    def _look(self, heard: list[Said]) -> None:
        """What was said before we ask: nobody else may speak."""
        for one in heard:
            if one.role == "unasked":
                raise ended("foreign", "somebody else speaks on this line")

    @property
    def framings(self) -> list[Way]:
        """The way, and with it those of the drive's other framings."""
        modes = serial(self.drive).modes
        return list(dict.fromkeys((self.way, *(replace(self.way, mode=mode) for mode in modes))))

    def steady(self, span: Span) -> Reply:
        """A read, tried again where the line spoils the reply or the drive is busy. Raises EndedError."""
        return self.patient(read_request(self.unit, self.drive, span))

    def patient(self, body: bytes) -> Reply:
        """The same with any request that reads."""
        busy, replies = codes(self.drive)["busy"], list[Reply]()
        for _ in range(TRIES):
            replies.append(reply := self.ask(body))
            if reply.answered and (reply.refused is None or reply.refused != busy):
                return reply
            if reply.kind == "foreign":
                break
            if reply.kind == "unclear" or (reply.kind == "silent" and len(replies) == 1):
                self.line.master.rest(LATE_US)
            if len(replies) == SILENT and not any(each.data for each in replies) and not self.line.master.said.damaged:
                break
        if all(each.kind in ("silent", "echo") for each in replies):
            raise ended("lost", f"unit {self.unit} does not answer any more")
        for kind in ("foreign", "half", "damaged"):
            if any(each.kind == kind for each in replies):
                raise ended(kind, f"unit {self.unit} gives no good answer")
        raise ended("slow", f"unit {self.unit} gives no answer in its time")
