"""The files of the ST library: generic blocks, then the blocks of each drive, each after what it uses."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass

from driveblocks.maps.model import Drive
from driveblocks.maps.plan import holding, plan
from driveblocks.maps.rivals import first_reads
from driveblocks.render import context, parameter, text
from driveblocks.render.drive import drive_block
from driveblocks.render.environment import render
from driveblocks.render.text import Language

LINE2, LINE32, PARAMETERS, METER, PLANT, FRAMES, CHINESE = EXTRAS = (
    "Line2", "Line32", "Parameters", "Meter", "Plant", "Frames", "Chinese",
)  # fmt: skip
"""What a first motor does not need, each in files of its own, after what it uses."""
TYPES = ("MB_Adu",)
FRAME_TYPES = ("MB_Chars", "MB_Words", "MB_Registers", "MB_Request")
FUNCTIONS = ("MB_HexDigit", "MB_HexValue")
FRAME_BLOCKS = (
    "MB_Crc16", "MB_Crc16Compact", "MB_Lrc", "MB_RtuSeal", "MB_RtuOpen", "MB_AsciiEncode", "MB_AsciiDecode",
    "MB_BuildRead", "MB_BuildWriteSingle", "MB_BuildWriteMultiple", "MB_BuildDiagnostics", "MB_ParseReply",
)  # fmt: skip
LINE_TYPES = (
    "MB_LineFrame", "MB_RxRing", "MB_Port", "MB_Words4", "MB_Words16", "MB_Ask", "MB_Asks", "MB_Answer", "MB_Answers",
    "MB_Slot", "MB_StopTrack", "MB_StopCopy", "MB_LifeTrack", "MB_OwnerTrack", "MB_Track", "MB_Given",
    "MB_Heard", "MB_Sums", "MB_LineTrack",
)  # fmt: skip
LINE_BLOCKS = (
    "MB_CrcByte", "MB_Plus", "MB_Minus", "MB_Sixteen", "MB_Usual", "MB_Retries", "MB_Characters", "MB_WireMs",
    "MB_Reads", "MB_Repeats", "MB_CheckBegin", "MB_CheckByte", "MB_FrameKind", "MB_ReplyFits", "MB_ReplyMs",
    "MB_Withdrawn", "MB_Strays", "MB_Box", "MB_Barred", "MB_SlotErrorID", "MB_Rank", "MB_ProbeMs", "MB_WhyFailed",
    "MB_WhyUnsent", "MB_TriesOver", "MB_Overdue", "MB_PollMs",
    "MB_StopMs", "MB_OthersMs", "MB_CutMs", "MB_ReadsMs", "MB_AskCheck", "MB_Listen", "MB_Frame", "MB_Exchange",
    "MB_Promise", "MB_Foreign", "MB_Silence", "MB_Stop", "MB_Life", "MB_Owner", "MB_Content", "MB_OneSlot",
    "MB_Sending", "MB_Next", "MB_Scan", "MB_Stray", "MB_Drives", "MB_Doubled", "MB_Recalled", "MB_DeadMs",
)  # fmt: skip
CONTROL_BLOCKS = (
    "VFD_HardStop", "VFD_Next", "VFD_Link", "VFD_Unit", "VFD_Set", "VFD_Usual", "VFD_Pace", "VFD_Evidence",
    "VFD_Known", "VFD_IsScale", "VFD_Scaled", "VFD_ScaledSigned", "VFD_Diagnose", "VFD_Identity", "VFD_Bar",
    "VFD_Pins", "VFD_Ends", "VFD_Run", "VFD_FaultReset", "VFD_Start", "VFD_FirstStop", "VFD_StopRound", "VFD_Steady",
    "VFD_Send", "VFD_Reason", "VFD_Error", "VFD_Why", "VFD_Control",
)  # fmt: skip
PARAMETER_BLOCKS = ("VFD_ReadParameter", "VFD_WriteParameter", "VFD_Store")
DEVICE = ("MB_Device", "MB_Float")
"""What is for a meter or a sensor; the block needs some of those."""
GROUP_TYPES = ("VFD_Counted", "VFD_Member", "VFD_Members")
GROUP_BLOCKS = ("VFD_Hours", "VFD_Scale", "VFD_Place", "VFD_Group", "VFD_Duty")
"""What several drives need together: groups, analog inputs, and what is counted."""
DRIVE_TYPES = ("VFD_Settings", "VFD_Diagnosis", "VFD_Asked", "VFD_Seen")
LINE_SIZES = {8: "", 2: LINE2, 32: LINE32}
"""How many slots a line can have, that of the first motor first, and the extra that holds it."""
USUAL = next(iter(LINE_SIZES))
"""Slots of the line of a first motor."""
ON_FRAMES = ("Request", "Reply")
"""Templates of blocks of a drive that make frames without a line."""
LEAST_S = 60
"""Seconds between two stores in a memory that wears out; at this pace 100,000 of them take 69 days."""
BOXES = (("Adu", 256), ("Chars", 513))
PACKERS = {"Pack": "Outgoing", "Unpack": "Incoming"}
"""Blocks, and the buffer of their example: what is sent and what is received never share one."""


@dataclass(frozen=True)
class File:
    """One file of the library: folder, block name, text, and the extra that it belongs to, if to one."""

    folder: str
    name: str
    text: str
    extra: str = ""

    @property
    def path(self) -> str:
        """Path below the platform's folder."""
        return f"{self.folder}/{self.name}.st"


