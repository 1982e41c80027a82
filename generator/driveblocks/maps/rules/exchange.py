"""Rules on frames that belong together: a reply and its request, a quantity and the scale that it proves."""

from decimal import Decimal

from driveblocks.maps import adu
from driveblocks.maps.form import address_text
from driveblocks.maps.model import Drive, Frame, Quantity, Register
from driveblocks.maps.pair import number_of
from driveblocks.maps.plan import dialect, start_of
from driveblocks.maps.problem import Report
from driveblocks.modbus.request import READS

_ECHOED: dict[int, tuple[str, ...]] = {
    0x03: ("unit", "function", "words"),
    0x04: ("unit", "function", "words"),
    0x06: ("unit", "function", "address", "values"),
    0x08: ("unit", "function", "sub_function", "data"),
    0x10: ("unit", "function", "address", "words"),
}
"""What a reply repeats: MODBUS Application Protocol V1.1b3, 6.3, 6.4, 6.6, 6.8, 6.12."""

Frames = dict[str, Frame]
Parsed = dict[str, adu.Fields]


def check(drive: Drive, frames: Frames, parsed: Parsed, report: Report) -> None:
    """Note every pair of frames that does not fit, and every quantity or scale that its frame does not prove."""
    for frame in drive.frames:
        asked = _asked(frame, frames, parsed, report)
        request, reply = parsed.get(asked.id) if asked else None, parsed.get(frame.id)
        if request is not None and reply is not None:
            _echo(drive, frame, request, reply, report)
            _read_values(drive, frame, request, reply, report)
        if reply is not None and (request is not None or frame.answers is None):
            for quantity in frame.means.quantities:
                _quantity(drive, frame, quantity, request or reply, report)
    for _, row in drive.registers():
        if row.scale is not None and row.scale.proof is not None:
            _proof(row, row.scale.proof, frames, report)


def _asked(frame: Frame, frames: Frames, parsed: Parsed, report: Report) -> Frame | None:
    """The request that a frame answers; notes a reply without one, unless it refuses whatever was asked."""
    if frame.answers is None:
        fields = parsed.get(frame.id)
        if frame.direction == "reply" and fields is not None and fields.error is None:
            report.miss(frame.at, "a reply without `answers`", "name the request that it answers")
        return None
    if frame.direction == "request":
        report.add(frame.place("answers"), "a request answers nothing", "remove `answers`, or write `direction: reply`")
        return None
    asked = frames.get(frame.answers)
    if asked is None or asked.direction != "request":
        wrong = f"`{frame.answers}` is not the id of a request"
        report.miss(frame.place("answers"), wrong, "name the request that it answers")
        return None
    if asked.mode != frame.mode:
        wrong = f"a reply in {frame.mode} to a request in {asked.mode}"
        report.add(frame.place("answers"), wrong, "name the request of the same mode")
    return asked


def _echo(drive: Drive, frame: Frame, request: adu.Fields, reply: adu.Fields, report: Report) -> None:
    keys = _ECHOED.get(request.function, ())
    due = request
    if reply.error is not None:
        keys = ("unit",) if reply.address is not None else ("unit", "function")
        due = adu.refused(request, dialect(drive))
    for key in keys:
        if getattr(due, key) != getattr(reply, key):
            got, asked = (adu.shown(key, getattr(fields, key)) for fields in (reply, due))
            wrong = f"this reply has {key} {got}, but its request asks for {asked}"
            report.add(frame.means.place(key), wrong, "check both frames")


def _read_values(drive: Drive, frame: Frame, request: adu.Fields, reply: adu.Fields, report: Report) -> None:
    if request.function not in READS or request.address is None or reply.error is not None:
        return
    for offset, word in enumerate(reply.values):
        row = drive.register_at(request.address + start_of(drive, request.function) + offset)
        if row is None or not row.values or row.masks:
            continue
        number = adu.number(word, row.signed)
        if number not in {value.value for value in row.values}:
            wrong = f"{number} was read, which is no value of {address_text(row.address.first)}"
            report.miss(frame.means.place("values"), wrong, "correct the frame, or list the value")


def _quantity(drive: Drive, frame: Frame, quantity: Quantity, carrier: adu.Fields, report: Report) -> None:
    row = drive.register_at(quantity.register, "r" if carrier.function in READS else "w")
    if row is None or row.scale is None:
        wrong = f"a quantity of {address_text(quantity.register)}, which has no scale"
        report.miss(quantity.at, wrong, "add the scale that this frame proves, or remove the quantity")
        return
    start = start_of(drive, carrier.function)
    index = quantity.register - start - carrier.address if carrier.address is not None else -1
    if not 0 <= index <= len(frame.means.values) - row.size:
        wrong = f"the frame carries no word of {address_text(quantity.register)}"
        report.miss(quantity.place("register"), wrong, "name a register whose value it carries")
        return
    raw = number_of(row, frame.means.values[index : index + row.size])
    dues = [Decimal(raw) * one.factor for one in row.scale.choices]
    if quantity.value not in dues:
        wrong = f"{quantity.value} {quantity.unit}, but {raw} x {row.scale.factor} is {dues[0]}"
        report.add(quantity.place("value"), wrong, "correct the scale or the quantity")
    if row.unit is not None and quantity.unit != row.unit:
        wrong = f"a quantity in {quantity.unit}, but {address_text(quantity.register)} has {row.unit}"
        report.add(quantity.place("unit"), wrong, "correct one of them")


def _proof(row: Register, proof: str, frames: Frames, report: Report) -> None:
    frame = frames.get(proof)
    scale = row.scale
    if scale is not None and (
        frame is None or row.address.first not in {quantity.register for quantity in frame.means.quantities}
    ):
        wrong = f"frame `{proof}` proves no scale of {address_text(row.address.first)}"
        report.miss(scale.place("proof"), wrong, "name a frame whose `quantities` hold this register")
