"""Rules on example frames: checksum, meaning, limits, registers, the table of PLC registers."""

from driveblocks.maps import adu
from driveblocks.maps.form import address_text
from driveblocks.maps.model import Drive, Frame, PlcTable, Register, Use
from driveblocks.maps.plan import READ_WORDS, dialect, start_of
from driveblocks.maps.problem import Report
from driveblocks.maps.rules import exchange
from driveblocks.maps.rules.access import carried
from driveblocks.maps.rules.unique import unique
from driveblocks.modbus.frame import checksum
from driveblocks.modbus.request import READS

_MEANT = ("unit", "function", "address", "words", "byte_count", "values", "sub_function", "data", "error")


def check(drive: Drive, report: Report) -> None:
    frames = unique(drive.frames, "id", "frame", report)
    parsed: dict[str, adu.Fields] = {}
    for frame in drive.frames:
        fields = _take_apart(drive, frame, report)
        if fields is not None:
            parsed[frame.id] = fields
            _meaning(frame, fields, report)
            _allowed(drive, frame, fields, report)
        if frame.plc is not None:
            _plc(frame, frame.plc, report)
    exchange.check(drive, frames, parsed, report)


def _take_apart(drive: Drive, frame: Frame, report: Report) -> adu.Fields | None:
    modes = drive.serial.mode.modes
    if modes and frame.mode not in modes:
        wrong = f"the drive does not speak {frame.mode}"
        report.add(frame.place("mode"), wrong, "correct the mode, or add it to `serial`")
    try:
        body, given = adu.split(frame.mode, frame.correct)
        due = checksum(frame.mode, body)
        if given != due:
            wrong = f"the checksum of `correct` is {adu.octets(given)}"
            report.add(frame.place("correct"), wrong, f"these bytes need {adu.octets(due)}")
        fields = adu.fields(body, frame.direction, dialect(drive))
    except adu.FrameError as error:
        report.add(frame.place("correct"), str(error), error.right)
        return None
    _printed(frame, report)
    return fields


def _printed(frame: Frame, report: Report) -> None:
    try:
        body, given = adu.split(frame.mode, frame.printed)
    except adu.FrameError as error:
        report.add(frame.place("printed"), f"as printed: {error}", error.right)
        return
    due = checksum(frame.mode, body)
    verdict = "right" if given == due else "wrong"
    if verdict != frame.checksum:
        wrong = f"`checksum: {frame.checksum}`, but {adu.octets(given)} is printed and {adu.octets(due)} is right"
        report.add(frame.place("checksum"), wrong, f"write `checksum: {verdict}`")
    owner = frame.printed_checksum_of
    if owner is not None and verdict == "right":
        report.add(frame.place("printed_checksum_of"), "the printed checksum is right", "remove the key")
    elif owner is not None and checksum(frame.mode, owner) != given:
        wrong = f"the printed checksum {adu.octets(given)} does not belong to these bytes"
        report.add(frame.place("printed_checksum_of"), wrong, "find the bytes, or remove the key")


def _meaning(frame: Frame, fields: adu.Fields, report: Report) -> None:
    for key in _MEANT:
        meant, found = getattr(frame.means, key), getattr(fields, key)
        silent, absent = meant in (None, ()), found in (None, ())
        if silent and not absent:
            wrong = f"`means` does not say `{key}`, which the bytes carry"
            report.miss(
                frame.means.at, wrong, f"type it from the manual's words; the bytes say {adu.shown(key, found)}"
            )
        elif meant != found and not silent:
            wrong = f"`means` says {key} {adu.shown(key, meant)}, the bytes say {adu.shown(key, found)}"
            report.add(frame.means.place(key), wrong, "the manual's words decide which of the two is wrong")


def _allowed(drive: Drive, frame: Frame, fields: adu.Fields, report: Report) -> None:
    known = {function.code for function in drive.functions}
    if fields.error is None and fields.function not in known:
        wrong = f"function {fields.function:02X}H is not listed under `functions`"
        report.miss(frame.means.place("function"), wrong, "add it there, or correct the frame")
    if fields.error is not None:
        _refused(drive, frame, fields, known, report)
    _unit(drive, frame, fields, report)
    _limits(drive, frame, fields, report)
    _sub_function(drive, frame, fields, report)
    _registers(drive, frame, fields, report)


def _refused(drive: Drive, frame: Frame, fields: adu.Fields, known: set[int], report: Report) -> None:
    add = dialect(drive).added
    if fields.address is None and fields.function - add not in known:
        wrong = f"function {fields.function:02X}H refuses a function that is not listed under `functions`"
        report.miss(frame.means.place("function"), wrong, "add it there, or correct the frame")
    if fields.error not in {error.code for error in drive.errors.codes}:
        wrong = f"error {fields.error} is not listed under `errors`"
        report.miss(frame.means.place("error"), wrong, "add it there, or correct the frame")


