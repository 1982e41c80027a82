"""Rules on commands of several writes: their steps, the states that they wait for, and what they pass through."""

from collections.abc import Iterator

from driveblocks.maps.model import Command, Does, Drive, Step
from driveblocks.maps.problem import Report
from driveblocks.maps.rules import meaning
from driveblocks.maps.rules.meaning import MOVES, Image, Write
from driveblocks.maps.rules.unique import unique

_STOPS: tuple[Does, ...] = ("stop", "coast_stop", "quick_stop", "jog_stop")
_LONGEST_MS = 60_000
_SILENT_MS = 5_000


def check(drive: Drive, report: Report) -> None:
    states = unique(drive.operation.states, "name", "state", report)
    awaited = set()
    for command in drive.operation.commands:
        if command.first and command.does in _STOPS:
            wrong = f"`{command.does}` has writes before it"
            report.add(command.place("first"), wrong, "a stop is one write, at once and whatever the state")
        _silence(command, report)
        for step in command.first:
            awaited.add(step.until)
            _step(step, set(states), report)
        if command.does not in _STOPS:
            _passes(drive, command, report)
    for name, state in states.items():
        if name not in awaited:
            wrong = f"no step waits for the state `{name}`"
            report.miss(state.place("name"), wrong, "name it in an `until`, or remove it")


def _silence(command: Command, report: Report) -> None:
    """Note a silence that no block waits for: after a stop or a run the drive is asked at once."""
    silent = [one for one in command.writes if one.silent_ms is not None]
    for one in silent:
        place = one.place("silent_ms")
        if command.does != "fault_reset":
            wrong = f"the drive is silent after a write of `{command.does}`"
            report.add(place, wrong, "only a fault reset may be waited for; say it under `notices`")
        elif one is not silent[0]:
            report.add(place, "the drive is silent after two writes of a fault reset", "keep the first")
        elif (one.silent_ms or 0) > _SILENT_MS:
            report.add(place, f"a silence of {one.silent_ms} ms", f"write at most {_SILENT_MS}: a reset has 10 s")


def _step(step: Step, states: set[str], report: Report) -> None:
    if step.until is not None and step.until not in states:
        report.miss(step.place("until"), f"there is no state `{step.until}`", "name an entry of `states`")
    if step.until is not None and step.for_ms is not None:
        report.add(step.place("for_ms"), "a step waits for a state or for a time", "keep one of them")
    if step.for_ms is not None and step.for_ms > _LONGEST_MS:
        wrong = f"a word that stays for {step.for_ms} ms"
        report.add(step.place("for_ms"), wrong, f"write at most {_LONGEST_MS}")


def _passes(drive: Drive, command: Command, report: Report) -> None:
    """Note a write after which the registers hold what another motion writes, the other way or from a reset.

    It starts from all that a stop, or a reset after it, can end in: what that stop wrote, and anything elsewhere.
    """
    others = [one for one in drive.operation.commands if one.does in MOVES and _contrary(command, one)]
    told: set[tuple[int, str]] = set()
    for start in _starts(drive):
        now = dict(start)
        for number, (one, word) in enumerate(words(drive, command)):
            now |= word
            for other in others:
                if _holds(now, meaning.image(meaning.acting(other)), one) and (number, other.does) not in told:
                    told.add((number, other.does))
                    wrong = f"`{command.does}` gives the command `{other.does}` in between"
                    report.add(
                        one.at, wrong, "write the direction first and the run bit last, or clear more bits before"
                    )


def words(drive: Drive, command: Command) -> Iterator[tuple[Write, Image]]:
    """What each write of a command puts into its register.

    Of a word written by bits, those of other commands are 0 unless an earlier write of this one has set them; a reset
    begins as a stop.
    """
    commands = drive.operation.commands
    by_bits = meaning.image(one for each in commands for one in each.writes if one.value is None)
    own = meaning.image(one for one in commands if one.does == "stop" and command.does == "fault_reset")
    for one in command.writes:
        own |= meaning.image([one])
        word = {place: own.get(place, False) for place in by_bits if place[0] == one.register}
        yield one, word | {place: on for place, on in own.items() if place[0] == one.register}


def _contrary(command: Command, other: Command) -> bool:
    """Whether another motion is one that a command must not even pass through."""
    return command.does not in MOVES or command.written_as.endswith("forward") != other.written_as.endswith("forward")


def _starts(drive: Drive) -> list[Image]:
    """What is known of the registers when a command begins."""
    commands = drive.operation.commands
    stopped = [meaning.image([one]) for one in commands if one.does in _STOPS]
    reset: Image = {}
    for one in commands:
        for _, word in words(drive, one) if one.does == "fault_reset" else ():
            reset |= word
    return [*stopped, *(stop | reset for stop in stopped)]


def _holds(now: Image, wanted: Image, last: Write) -> bool:
    """Whether the registers may hold an image, by what was just written."""
    fits = all(now.get(place, on) == on for place, on in wanted.items())
    return fits and any(place in wanted for place in meaning.image([last]))
