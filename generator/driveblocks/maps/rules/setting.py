"""Rules on keypad settings: their values, their registers, and the codes of the serial line that they choose."""

import re
from collections.abc import Iterator, Sequence

from driveblocks.maps.form import address_text
from driveblocks.maps.model import (
    BaudCode,
    Choice,
    Drive,
    FormatCode,
    ModeCode,
    Serial,
    Setting,
    StopBitsCode,
    Switch,
    UnitAddress,
    Value,
)
from driveblocks.maps.problem import Report
from driveblocks.maps.rules.parameter import of_form
from driveblocks.maps.rules.unique import unique

Code = ModeCode | BaudCode | FormatCode | StopBitsCode
_NOTATION = re.compile(r"\b([78])\W{0,3}([NEO])\W{0,3}([12])\b")
_PARITIES = {"N": "none", "E": "even", "O": "odd"}
_RATE = re.compile(r"[0-9]{3,}")
_MODE = re.compile(r"\b(rtu|ascii)\b", re.IGNORECASE)
_MS = {"s": 1000, "ms": 1}
_PARITY_WORDS = (("无校验", "none"), ("偶校验", "even"), ("奇校验", "odd"))


def check(drive: Drive, report: Report) -> None:
    """Note every rule that a setting breaks, or a choice of the serial line that rests on it."""
    settings = unique(drive.settings, "id", "setting", report)
    registers = {row.id: row.address.first for _, row in drive.registers() if row.id is not None}
    for setting in drive.settings:
        of_form(drive, setting, setting.id, report)
        _values(setting, report)
        _numbers(setting, report)
        _editions(setting, report)
        _display(drive, setting, report)
        _register(drive, setting, registers.get(setting.id), report)
    if drive.profile is not None:
        _profile(drive, drive.profile, report)
    for _, row in drive.registers():
        if row.scale is not None and row.scale.needs is not None:
            must_be(drive, row.scale.needs, "the scale holds", report)
    for name, choice, codes in _choices(drive.serial):
        _choice(name, choice, codes, report)
        if choice.setting is not None:
            _chosen(name, choice, codes, settings.get(choice.setting), report)
    unit = drive.serial.unit
    if unit.setting is not None:
        _chosen("unit", unit, (), settings.get(unit.setting), report)
    if unit.no_address is not None:
        _no_address(unit, unit.no_address, settings.get(unit.setting or ""), report)


def _profile(drive: Drive, profile: Switch, report: Report) -> None:
    must_be(drive, profile, "this map holds", report)
    setting = next((each for each in drive.settings if each.id == profile.setting), None)
    if setting is not None and setting.register is None:
        wrong = f"nobody can read {setting.id}, which chooses the profile"
        report.miss(profile.place("setting"), wrong, "add its `register`")


def must_be(drive: Drive, switch: Switch, what: str, report: Report) -> None:
    """Note a setting on which something rests, and that no person is asked to set so."""
    setting = next((each for each in drive.settings if each.id == switch.setting), None)
    if setting is None:
        report.miss(switch.place("setting"), f"there is no setting `{switch.setting}`", "name an entry of `settings`")
    elif setting.needed is None or setting.needed.right != (switch.value,):
        wrong = f"{what} while {setting.id} is {switch.value}, and it is not `needed` so"
        report.miss(switch.place("value"), wrong, f"add `needed: {{value: {switch.value}, why: ...}}` to {setting.id}")


def _values(setting: Setting, report: Report) -> None:
    unique(setting.values, "value", f"{setting.id}: value", report, str)
    allowed = setting.range
    for value in setting.values:
        if allowed and not allowed.holds(value.value):
            wrong = f"value {value.value} of {setting.id} is outside its range"
            report.add(value.place("value"), wrong, "widen `range`, or note an erratum")
    if allowed and allowed.min > allowed.max:
        wrong = f"the range of {setting.id} runs backwards"
        report.add(setting.place("range"), wrong, "write the smaller number as `min`")


def _numbers(setting: Setting, report: Report) -> None:
    """What the setting must be, and its factory setting where that is printed in plain decimal."""
    needed = setting.needed
    if needed is not None:
        numbers = [("value", needed.value), ("by_terminals", needed.by_terminals)]
        for key, number in numbers:
            wrong = _impossible(setting, number) if number is not None else ""
            if wrong:
                report.miss(needed.place(key), f"needed is {number}, but {wrong}", "correct one of them")
    default = _decimal(setting.default)
    if default is not None:
        wrong = _impossible(setting, default)
        if wrong:
            right = "correct one of them; where the manual prints both, leave `default` out and add an erratum"
            report.miss(setting.place("default"), f"default is {default}, but {wrong}", right)


