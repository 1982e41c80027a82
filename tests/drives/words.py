"""What the words on the wire mean, by the map alone."""

from functools import cache

from tests.second.line import RUNS, Bench, Frame
from tests.second.station import maps

from driveblocks.meaning.pattern import Pattern
from driveblocks.meaning.words import words

STOPS = ("stop", "quick_stop", "coast_stop", "jog_stop")
MOTIONS = dict(zip(RUNS, ("run_forward", "run_reverse", "jog_forward", "jog_reverse"), strict=True))


@cache
def _words(kind: str) -> list[tuple[str, Pattern]]:
    """The writes of a map's commands, each with what it is for."""
    return [(command.does, each.pattern) for command in words(maps()[kind]).commands for each in command.writes]


def does(bench: Bench, frame: Frame) -> set[str]:
    """What a write may do; nothing: it is no command."""
    found = {does for does, each in _words(bench.types[0]) if each.register == frame.address and each.holds(frame.word)}
    return found | ({"reference"} if frame.address == bench.maps[0].operation.reference.register else set())


def sent(bench: Bench, frames: list[Frame], *what: str) -> list[Frame]:
    """Those of these frames that do one of these things."""
    return [each for each in frames if not each.read and does(bench, each) & set(what)]


def stops(bench: Bench, frames: list[Frame]) -> list[Frame]:
    """The stops among frames, of any kind."""
    return sent(bench, frames, *STOPS)


def motions(bench: Bench, frames: list[Frame]) -> list[Frame]:
    """Frames that may set a motor in motion."""
    others = sent(bench, frames, "stop", "fault_reset")
    return [each for each in sent(bench, frames, *MOTIONS.values()) if each not in others]


def edge(bench: Bench, pin: str = "RunForward") -> None:
    """A release and an edge."""
    bench.put(**{pin: False}).scan()
    bench.put(**{pin: True}).scan()


def meet(bench: Bench) -> None:
    """Another master, until the line says so."""
    while bench.block["TheLine.ForeignFrames"] != 10:
        bench.foreign(bytes([9, 6, 0x10, 0, 0, 1]))
        bench.run(100)
