"""Simulated drives that serve a master in real time, what happens to them, and what is to be seen."""

from collections.abc import Callable, Mapping

from driveblocks.desk.bus import Bus
from driveblocks.desk.clock import Clock
from driveblocks.desk.ending import Ending
from driveblocks.desk.port import Port
from driveblocks.desk.run.play import Play
from driveblocks.desk.seen import Seen, View
from driveblocks.maps.model import Drive
from driveblocks.simulator.drive import SimulatedDrive

LOOK_US = 200_000
"""Between two looks for the screen."""
TICK_US = 1_000


class Stand:
    """Drives on a bus, and a link to a master."""

    def __init__(self, bus: Bus, link: Port, clock: Clock, ending: Ending, play: Play | None = None) -> None:
        self.bus, self.link = bus, link
        self._clock, self._ending = clock, ending
        self._play = play or Play({})
        self._play.act = lambda happening: happening.act(bus.drives, bus.loss)

    def run(self, say: Callable[[str], None], look: Callable[[int], None], for_us: int | None = None) -> None:
        """Serve until the end; `say` takes what happens, `look` the time every now and then."""
        begun = self._clock.now_us()
        looked, error = -LOOK_US, ""
        while not self._ending.reason:
            now = self._clock.now_us() - begun
            if for_us is not None and now >= for_us:
                self._ending.ask(f"{for_us / 1e6:g} s are over")
            for says in self._play.due(now):
                say(f"{now / 1e6:5.1f} s  {says}")
            self._pass_bytes(now)
            if now - looked >= LOOK_US:
                looked = now
                if self.link.error != error:
                    error = self.link.error
                    say(f"the port does not work: {error}" if error else "the port works again")
                look(now)
            self._clock.sleep_until(begun + now + TICK_US)

    def _pass_bytes(self, now_us: int) -> None:
        data = self.link.receive()
        if data:
            self.bus.send(data, now_us)
        reply = self.bus.receive(now_us)
        if reply:
            self.link.send(reply)


def view(bus: Bus, maps: Mapping[int, Drive], at_us: int, *, counted: bool) -> View:
    """How the drives are; `counted`: with what the line has seen."""
    drives = tuple(_seen(drive, maps[drive.unit], bus) for drive in bus.drives)
    loss = bus.loss
    line = {"frames lost": loss.dropped, "damaged": loss.damaged, "characters not understood": bus.strange}
    return View(at_us, drives, dict(line) if counted else {}, {})


def _seen(drive: SimulatedDrive, known: Drive, bus: Bus) -> Seen:
    counts = bus.counts[drive.unit]
    told = f"{counts.heard}/{counts.replied}/{counts.refused}"
    return Seen(known.prefix, drive.unit, _state(drive, known), drive.asked_hertz, drive.hertz, told)


def _state(drive: SimulatedDrive, known: Drive) -> str:
    if not drive.powered:
        return "no power"
    if drive.fault:
        names = {each.code: each.id or each.name for each in known.faults.codes}
        return f"fault {drive.fault} {names.get(drive.fault) or ''}".strip()
    warnings = known.warning_codes
    return f"{drive.mode}, warning {warnings[0].id or warnings[0].name}" if drive.warning and warnings else drive.mode
