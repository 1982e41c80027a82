"""Rules on commands: their registers, their values or bits, and what stays set after them."""

from driveblocks.maps.form import address_text, bits_text
from driveblocks.maps.model import Command, Does, Drive, Range, Register
from driveblocks.maps.problem import Report
from driveblocks.maps.rules import meaning, path
from driveblocks.maps.rules.access import cyclic
from driveblocks.maps.rules.condition import bit_at
from driveblocks.maps.rules.meaning import Write
from driveblocks.maps.rules.unique import unique

_ENDS: dict[Does, tuple[Does, ...]] = {
    **dict.fromkeys((*meaning.MOVES, "stop", "coast_stop", "quick_stop"), meaning.MOVES),
    "jog_stop": meaning.JOGS,
}
"""What may not go on beside or after a command."""


def check(drive: Drive, report: Report) -> None:
    commands = drive.operation.commands
    seen = unique(commands, "does", "command", report)
    words: dict[frozenset[tuple[tuple[int, int], bool]], Command] = {}
    for command in commands:
        _command(drive, command, report)
        last = meaning.acting(command)[-1]
        if command.negative:
            _negative(drive, command, seen.get("run_forward"), report)
        elif last.value is not None:
            other = words.setdefault(frozenset(meaning.image(meaning.acting(command)).items()), command)
            if other is not command:
                wrong = f"`{command.does}` and `{other.does}` write the same value {last.value}"
                report.add(last.place("value"), wrong, "each command has its own value")
    for command in commands:
        _releases(drive, command, report)
    for does in ("run_forward", "stop"):
        if does not in seen:
            wrong = f"there is no command `{does}`"
            report.miss(drive.operation.place("commands"), wrong, "a drive that cannot run or stop is of no use")
    path.check(drive, report)


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


def _releases(drive: Drive, command: Command, report: Report) -> None:
    """Note a stop that keeps a run bit, and a direction that keeps that of the other one."""
    if not (command.set or command.clear) or drive.register_at(command.register, "w") is None:
        return
    ours = meaning.image(command.writes)
    registers = dict.fromkeys(one.register for one in command.writes)
    for other in drive.operation.commands:
        if other is command or other.does not in _ENDS.get(command.does, ()):
            continue
        made = meaning.sets_off(drive, other)
        for register in registers:
            left = [number for where, number in made if where == register and (where, number) not in ours]
            if left:
                bits = ", ".join(f"{number:X}" for number in sorted(left))
                wrong = f"`{command.does}` does not change bit {bits}, which `{other.does}` sets"
                report.add(command.place("clear"), wrong, "add it to `clear`, so that the two never act together")


def _command(drive: Drive, command: Command, report: Report) -> None:
    before = len(report.problems)
    rows = [_write(drive, one, command, report) for one in command.writes]
    if all(rows) and len(report.problems) == before:
        meaning.check(drive, command, report)


def _write(drive: Drive, one: Write, command: Command, report: Report) -> Register | None:
    """The row of a register that a command writes, if it can be written so."""
    what = f"command `{command.does}`" if one is command else f"a step of `{command.does}`"
    if (one.value is None) == (not one.set and not one.clear):
        report.miss(one.at, f"{what} needs a value, or bits to set and clear", "give one of the two")
        return None
    row = cyclic(drive, one.register, one.place("register"), report)
    if row is not None:
        _value(one, row, report)
        _bits(one, command.does, row, report)
    return row


def _value(one: Write, row: Register, report: Report) -> None:
    if one.value is None:
        return
    allowed = row.range or Range(min=0, max=0xFFFF)
    if row.values and one.value not in {value.value for value in row.values}:
        wrong = f"{one.value} is no value of {address_text(one.register)}"
        report.miss(one.place("value"), wrong, "write one of the listed values")
    elif not allowed.holds(one.value):
        wrong = f"{one.value} is outside the range of {address_text(one.register)}"
        report.add(one.place("value"), wrong, f"it holds {allowed.min} to {allowed.max}")


def _bits(one: Write, does: Does, row: Register, report: Report) -> None:
    both = {n for span in one.set for n in span} & {n for span in one.clear for n in span}
    if both:
        bits = ", ".join(f"{n:X}" for n in sorted(both))
        report.add(one.at, f"`{does}` sets and clears bit {bits}", "decide for one")
    for key in ("set", "clear"):
        for span in getattr(one, key):
            if not span:
                report.add(one.place(key), f"bits {bits_text(span)} run backwards", "write the lower bit first")
    for number, on in meaning.written(one).items():
        bit = bit_at(row, number)
        if (one.value is None or (on and row.bits)) and (bit is None or bit.unused):
            wrong = f"bit {number:X} of {address_text(row.address.first)} is not in use"
            report.miss(one.place(meaning.key(one, on)), wrong, "name a bit that the register lists")
    _fields(one, does, row, report)


def _fields(one: Write, does: Does, row: Register, report: Report) -> None:
    """Note a field of which a command writes a part, or a value that the field does not list."""
    written = meaning.written(one)
    for field in row.bits:
        ours = [number for number in field.bit if number in written]
        what = f"bits {bits_text(field.bit)} of {address_text(row.address.first)}"
        place = one.place(meaning.key(one, any(written[number] for number in ours)))
        if not ours or not field.values:
            continue
        if len(ours) < len(field.bit):
            report.add(place, f"`{does}` writes a part of {what}", "set or clear every bit of a field")
        elif meaning.field_value(field, written) is None:
            number = meaning.number(field, written)
            report.miss(place, f"{number} is no value of {what}", "write one of the listed values")