def _editions(setting: Setting, report: Report) -> None:
    """Note factory settings by edition that are none, or that nobody is asked to look up."""
    some = setting.editions
    if not some:
        return
    if setting.default is not None:
        report.add(setting.place("default"), "`default` beside `editions`", "leave it out: each edition has its own")
    if len({each.default for each in some}) == 1:
        wrong = f"{setting.id} is {some[0].default} in every edition named"
        report.add(setting.place("editions"), wrong, "write it as `default`, or add the edition that differs")
    for each in some:
        number = _decimal(each.default)
        if number is not None and (wrong := _impossible(setting, number)):
            report.miss(each.place("default"), f"default is {number}, but {wrong}", "correct one of them")
    if setting.needed is None:
        wrong = f"what {setting.id} is as delivered differs by edition, and nothing says what to set"
        report.miss(setting.place("editions"), wrong, "add `needed: {why: ...}`: a person has to look it up")


def _display(drive: Drive, setting: Setting, report: Report) -> None:
    """Note texts that no person can tell apart, and a scale that has no unit or that the watchdog does not have."""
    texts = [each for each in setting.values if each.display is not None]
    unique(texts, "display", f"{setting.id}: display", report, str)
    own = setting.display
    if own is None or own.factor is None:
        return
    if own.unit is None or own.factor <= 0:
        wrong = f"the keypad shows {setting.id} on a scale of {own.factor} without a unit, or not above 0"
        report.miss(own.place("factor"), wrong, "add `unit: s`, and what one count is in it")
    time, delay = drive.watchdog.time if drive.watchdog else None, drive.serial.reply_delay
    for each in (time, delay):
        counted = own.factor * _MS.get(own.unit or "", 0)
        if each and each.setting == setting.id and counted and counted != each.milliseconds:
            wrong = f"a count of {setting.id} is {counted.normalize():f} ms here, and {each.milliseconds} ms elsewhere"
            report.add(own.place("factor"), wrong, "the manual's table decides which of the two is wrong")


def _no_address(unit: UnitAddress, number: int, setting: Setting | None, report: Report) -> None:
    """Note a number for no address that is one, or that no person is asked to change."""
    if unit.min <= number <= unit.max:
        report.add(
            unit.place("no_address"), f"{number} is a unit address of this drive", f"it has {unit.min} to {unit.max}"
        )
    if unit.setting is None:
        report.miss(unit.place("no_address"), "no setting that holds it", "add `setting`, an entry of `settings`")
    elif setting is not None and (wrong := _impossible(setting, number)):
        report.miss(unit.place("no_address"), f"it is {number}, but {wrong}", "correct one of them")
    elif setting is not None and unit.silent and setting.needed is None:
        wrong = f"the drive answers nobody until {setting.id} is set, and it is not `needed`"
        report.miss(unit.place("no_address"), wrong, f"add `needed: {{why: ...}}` to {setting.id}")


def _impossible(setting: Setting, number: int) -> str:
    codes = [value.value for value in setting.values]
    if codes and number not in codes:
        return f"the values of {setting.id} are {_list(codes)}"
    allowed = setting.range
    if allowed and not allowed.holds(number):
        return f"the range of {setting.id} is {allowed.min} to {allowed.max}"
    return ""


def _register(drive: Drive, setting: Setting, listed: int | None, report: Report) -> None:
    if setting.register is None:
        if listed is not None:
            wrong = f"setting {setting.id} has no `register`, but a table lists it at {address_text(listed)}"
            report.add(setting.place("id"), wrong, f"add `register: {address_text(listed)}`")
        return
    row = drive.register_at(setting.register)
    if row is None or row.id != setting.id:
        held = f"belongs to {row.id or 'a register without id'}" if row else "is in no register table"
        wrong = f"{address_text(setting.register)} {held}"
        there = f"name the register of {setting.id}, {address_text(listed)}" if listed is not None else ""
        none = f"add a row with `id: {setting.id}` to its register table, or leave `register` out"
        report.miss(setting.place("register"), wrong, there or none)


def _list(numbers: Sequence[int]) -> str:
    return ", ".join(map(str, numbers))


