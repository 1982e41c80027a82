"""The files of the ST library: generic blocks, then the blocks of each drive, in an order that every compiler takes."""

from collections.abc import Iterator
from dataclasses import dataclass

from driveblocks.maps.model import Drive
from driveblocks.render import context, text
from driveblocks.render.environment import render
from driveblocks.render.text import Language

TYPES = ("MB_Adu", "MB_Chars", "MB_Words", "MB_Registers", "MB_Request")
FUNCTIONS = ("MB_HexDigit", "MB_HexValue")
BLOCKS = (
    "MB_Crc16", "MB_Crc16Compact", "MB_Lrc", "MB_RtuSeal", "MB_RtuOpen", "MB_AsciiEncode", "MB_AsciiDecode",
    "MB_BuildRead", "MB_BuildWriteSingle", "MB_BuildWriteMultiple", "MB_BuildDiagnostics", "MB_ParseReply",
)  # fmt: skip
LINE_TYPES = (
    "MB_LineFrame", "MB_RxRing", "MB_Port", "MB_Words4", "MB_Words16", "MB_Ask", "MB_Asks", "MB_Answer", "MB_Answers",
    "MB_Slot", "MB_Track",
)  # fmt: skip
LINE_BLOCKS = ("MB_CrcByte", "MB_Plus", "MB_Minus", "MB_Sixteen", "MB_Characters", "MB_WireMs", "MB_Listen")
LINE_SIZES = (8, 32)
"""How many slots a line can have."""
BOXES = (("Adu", 256), ("Chars", 513))
PACKERS = ("Pack", "Unpack")


@dataclass(frozen=True)
class File:
    """One file of the library: folder, block name, text."""

    folder: str
    name: str
    text: str

    @property
    def path(self) -> str:
        """Path below the platform's folder."""
        return f"{self.folder}/{self.name}.st"


def generic(languages: list[Language]) -> Iterator[File]:
    """Types and blocks that every drive shares."""
    for name in TYPES:
        yield File("types", name, render(f"types/{name}.st.j2"))
    yield from _line_types()
    for name in (*FUNCTIONS, *BLOCKS):
        yield File("modbus", name, render(f"modbus/{name}.st.j2"))
    for box, most in BOXES:
        for packer in PACKERS:
            for bits in (8, 16):
                rendered = render(f"modbus/{packer.lower()}{bits}.st.j2", box=box, most=most)
                yield File("modbus", f"MB_{packer}{box}{bits}", rendered)
    for language in languages:
        yield _file("modbus", "CodeText", text.result_texts(language))
    yield from _line_blocks()


def _line_types() -> Iterator[File]:
    """What a line, its slots and its port are made of."""
    for name in LINE_TYPES:
        yield File("types", name, render(f"line/{name}.st.j2"))
    for name in ("MB_Slots", "MB_Tracks"):
        yield from _sized("types", name)


def _line_blocks() -> Iterator[File]:
    """The functions and blocks of a line."""
    for name in LINE_BLOCKS:
        yield File("line", name, render(f"line/{name}.st.j2"))
    for name in ("MB_Line", "MB_ByteLine"):
        yield from _sized("line", name)


def _sized(folder: str, name: str) -> Iterator[File]:
    """One type or block for each number of slots."""
    for slots in LINE_SIZES:
        yield File(folder, f"{name}{slots}", render(f"line/{name}.st.j2", slots=slots))


def drive(stem: str, drive: Drive, languages: list[Language]) -> Iterator[File]:
    """The blocks of one drive. Raises ValueError when a name makes no identifier."""
    prefix = drive.prefix
    for use in ("r", "w"):
        yield _file(stem, "CanAccess", context.access(drive, use))
    yield _file(stem, "Request", {**context.request(drive), "name": f"{prefix}_Request"})
    yield _file(stem, "Reply", {**context.reply(drive), "name": f"{prefix}_Reply"})
    yield _file(stem, "Command", {**context.command(drive), "name": f"{prefix}_Command"})
    yield _file(stem, "Reference", {**context.reference(drive), "name": f"{prefix}_Reference"})
    yield _file(stem, "Standstill", {**context.standstill(drive), "name": f"{prefix}_Standstill"})
    numbers = context.fault_number(drive)
    if numbers is not None:
        yield _file(stem, "FaultNumber", {**numbers, "name": f"{prefix}_FaultNumber"})
    for one in context.decoders(drive):
        yield _file(stem, "Decoder", one)
    for one in context.scales(drive):
        yield _file(stem, "Scale", one)
    yield from _texts(stem, drive, languages)


def _texts(stem: str, drive: Drive, languages: list[Language]) -> Iterator[File]:
    for language in languages:
        yield _file(stem, "CodeText", text.fault_texts(drive, language))
        yield _file(stem, "CodeText", text.error_texts(drive, language))
        for one in text.place_texts(drive, language):
            yield _file(stem, "PlaceText", one)


def _file(folder: str, template: str, values: context.Context) -> File:
    return File(folder, values["name"], render(f"drive/{template}.st.j2", **values))
