"""The files of the ST library: generic blocks, then the blocks of each drive, each after what it uses."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass

from driveblocks.maps.model import Drive
from driveblocks.maps.plan import holding, plan
from driveblocks.render import context, parameter, text
from driveblocks.render.channels import channels
from driveblocks.render.drive import drive_block
from driveblocks.render.environment import render
from driveblocks.render.motor import master, motor
from driveblocks.render.text import Language

TYPES = ("MB_Adu", "MB_Chars", "MB_Words", "MB_Registers", "MB_Request")
FUNCTIONS = ("MB_HexDigit", "MB_HexValue")
BLOCKS = (
    "MB_Crc16", "MB_Crc16Compact", "MB_Lrc", "MB_RtuSeal", "MB_RtuOpen", "MB_AsciiEncode", "MB_AsciiDecode",
    "MB_BuildRead", "MB_BuildWriteSingle", "MB_BuildWriteMultiple", "MB_BuildDiagnostics", "MB_ParseReply",
)  # fmt: skip
LINE_TYPES = (
    "MB_LineFrame", "MB_RxRing", "MB_Port", "MB_Words4", "MB_Words16", "MB_Ask", "MB_Asks", "MB_Answer", "MB_Answers",
    "MB_Slot", "MB_StopTrack", "MB_StopCopy", "MB_Track", "MB_Open", "MB_Talk", "MB_Times", "MB_Next",
    "MB_Scan", "MB_SlotNow", "MB_Heard", "MB_Sums",
)  # fmt: skip
LINE_BLOCKS = (
    "MB_CrcByte", "MB_Plus", "MB_Minus", "MB_Sixteen", "MB_Usual", "MB_Retries", "MB_Characters", "MB_WireMs",
    "MB_Reads", "MB_Repeats", "MB_CheckBegin", "MB_CheckByte", "MB_FrameKind", "MB_ReplyFits", "MB_ReplyMs",
    "MB_Withdrawn", "MB_Rank", "MB_ProbeMs", "MB_WhyFailed", "MB_WhyUnsent", "MB_TriesOver", "MB_Overdue", "MB_PollMs",
    "MB_StopMs", "MB_OthersMs", "MB_CutMs", "MB_Listen", "MB_Promise", "MB_Foreign", "MB_Stop",
)  # fmt: skip
CONTROL_BLOCKS = (
    "VFD_HardStop", "VFD_Next", "VFD_Link", "VFD_Unit", "VFD_LineFacts", "VFD_Set", "VFD_Usual", "VFD_IsScale",
    "VFD_Scaled", "VFD_ScaledSigned", "VFD_Diagnose", "VFD_Identity", "VFD_Pins", "VFD_Run", "VFD_FaultReset",
    "VFD_Start", "VFD_FirstStop", "VFD_StopRound", "VFD_Steady", "VFD_Send", "VFD_Why", "VFD_Control",
    "VFD_ReadParameter", "VFD_WriteParameter", "VFD_Store",
)  # fmt: skip
DEVICE = ("MB_Device", "MB_Float")
"""What is for a meter or a sensor; the block needs some of those."""
DRIVE_TYPES = ("VFD_Settings", "VFD_Diagnosis", "VFD_Asked", "VFD_Seen")
LINE_SIZES = (8, 32)
"""How many slots a line can have."""
PLATFORMS = {
    "linux": ("LX", "a serial port of Linux"),
    "plcopen": ("MB", "any serial port"),
    "codesys": ("CD", "a serial port of CODESYS"),
    "siemens": ("SI", "an RS-485 module of the S7-1200 or S7-1500"),
    "twincat": ("TC", "a serial terminal of Beckhoff"),
}
"""Platform -> the prefix of its blocks, and where its line is."""
BYTES = "plcopen"
"""The platform without an adapter: the program gives and takes the bytes."""
MASTERS: dict[str, Callable[[Drive], dict[str, object]]] = {"codesys": channels, "siemens": master}
"""Platforms with a Modbus master of their own -> what the template of a program for it needs."""
HOLDING = 3
"""The function that reads holding registers (MODBUS Application Protocol V1.1b3, 6.3)."""
LEAST_S = 60
"""Seconds between two stores in a memory that wears out; at this pace 100,000 of them take 69 days."""
BOXES = (("Adu", 256), ("Chars", 513))
PACKERS = {"Pack": "Outgoing", "Unpack": "Incoming"}
"""Blocks, and the buffer of their example: what is sent and what is received never share one."""


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
    yield from _line_types(languages)
    for name in (*FUNCTIONS, *BLOCKS):
        yield File("modbus", name, render(f"modbus/{name}.st.j2", **_texts_of(languages)))
    for box, most in BOXES:
        for packer, way in PACKERS.items():
            for bits in (8, 16):
                values = {"box": box, "most": most, "buffer": way + box.removeprefix("Adu")}
                rendered = render(f"modbus/{packer.lower()}{bits}.st.j2", **values)
                yield File("modbus", f"MB_{packer}{box}{bits}", rendered)
    for language in languages:
        yield _file("modbus", "CodeText", vars(text.result_texts(language)))
    yield from _line_blocks(languages)
    for name in DRIVE_TYPES:
        yield File("types", name, render(f"types/{name}.st.j2", **_texts_of(languages)))
    for name in CONTROL_BLOCKS:
        yield File("vfd", name, render(f"control/{name}.st.j2", least=LEAST_S, **_texts_of(languages)))
    yield from (File("device", name, render(f"device/{name}.st.j2", **_texts_of(languages))) for name in DEVICE)
    for language in languages:
        yield _file("vfd", "CodeText", vars(text.reason_texts(language)))
        yield _file("vfd", "CodeText", vars(text.state_texts(language)))


def adapter(platform: str, languages: list[Language]) -> Iterator[File]:
    """The blocks of a platform's serial port and the lines on top of it, which name what only that platform has.

    None for BYTES.
    """
    prefix, where = PLATFORMS[platform]
    if platform == BYTES:
        return
    yield File(platform, f"{prefix}_Port", render(f"{platform}/{prefix}_Port.st.j2", where=where))
    for slots in LINE_SIZES:
        bits = "Bits" if platform in ("linux", "codesys") else "CharacterBits"  # where parity is a pin
        values = {"slots": slots, "where": where, "busy": platform != "linux", "bits": bits}
        line = render(f"{platform}/{prefix}_Line.st.j2", **values, **_texts_of(languages))
        yield File(platform, f"{prefix}_Line{slots}", line)


def first_motor(platform: str, drive: Drive) -> File:
    """A program for a first motor at a platform's serial port."""
    prefix, where = PLATFORMS[platform]
    line = f"{prefix}_{'ByteLine' if platform == BYTES else 'Line'}{LINE_SIZES[0]}"
    values = {"platform": platform, "where": where, "line": line, **vars(motor(drive))}
    return File(platform, f"{drive.prefix}_Motor", render("motor/Motor.st.j2", **values))


