"""Rules on commands of several writes: their steps, and the states that they wait for."""

from driveblocks.maps.model import Command, Drive, Step
from driveblocks.maps.problem import Report
from driveblocks.maps.rules.unique import unique
from driveblocks.meaning.words import STOPS

_LONGEST_MS = 60_000
_SILENT_MS = 5_000


def check(drive: Drive, report: Report) -> None:
    states = unique(drive.operation.states, "name", "state", report)
    for command in drive.operation.commands:
        if command.first and command.does in STOPS:
            wrong = f"`{command.does}` has writes before it"
            report.add(command.place("first"), wrong, "a stop is one write, at once and whatever the state")
        _silence(command, report)
        for step in command.first:
            _step(step, set(states), report)


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
    if step.for_ms is not None and step.for_ms > _LONGEST_MS:
        wrong = f"a word that stays for {step.for_ms} ms"
        report.add(step.place("for_ms"), wrong, f"write at most {_LONGEST_MS}")
