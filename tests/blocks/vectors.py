"""The manuals' example frames through the blocks: bytes as printed, meanings as typed by hand."""

from collections.abc import Iterator

from tests.blocks import wire
from tests.blocks.library import Blocks, number, octets, words
from tests.blocks.meanings import scale_name

from driveblocks.maps.model import Drive, Frame
from driveblocks.reference.reply import Answer
from driveblocks.reference.request import BUILDABLE, Asked
from driveblocks.reference.single import stored


def asked(frame: Frame) -> Asked:
    """The request that a frame is said to be, from its meaning and never from its bytes."""
    means = frame.means
    single = means.values[0] & 0xFFFF if means.function == 6 else means.data or 0
    several = tuple(value & 0xFFFF for value in means.values) if means.function == 16 else ()
    return Asked(
        function=means.function,
        unit=means.unit,
        address=means.address or 0,
        quantity=means.words or 1,
        value=single,
        sub_function=means.sub_function or 0,
        words=several,
        ascii=frame.mode == "ascii",
    )


def assert_request(blocks: Blocks, drive: Drive, frame: Frame) -> None:
    """Build and frame a request: every byte as the manual has it; opening it gives the body back."""
    assert frame.means.function in BUILDABLE, frame.id
    sent = wire.build(blocks, drive.prefix, asked(frame))
    assert sent.built.result == "OK", frame.id
    made = wire.frame(blocks, sent.built.body, ascii_mode=frame.mode == "ascii")
    assert made == frame.correct, (frame.id, made.hex(" "))
    back = wire.unframe(blocks, frame.correct, ascii_mode=frame.mode == "ascii")
    assert (back.result, back.body) == ("OK", sent.built.body), frame.id


def questions(drive: Drive, frame: Frame) -> Iterator[Asked]:
    """The requests that a reply may answer: the one it names, or every one that it may belong to."""
    if frame.answers is not None:
        yield asked(next(one for one in drive.frames if one.id == frame.answers))
    elif frame.means.error is None:
        yield asked(frame)
    elif drive.errors.form is not None and drive.errors.form.kind == "write_reply":
        for function in drive.functions:
            yield Asked(function.code, frame.means.unit)
    else:
        add = drive.errors.form.add if drive.errors.form else 0x80
        yield Asked(frame.means.function - (add or 0), frame.means.unit)


def wanted(frame: Frame) -> Answer:
    """What a reply must be understood as."""
    means = frame.means
    if means.error is not None:
        return Answer("REFUSED", reason=means.error)
    return Answer("OK", tuple(value & 0xFFFF for value in means.values) if means.function in {3, 4} else ())


def assert_reply(blocks: Blocks, drive: Drive, frame: Frame) -> None:
    """Open and parse a reply; sealing its body again gives its bytes."""
    in_ascii = frame.mode == "ascii"
    for question in questions(drive, frame):
        answer = wire.receive(blocks, drive.prefix, wire.opened(question), frame.correct, ascii_mode=in_ascii)
        assert answer == wanted(frame), (frame.id, question, answer)
    body = wire.unframe(blocks, frame.correct, ascii_mode=in_ascii)
    assert wire.frame(blocks, body.body, ascii_mode=in_ascii) == frame.correct, frame.id


def assert_quantities(blocks: Blocks, drive: Drive, frame: Frame) -> None:
    """The engineering values that the manual states for a reply's words."""
    request = next((one for one in drive.frames if one.id == frame.answers), frame)
    for quantity in frame.means.quantities:
        row = drive.register_at(quantity.register)
        if row is None or row.scale is None or request.means.address is None:
            continue
        at = quantity.register - request.means.address
        found = [each & 0xFFFF for each in frame.means.values[at : at + (row.words or 1)]]
        value = blocks.call(
            scale_name(drive, row), dict(zip(("High", "Low") if row.words else ("Raw",), found, strict=True))
        )
        assert value == stored(float(quantity.value)), (frame.id, value, quantity.value)


def assert_table(blocks: Blocks, frame: Frame) -> None:
    """The manual's table of PLC registers, packed and unpacked by both boxes that can hold the frame."""
    assert frame.plc is not None
    registers = [int(text.replace("--", "00"), 16) for text in frame.plc.registers]
    count = len(frame.correct)
    for box in ("Adu", "Chars"):
        packed = blocks.run(f"MB_Pack{box}{frame.plc.bits}", {"CharCount": count, box: frame.correct})
        assert words(packed, "Registers", number(packed, "RegisterCount")) == tuple(registers), (frame.id, box)
        back = blocks.run(f"MB_Unpack{box}{frame.plc.bits}", {"CharCount": count, "Registers": list(registers)})
        assert octets(back, box, number(back, "Unpacked")) == frame.correct, (frame.id, box)