def programs(platform: str, drive: Drive, languages: list[Language]) -> Iterator[File]:
    """Beside the first motor: where the PLC itself is the master and owns the frames, a program for such a drive."""
    if platform in MASTERS and _by_words(drive):
        values = {**MASTERS[platform](drive), **_texts_of(languages)}
        yield File(platform, f"{drive.prefix}_Master", render(f"{platform}/Master.st.j2", **values))


def _by_words(drive: Drive) -> bool:
    """Whether a motor takes no more than holding registers that are read, and single words that are written."""
    block = drive_block(drive)
    read = all(each.read.function == HOLDING for each in block.reading.reads)
    return read and drive.operation.in_one_word and not block.ordering.pair


def _line_types(languages: list[Language]) -> Iterator[File]:
    """What a line, its slots and its port are made of."""
    for name in LINE_TYPES:
        yield File("types", name, render(f"line/{name}.st.j2", **_texts_of(languages)))
    for name in ("MB_Slots", "MB_Tracks"):
        yield from _sized("types", name, languages)


def _line_blocks(languages: list[Language]) -> Iterator[File]:
    """The functions and blocks of a line."""
    for name in LINE_BLOCKS:
        yield File("line", name, render(f"line/{name}.st.j2", **_texts_of(languages)))
    for name in ("MB_Line", "MB_ByteLine"):
        yield from _sized("line", name, languages)


def _sized(folder: str, name: str, languages: list[Language]) -> Iterator[File]:
    """One type or block for each number of slots."""
    for slots in LINE_SIZES:
        yield File(folder, f"{name}{slots}", render(f"line/{name}.st.j2", slots=slots, **_texts_of(languages)))


def drive(stem: str, drive: Drive, languages: list[Language]) -> Iterator[File]:
    """The blocks of one drive. Raises ValueError when a name makes no identifier."""
    shared = {"drive": context.identity(drive), **_texts_of(languages)}
    for template, values in (*_blocks(drive), *_texts(drive, languages)):
        yield _file(stem, template, {"name": f"{drive.prefix}_{template}", **shared, **values})


def _blocks(drive: Drive) -> Iterator[tuple[str, Mapping[str, object]]]:
    """The template of each block, and what it is to print."""
    allowed = plan(drive)
    yield "CanAccess", vars(context.access(drive, "r", holding(allowed.readable)))
    yield "CanAccess", vars(context.access(drive, "w", holding(allowed.writable)))
    yield "MayWrite", vars(parameter.may_write(drive, allowed))
    numbers = parameter.addresses(drive)
    if numbers is not None:
        yield type(numbers).__name__, vars(numbers)
    yield "Request", vars(context.request(drive, allowed))
    yield "Reply", vars(context.reply(drive))
    if drive.operation.in_one_word:
        yield "Command", vars(context.command(drive))
    yield "Reference", vars(context.reference(drive))
    yield "Standstill", vars(context.standstill(drive))
    bits = context.fault_number(drive)
    if bits is not None:
        yield "FaultNumber", vars(bits)
    yield from (("Decoder", vars(one)) for one in context.decoders(drive))
    yield from (("Scale", vars(one)) for one in context.scales(drive))
    block = {**drive_block(drive).values, "parameter": parameter.passing(drive, allowed)}
    for part in (*(["Identity"] if drive.identity else []), "Reads", "Orders", "ParameterGate", "Drive"):
        yield part, block
    yield "Version", vars(context.version(drive))


def _texts_of(languages: list[Language]) -> dict[str, str]:
    """The language whose texts a comment points to, the first that is built, and the function of the result codes."""
    suffix = languages[0].suffix if languages else text.ENGLISH.suffix
    return {"language": suffix, "texts": f"MB_ResultText{suffix}"}


def _texts(drive: Drive, languages: list[Language]) -> Iterator[tuple[str, Mapping[str, object]]]:
    for language in languages:
        if text.exists(drive, "Fault", language):
            yield "CodeText", vars(text.fault_texts(drive, language))
        warnings = text.warning_texts(drive, language)
        if warnings is not None and text.exists(drive, "Warning", language):
            yield "CodeText", vars(warnings)
        if text.exists(drive, "Error", language):
            yield "CodeText", vars(text.error_texts(drive, language))
        for one in text.place_texts(drive, language):
            yield "PlaceText", vars(one)


def _file(folder: str, template: str, values: Mapping[str, object]) -> File:
    return File(folder, str(values["name"]), render(f"drive/{template}.st.j2", **values))
