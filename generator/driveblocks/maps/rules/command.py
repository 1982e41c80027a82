"""Rules on commands: their register, their value or bits, and that the register's own words do not contradict them."""

from collections.abc import Iterator

from driveblocks.maps.form import address_text, bits_text
from driveblocks.maps.model import Command, Does, Drive, Range, Register
from driveblocks.maps.problem import Report
from driveblocks.maps.rules.access import known
from driveblocks.maps.rules.condition import bit_at
from driveblocks.maps.rules.unique import unique

_JOG, _STOP, _RESET = ("jog", "点动"), ("stop", "停"), ("reset", "复位")
_FORWARD, _REVERSE = ("forward", "正转"), ("reverse", "反转")
_COAST = ("coast", "free", "自由", "惯性")
_CONTRARY: dict[Does, tuple[tuple[str, ...], ...]] = {
    "run_forward": (_REVERSE, _JOG, _STOP, _RESET),
    "run_reverse": (_FORWARD, _JOG, _STOP, _RESET),
    "jog_forward": (_REVERSE, _STOP, _RESET),
    "jog_reverse": (_FORWARD, _STOP, _RESET),
    "jog_stop": (_FORWARD, _REVERSE, _RESET, _COAST),
    "stop": (_FORWARD, _REVERSE, _JOG, _RESET, _COAST),
    "coast_stop": (_FORWARD, _REVERSE, _JOG, _RESET),
    "quick_stop": (_FORWARD, _REVERSE, _JOG, _RESET, _COAST),
    "fault_reset": (_FORWARD, _REVERSE, _JOG, _STOP),
    "no_function": (_FORWARD, _REVERSE, _JOG, _STOP, _RESET),
}
"""What the register may not call the value or bit of a command: a swapped code is a motor that turns the wrong way."""
_OWN: dict[Does, tuple[str, ...]] = {"jog_forward": _JOG, "jog_reverse": _JOG, "jog_stop": _JOG, "coast_stop": _COAST}
"""What the register's name for it must hold."""


_MOVES: tuple[Does, ...] = ("run_forward", "run_reverse", "jog_forward", "jog_reverse")
_STOPS: tuple[Does, ...] = ("stop", "coast_stop", "quick_stop")


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
        _releases(command, commands, report)
    for does in ("run_forward", "stop"):
        if does not in seen:
            wrong = f"there is no command `{does}`"
            report.miss(drive.operation.place("commands"), wrong, "a drive that cannot run or stop is of no use")


def _releases(command: Command, commands: tuple[Command, ...], report: Report) -> None:
    """Note a stop that leaves a run bit set, and a direction that leaves the other one set."""
    if command.does not in (*_MOVES, *_STOPS) or not (command.set or command.clear):
        return
    cleared = {number for span in command.clear for number in span}
    for other in commands:
        if (
            other.does not in _MOVES
            or other is command
            or other.register != command.register
            or command.value is not None
        ):
            continue
        left = {n for span in other.set for n in span} - cleared - {n for span in command.set for n in span}
        if left:
            bits = ", ".join(f"{number:X}" for number in sorted(left))
            wrong = f"`{command.does}` leaves bit {bits} as it is, which `{other.does}` sets"
            report.add(command.place("clear"), wrong, "add it to `clear`, so that the two never act together")


def _command(drive: Drive, command: Command, report: Report) -> None:
    if (command.value is None) == (not command.set and not command.clear):
        wrong = f"command `{command.does}` needs a value, or bits to set and clear"
        report.miss(command.at, wrong, "give one of the two")
    row = known(drive, command.register, "w", command.place("register"), report)
    if row is not None:
        _command_value(command, row, report)
        _command_bits(command, row, report)
        for place, name, zh in _names(command, row):
            _contrary(command, place, name, zh, report)


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
            for number in span:
                bit = bit_at(row, number)
                if bit is None or bit.unused:
                    wrong = f"bit {number:X} of {address_text(row.address.first)} is not in use"
                    report.miss(command.place(key), wrong, "name a bit that the register lists")


def _names(command: Command, row: Register) -> Iterator[tuple[str, str, str]]:
    """What the register calls the value or the bits of a command: key of the command, English, Chinese."""
    for value in row.values:
        if value.value == command.value:
            yield "value", value.name, value.text_zh or ""
    for number in (n for span in command.set for n in span):
        bit = bit_at(row, number)
        if bit is not None and not bit.values:
            yield "set", bit.name or "", bit.text_zh or ""


def _contrary(command: Command, key: str, name: str, zh: str, report: Report) -> None:
    words = f"{name.lower()} {zh}"
    wrong = any(word in words for group in _CONTRARY[command.does] for word in group)
    own = _OWN.get(command.does, ("",))
    if wrong or not any(word in words for word in own):
        calls = f"`{command.does}`, but the register calls it `{name}` {zh}".rstrip()
        report.add(command.place(key), calls, "correct the value or bit, or the register's table")
