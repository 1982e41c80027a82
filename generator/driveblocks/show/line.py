"""The serial line: what it speaks, what fits into a frame, and the the keypad settings for it."""

from collections.abc import Iterable, Iterator

from rich.console import RenderableType

from driveblocks.maps.form import address_text
from driveblocks.maps.model import (
    BaudCode,
    Choice,
    Drive,
    FormatCode,
    Function,
    Limits,
    ModeCode,
    Serial,
    Setting,
    StopBitsCode,
)
from driveblocks.meaning import conduct
from driveblocks.meaning.plug import plug
from driveblocks.meaning.serial import PARITIES
from driveblocks.meaning.setting import Keypad, in_order, keypad_of
from driveblocks.meaning.setting import setting as setting_of
from driveblocks.show.errata import corroborated
from driveblocks.show.faults import recorded
from driveblocks.show.layout import both, card, choices, code_text, facts, heading, listed

_TOLERATED = {"two_byte_count": ("byte count", "of a read may be a word")}
_LIMITS = {
    "read_words": "words in one read",
    "write_words": "words in one write",
    "group": "addresses of a group, which no request may cross",
    "data_bytes": "data bytes in an RTU frame",
    "ascii_data_bytes": "data bytes in an ASCII frame",
}


def serial(drive: Drive) -> Iterator[RenderableType]:
    yield from line(drive)
    yield from settings(drive)
    yield from recorded(drive, "serial", "")


def line(drive: Drive) -> Iterator[RenderableType]:
    known = drive.serial
    yield heading("Serial line")
    yield facts(
        ("interface", both(known.interface.en, known.interface.own)),
        ("connected at", _plug(drive)),
        ("mode", _choice(known.mode, map(_mode, known.mode.codes), listed(known.mode.modes).upper())),
        ("bit rate", known.baud and _choice(known.baud, map(_baud, known.baud.codes))),
        ("format", known.format and _choice(known.format, map(_format, known.format.codes))),
        ("stop bits", known.stop_bits and _choice(known.stop_bits, map(_stops, known.stop_bits.codes))),
        ("unit address", _unit(known)),
        ("silence", _silence(known)),
        ("replies later", conduct.reply_delay(drive)),
        ("broadcast", _broadcast(known)),
    )
    yield heading("Limits")
    yield limits(drive.limits)
    yield heading("Functions")
    yield from map(of_function, drive.functions)
    yield from tolerances(drive)


def _plug(drive: Drive) -> str:
    """Which wire goes where; nothing where no text says."""
    own = plug(drive)
    wires = {"+": own.at("positive"), "-": own.at("negative"), "common": own.at("common")}
    return "; ".join(filter(None, (own.connector, *(f"{wire} {at}" for wire, at in wires.items() if at))))


def _mode(code: ModeCode) -> str:
    return f"{code.code} = {code.mode.upper()}"


def _baud(code: BaudCode) -> str:
    return _coded(code, f"{code.baud} bit/s")


def _format(code: FormatCode) -> str:
    """As people write it, 8E1, where the manual gives all three parts; else each part, with what it does not give."""
    if code.data_bits is None or code.stop_bits is None:
        return _coded(
            code, f"parity {code.parity}, {code.data_bits or '?'} data bits, {code.stop_bits or '?'} stop bits"
        )
    return _coded(code, f"{code.data_bits}{PARITIES[code.parity]}{code.stop_bits}")


def _stops(code: StopBitsCode) -> str:
    return f"{code.code} = {code.stop_bits}"


def _coded(code: BaudCode | FormatCode, words: str) -> str:
    """What a code chooses, or what the drive has without one."""
    return f"{words}{' (as delivered)' if code.delivered else ''}" if code.code is None else f"{code.code} = {words}"


def _choice(choice: Choice, codes: Iterable[str], always: str = "") -> str:
    known = listed(codes)
    setting = f"by {choice.setting}: " if choice.setting else ""
    default = "" if choice.default is None else f"; factory setting {choice.default}"
    parts = [always, f"{setting}{known}{default}" if known or setting or default else "", f"({choice.source})"]
    return "  ".join(part for part in parts if part)


def _unit(line: Serial) -> str:
    unit = line.unit
    setting = f" by {unit.setting}" if unit.setting else ""
    default = "" if unit.default is None else f"; factory setting {unit.default}"
    default += "" if unit.no_address is None else f"; at {unit.no_address} it answers nobody"
    beyond = f"; beyond the standard's 247 by {unit.above_247}" if unit.above_247 else ""
    return f"{unit.min} to {unit.max}{setting}{default}  ({unit.source}{beyond})"


