"""Programs from the map's vectors: the manual's example frames, built, opened, parsed and packed byte for byte."""

from collections.abc import Iterator

from driveblocks.bench import kit
from driveblocks.bench.naming import scale_block
from driveblocks.bench.script import Item, Script
from driveblocks.maps.form import wire
from driveblocks.maps.model import Drive, Frame, Means
from driveblocks.reference.framing import ascii_decode, rtu_open
from driveblocks.reference.request import BUILDABLE, Asked, Requests

ABSENT = 0x00
"""What is in a PLC register's low byte that is not sent, printed as --."""


def scripts(drive: Drive, stem: str) -> Iterator[Script]:
    """One program with all frames and one with the tables of PLC registers."""
    program = kit.script(drive, stem, "Frames", "the manual's example frames, byte for byte")
    kit.declare(program, "Adu", "Chars", "Words", "Request", **_blocks(drive))
    for frame in drive.frames:
        _frame(program, drive, frame)
    yield program
    tables = kit.script(drive, stem, "Tables", "the manual's tables of PLC registers, packed and unpacked")
    kit.declare(tables, "Adu", "Chars", "Registers")
    for frame in drive.frames:
        if frame.plc is not None:
            _table(tables, frame)
    yield tables


def _blocks(drive: Drive) -> dict[str, str]:
    return {
        "Build": f"{drive.prefix}_Request",
        "Parse": f"{drive.prefix}_Reply",
        "Seal": "MB_RtuSeal",
        "Open": "MB_RtuOpen",
        "Encode": "MB_AsciiEncode",
        "Decode": "MB_AsciiDecode",
    }


def buildable(drive: Drive) -> frozenset[int]:
    """Functions of the request block: 04H is none where it reads another table than that of holding registers."""
    return BUILDABLE & Requests(drive).functions.keys()


def _frame(program: Script, drive: Drive, frame: Frame) -> None:
    source = frame.source
    if frame.direction == "request" and frame.means.function in buildable(drive):
        program.stage(f"{frame.id}: {frame.means.says}", *_built(frame), source=source)
    elif frame.direction == "reply":
        for words, asked in _questions(drive, frame):
            program.stage(f"{frame.id}: {words}", *asked, *_parsed(drive, frame), source=source)
    if (result := _read(frame, frame.printed)) != "OK":
        items = _opened(frame, frame.printed, result)
        program.stage(f"{frame.id} as printed, which is wrong", *items, source=f"{source}; see errata")


def _read(frame: Frame, data: bytes) -> str:
    return (ascii_decode(data) if frame.mode == "ascii" else rtu_open(data)).result


def asked(means: Means, *, ascii_mode: bool = False) -> Asked:
    single = means.values[0] if means.values and means.function == 6 else 0
    return Asked(
        means.function,
        means.unit,
        means.address or 0,
        means.words or 1,
        (means.data or 0 if means.function == 8 else single) & 0xFFFF,
        means.sub_function or 0,
        tuple(value & 0xFFFF for value in means.values) if means.function == 16 else (),
        ascii_mode,
    )


def _body_length(frame: Frame, data: bytes) -> int:
    return (len(data) - 5) // 2 if frame.mode == "ascii" else len(data) - 2


def _built(frame: Frame) -> Iterator[Item]:
    """Build the request, then frame it: every byte as the manual has it."""
    yield from kit.build(asked(frame.means, ascii_mode=frame.mode == "ascii"))
    yield kit.has_result("Build", "OK")
    yield kit.is_number("Build.Length", _body_length(frame, frame.correct), "bytes without checksum")
    if frame.mode == "ascii":
        yield "Encode(Length := Build.Length, Adu := Adu, Chars := Chars);"
        yield kit.is_number("Encode.CharCount", len(frame.correct), "characters of the frame")
        yield from kit.same_bytes("Chars", frame.correct, "characters")
    else:
        yield "Seal(Length := Build.Length, Adu := Adu);"
        yield kit.is_number("Seal.AduLength", len(frame.correct), "bytes of the frame")
        yield from kit.same_bytes("Adu", frame.correct)


