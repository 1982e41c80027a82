"""Example frames: bytes as printed, verdict on the checksum, the correct bytes, and what they mean."""

from collections.abc import Iterator

from rich.console import RenderableType
from rich.text import Text

from driveblocks.maps.form import address_text
from driveblocks.maps.model import Drive, Frame, Means, PlcTable
from driveblocks.maps.view import UNPROVED
from driveblocks.show.layout import card, code_text, heading, listed


def frames(drive: Drive) -> Iterator[RenderableType]:
    wrong = sum(frame.checksum == "wrong" for frame in drive.frames)
    yield heading(f"Example frames: {len(drive.frames)}, {wrong} of them with a wrong checksum")
    if not drive.frames:
        yield UNPROVED
    for frame in drive.frames:
        yield of_frame(frame)


def of_frame(frame: Frame) -> RenderableType:
    return card(
        f"{frame.id}  ({frame.mode.upper()} {frame.direction})",
        ("says", frame.means.says),
        ("printed", _wire(frame.mode, frame.printed)),
        ("checksum", _verdict(frame)),
        ("correct", _wire(frame.mode, frame.correct)),
        ("fields", _fields(frame.means)),
        ("answers", frame.answers),
        ("PLC", _plc(frame.plc) if frame.plc else None),
        ("source", frame.source),
    )


def _wire(mode: str, data: bytes) -> str:
    if mode == "rtu":
        return data.hex(" ").upper()
    return data.decode("ascii", "backslashreplace").replace("\r", " CR").replace("\n", " LF")


def _verdict(frame: Frame) -> str | Text:
    if frame.checksum == "right":
        return "right"
    of = frame.printed_checksum_of
    belongs = f"; the printed one belongs to {of.hex(' ').upper()}" if of else ""
    return Text(f"WRONG{belongs}", style="bold red")


def _fields(means: Means) -> str:
    parts = [f"unit {means.unit}", f"function {code_text(means.function)}"]
    parts += [f"address {address_text(means.address)}"] if means.address is not None else []
    for name in ("words", "byte_count"):
        count = getattr(means, name)
        parts += [f"{name.replace('_', ' ')} {count}"] if count is not None else []
    for name in ("sub_function", "data"):
        word = getattr(means, name)
        parts += [f"{name.replace('_', '-')} {address_text(word)}"] if word is not None else []
    parts += [f"values {listed(means.values)}"] if means.values else []
    parts += [f"error {code_text(means.error)}"] if means.error is not None else []
    parts += [f"{address_text(one.register)} = {one.value} {one.unit}" for one in means.quantities]
    return listed(parts)


def _plc(table: PlcTable) -> str:
    letters = table.first.rstrip("0123456789")
    start = int(table.first.removeprefix(letters))
    lines = [f"{table.bits}-bit mode from {table.first}"]
    lines.append("  ".join(f"{letters}{start + n}={word}" for n, word in enumerate(table.registers)))
    differ = [
        f"{letters}{start + n}={was}"
        for n, (word, was) in enumerate(zip(table.registers, table.printed, strict=False))
        if word != was
    ]
    return "\n".join([*lines, f"printed instead: {'  '.join(differ)}"] if differ else lines)
