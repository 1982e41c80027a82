"""Rules on commands: their registers, their values or bits, their steps, and what these wait for."""

from driveblocks.maps.form import address_text, bits_text
from driveblocks.maps.model import Command, Does, Drive, Range, Register, Step
from driveblocks.maps.problem import Place, Report
from driveblocks.maps.rules import word
from driveblocks.maps.rules.access import cyclic
from driveblocks.maps.rules.condition import bit_at
from driveblocks.maps.rules.unique import unique
from driveblocks.meaning.words import STOPS, Write, words

_LONGEST_MS = 60_000
_SILENT_MS = 5_000


def check(drive: Drive, report: Report) -> None:
    commands = drive.operation.commands
    seen = unique(commands, "does", "command", report)
    good: set[Does] = set()
    for command, sent in zip(commands, words(drive).commands, strict=True):
        before = len(report.problems)
        for one, write in zip(command.writes, sent.writes, strict=True):
            _write(drive, one, write, command, report)
        if command.negative:
            _negative(drive, command, seen.get("run_forward"), report)
        good |= {command.does} if len(report.problems) == before else set()
    for does in ("run_forward", "stop"):
        if does not in seen:
            wrong = f"there is no command `{does}`"
            report.miss(drive.operation.place("commands"), wrong, "a drive that cannot run or stop is of no use")
    states = unique(drive.operation.states, "name", "state", report)
    for command in commands:
        if command.first and command.does in STOPS:
            wrong = f"`{command.does}` has writes before it"
            report.add(command.place("first"), wrong, "a stop is one write, at once and whatever the state")
        _silence(command, report)
        for step in command.first:
            _step(step, set(states), report)
    word.check(drive, good, report)


def _negative(drive: Drive, command: Command, forward: Command | None, report: Report) -> None:
    """Note a run in reverse by a negative reference that is none, or that no negative reference turns round."""
    place = command.place("negative")
    if command.does != "run_reverse":
        wrong = f"`{command.does}` with a negative reference"
        report.add(place, wrong, "`negative` is of `run_reverse` alone; remove it")
        return
    if not drive.operation.reference.negative_reverses:
        wrong = "a run in reverse by a negative reference, but nothing says that a negative reference reverses"
        report.miss(place, wrong, "add `negative_reverses: true` to the reference, or remove `negative`")
    ways = [
        [(one.register, one.value, one.set, one.clear) for one in each.writes] for each in (command, forward) if each
    ]
    if any(way != ways[0] for way in ways):
        wrong = "a run in reverse by a negative reference, but it writes something else than `run_forward`"
        report.add(place, wrong, "write what `run_forward` does, or remove `negative`")


def _write(drive: Drive, one: Command | Step, sent: Write, command: Command, report: Report) -> None:
    """Note a register that cannot be written so."""
    what = f"command `{command.does}`" if one is command else f"a step of `{command.does}`"
    if (one.value is None) == (not one.set and not one.clear):
        report.miss(one.at, f"{what} needs a value, or bits to set and clear", "give one of the two")
        return
    row = cyclic(drive, one.register, one.place("register"), report)
    if row is not None:
        _value(one, row, report)
        _bits(one, sent, command.does, row, report)


def _value(one: Command | Step, row: Register, report: Report) -> None:
    if one.value is None:
        return
    allowed = row.range or Range(min=0, max=0xFFFF)
    if row.values and one.value not in {value.value for value in row.values}:
        wrong = f"{one.value} is no value of {address_text(one.register)}"
        report.miss(one.place("value"), wrong, "write one of the listed values")
    elif not allowed.holds(one.value):
        wrong = f"{one.value} is outside the range of {address_text(one.register)}"
        report.add(one.place("value"), wrong, f"it holds {allowed.min} to {allowed.max}")


def _bits(one: Command | Step, sent: Write, does: Does, row: Register, report: Report) -> None:
    both = {n for span in one.set for n in span} & {n for span in one.clear for n in span}
    if both:
        bits = ", ".join(f"{n:X}" for n in sorted(both))
        report.add(one.at, f"`{does}` sets and clears bit {bits}", "decide for one")
    for key in ("set", "clear"):
        for span in getattr(one, key):
            if not span:
                report.add(one.place(key), f"bits {bits_text(span)} run backwards", "write the lower bit first")
    asked = sent.names if one.value is None else sent.word * bool(row.bits)
    for number in range(16):
        bit = bit_at(row, number)
        if asked >> number & 1 and (bit is None or bit.unused):
            wrong = f"bit {number:X} of {address_text(row.address.first)} is not in use"
            report.miss(_place(one, sent.word >> number & 1), wrong, "name a bit that the register lists")
    _fields(one, sent, does, row, report)


def _place(one: Command | Step, on: int) -> Place:
    """Where a bit is written."""
    return one.place("value" if one.value is not None else "set" if on else "clear")


def _fields(one: Command | Step, sent: Write, does: Does, row: Register, report: Report) -> None:
    """Note a field of which a command writes a part, or a value that the field does not list."""
    for field in row.bits:
        ones = (1 << len(field.bit)) - 1
        ours, number = sent.names >> field.bit.first & ones, sent.word >> field.bit.first & ones
        what = f"bits {bits_text(field.bit)} of {address_text(row.address.first)}"
        place = _place(one, ours & number)
        if not ours or not field.values:
            continue
        if ours != ones:
            report.add(place, f"`{does}` writes a part of {what}", "set or clear every bit of a field")
        elif number not in {value.value for value in field.values}:
            report.miss(place, f"{number} is no value of {what}", "write one of the listed values")


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
