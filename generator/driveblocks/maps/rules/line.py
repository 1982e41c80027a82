"""Rules on the serial line, the limits of frames, and the functions."""

from driveblocks.maps.form import address_text
from driveblocks.maps.model import Broadcast, Drive, Function, Plug, ReplyDelay, Serial, Silence
from driveblocks.maps.plan import OF_BITS
from driveblocks.maps.problem import Report
from driveblocks.maps.rules.unique import unique

STANDARD_UNITS = 247
"""MODBUS over Serial Line V1.02, 2.2: the last unit address; 248 to 255 are reserved."""

_CEILINGS = {"read_words": 125, "write_words": 123, "data_bytes": 252, "ascii_data_bytes": 252}
"""MODBUS Application Protocol V1.1b3, 6.3 and 6.12: what fits into a PDU of 253 bytes."""

PINS = {"rj45": 8, "d_sub": 9}
"""How many a plug has."""

MOST_GROUP = 0x8000
"""Half of all addresses: a larger group holds them all, or all but a few."""

SENT = frozenset({0x03, 0x04, 0x06, 0x08, 0x10})
"""Functions that blocks know: what a manual lists beside them and those of coils is a fact that nobody can use."""


def check(drive: Drive, report: Report) -> None:
    _modes(drive.serial, report)
    _unit(drive.serial, report)
    _stop_bits(drive.serial, report)
    if drive.serial.silence is not None:
        _silence(drive.serial.silence, report)
    if drive.serial.reply_delay is not None:
        _reply_delay(drive, drive.serial.reply_delay, report)
    if drive.serial.broadcast is not None:
        _broadcast(drive, drive.serial.broadcast, report)
    if drive.serial.pins is not None:
        _plug(drive.serial.pins, report)
    _limits(drive, report)
    _functions(drive, report)
    unique(drive.tolerances, "kind", "tolerance", report)


def _modes(serial: Serial, report: Report) -> None:
    modes = serial.mode.modes
    if not modes or len(set(modes)) != len(modes):
        report.add(serial.mode.place("modes"), "`modes` is empty or names one twice", "write [rtu], [ascii] or both")
    for code in serial.mode.codes:
        if modes and code.mode not in modes:
            wrong = f"mode {code.mode} is not among `modes`"
            report.add(code.place("mode"), wrong, "add it there, or remove this code")


def _stop_bits(serial: Serial, report: Report) -> None:
    """Note stop bits that two settings choose, or that have no parity beside them."""
    stops, forms = serial.stop_bits, serial.format
    if stops is not None and forms is None:
        report.miss(stops.at, "`stop_bits` without `format`", "add `format` with the codes of the parity")
    for code in forms.codes if stops is not None and forms is not None else ():
        if code.stop_bits is not None:
            wrong = f"stop bits by {stops.setting if stops else ''}, and by a code of `format`, too"
            report.add(code.place("stop_bits"), wrong, "leave them out here, or remove `stop_bits` of `serial`")


def _unit(serial: Serial, report: Report) -> None:
    unit = serial.unit
    if not 0 <= unit.min <= unit.max <= 255:
        report.add(unit.at, f"unit addresses {unit.min} to {unit.max}", "Modbus has 1 to 247; write the smaller first")
    elif unit.max > STANDARD_UNITS and unit.above_247 is None:
        wrong = f"unit addresses to {unit.max}, but the standard reserves 248 to 255"
        report.miss(unit.place("max"), wrong, "write 247, or add `above_247:` with the place where the manual says so")
    elif unit.max <= STANDARD_UNITS and unit.above_247 is not None:
        wrong = f"`above_247`, but the addresses end at {unit.max}"
        report.add(unit.place("above_247"), wrong, "remove it, or correct `max`")
    if unit.default is not None and not unit.min <= unit.default <= unit.max and not unit.silent:
        wrong = f"default {unit.default} is no unit address of this drive"
        report.add(unit.place("default"), wrong, f"it has {unit.min} to {unit.max}")


def _silence(silence: Silence, report: Report) -> None:
    if silence.characters is None and silence.milliseconds is None:
        wrong = "`silence` says neither characters nor milliseconds"
        report.miss(silence.at, wrong, "add the one that the manual gives")
    for key in ("characters", "milliseconds", "gap_characters"):
        value = getattr(silence, key)
        if value is not None and value <= 0:
            report.add(silence.place(key), f"`{key}: {value}` is no time", "write a number above 0")
    gap, characters = silence.gap_characters, silence.characters
    if gap is not None and characters is not None and gap >= characters:
        wrong = f"a pause of {gap} characters inside a frame, where {characters} end it"
        report.add(silence.place("gap_characters"), wrong, "the pause inside a frame is the shorter one")


def _reply_delay(drive: Drive, delay: ReplyDelay, report: Report) -> None:
    if delay.setting not in {each.id for each in drive.settings}:
        wrong = f"there is no setting `{delay.setting}`"
        report.miss(delay.place("setting"), wrong, "name an entry of `settings`")
    if delay.milliseconds <= 0:
        wrong = f"{delay.milliseconds} ms is no time"
        report.add(delay.place("milliseconds"), wrong, "write how long one count is, in ms")


