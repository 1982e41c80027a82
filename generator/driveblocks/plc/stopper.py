"""The end of a run: every drive is stopped past the program, for a bounded time, and read for its standstill."""

from driveblocks.desk.clock import Clock
from driveblocks.desk.ending import Ending
from driveblocks.maps.model import Drive
from driveblocks.maps.plan import plan
from driveblocks.modbus.layout import granted
from driveblocks.plc.ask import Asker, Last, Speech
from driveblocks.plc.gate import Gate
from driveblocks.plc.guard import stop_request
from driveblocks.simulator.pattern import Pattern, of_condition

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
        function = 3 if 3 in plan(drive).functions else 4
        patterns = [of_condition(each) for each in drive.operation.standstill.all]
        words = {register: self._read(unit, function, register) for register in {each.register for each in patterns}}
        if None in words.values():
            return "stop acknowledged, its status is not answered"
        return (
            ""
            if all(_holds(each, words) for each in patterns)
            else "stop acknowledged, its status does not prove standstill"
        )

    def _read(self, unit: int, function: int, register: int) -> int | None:
        reply = self._asker.ask(bytes([unit, function, *register.to_bytes(2, "big"), 0, 1]), 5)
        words = granted(reply, "reply").words if reply else ()
        return words[0] if len(words) == 1 else None


def _holds(pattern: Pattern, words: dict[int, int | None]) -> bool:
    return pattern.holds(words[pattern.register] or 0)
