"""Rules on commands: their register, and their value or bits."""

from driveblocks.maps.form import address_text, bits_text
from driveblocks.maps.model import Command, Does, Drive, Range, Register
from driveblocks.maps.problem import Report
from driveblocks.maps.rules import meaning
from driveblocks.maps.rules.access import known
from driveblocks.maps.rules.condition import bit_at
from driveblocks.maps.rules.unique import unique

_ENDS: dict[Does, tuple[Does, ...]] = {
    **dict.fromkeys((*meaning.MOVES, "stop", "coast_stop", "quick_stop"), meaning.MOVES),
    "jog_stop": meaning.JOGS,
}
"""What may not go on beside or after a command."""


def check(drive: Drive, report: Report) -> None:
    """Note every rule that commands break."""
    commands = drive.operation.commands
    seen = unique(commands, "does", "command", report)
    words: dict[tuple[int, int], Command] = {}
    for command in commands:
        _command(drive, command, report)
        if command.value is not None:
            other = words.setdefault((command.register, command.value), command)
            if other is not command:
                wrong = f"`{command.does}` and `{other.does}` write the same value {command.value}"
                report.add(command.place("value"), wrong, "each command has its own value")
    for command in commands:
        _releases(drive, command, report)
    for does in ("run_forward", "stop"):
        if does not in seen:
            wrong = f"there is no command `{does}`"
            report.miss(drive.operation.place("commands"), wrong, "a drive that cannot run or stop is of no use")


def _releases(drive: Drive, command: Command, report: Report) -> None:
    """Note a stop that leaves a run bit set, and a direction that leaves the other one set."""
    row = drive.register_at(command.register)
    if row is None or not (command.set or command.clear):
        return
    written = meaning.written(command)
    for other in drive.operation.commands:
        if other is command or other.does not in _ENDS.get(command.does, ()) or other.register != command.register:
            continue
        left = [number for number, one in meaning.written(other).items() if one and number not in written]
        if left:
            bits = ", ".join(f"{number:X}" for number in sorted(left))
            wrong = f"`{command.does}` leaves bit {bits} as it is, which `{other.does}` sets"
            report.add(command.place("clear"), wrong, "add it to `clear`, so that the two never act together")


def _command(drive: Drive, command: Command, report: Report) -> None:
    if (command.value is None) == (not command.set and not command.clear):
        wrong = f"command `{command.does}` needs a value, or bits to set and clear"
        report.miss(command.at, wrong, "give one of the two")
        return
    row = known(drive, command.register, "w", command.place("register"), report)
    if row is None:
        return
    before = len(report.problems)
    _command_value(command, row, report)
    _command_bits(command, row, report)
    if len(report.problems) == before:
        meaning.check(drive, command, row, report)


def _command_value(command: Command, row: Register, report: Report) -> None:
    if command.value is None:
        return
    allowed = row.range or Range(min=0, max=0xFFFF)
    if row.values and command.value not in {value.value for value in row.values}:
        wrong = f"{command.value} is no value of {address_text(command.register)}"
        report.miss(command.place("value"), wrong, "write one of the listed values")
    elif not allowed.holds(command.value):
        wrong = f"{command.value} is outside the range of {address_text(command.register)}"
        report.add(command.place("value"), wrong, f"it holds {allowed.min} to {allowed.max}")


def _command_bits(command: Command, row: Register, report: Report) -> None:
    both = {n for span in command.set for n in span} & {n for span in command.clear for n in span}
    if both:
        bits = ", ".join(f"{n:X}" for n in sorted(both))
        report.add(command.at, f"`{command.does}` sets and clears bit {bits}", "decide for one")
    for key in ("set", "clear"):
        for span in getattr(command, key):
            if not span:
                report.add(command.place(key), f"bits {bits_text(span)} run backwards", "write the lower bit first")
    for number, one in meaning.written(command).items():
        bit = bit_at(row, number)
        if (command.value is None or (one and row.bits)) and (bit is None or bit.unused):
            wrong = f"bit {number:X} of {address_text(row.address.first)} is not in use"
            report.miss(command.place(meaning.key(command, one)), wrong, "name a bit that the register lists")
    _command_fields(command, row, report)


def _command_fields(command: Command, row: Register, report: Report) -> None:
    """Note a field of which a command writes a part, or a value that the field does not list."""
    written = meaning.written(command)
    for field in row.bits:
        ours = [number for number in field.bit if number in written]
        what = f"bits {bits_text(field.bit)} of {address_text(row.address.first)}"
        place = command.place(meaning.key(command, any(written[number] for number in ours)))
        if not ours or not field.values:
            continue
        if len(ours) < len(field.bit):
            report.add(place, f"`{command.does}` writes a part of {what}", "set or clear every bit of a field")
        elif meaning.field_value(field, written) is None:
            number = meaning.number(field, written)
            report.miss(place, f"{number} is no value of {what}", "write one of the listed values")
