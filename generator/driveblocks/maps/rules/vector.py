"""Rules on example frames: checksum, meaning, limits, the pair of request and reply, the table of PLC registers."""

from decimal import Decimal

from driveblocks.maps import adu
from driveblocks.maps.form import address_text
from driveblocks.maps.model import Drive, Frame, Means, PlcTable, Quantity, Register
from driveblocks.maps.problem import Report

_MEANT = ("unit", "function", "address", "words", "byte_count", "values", "sub_function", "data", "error")


def check(drive: Drive, report: Report) -> None:
    """Note every rule that an example frame breaks."""
    frames: dict[str, Frame] = {}
    parsed: dict[str, adu.Fields] = {}
    for frame in drive.frames:
        if frame.id in frames:
            report.add(frame.place("id"), f"frame id `{frame.id}` stands twice", "give each frame its own id")
        frames[frame.id] = frame
        fields = _take_apart(drive, frame, report)
        if fields is not None:
            parsed[frame.id] = fields
            _meaning(frame, fields, report)
            _allowed(drive, frame, fields, report)
        if frame.plc is not None:
            _plc(frame, frame.plc, report)
    if not drive.frames:
        report.add(
            drive.place("frames"), "a map without example frames", "without vectors nothing proves that it is right"
        )
    for frame in drive.frames:
        _answer(frame, frames, parsed, report)
    _proofs(drive, frames, report)


def _take_apart(drive: Drive, frame: Frame, report: Report) -> adu.Fields | None:
    if frame.mode not in drive.serial.mode.modes:
        report.add(
            frame.place("mode"), f"the drive does not speak {frame.mode}", "correct the mode, or add it to `serial`"
        )
    try:
        body, given = adu.split(frame.mode, frame.correct)
    except adu.FrameError as error:
        report.add(frame.place("correct"), str(error), error.right)
        return None
    due = adu.checksum(frame.mode, body)
    if given != due:
        wrong = f"the checksum of `correct` is {given.hex(' ').upper()}"
        report.add(frame.place("correct"), wrong, f"these bytes need {due.hex(' ').upper()}")
    _printed(frame, report)
    form = drive.errors.form
    try:
        return adu.fields(body, frame.direction, form.address if form else None, form.function if form else None)
    except adu.FrameError as error:
        report.add(frame.place("correct"), str(error), error.right)
        return None


def _printed(frame: Frame, report: Report) -> None:
    try:
        body, given = adu.split(frame.mode, frame.printed)
    except adu.FrameError as error:
        report.add(frame.place("printed"), f"as printed: {error}", error.right)
        return
    due = adu.checksum(frame.mode, body)
    verdict = "right" if given == due else "wrong"
    if verdict != frame.checksum:
        shown = f"{given.hex(' ').upper()} printed, {due.hex(' ').upper()} due"
        report.add(
            frame.place("checksum"), f"`checksum: {frame.checksum}`, but {shown}", f"write `checksum: {verdict}`"
        )
    if frame.printed_checksum_of is not None and adu.checksum(frame.mode, frame.printed_checksum_of) != given:
        wrong = f"the printed checksum {given.hex(' ').upper()} does not belong to these bytes"
        report.add(frame.place("printed_checksum_of"), wrong, "find the bytes, or remove the key")
    if frame.printed_checksum_of is not None and frame.checksum == "right":
        report.add(frame.place("printed_checksum_of"), "the printed checksum is right", "remove the key")


def _meaning(frame: Frame, fields: adu.Fields, report: Report) -> None:
    for key in _MEANT:
        meant, found = getattr(frame.means, key), getattr(fields, key)
        if meant in (None, ()) and found not in (None, ()):
            wrong = f"`means` does not say `{key}`, which the bytes carry"
            report.add(frame.means.at, wrong, f"type it from the manual's words; the bytes say {_shown(found)}")
        elif meant != found and not (meant in (None, ()) and found in (None, ())):
            wrong = f"`means` says {key} {_shown(meant)}, the bytes say {_shown(found)}"
            report.add(frame.means.place(key), wrong, "the manual's words decide which of the two is wrong")
    if frame.direction == "request" and frame.means.quantities and not frame.means.values:
        report.add(frame.means.place("quantities"), "a request that carries no words has no quantities", "remove them")


