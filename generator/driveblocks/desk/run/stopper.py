"""The end of a run: every drive is stopped past the program, for a bounded time, and read for its standstill."""

from driveblocks.desk.clock import Clock
from driveblocks.desk.ending import Ending
from driveblocks.desk.run.ask import Asker, Last, Speech
from driveblocks.desk.run.gate import Gate
from driveblocks.desk.run.guard import stop_request
from driveblocks.maps.form import Span
from driveblocks.maps.model import Drive
from driveblocks.maps.pair import whole
from driveblocks.maps.plan import read_request
from driveblocks.modbus.layout import granted, reply_size
from driveblocks.simulator.pattern import of_condition

WITHIN_US = 10_000_000
"""How long it is tried where no drive block gives the time to standstill."""
LEAST_US = 2_000_000
"""How long it is tried at least: eight drives are not stopped and read in less."""
SILENT = "no reply to the stop"


class Stopper:
    """Stops drives, and reads whether they are at standstill."""

    def __init__(self, gate: Gate, clock: Clock, ending: Ending, speech: Speech) -> None:
        """On a port that was taken from the program."""
        self._clock = clock
        self._ending = ending
        last = Last(gate.sent, gate.heard, gate.sent_us, gate.heard_us)
        self._asker = Asker(gate.port, clock, speech, last, lambda: ending.hurry)

    def stop(self, drives: dict[int, Drive], within_us: int = WITHIN_US) -> dict[int, str]:
        """Stop them all; what cannot be confirmed of each, empty where its standstill is proved.

        A stop is sent to every drive before any is asked for its standstill.
        """
        end = self._clock.now_us() + within_us
        told = dict.fromkeys(drives, SILENT)
        self._confirm([unit for unit, drive in drives.items() if self._stopped(unit, drive)], drives, told, end)
        while (waiting := [unit for unit, why in told.items() if why]) and self._goes_on(end):
            stopped = [unit for unit in waiting if self._goes_on(end) and self._stopped(unit, drives[unit])]
            self._confirm(stopped, drives, told, end)
        return told

    def _confirm(self, stopped: list[int], drives: dict[int, Drive], told: dict[int, str], end: int) -> None:
        """Read whether drives that have acknowledged their stop are at standstill."""
        for unit in stopped:
            if self._goes_on(end):
                told[unit] = self._moves(unit, drives[unit])
            elif told[unit] == SILENT:
                told[unit] = "stop acknowledged, not read since"

    def _goes_on(self, end: int) -> bool:
        return self._clock.now_us() < end and not self._ending.hurry

    def _stopped(self, unit: int, drive: Drive) -> bool:
        """Send a stop; whether the drive has acknowledged it."""
        request = stop_request(unit, drive)
        return self._asker.ask(request, 6) == request[:6]

    def _moves(self, unit: int, drive: Drive) -> str:
        """Why standstill is not proved; empty if it is."""
        patterns = [of_condition(each) for each in drive.operation.standstill.all]
        words: dict[int, int] = {}
        for value in sorted({whole(drive, each.register) for each in patterns}):
            read = self._read(unit, drive, value)
            if not read:
                return "stop acknowledged, its status is not answered"
            words |= zip(value, read, strict=True)
        return (
            ""
            if all(each.holds(words[each.register]) for each in patterns)
            else "stop acknowledged, its status does not prove standstill"
        )

    def _read(self, unit: int, drive: Drive, value: tuple[int, ...]) -> tuple[int, ...]:
        """The registers of a value, or a coil; none if they are not answered."""
        request = read_request(unit, drive, Span(value[0], value[-1]))
        reply = self._asker.ask(request, reply_size(request))
        return granted(reply, "reply").values(len(value)) if reply else ()