def _unit(drive: Drive, frame: Frame, fields: adu.Fields, report: Report) -> None:
    unit, cast = drive.serial.unit, drive.serial.broadcast
    if cast is None or fields.unit != cast.address:
        if unit.min <= unit.max and not unit.min <= fields.unit <= unit.max:
            wrong = f"unit {fields.unit} is no unit address of this drive"
            report.add(frame.means.place("unit"), wrong, f"it has {unit.min} to {unit.max}")
        return
    if fields.function in READS or (frame.direction == "reply" and not cast.replies):
        report.add(frame.means.place("unit"), "a broadcast cannot read and gets no reply", "correct the frame")
    if cast.start_addresses and fields.address is not None and fields.address not in cast.start_addresses:
        wrong = f"a broadcast cannot start at {address_text(fields.address)}"
        right = "it starts at " + ", ".join(map(address_text, cast.start_addresses))
        report.add(frame.means.place("address"), wrong, right)


def _limits(drive: Drive, frame: Frame, fields: adu.Fields, report: Report) -> None:
    limits = drive.limits
    limit = limits.read_words if fields.function in READS else limits.write_words
    most = limit.value if limit is not None else READ_WORDS
    words = fields.words if fields.words is not None else len(fields.values)
    if words > most or fields.words == 0:
        report.add(frame.place("correct"), f"{words} words, but a frame has 1 to {most}", "one of the two is wrong")
    size = limits.ascii_data_bytes if frame.mode == "ascii" else limits.data_bytes
    length = len(adu.split(frame.mode, frame.correct)[0]) - 2
    if size is not None and length > size.value:
        wrong = f"{length} data bytes, but the limit is {size.value}"
        report.add(frame.place("correct"), wrong, "one of the two is wrong")


def _sub_function(drive: Drive, frame: Frame, fields: adu.Fields, report: Report) -> None:
    listed = {sub.code for function in drive.functions for sub in function.sub_functions}
    if fields.sub_function is not None and fields.sub_function not in listed:
        wrong = f"sub-function {fields.sub_function:04X}H is not listed under function 08H"
        report.miss(frame.means.place("sub_function"), wrong, "add it there, or correct the frame")


def _registers(drive: Drive, frame: Frame, fields: adu.Fields, report: Report) -> None:
    if fields.address is None or fields.error is not None:
        return
    use: Use = "r" if fields.function in READS else "w"
    words = fields.words if fields.words is not None else 1
    for offset in range(min(words, READ_WORDS)):
        address = fields.address + start_of(drive, fields.function) + offset
        row = carried(drive, address, use, frame.means.place("address"), report)
        if row is not None and row.words is None and use == "w" and offset < len(fields.values):
            _value(row, fields.values[offset], frame, report)


def _value(row: Register, word: int, frame: Frame, report: Report) -> None:
    number = adu.number(word, row.signed)
    if row.values and number not in {one.value for one in row.values}:
        wrong = f"{number} is no value of {address_text(row.address.first)}"
        report.miss(frame.means.place("values"), wrong, "correct the frame, or list the value")
    if row.range and not row.range.holds(number):
        wrong = f"{number} is outside the range of {address_text(row.address.first)}"
        report.add(frame.means.place("values"), wrong, f"it holds {row.range.min} to {row.range.max}")


def _plc(frame: Frame, table: PlcTable, report: Report) -> None:
    if _sound(table, "registers", table.registers, report):
        digits = "".join(table.registers).removesuffix("--")
        if bytes.fromhex(digits) != frame.correct:
            wrong = "the table does not hold the bytes of `correct`"
            report.add(table.place("registers"), wrong, "pack them in order, high byte first")
    if not table.printed:
        return
    _sound(table, "printed", table.printed, report)
    if len(table.printed) != len(table.registers):
        wrong = "the printed table has another length"
        report.add(table.place("printed"), wrong, f"write {len(table.registers)} registers")
    if table.printed == table.registers:
        report.add(table.place("printed"), "the printed table is the right one", "remove the key")


def _sound(table: PlcTable, key: str, words: tuple[str, ...], report: Report) -> bool:
    width = 2 if table.bits == 8 else 4
    odd = next((word for word in words if len(word) != width), None)
    if odd is not None:
        right = f"in {table.bits}-bit mode each register has {width}"
        report.add(table.place(key), f"`{odd}` has not {width} digits", right)
    elif any("--" in word for word in words[:-1]):
        report.add(table.place(key), "an empty byte in the middle", "only the last byte may be empty")
    else:
        return True
    return False
