"""Commands: the pins of the command block as the word for the drive's command register. Stop wins."""

from dataclasses import dataclass

from driveblocks.maps.model import Command, Drive


@dataclass(frozen=True, kw_only=True)
class Pins:
    """The inputs of the command block."""

    enable: bool = True
    stop: bool = False
    quick_stop: bool = False
    coast_stop: bool = False
    run_forward: bool = False
    run_reverse: bool = False
    jog_forward: bool = False
    jog_reverse: bool = False
    fault_reset: bool = False
    keep: int = 0
    """The word whose bits beside the commands' own are kept; only for a drive that is commanded by bits."""

    @property
    def stopping(self) -> bool:
        """Whether a pin asks for a stop."""
        return not self.enable or self.stop or self.quick_stop or self.coast_stop

    @property
    def contrary(self) -> bool:
        """Whether both directions are asked."""
        return (self.run_forward or self.jog_forward) and (self.run_reverse or self.jog_reverse)

    @property
    def motion(self) -> str | None:
        """What motion is asked, running before jogging."""
        asked = ("run_forward", "run_reverse", "jog_forward", "jog_reverse")
        return next((name for name in asked if getattr(self, name)), None)


@dataclass(frozen=True)
class Told:
    """What the block puts out."""

    address: int
    value: int
    result: str = "OK"
    stopping: bool = False


class Commands:
    """The command block of one drive, with its memory; one `step` is one call."""

    def __init__(self, drive: Drive) -> None:
        """Take the commands from the map. Raises ValueError if it has no stop."""
        self.known: dict[str, Command] = {one.does: one for one in drive.operation.commands}
        if "stop" not in self.known:
            raise ValueError("the map has no stop command")
        self.own = {bit for one in self.known.values() for span in (*one.set, *one.clear) for bit in span}
        self.jogging = False
        self.reset_before = False

    def step(self, pins: Pins) -> Told:
        """What one call answers."""
        edge = pins.fault_reset and not self.reset_before
        self.reset_before = pins.fault_reset
        if pins.stopping:
            self.jogging = False
            return self._tell(self._stop(pins), pins, stopping=True)
        if pins.contrary:
            return self._tell("stop", pins, "BOTH_DIRECTIONS", stopping=True)
        wanted = "fault_reset" if edge else pins.motion
        if wanted is None:
            ending = "jog_stop" if self.jogging and "jog_stop" in self.known else "stop"
            return self._tell(ending, pins, stopping=True)
        if wanted not in self.known:
            return self._tell("stop", pins, "NOT_ABLE", stopping=True)
        if wanted != "fault_reset":
            self.jogging = wanted.startswith("jog")
        return self._tell(wanted, pins)

    def _stop(self, pins: Pins) -> str:
        """The stop that is asked, if the drive has it; coasting before the quick one."""
        asked = (name for name in ("coast_stop", "quick_stop") if getattr(pins, name) and name in self.known)
        return next(asked, "stop")

    def _tell(self, name: str, pins: Pins, result: str = "OK", *, stopping: bool = False) -> Told:
        command = self.known[name]
        return Told(command.register, self.word(command, pins.keep), result, stopping)

    def word(self, command: Command, keep: int) -> int:
        """The word of a command: its value, or its bits among those that are kept."""
        if command.value is not None:
            return command.value
        wanted = {bit for span in command.set for bit in span}
        kept = {bit for bit in range(16) if keep >> bit & 1 and bit not in self.own}
        return sum(1 << bit for bit in wanted | kept)