def _silence(line: Serial) -> str | None:
    silence = line.silence
    if silence is None:
        return None
    parts = [f"{silence.characters} characters around a frame"] if silence.characters is not None else []
    parts += [f"{silence.milliseconds} ms around a frame"] if silence.milliseconds is not None else []
    parts += [f"at most {silence.gap_characters} characters inside"] if silence.gap_characters is not None else []
    return f"{listed(parts)}  ({silence.source})"


def _broadcast(line: Serial) -> str | None:
    cast = line.broadcast
    if cast is None:
        return None
    starts = f", only from {listed(map(address_text, cast.start_addresses))}" if cast.start_addresses else ""
    return f"address {cast.address}, {'answered' if cast.replies else 'not answered'}{starts}  ({cast.source})"


def limits(known: Limits) -> RenderableType:
    """What fits into one frame."""
    lines = []
    for key, meaning in _LIMITS.items():
        limit = getattr(known, key)
        if limit is not None:
            lines.append((f"{limit.value}", f"{meaning}  ({limit.source})"))
    return facts(*lines) if lines else "the manual gives none"


def of_function(function: Function) -> RenderableType:
    subs = [(f"  {sub.code:04X}H", both(sub.name, sub.own)) for sub in function.sub_functions]
    unsent = "" if function.sent else "; no block sends it"
    text = f"{both(function.name, function.own)}{unsent}  ({function.source})"
    return facts((code_text(function.code), text), *subs)


def tolerances(drive: Drive) -> Iterator[RenderableType]:
    """What replies of this drive are allowed beyond the standard; nothing for most drives."""
    if drive.tolerances:
        yield heading("Tolerated in replies")
        for each in drive.tolerances:
            label, what = _TOLERATED[each.kind]
            yield facts((label, f"{what}: {each.why}  ({each.source})"))


def settings(drive: Drive) -> Iterator[RenderableType]:
    """The settings in the order in which a person meets them."""
    needed = sum(setting.needed is not None for setting in drive.settings)
    yield heading(f"Keypad settings: {len(drive.settings)}, of which the drive needs {needed} before it listens")
    by_id = {one.id: one for one in drive.settings}
    for one in in_order(drive):
        yield of_setting(drive, by_id[one.id])


def of_setting(drive: Drive, setting: Setting) -> RenderableType:
    keypad = keypad_of(drive, setting)
    values = [(_number(keypad, value.value), value.name, value.own, value.note or "") for value in setting.values]
    return card(
        f"{setting.id}  {both(setting.name, setting.own)}",
        ("needed", _needed(setting, keypad)),
        ("keypad", _keypad(setting, keypad)),
        ("printed", setting.zh if setting.zh_used else None),
        ("register", address_text(setting.register) if setting.register is not None else None),
        ("range", _range(setting, keypad)),
        ("step", setting.unit_step),
        ("factory", _factory(drive, setting)),
        ("values", choices(values)),
        ("note", setting.note),
        ("also says", corroborated(drive, setting.corroborated)),
        ("source", setting.source),
    )


def _range(setting: Setting, keypad: Keypad) -> str | None:
    bounds = setting.range
    return f"{keypad.plain(bounds.min)} to {keypad.shown(bounds.max)}" if bounds else None


def _keypad(setting: Setting, keypad: Keypad) -> str | None:
    """What it is called there, where in the menu, and how it shows numbers, as far as that differs."""
    said = [keypad.code] if keypad.code != setting.id else []
    said += [f"in the menu {keypad.menu}"] if keypad.menu else []
    said += ["in hexadecimal"] if keypad.hexadecimal else []
    said += [f"in {keypad.unit}"] if keypad.unit else []
    said += [f"a count on the bus is {keypad.shown(1)}"] if keypad.factor is not None else []
    return "; ".join(said) or None


def _number(keypad: Keypad, number: int) -> str:
    """What the keypad shows for a number, and the number on the bus where that is another."""
    shown = keypad.shown(number)
    return shown if shown == str(number) else f"{shown} ({number} on the bus)"


def _factory(drive: Drive, setting: Setting) -> str | None:
    known = setting_of(drive, setting.id)
    number = known.factory if known else None
    if known is None or number is None:
        return setting.default or _editions(setting)
    return _number(known.keypad, number)


def _editions(setting: Setting) -> str | None:
    return " or ".join(f"{each.default} ({each.edition}, {each.source})" for each in setting.editions) or None


def _needed(setting: Setting, keypad: Keypad) -> str | None:
    if setting.needed is None:
        return None
    needed = setting.needed
    value = f"{' or '.join(map(keypad.shown, needed.right))}: " if needed.right else ""
    other = "" if needed.by_terminals is None else f" ({keypad.shown(needed.by_terminals)}: from the drive's terminals)"
    return f"{value}{needed.why}{other}"