def _choices(serial: Serial) -> Iterator[tuple[str, Choice, Sequence[Code]]]:
    yield "mode", serial.mode, serial.mode.codes
    if serial.baud:
        yield "baud", serial.baud, serial.baud.codes
    if serial.format:
        yield "format", serial.format, serial.format.codes
    if serial.stop_bits:
        yield "stop_bits", serial.stop_bits, serial.stop_bits.codes


def _choice(name: str, choice: Choice, codes: Sequence[Code], report: Report) -> None:
    unique([code for code in codes if code.code is not None], "code", f"`{name}`: code", report, str)
    numbers = [code.code for code in codes if code.code is not None]
    _uncoded(name, choice, codes, report)
    if choice.default is not None and numbers and choice.default not in numbers:
        wrong = f"default {choice.default} is not a code of `{name}`"
        report.miss(choice.place("default"), wrong, f"its codes are {_list(numbers)}")


def _uncoded(name: str, choice: Choice, codes: Sequence[Code], report: Report) -> None:
    """Note what has no code though a setting chooses it, and what is as delivered twice."""
    bare = [code for code in codes if code.code is None]
    if bare and (choice.setting is not None or len(bare) < len(codes)):
        wrong = f"{choice.setting or 'a code'} chooses `{name}`, but this has no code"
        report.miss(bare[0].at, wrong, "add `code`, or leave `setting` and all codes out")
    delivered = [code for code in codes if getattr(code, "delivered", False)]
    for code in delivered[len(bare) > 1 :]:
        right = "mark one of several without codes; a code is named by `default`, and a single one needs no mark"
        report.add(code.place("delivered"), f"`delivered` marks this in `{name}`, too", right)


def _chosen(
    name: str, choice: Choice | UnitAddress, codes: Sequence[Code], setting: Setting | None, report: Report
) -> None:
    if setting is None:
        wrong = f"there is no setting `{choice.setting}`"
        report.miss(choice.place("setting"), wrong, "name an entry of `settings`")
        return
    values = {value.value: value for value in setting.values}
    if values and codes and set(values) != {code.code for code in codes}:
        wrong = f"the codes of `{name}` are not the values of {setting.id}"
        report.miss(choice.place("codes"), wrong, f"its values are {_list(list(values))}")
    for code in codes:
        if code.code is not None and code.code in values:
            _same(code, values[code.code], setting, report)
    _same_default(name, choice, setting, report)


def _same_default(name: str, choice: Choice | UnitAddress, setting: Setting, report: Report) -> None:
    if choice.default is not None and setting.editions:
        wrong = f"default {choice.default} of `{name}`, but {setting.id} has another in each edition"
        report.add(choice.place("default"), wrong, "leave it out: a person has to look it up")
    printed = _decimal(setting.default)
    if None not in (choice.default, printed) and choice.default != printed:
        wrong = f"default {choice.default} of `{name}`, but {setting.id} has {printed}"
        report.add(choice.place("default"), wrong, "the manual's table decides which of the two is wrong")


def _decimal(printed: str | None) -> int | None:
    """A number printed in plain decimal; a factory setting may also be text, or hexadecimal."""
    return int(printed[:9]) if printed is not None and printed.isascii() and printed.isdecimal() else None


def _same(code: Code, value: Value, setting: Setting, report: Report) -> None:
    """Note a code that says something else than the words of the setting's value."""
    for key, said in _said(value.zh or value.wording or "") | _said(value.name):
        own = getattr(code, key, None)
        if own is not None and own != said:
            wrong = f"`{key}: {own}`, but value {value.value} of {setting.id} says {said}"
            report.add(code.place(key), wrong, "the manual's table decides which of the two is wrong")


def _said(words: str) -> set[tuple[str, str | int]]:
    """What the words for a code say in an unambiguous notation: 9600 bit/s, RTU, <8, N, 1>, 偶校验."""
    said: set[tuple[str, str | int]] = {("baud", int(rate[:9])) for rate in _RATE.findall(words)}
    said |= {("mode", mode.lower()) for mode in _MODE.findall(words)}
    said |= {("parity", parity) for word, parity in _PARITY_WORDS if word in words}
    for data_bits, parity, stop_bits in _NOTATION.findall(words):
        said |= {("data_bits", int(data_bits)), ("parity", _PARITIES[parity]), ("stop_bits", int(stop_bits))}
    return said