def _shown(value: object) -> str:
    if isinstance(value, tuple):
        return " ".join(f"{word:04X}H" for word in value)
    return f"{value:02X}H" if isinstance(value, int) else "nothing"


def _allowed(drive: Drive, frame: Frame, fields: adu.Fields, report: Report) -> None:
    known = {function.code for function in drive.functions}
    form = drive.errors.form
    refusal = fields.error is not None
    if not refusal and fields.function not in known:
        report.add(
            frame.means.place("function"),
            f"function {fields.function:02X}H is not listed under `functions`",
            "add it there",
        )
    if refusal and form is not None and form.add and fields.function - form.add not in known:
        report.add(
            frame.means.place("function"), f"exception {fields.function:02X}H to an unknown function", "correct it"
        )
    if not drive.serial.unit.min <= fields.unit <= drive.serial.unit.max:
        report.add(
            frame.means.place("unit"), f"unit {fields.unit} is no unit address of this drive", "correct one of them"
        )
    if refusal and fields.error not in {error.code for error in drive.errors.codes}:
        report.add(frame.means.place("error"), f"error {fields.error} is not listed under `errors`", "add it there")
    _limits(drive, frame, fields, report)
    _registers(drive, frame, fields, report)


def _limits(drive: Drive, frame: Frame, fields: adu.Fields, report: Report) -> None:
    limits = drive.limits
    read = fields.function in (0x03, 0x04)
    limit = limits.read_words if read else limits.write_words
    words = fields.words or (len(fields.values) if not read else 0)
    if limit is not None and words > limit.value:
        report.add(frame.place("correct"), f"{words} words, but the limit is {limit.value}", "one of the two is wrong")
    size = limits.ascii_data_bytes if frame.mode == "ascii" else limits.data_bytes
    length = len(adu.split(frame.mode, frame.correct)[0]) - 2
    if size is not None and length > size.value:
        report.add(
            frame.place("correct"), f"{length} data bytes, but the limit is {size.value}", "one of the two is wrong"
        )


def _registers(drive: Drive, frame: Frame, fields: adu.Fields, report: Report) -> None:
    if fields.address is None or fields.error is not None:
        return
    use = "r" if fields.function in (0x03, 0x04) else "w"
    count = fields.words or 1
    for offset, address in enumerate(range(fields.address, fields.address + count)):
        access = _access(drive, address)
        if use not in access:
            what = f"cannot be {'read' if use == 'r' else 'written'}" if access else "is in no register table or area"
            report.add(
                frame.means.place("address"), f"{address_text(address)} {what}", "the frame or the table is wrong"
            )
        if use == "w" and offset < len(fields.values):
            _value(drive.register_at(address), fields.values[offset], frame, report)


def _access(drive: Drive, address: int) -> str:
    for section, row in drive.registers():
        if address in row.address:
            return "" if row.unused else row.access or section.access
    return next((area.access for area in drive.areas if address in area.addresses), "")


def _value(row: Register | None, value: int, frame: Frame, report: Report) -> None:
    if row is None:
        return
    number = value - 0x10000 if row.signed and value & 0x8000 else value
    if row.values and number not in {one.value for one in row.values}:
        report.add(
            frame.means.place("values"), f"{number} is no value of {address_text(row.address.first)}", "one is wrong"
        )
    if row.range and not row.range.min <= number <= row.range.max:
        wrong = f"{number} is outside the range of {address_text(row.address.first)}"
        report.add(frame.means.place("values"), wrong, f"it holds {row.range.min} to {row.range.max}")


