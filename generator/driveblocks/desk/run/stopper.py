"""The end of a run: every drive is stopped past the program until it is proved at standstill."""

from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass, field

from driveblocks.desk.clock import Clock
from driveblocks.desk.ending import Ending
from driveblocks.desk.exchange import LATE_US
from driveblocks.desk.master import REPLY_US, Last, Master, Speech
from driveblocks.desk.run.controller import LineEnd
from driveblocks.desk.run.gate import Gate
from driveblocks.desk.run.guard import stop_request
from driveblocks.desk.site.register import spans
from driveblocks.maps.model import Drive
from driveblocks.maps.pair import whole
from driveblocks.maps.plan import most, read_request
from driveblocks.meaning.serial import USUAL_BITS, USUAL_RATE, serial
from driveblocks.meaning.status import registers, status

LEAST_US = 2_000_000
"""How long it is tried at least: eight drives are not stopped and read in less."""
ALONE_US = 60_000_000
"""Beside the time to standstill, how long it is tried in all where nobody is there who could end it."""
ROUNDS = 3
"""How often a drive is stopped that has never answered, and was never told to run."""
PATIENT = 4
"""In each of so many rounds, a reply is waited for as long as a gateway may take; in the others other drives come."""
SAY_US = 5_000_000
SILENT = "no reply to the stop"
LATE = "its replies come late: raise PortLateMs, or look at the gateway"


@dataclass
class Stop:
    """One drive on its way to standstill; times in us."""

    drive: Drive
    within_us: int
    """From the first stop that it has acknowledged."""
    waited_for: bool = True
    """It has answered before, or was told to run."""
    why: str = SILENT
    """What is not proved; empty at standstill."""
    heard: bool = False
    """A reply to a stop came, or our own echo."""
    acknowledged_us: int | None = None
    rounds: int = 0


@dataclass
class Stopper:
    """Stops drives on a port that was taken from the program, and reads whether they are at standstill."""

    gate: Gate
    clock: Clock
    ending: Ending
    speech: Speech
    say: Callable[[str], None] = lambda _: None
    """Tells a person which drives are waited for."""
    names: Mapping[int, str] = field(default_factory=dict)
    _said_us: int = 0

    def stop(self, stops: Mapping[int, Stop]) -> None:
        """Stop them all, by unit, until each is at standstill or must not be waited for any longer.

        A stop is sent to every drive before any is asked for its standstill.
        """
        gate, begun = self.gate, self.clock.now_us()
        last = Last(gate.sent, gate.heard, gate.sent_us, gate.heard_us, REPLY_US + 1000 * gate.late_ms)
        master = Master(gate.port, self.clock, self.speech)
        master.hurries = lambda: self.ending.hurry
        master.take_over(last)
        self._said_us = begun
        while waiting := [unit for unit, one in stops.items() if self._goes_on(one, begun)]:
            for unit in waiting:
                if self._goes_on(stops[unit], begun):
                    self._stopped(master, unit, stops[unit])
            for unit in waiting:
                if self._goes_on(stops[unit], begun) and stops[unit].heard:
                    self._confirm(master, unit, stops[unit])
            self._tell(stops, begun)

    def _goes_on(self, one: Stop, begun: int) -> bool:
        """Whether one is not at standstill and still waited for."""
        if not one.why:
            return False
        if self.ending.hurry:
            return one.rounds == 0
        if not one.waited_for and one.acknowledged_us is None:
            return one.rounds < ROUNDS
        if not self.ending.alone:
            return True
        now, since = self.clock.now_us(), one.acknowledged_us
        within = max(LEAST_US, one.within_us)
        return now < begun + within + ALONE_US and (since is None or now < since + within)

    def _patience_us(self, master: Master, one: Stop) -> int:
        long = master.lates or one.rounds % PATIENT == 0
        return (LATE_US if long else REPLY_US) + 1000 * self.gate.late_ms

    def _stopped(self, master: Master, unit: int, one: Stop) -> None:
        """Send a stop. What came is an acknowledgement where the line does not give back what is sent."""
        master.said.anyone = one.drive
        one.rounds += 1
        reply = master.ask(stop_request(unit, one.drive), self._patience_us(master, one))
        if reply.kind == "good":
            one.heard = True
            if master.hears_itself is False or reply.echo:
                self._acknowledged(one)
        elif reply.kind == "refused":
            one.why = "the stop was refused"
        elif one.why == SILENT and master.lates:
            one.why = LATE

    def _acknowledged(self, one: Stop) -> None:
        if one.acknowledged_us is None:
            one.acknowledged_us = self.clock.now_us()

    def _confirm(self, master: Master, unit: int, one: Stop) -> None:
        """Read whether it is at standstill. Between two reads it is stopped again: their replies may look the same."""
        patterns = status(one.drive).standstill.patterns
        wanted = sorted({word for each in registers(patterns) for word in whole(one.drive, each)})
        words: dict[int, int] = {}
        for at, span in enumerate(spans(one.drive, wanted, most(one.drive, self.speech.mode).read)):
            if at:
                self._stopped(master, unit, one)
            reply = master.ask(read_request(unit, one.drive, span), self._patience_us(master, one))
            if not reply.words:
                silent = one.acknowledged_us is None and not reply.answered
                one.why = SILENT if silent else "stop acknowledged, its status is not answered"
                return
            self._acknowledged(one)
            words |= zip(span, reply.words, strict=True)
        proved = all(each.holds(words[each.register]) for each in patterns)
        one.why = "" if proved else "stop acknowledged, its status does not prove standstill"

    def _tell(self, stops: Mapping[int, Stop], begun: int) -> None:
        """Say now and then which drives are not at standstill, for how long, and what to do."""
        now = self.clock.now_us()
        if now - self._said_us < SAY_US:
            return
        self._said_us = now
        for unit in waited(stops):
            said = (
                f"{self.names.get(unit, 'unit')} (unit {unit}): {stops[unit].why}, for {(now - begun) // 1_000_000} s"
            )
            gives_up = "" if self.ending.alone else "; Ctrl-C gives up"
            self.say(f"{said}; look at its cable and supply, or stop it by hand{gives_up}")


def waited(stops: Mapping[int, Stop]) -> Collection[int]:
    """Units of drives whose standstill is not proved."""
    return [unit for unit, one in stops.items() if one.why]


def speech(line: LineEnd, units: dict[int, Drive]) -> Speech:
    """How a program's line is spoken on."""
    milliseconds = max((serial(each).silence_ms for each in units.values()), default=0)
    bits, rate = line.number("CharacterBits") or USUAL_BITS, line.number("BitRate") or USUAL_RATE
    return Speech("ascii" if line.number("Ascii") else "rtu", 1e6 * bits / rate, int(1000 * milliseconds))