def generic(languages: list[Language]) -> Iterator[File]:
    """Types and blocks that every drive shares."""
    yield from _named("types", "types", TYPES)
    yield from _named("types", "types", FRAME_TYPES, FRAMES)
    yield from _line_types(languages)
    yield from _named("modbus", "modbus", FUNCTIONS)
    yield from _named("modbus", "modbus", FRAME_BLOCKS, FRAMES, **texts_of(languages))
    for box, most in BOXES:
        for packer, way in PACKERS.items():
            for bits in (8, 16):
                values = {"box": box, "most": most, "buffer": way + box.removeprefix("Adu")}
                rendered = render(f"modbus/{packer.lower()}{bits}.st.j2", **values)
                yield File("modbus", f"MB_{packer}{box}{bits}", rendered, FRAMES)
    for language in languages:
        yield _text_file("modbus", text.result_texts(language), language)
    yield from _line_blocks(languages)
    yield from _named("types", "types", DRIVE_TYPES, **texts_of(languages))
    yield from _named("vfd", "control", CONTROL_BLOCKS, **texts_of(languages))
    yield from _named("vfd", "control", PARAMETER_BLOCKS, PARAMETERS, least=LEAST_S, **texts_of(languages))
    yield from _named("device", "device", DEVICE, METER, **texts_of(languages))
    yield from _named("types", "plant", GROUP_TYPES, PLANT)
    yield from _named("plant", "plant", GROUP_BLOCKS, PLANT)
    for language in languages:
        yield _text_file("vfd", text.reason_texts(language), language)
        yield _text_file("vfd", text.state_texts(language), language)


def _named(folder: str, room: str, names: Iterable[str], extra: str = "", **values: object) -> Iterator[File]:
    """A file for each name, from its own template."""
    for name in names:
        yield File(folder, name, render(f"{room}/{name}.st.j2", **values), extra)


def _line_types(languages: list[Language]) -> Iterator[File]:
    """What a line, its slots and its port are made of."""
    yield from _named("types", "line", LINE_TYPES, **texts_of(languages))
    for name in ("MB_Slots", "MB_Tracks"):
        yield from _sized("types", name, languages)


def _line_blocks(languages: list[Language]) -> Iterator[File]:
    """The functions and blocks of a line."""
    yield from _named("line", "line", LINE_BLOCKS, **texts_of(languages))
    for name in ("MB_Line", "MB_ByteLine"):
        yield from _sized("line", name, languages)


def _sized(folder: str, name: str, languages: list[Language]) -> Iterator[File]:
    """One type or block for each number of slots."""
    for slots, extra in LINE_SIZES.items():
        rendered = render(f"line/{name}.st.j2", slots=slots, **texts_of(languages))
        yield File(folder, f"{name}{slots}", rendered, extra)


def drive(stem: str, drive: Drive, languages: list[Language]) -> Iterator[File]:
    """The blocks of one drive. Raises ValueError when a name makes no identifier."""
    shared = {"drive": context.identity(drive), **texts_of(languages)}
    for template, values in _blocks(drive):
        named = {"name": f"{drive.prefix}_{template}", **shared, **values}
        extra = FRAMES if template in ON_FRAMES else ""
        yield File(stem, str(named["name"]), render(f"drive/{template}.st.j2", **named), extra)
    for language in languages:
        for values in _texts(drive, language):
            yield _text_file(stem, {**shared, **values}, language)


def _blocks(drive: Drive) -> Iterator[tuple[str, Mapping[str, object]]]:
    """The template of each block, and what it is to print."""
    allowed = plan(drive)
    yield "CanAccess", context.access(drive, "r", holding(allowed.readable))
    yield "CanAccess", context.access(drive, "w", holding(allowed.writable))
    yield "MayWrite", vars(parameter.may_write(drive, allowed))
    numbers = parameter.addresses(drive)
    if numbers is not None:
        yield type(numbers).__name__, vars(numbers)
    yield "Request", context.request(drive, allowed)
    yield "Reply", context.reply(drive)
    if drive.operation.in_one_word:
        yield "Command", context.command(drive)
    yield "Reference", context.referred(drive)
    yield "Standstill", vars(context.standstill(drive))
    bits = context.fault_number(drive)
    if bits is not None:
        yield "FaultNumber", vars(bits)
    yield from (("Decoder", vars(one)) for one in context.decoders(drive))
    yield from (("Scale", vars(one)) for one in context.scales(drive))
    block = {**drive_block(drive).values, "parameter": parameter.passing(drive, allowed)}
    for part in (*(["Identity"] if first_reads(drive) else []), "Reads", "Orders", "ParameterGate", "Drive"):
        yield part, block
    yield "Version", context.version(drive)


def texts_of(languages: list[Language]) -> dict[str, str]:
    """The language whose texts a comment points to, the first that is built, and the function of the result codes."""
    suffix = languages[0].suffix if languages else text.ENGLISH.suffix
    return {"language": suffix, "texts": f"MB_ResultText{suffix}"}


def _texts(drive: Drive, language: Language) -> Iterator[Mapping[str, object]]:
    """What each text function of a drive is to print, in a language."""
    if text.exists(drive, "Fault", language):
        yield text.fault_texts(drive, language)
    warnings = text.warning_texts(drive, language)
    if warnings is not None and text.exists(drive, "Warning", language):
        yield warnings
    if text.exists(drive, "Error", language):
        yield text.error_texts(drive, language)
    yield from text.place_texts(drive, language)


def _text_file(folder: str, values: Mapping[str, object], language: Language) -> File:
    """A text function; one in Chinese is an extra."""
    template = "drive/PlaceText.st.j2" if "groups" in values else "drive/CodeText.st.j2"
    extra = "" if language.suffix == text.ENGLISH.suffix else CHINESE
    return File(folder, str(values["name"]), render(template, **values), extra)