def _answer(frame: Frame, frames: dict[str, Frame], parsed: dict[str, adu.Fields], report: Report) -> None:
    if frame.answers is None:
        return
    asked = frames.get(frame.answers)
    if asked is None or asked.direction != "request" or frame.direction != "reply":
        report.add(
            frame.place("answers"), f"`{frame.answers}` is not the id of a request", "name the request that it answers"
        )
        return
    request, reply = parsed.get(asked.id), parsed.get(frame.id)
    if request is None or reply is None or reply.error is not None:
        return
    keys = ("unit", "function", "words") if request.function in (0x03, 0x04) else _ECHOED.get(request.function, ())
    for key in keys:
        if getattr(request, key) != getattr(reply, key):
            asked_for, got = _shown(getattr(request, key)), _shown(getattr(reply, key))
            report.add(
                frame.at, f"{key} {got} answers a request for {asked_for}", "the pair does not fit; check both frames"
            )
    if asked.mode != frame.mode:
        report.add(
            frame.place("answers"),
            f"a reply in {frame.mode} to a request in {asked.mode}",
            "name the request of the same mode",
        )


_ECHOED = {
    0x06: ("unit", "function", "address", "values"),
    0x08: ("unit", "function", "sub_function", "data"),
    0x10: ("unit", "function", "address", "words"),
}
"""What a reply repeats: MODBUS Application Protocol V1.1b3, 6.6, 6.8, 6.12."""


def _plc(frame: Frame, table: PlcTable, report: Report) -> None:
    digits = "".join(table.registers)
    width = 2 if table.bits == 8 else 4
    odd = next((word for word in (*table.registers, *table.printed) if len(word) != width), None)
    if odd is not None:
        report.add(
            table.place("registers"),
            f"`{odd}` has not {width} digits",
            f"in {table.bits}-bit mode each register has {width}",
        )
    elif "--" in digits.removesuffix("--"):
        report.add(table.place("registers"), "an empty byte in the middle", "only the last byte may be empty")
    elif bytes.fromhex(digits.removesuffix("--")) != frame.correct:
        report.add(
            table.place("registers"),
            "the table does not hold the bytes of `correct`",
            "pack them in order, high byte first",
        )
    if table.printed and len(table.printed) != len(table.registers):
        report.add(
            table.place("printed"), "the printed table has another length", f"write {len(table.registers)} registers"
        )


def _proofs(drive: Drive, frames: dict[str, Frame], report: Report) -> None:
    for frame in drive.frames:
        for quantity in frame.means.quantities:
            _quantity(drive, frame, quantity, frames, report)
    for _, row in drive.registers():
        if row.scale is None or row.scale.proof is None:
            continue
        proof = frames.get(row.scale.proof)
        if proof is None or row.address.first not in {q.register for q in proof.means.quantities}:
            wrong = f"frame `{row.scale.proof}` proves no scale of {address_text(row.address.first)}"
            report.add(row.scale.place("proof"), wrong, "name a frame whose `quantities` hold this register")


def _quantity(drive: Drive, frame: Frame, quantity: Quantity, frames: dict[str, Frame], report: Report) -> None:
    row = drive.register_at(quantity.register)
    if row is None or row.scale is None or row.unit is None:
        wrong = f"a quantity of {address_text(quantity.register)}, which has no scale and unit"
        report.add(quantity.at, wrong, "add the scale that this frame proves, or remove the quantity")
        return
    raw = _raw(frame.means, quantity.register, frames.get(frame.answers or ""))
    if raw is None:
        report.add(
            quantity.place("register"),
            f"the frame does not carry {address_text(quantity.register)}",
            "name a register it carries",
        )
    elif Decimal(raw) * row.scale.factor != quantity.value or quantity.unit != row.unit:
        wrong = (
            f"{quantity.value} {quantity.unit}, but {raw} x {row.scale.factor} is {raw * row.scale.factor} {row.unit}"
        )
        report.add(quantity.place("value"), wrong, "correct the scale or the quantity")


def _raw(means: Means, address: int, request: Frame | None) -> int | None:
    start = means.address if means.address is not None else request.means.address if request else None
    index = address - start if start is not None else -1
    return means.values[index] if 0 <= index < len(means.values) else None
