"""Rules on commands, the speed reference, and what proves standstill."""

from collections.abc import Iterator

from driveblocks.maps.form import Span, address_text, bits_text
from driveblocks.maps.model import Bit, Command, Condition, Does, Drive, Operation, Range, Reference, Register
from driveblocks.maps.problem import Report
from driveblocks.maps.rules.access import known
from driveblocks.maps.rules.parameter import of_form
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


def check(drive: Drive, report: Report) -> None:
    """Note every rule that commands, reference or conditions break."""
    _commands(drive, report)
    _reference(drive, drive.operation.reference, report)
    _standstill(drive, drive.operation, report)
    for _, row in drive.registers():
        if row.scale is not None and row.scale.when is not None:
            _condition(drive, row.scale.when, report)


def _commands(drive: Drive, report: Report) -> None:
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
    for does in ("run_forward", "stop"):
        if does not in seen:
            wrong = f"there is no command `{does}`"
            report.miss(drive.operation.place("commands"), wrong, "a drive that cannot run or stop is of no use")


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
                bit = _bit_at(row, number)
                if bit is None or bit.unused:
                    wrong = f"bit {number:X} of {address_text(row.address.first)} is not in use"
                    report.miss(command.place(key), wrong, "name a bit that the register lists")


def _bit_at(row: Register, number: int) -> Bit | None:
    return next((bit for bit in row.bits if number in bit.bit), None)


def _names(command: Command, row: Register) -> Iterator[tuple[str, str, str]]:
    """What the register calls the value or the bits of a command: key of the command, English, Chinese."""
    for value in row.values:
        if value.value == command.value:
            yield "value", value.name, value.text_zh
    for number in (n for span in command.set for n in span):
        bit = _bit_at(row, number)
        if bit is not None and not bit.values:
            yield "set", bit.name or "", bit.text_zh or ""


def _contrary(command: Command, key: str, name: str, zh: str, report: Report) -> None:
    words = f"{name.lower()} {zh}"
    wrong = any(word in words for group in _CONTRARY[command.does] for word in group)
    own = _OWN.get(command.does, ("",))
    if wrong or not any(word in words for word in own):
        calls = f"`{command.does}`, but the register calls it `{name}` {zh}"
        report.add(command.place(key), calls, "correct the value or bit, or the register's table")


def _reference(drive: Drive, reference: Reference, report: Report) -> None:
    row = known(drive, reference.register, "w", reference.place("register"), report)
    for condition in reference.verify:
        _condition(drive, condition, report)
    if row is None:
        return
    if reference.negative_reverses and not row.signed:
        wrong = f"a negative reference, but {address_text(reference.register)} is not signed"
        report.add(reference.place("negative_reverses"), wrong, "add `signed: true` to the register")
    unit = "Hz" if reference.means == "frequency" else "%"
    if row.unit not in (None, unit):
        wrong = f"the reference means {reference.means}, but {address_text(reference.register)} has the unit {row.unit}"
        report.add(reference.place("means"), wrong, "correct one of them")
    when = row.scale.when if row.scale else None
    if when is not None and when not in reference.verify:
        wrong = f"the scale of {address_text(reference.register)} has a condition that nobody verifies"
        report.miss(reference.place("verify"), wrong, "repeat the condition of `when` under `verify`")
    _maximum(drive, reference, report)


def _maximum(drive: Drive, reference: Reference, report: Report) -> None:
    if reference.maximum is None:
        if reference.means == "percent_of_maximum":
            wrong = "the reference is a percentage, but nothing says of what"
            report.miss(reference.at, wrong, "add `maximum` with the id of that parameter")
        return
    of_form(drive, reference, reference.maximum, report, "maximum")
    ids = {row.id for _, row in drive.registers()} | {setting.id for setting in drive.settings}
    if not drive.areas and reference.maximum not in ids:
        wrong = f"there is no parameter `{reference.maximum}`"
        report.miss(reference.place("maximum"), wrong, "name the id of a register or setting")


def _standstill(drive: Drive, operation: Operation, report: Report) -> None:
    proof = operation.standstill
    for condition in proof.all:
        _condition(drive, condition, report)
    if len({condition.register for condition in proof.all}) < 2:
        wrong = "one register alone does not prove standstill"
        report.miss(proof.place("all"), wrong, "ask for the status and for an output frequency of 0")
    if not any(condition.bit is None and condition.equals == 0 for condition in proof.all):
        wrong = "no condition says that an output frequency is 0"
        report.miss(proof.place("all"), wrong, "add {register: its address, equals: 0}")


def _condition(drive: Drive, condition: Condition, report: Report) -> None:
    row = known(drive, condition.register, "r", condition.place("register"), report)
    bits = condition.bit or Span(0, 15)
    if condition.bit is not None and not condition.bit:
        wrong = f"bits {bits_text(condition.bit)} run backwards"
        report.add(condition.place("bit"), wrong, "write the lower bit first")
        return
    if not 0 <= condition.equals < 1 << len(bits):
        wrong = f"{condition.equals} does not fit {len(bits)} bit{'s' * (len(bits) > 1)}"
        report.add(condition.place("equals"), wrong, f"write 0 to {(1 << len(bits)) - 1}")
    elif row is not None:
        _condition_value(condition, row, report)


def _condition_value(condition: Condition, row: Register, report: Report) -> None:
    what = address_text(condition.register)
    values = row.values
    if condition.bit is not None:
        what = f"bit {bits_text(condition.bit)} of {what}"
        bit = _bit_at(row, condition.bit.first)
        if bit is None or bit.unused or bit.bit != condition.bit:
            wrong = f"{what} is not a listed bit or field"
            report.miss(condition.place("bit"), wrong, "name a bit that the register lists")
        values = bit.values if bit is not None else ()
    if values and condition.equals not in {value.value for value in values}:
        wrong = f"{condition.equals} is no value of {what}"
        report.miss(condition.place("equals"), wrong, "write one of the listed values")