def _broadcast(drive: Drive, cast: Broadcast, report: Report) -> None:
    unit = drive.serial.unit
    if unit.min <= cast.address <= unit.max:
        wrong = f"broadcast address {cast.address} is also a unit address"
        report.add(cast.place("address"), wrong, "they exclude each other")
    if not 0 <= cast.address <= 255:
        report.add(cast.place("address"), f"broadcast address {cast.address}", "an address is one byte, 0 to 255")
    for start in cast.start_addresses:
        if drive.row_at(start) is None and not any(start in area.addresses for area in drive.areas):
            wrong = f"{address_text(start)} is in no register table or area"
            report.miss(cast.place("start_addresses"), wrong, "name listed registers")


def _plug(plug: Plug, report: Report) -> None:
    """Note a pin that is there twice or that its connector has not, and wires that are no pair."""
    unique(plug.pins, "pin", "pin", report)
    most = PINS.get(plug.connector or "", 0)
    for one in plug.pins:
        if most and one.pin.isdecimal() and one.pin not in map(str, range(1, most + 1)):
            report.add(one.place("pin"), f"pin {one.pin} of {most}", f"`{plug.connector}` has pins 1 to {most}")
    if len(wires := {one.wire for one in plug.pins} & {"positive", "negative"}) == 1:
        report.add(plug.place("pins"), f"a {min(wires)} wire alone", "name the other, too")
    said = (plug.pins, plug.termination, plug.bias, plug.shield, plug.never)
    if plug.connector is None and not any(said):
        report.miss(plug.at, "`pins` that say nothing", "add what the text says, or an entry of `absent`")
    elif plug.pins and plug.connector is None:
        report.miss(plug.at, "pins of no connector", "add `connector: rj45`, `terminals` or `d_sub`")


def _limits(drive: Drive, report: Report) -> None:
    for name, ceiling in _CEILINGS.items():
        limit = getattr(drive.limits, name)
        if limit is not None and limit.value > ceiling:
            wrong = f"{name} {limit.value} does not fit a Modbus frame"
            report.add(limit.place("value"), wrong, f"at most {ceiling} do")
    group = drive.limits.group
    if group is not None and group.value > MOST_GROUP:
        wrong = f"groups of {group.value} addresses keep nothing apart"
        report.add(group.place("value"), wrong, f"write {MOST_GROUP} at most, or remove it")
    if drive.limits.ascii_data_bytes and "ascii" not in drive.serial.mode.modes:
        wrong = "a limit for ASCII frames, but the drive speaks no ASCII"
        report.add(drive.limits.place("ascii_data_bytes"), wrong, "remove it, or add ascii to `modes`")
    if drive.limits.data_bytes and drive.serial.mode.modes == ("ascii",):
        wrong = "a limit for RTU frames, but the drive speaks no RTU"
        report.add(drive.limits.place("data_bytes"), wrong, "remove it, add rtu to `modes`, or use `ascii_data_bytes`")


def _functions(drive: Drive, report: Report) -> None:
    known = unique(drive.functions, "code", "function", report, "{:02X}H".format)
    for function in drive.functions:
        _function(function, report)
    for use, codes in (("read", (0x03, 0x04)), ("write", (0x06, 0x10))):
        if not any(code in known for code in codes):
            wrong = f"no function to {use} registers"
            right = "list " + " or ".join(f"{code:02X}H" for code in codes)
            report.miss(drive.place("functions"), wrong, right)


def _function(function: Function, report: Report) -> None:
    unique(function.sub_functions, "code", "sub-function", report, "{:04X}H".format)
    for sub in function.sub_functions:
        if not 0 <= sub.code <= 0xFFFF:
            report.add(sub.place("code"), f"sub-function {sub.code:X}H", "a sub-function is a word, 0000H to FFFFH")
    if not 1 <= function.code <= 0x7F:
        wrong = f"function {function.code:02X}H is no Modbus function"
        report.add(function.place("code"), wrong, "function codes are 01H to 7FH")
    else:
        _sent(function, report)
    if function.sub_functions and function.code != 0x08:
        report.add(function.place("sub_functions"), "only function 08H has sub-functions", "remove them")


def _sent(function: Function, report: Report) -> None:
    """Note a function that no block sends and that the map does not mark so, and the mark on one that they send."""
    what = f"function {function.code:02X}H"
    if function.sent and function.code not in SENT | OF_BITS:
        wrong = f"no block sends {what}, only " + ", ".join(f"{code:02X}H" for code in sorted(SENT | OF_BITS))
        report.add(function.place("code"), wrong, "add `sent: false`, so that nobody counts on it")
    elif not function.sent and function.code in SENT:
        report.add(function.place("sent"), f"blocks send {what}", "remove `sent: false`")
    if function.code == 0x08 and not function.sub_functions:
        wrong = "function 08H without sub-functions: no block sends one that is not listed"
        report.miss(function.at, wrong, "list the manual's, such as {code: 0000H, name: Return query data, zh: ...}")