def _questions(drive: Drive, frame: Frame) -> Iterator[tuple[str, list[Item]]]:
    """Requests that a reply may answer, with words: the one that it names, or all that it may belong to."""
    if frame.answers is not None:
        request = next(one for one in drive.frames if one.id == frame.answers)
        sent = asked(request.means, ascii_mode=request.mode == "ascii")
        can = request.means.function in buildable(drive)
        yield frame.means.says, [*kit.build(sent)] if can else kit.open_request(sent)
        return
    form = drive.errors.form
    if frame.means.error is None:
        yield frame.means.says, kit.open_request(asked(frame.means))
    elif form is not None and form.kind == "write_reply":
        for function in drive.functions:
            says = f"{frame.means.says}, asked by function {function.code:02X}H"
            yield says, kit.open_request(Asked(function.code, frame.means.unit))
    else:
        add = 0x80 if form is None or form.add is None else form.add
        yield frame.means.says, kit.open_request(Asked(frame.means.function - add, frame.means.unit))


def _opened(frame: Frame, data: bytes, result: str) -> Iterator[Item]:
    """Hand the bytes or characters over as received."""
    block, box = ("Decode", "Chars") if frame.mode == "ascii" else ("Open", "Adu")
    yield from kit.fill(box, data)
    if frame.mode == "ascii":
        yield f"Decode(CharCount := {len(data)}, Chars := Chars, Adu := Adu);"
    else:
        yield f"Open(AduLength := {len(data)}, Adu := Adu);"
    yield kit.has_result(block, result)
    yield kit.is_number(f"{block}.Length", _body_length(frame, data) if result == "OK" else 0, "bytes without checksum")


def _parsed(drive: Drive, frame: Frame) -> Iterator[Item]:
    """Open the reply, parse it, and compare what it says with what a person typed."""
    means, block = frame.means, "Decode" if frame.mode == "ascii" else "Open"
    yield from _opened(frame, frame.correct, "OK")
    yield f"Parse(Length := {block}.Length, Adu := Adu, Request := Request, Words := Words);"
    yield kit.has_result("Parse", "REFUSED" if means.error is not None else "OK")
    yield kit.is_number("Parse.Reason", means.error or 0, "the drive's error code")
    read = means.values if means.function in (3, 4) else ()
    yield kit.is_number("Parse.WordCount", len(read), "registers read")
    yield from kit.same_words("Words", read)
    yield from _quantities(drive, frame)


def _quantities(drive: Drive, frame: Frame) -> Iterator[Item]:
    request = next((one for one in drive.frames if one.id == frame.answers), frame)
    for quantity in frame.means.quantities:
        row = drive.register_at(quantity.register)
        if row is None or row.scale is None or request.means.address is None:
            continue
        at = wire(quantity.register) - wire(request.means.address)
        low_first = row.order == "low_first"
        halves = f"High := Words[{at + low_first}], Low := Words[{at + (not low_first)}]"
        pins = halves if row.words else f"Raw := Words[{at}]"
        words = f"{quantity.value} {quantity.unit}"
        yield kit.is_real(f"{scale_block(drive, row)}({pins})", float(quantity.value), words)


def _table(program: Script, frame: Frame) -> None:
    """Pack the frame and compare with the table; unpack the table and compare with the frame."""
    assert frame.plc is not None  # noqa: S101  (asked before)
    box = "Chars" if frame.mode == "ascii" else "Adu"
    pack, unpack_ = f"Pack{box}{frame.plc.bits}", f"Unpack{box}{frame.plc.bits}"
    kit.declare(program, **{pack: f"MB_{pack}", unpack_: f"MB_{unpack_}"})
    table = [int(text.replace("--", f"{ABSENT:02X}"), 16) for text in frame.plc.registers]
    first, size = frame.plc.first, len(frame.correct)
    program.stage(
        f"{frame.id}: packed into registers from {first}, {frame.plc.bits} bits each",
        *kit.fill(box, frame.correct),
        f"{pack}(CharCount := {size}, {box} := {box}, Registers := Registers);",
        kit.is_number(f"{pack}.RegisterCount", len(table), "registers"),
        *kit.same_words("Registers", table, f"{first} +"),
        source=frame.source,
    )
    program.stage(
        f"{frame.id}: unpacked from registers from {first}, {frame.plc.bits} bits each",
        *kit.fill(box, bytes(size)),
        *kit.fill_words("Registers", table),
        f"{unpack_}(CharCount := {size}, Registers := Registers, {box} := {box});",
        kit.is_number(f"{unpack_}.Unpacked", size, "characters"),
        *kit.same_bytes(box, frame.correct),
        source=frame.source,
    )
