"""Commands: the pins of the command block as the word for the drive's command register. Stop wins."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field

from driveblocks.maps.model import Bits, Command, Drive, Register

MOTIONS = ("run_forward", "run_reverse", "jog_forward", "jog_reverse")


@dataclass(frozen=True, kw_only=True)
class Pins:
    enable: bool = True
    stop: bool = False
    quick_stop: bool = False
    coast_stop: bool = False
    run_forward: bool = False
    run_reverse: bool = False
    jog_forward: bool = False
    jog_reverse: bool = False
    fault_reset: bool = False
    stop_acknowledged: bool = False
    reset_acknowledged: bool = False
    keep: Mapping[int, int] = field(default_factory=dict)
    """By command register: the word whose bits beside the commands' own are kept."""

    @property
    def stops(self) -> frozenset[str]:
        asked = {name for name in ("stop", "quick_stop", "coast_stop") if getattr(self, name)}
        return frozenset(asked | ({"disable"} if not self.enable else set()))

    @property
    def contrary(self) -> bool:
        return (self.run_forward or self.jog_forward) and (self.run_reverse or self.jog_reverse)

    @property
    def motion(self) -> str | None:
        """What motion is asked, running before jogging."""
        return next((name for name in MOTIONS if getattr(self, name)), None)


@dataclass(frozen=True)
class Told:
    address: int
    value: int
    result: str = "OK"
    stopping: bool = False
    resetting: bool = False
    changed: bool = True
    """To be written: another telegram than that of the last call, or a stop that is asked anew."""


class Commands:
    """The command block of one drive, with its memory; one `step` is one call."""

    def __init__(self, drive: Drive) -> None:
        """Take the commands from the map. Raises ValueError if it has no stop, or a command of several writes."""
        self.known: dict[str, Command] = {one.does: one for one in drive.operation.commands if not one.negative}
        if "stop" not in self.known:
            raise ValueError("the map has no stop command")
        if not drive.operation.in_one_word:
            raise ValueError("a command of the map takes several writes")
        self.home = self.known["stop"].register
        self.kept = kept(drive)
        self.before: tuple[Pins, Told] | None = None
        self.jogging = False
        self.reset_asked = False
        self.stopped = False
        """Whether the last acknowledged telegram was a stop, and nothing but stops was sent since."""
        self.released = True
        """Whether run and jog pins count: not from a reset on until all of them were FALSE."""

    @property
    def resets(self) -> bool:
        return "fault_reset" in self.known

    def step(self, pins: Pins) -> Told:
        """What one call answers."""
        anew = self._notice(pins)
        name, result = self._decided(pins)
        command = self.known[name]
        stopping = name in ("stop", "quick_stop", "coast_stop", "jog_stop")
        resetting = name == "fault_reset"
        self._remember(name, pins)
        value = self.word(command, pins.keep)
        changed = (stopping and anew) or self.before is None or (command.register, value) != self._last()
        told = Told(command.register, value, self._error(result, pins), stopping, resetting, changed)
        self.before = (pins, told)
        return told

    def _last(self) -> tuple[int, int] | None:
        return (self.before[1].address, self.before[1].value) if self.before else None

    def _notice(self, pins: Pins) -> bool:
        """Take in acknowledgements and edges; whether a stop is to be sent anew."""
        then, told = self.before or (Pins(enable=False), None)
        if pins.stop_acknowledged and told is not None and told.stopping and told.address == self.home:
            self.stopped = True
        if pins.reset_acknowledged and self.reset_asked:
            self.reset_asked = self.stopped = False
        stops_more = bool(pins.stops - then.stops)
        if stops_more:
            self.stopped = False
        reset_rose = self.resets and pins.fault_reset and not then.fault_reset
        self.reset_asked = self.reset_asked or reset_rose
        if self.reset_asked or pins.motion is None:
            self.released = not self.reset_asked
        return stops_more or reset_rose

    def _decided(self, pins: Pins) -> tuple[str, str]:
        """The command to send, and what is wrong with what was asked."""
        if self.reset_asked and self.stopped:
            return "fault_reset", "OK"
        if pins.stops:
            asked = (name for name in ("coast_stop", "quick_stop") if name in pins.stops and name in self.known)
            return next(asked, "stop"), "OK"
        if pins.contrary:
            return "stop", "BOTH_DIRECTIONS"
        if pins.motion is None or not self.released:
            return "jog_stop" if self.jogging and "jog_stop" in self.known else "stop", "OK"
        return (pins.motion, "OK") if pins.motion in self.known else ("stop", "NOT_ABLE")

    def _remember(self, name: str, pins: Pins) -> None:
        if name in MOTIONS:
            self.jogging = name.startswith("jog")
            self.stopped = False
        elif name == "fault_reset" or pins.stops:
            self.jogging = False

    def _error(self, result: str, pins: Pins) -> str:
        """What is wrong with a motion comes before what is wrong with a reset."""
        if result != "OK":
            return result
        if not self.released and pins.motion is not None and not pins.stops:
            return "HELD"
        return "NOT_ABLE" if pins.fault_reset and not self.resets else "OK"

    def word(self, command: Command, keep: Mapping[int, int]) -> int:
        """The word of a command: its value; or its bits, nothing else that a command does, and what is kept.

        A reset by a bit beside those that run is the stop with that bit, never the word of a motion.
        """
        if command.value is not None:
            return command.value
        wanted = set(_numbers(command.set))
        if command.does == "fault_reset" and command.register == self.home:
            wanted |= set(_numbers(self.known["stop"].set)) - set(_numbers(command.clear))
        word = keep.get(command.register, 0)
        return sum(1 << bit for bit in wanted | {bit for bit in self.kept[command.register] if word >> bit & 1})


def _numbers(spans: Iterable[Bits]) -> Iterable[int]:
    return (bit for span in spans for bit in span)


def kept(drive: Drive) -> dict[int, frozenset[int]]:
    """Each register that is commanded by bits: its bits that the manual gives a use and that no command touches."""
    found: dict[int, frozenset[int]] = {}
    commands = [one for one in drive.operation.commands if one.value is None]
    for register in {one.register for one in commands}:
        touched = {bit for one in commands if one.register == register for bit in _numbers((*one.set, *one.clear))}
        found[register] = frozenset(_in_use(drive.register_at(register, "w")) - touched)
    return found


def _in_use(row: Register | None) -> set[int]:
    """The bits of a register that the manual gives a use; not those that could make up what must never be sent."""
    if row is None:
        return set()
    barred = {bit for each in row.never for bit in each.bit}
    return {bit for entry in row.bits if not entry.unused for bit in entry.bit} - barred
