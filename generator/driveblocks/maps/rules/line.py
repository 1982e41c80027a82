"""Rules on the serial line, keypad settings, limits and functions."""

from collections.abc import Iterator, Sequence

from driveblocks.maps.form import address_text
from driveblocks.maps.model import Choice, Drive, Entry, Function, Serial, Setting
from driveblocks.maps.problem import Report
from driveblocks.maps.rules.parameter import of_form

_CEILINGS = {"read_words": 125, "write_words": 123, "data_bytes": 252, "ascii_data_bytes": 252}
"""MODBUS Application Protocol V1.1b3, 6.3 and 6.12: what fits into a PDU of 253 bytes."""


def check(drive: Drive, report: Report) -> None:
    """Note every rule that the line, the settings, the limits or the functions break."""
    settings = {setting.id: setting for setting in drive.settings}
    _settings(drive, report)
    _serial(drive.serial, settings, report)
    _limits(drive, report)
    _functions(drive.functions, report)


def _settings(drive: Drive, report: Report) -> None:
    seen: set[str] = set()
    for setting in drive.settings:
        if setting.id in seen:
            report.add(setting.place("id"), f"setting `{setting.id}` stands twice", "one entry per setting")
        seen.add(setting.id)
        if not of_form(drive, setting.id):
            forms = ", ".join(drive.id_forms)
            report.add(
                setting.place("id"), f"id `{setting.id}` has none of the manual's forms", f"the forms are {forms}"
            )
        _setting_values(setting, report)
        _setting_register(drive, setting, report)


def _setting_values(setting: Setting, report: Report) -> None:
    codes = [value.value for value in setting.values]
    for value in setting.values:
        if codes.count(value.value) > 1:
            report.add(value.place("value"), f"value {value.value} of {setting.id} stands twice", "one entry per value")
        if setting.range and not setting.range.min <= value.value <= setting.range.max:
            report.add(
                value.place("value"),
                f"value {value.value} of {setting.id} is outside its range",
                "widen `range`, or note an erratum",
            )
    if setting.range and setting.range.min > setting.range.max:
        report.add(
            setting.place("range"), f"the range of {setting.id} runs backwards", "write the smaller number as `min`"
        )
    needed = setting.needed.value if setting.needed else None
    if setting.needed and needed is not None and codes and needed not in codes:
        report.add(
            setting.needed.place("value"), f"{needed} is not a value of {setting.id}", f"its values are {_list(codes)}"
        )


def _setting_register(drive: Drive, setting: Setting, report: Report) -> None:
    if setting.register is None:
        return
    row = drive.register_at(setting.register)
    if row is None or row.id != setting.id:
        held = f"belongs to {row.id or 'a register without id'}" if row else "is in no register table"
        report.add(
            setting.place("register"), f"{address_text(setting.register)} {held}", f"name the register of {setting.id}"
        )


def _list(numbers: Sequence[int]) -> str:
    return ", ".join(map(str, numbers))


def _choices(serial: Serial) -> Iterator[tuple[str, Choice, Sequence[Entry]]]:
    yield "mode", serial.mode, serial.mode.codes
    if serial.baud:
        yield "baud", serial.baud, serial.baud.codes
    if serial.format:
        yield "format", serial.format, serial.format.codes


def _serial(serial: Serial, settings: dict[str, Setting], report: Report) -> None:
    for name, choice, codes in _choices(serial):
        _choice(name, choice, [getattr(code, "code") for code in codes], settings, report)  # noqa: B009
    for code in serial.mode.codes:
        if code.mode not in serial.mode.modes:
            report.add(
                code.place("mode"), f"mode {code.mode} is not among `modes`", "add it there, or remove this code"
            )
    _unit(serial, settings, report)
    if serial.silence and serial.silence.characters is None and serial.silence.milliseconds is None:
        report.add(
            serial.silence.at, "`silence` says neither characters nor milliseconds", "add the one that the manual gives"
        )


def _choice(name: str, choice: Choice, codes: list[int], settings: dict[str, Setting], report: Report) -> None:
    for code in sorted({code for code in codes if codes.count(code) > 1}):
        report.add(choice.place("codes"), f"code {code} of `{name}` stands twice", "one entry per code")
    if choice.default is not None and codes and choice.default not in codes:
        report.add(
            choice.place("default"),
            f"default {choice.default} is not a code of `{name}`",
            f"its codes are {_list(codes)}",
        )
    if choice.setting is None:
        return
    setting = settings.get(choice.setting)
    if setting is None:
        report.add(choice.place("setting"), f"there is no setting `{choice.setting}`", "name an entry of `settings`")
    elif setting.values and codes and sorted(codes) != sorted(value.value for value in setting.values):
        values = _list([value.value for value in setting.values])
        report.add(
            choice.place("codes"),
            f"the codes of `{name}` are not the values of {choice.setting}",
            f"its values are {values}",
        )


def _unit(serial: Serial, settings: dict[str, Setting], report: Report) -> None:
    unit = serial.unit
    if not 0 <= unit.min <= unit.max <= 247:
        report.add(unit.at, f"unit addresses {unit.min} to {unit.max}", "they lie within 1 to 247")
    if unit.setting is not None and unit.setting not in settings:
        report.add(unit.place("setting"), f"there is no setting `{unit.setting}`", "name an entry of `settings`")
    if unit.default is not None and not unit.min <= unit.default <= unit.max:
        report.add(
            unit.place("default"),
            f"default {unit.default} is no unit address of this drive",
            f"it has {unit.min} to {unit.max}",
        )
    cast = serial.broadcast
    if cast and unit.min <= cast.address <= unit.max:
        report.add(
            cast.place("address"), f"broadcast address {cast.address} is also a unit address", "they exclude each other"
        )


def _limits(drive: Drive, report: Report) -> None:
    for name, ceiling in _CEILINGS.items():
        limit = getattr(drive.limits, name)
        if limit is not None and limit.value > ceiling:
            report.add(
                limit.place("value"), f"{name} {limit.value} does not fit a Modbus frame", f"at most {ceiling} do"
            )
    if drive.limits.ascii_data_bytes and "ascii" not in drive.serial.mode.modes:
        report.add(
            drive.limits.place("ascii_data_bytes"),
            "a limit for ASCII frames, but the drive speaks no ASCII",
            "remove it",
        )


def _functions(functions: tuple[Function, ...], report: Report) -> None:
    seen: set[int] = set()
    for function in functions:
        if not 1 <= function.code <= 0x7F:
            report.add(function.place("code"), f"function {function.code:02X}H", "function codes lie within 01H to 7FH")
        if function.code in seen:
            report.add(function.place("code"), f"function {function.code:02X}H stands twice", "one entry per function")
        if function.sub_functions and function.code != 0x08:
            report.add(function.place("sub_functions"), "only function 08H has sub-functions", "remove them")
        seen.add(function.code)
