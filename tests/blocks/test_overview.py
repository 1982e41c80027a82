"""The figures of blocks/README.md: memory summed a second time, loops counted while each block does its worst."""

import functools
import re
from bisect import bisect_right
from pathlib import Path

import pytest
from tests.blocks.library import BLOCKS, Blocks, octets, sources
from tests.shipped import drives

from driveblocks.maps.form import is_bit
from driveblocks.maps.model import Drive
from driveblocks.reference.framing import rtu_seal
from structured_text.engines.embedded.engine import EmbeddedEngine
from structured_text.engines.embedded.library import EmbeddedLibrary
from structured_text.engines.engine import Source, Value

WIDTHS = {"BOOL": 1, "BYTE": 1, "USINT": 1, "WORD": 2, "UINT": 2, "INT": 2, "DINT": 4, "UDINT": 4, "REAL": 4}
TYPES = {
    "MB_Adu": 256, "MB_Chars": 513, "MB_Words": 250, "MB_Registers": 1026, "MB_Request": 12,
    "MB_LineFrame": 40, "MB_RxRing": 256, "MB_Port": 356, "MB_Words4": 8, "MB_Words16": 32, "MB_Ask": 19,
    "MB_Asks": 76, "MB_Answer": 6, "MB_Answers": 24, "MB_Slot": 254, "MB_StopTrack": 13, "MB_StopCopy": 13,
    "MB_LifeTrack": 21, "MB_OwnerTrack": 9, "MB_Track": 75, "MB_Given": 24, "MB_Heard": 83, "MB_Sums": 81,
    "MB_LineTrack": 21, "MB_Slots8": 8 * 254, "MB_Slots2": 2 * 254,
    "MB_Slots32": 32 * 254, "MB_Tracks8": 8 * 75, "MB_Tracks2": 2 * 75, "MB_Tracks32": 32 * 75, "VFD_Settings": 42,
    "VFD_Counted": 8, "VFD_Member": 18, "VFD_Members": 288,
    "VFD_Diagnosis": 145, "VFD_Asked": 13, "VFD_Seen": 35,
}  # fmt: skip
"""ABI 1, typed by hand: 256 bytes; 513 characters; 125 words; 513 words; six fields of two bytes;
the line's; the drive blocks'."""

_ROW = re.compile(r"^\| \[`(\w+)`\]\(\S+\)( FB| function)? \|.*\| *(\d*) *\| *([^|]*?) *\|$", re.MULTILINE)
_TYPE = re.compile(r"^\| \[`(\w+)`\]\(\S+types/\w+\.st\) \|[^|]*\| (\d+) \|$", re.MULTILINE)
_VARIABLE = re.compile(r"^  (\w+) : (\w+)(?:\[0\.\.(\d+)\] OF (\w+))?\s*(?::=|;)", re.MULTILINE)
README = (Path(BLOCKS).parent / "README.md").read_text(encoding="utf-8")
TEXTS = {Path(source.path).stem: source.text for source in sources()}
ROWS = {name: (kind.strip(), size, loops) for name, kind, size, loops in _ROW.findall(README) if kind}


def size_of(type_: str) -> int:
    """Bytes of a type or of an instance of a block."""
    return WIDTHS.get(type_) or TYPES.get(type_) or memory(type_)


@functools.cache
def memory(block: str) -> int:
    """The sum of the widths of a block's variables, read from its text."""
    declared = re.sub(r"\(\*.*?\*\)", "", TEXTS[block], flags=re.DOTALL).rpartition("END_VAR")[0]
    total = 0
    for _, type_, last, element in _VARIABLE.findall(declared.replace("ARRAY[", "ARRAY[")):
        total += (int(last) + 1) * size_of(element) if last else size_of(type_)
    return total


def test_every_block_is_listed() -> None:
    assert set(ROWS) == set(TEXTS) - set(TYPES)


def test_sizes_of_types_are_published() -> None:
    assert {name: int(size) for name, size in _TYPE.findall(README)} == TYPES


@pytest.mark.parametrize("block", [name for name, (kind, _, _) in ROWS.items() if kind == "FB"])
def test_memory(block: str) -> None:
    assert int(ROWS[block][1]) == memory(block)


LONGEST = b":" + b"00" * 255 + b"\r\n"
PACKED = {
    f"MB_{way}{box}{bits}": {"CharCount": 513}
    for way in ("Pack", "Unpack")
    for box in ("Adu", "Chars")
    for bits in (8, 16)
}
OPEN: dict[str, Value] = {
    "Length": 253,
    "Adu": bytes((1, 3, 250)),
    "Request.UnitAddress": 1,
    "Request.FunctionCode": 3,
    "Request.Quantity": 125,
}
WRITE: dict[str, Value] = {"UnitAddress": 1, "FunctionCode": 16, "Quantity": 10, "MaxWords": 123}
WORST: dict[str, dict[str, Value]] = {
    "MB_Crc16": {"Length": 256},
    "MB_Crc16Compact": {"Length": 256},
    "MB_Lrc": {"Length": 256},
    "MB_RtuSeal": {"Length": 254},
    "MB_RtuOpen": {"AduLength": 256},
    "MB_AsciiEncode": {"Length": 254},
    "MB_AsciiDecode": {"CharCount": 513, "Chars": LONGEST},
    "MB_Foreign": {"Acknowledge": True},
    "MB_Frame": {"Ascii": True, "FunctionCode": 16, "Quantity": 4, "CharUs": 573},
    "MB_Device": {"Address": 1},
    "VFD_Group": {"Count": 16},
    "VFD_Duty": {"Run": True, "Count": 16, "Duty": 16, **{f"Members[{number}].Ready": True for number in range(16)}},
    "MB_BuildWriteMultiple": {**WRITE, "Quantity": 123},
    "MB_ParseReply": OPEN,
    **{f"{prefix}_Reply": OPEN for prefix in drives()},
    "ATV312_Request": {**WRITE, "Address": 0x0C1E, "Quantity": 4},
    "GD200A_Request": {**WRITE, "Address": 0x2000, "Quantity": 15},
    "JSCC_Request": {**WRITE, "Address": 0x0000},
    "MX2_Request": {**WRITE, "Address": 0x144D, "Quantity": 5},
    "SN300G5_Request": {**WRITE, "Address": 0x0106, "Quantity": 16},
    "SN300G5_FaultNumber": dict.fromkeys(
        (*(f"FaultContents{n}Word" for n in (1, 2, 3)), "CPFContents1Word", "CPFContents2Word"), 0xFFFF
    ),
    "IG5A_FaultNumber": {"TripInfoWord": 0xFFFF},
    **{name: dict(pins) for name, pins in PACKED.items()},
}
"""Pins with which a block turns as often as it can."""


def longest(drive: Drive) -> dict[str, Value]:
    """A write of the most registers side by side that can be written."""
    written = {
        address
        for section in drive.sections
        for row in section.registers
        for address in row.address
        if "w" in (row.access or section.access) and not is_bit(address)
    }
    starts = [address for address in written if address - 1 not in written]
    sizes = {start: next(count for count in range(1, 125) if start + count not in written) for start in starts}
    start = max(sorted(sizes), key=sizes.__getitem__)
    return {**WRITE, "Address": start, "Quantity": sizes[start]}


def all_set(block: str) -> dict[str, Value]:
    """Every bit of the words that it reads."""
    declared = TEXTS[block].partition("VAR_INPUT")[2].partition("END_VAR")[0]
    return dict.fromkeys(re.findall(r"^  (\w+) : WORD;", declared, re.MULTILINE), 0xFFFF)


NUMBERS = [name for name in ROWS if name.endswith("_FaultNumber") and name not in WORST]
WORST |= {name: all_set(name) for name in NUMBERS}
UNTYPED = [*NUMBERS, *(name for name in (f"{prefix}_Request" for prefix in drives()) if name not in WORST)]
WORST |= {
    name: longest(drives()[name.removesuffix("_Request")])
    for name in UNTYPED
    if name not in NUMBERS and ROWS[name][2] != "none"
}

SLACK = {
    "MB_AsciiDecode": 1, "MB_Frame": 3, "SN300G5_FaultNumber": 32, "GD200A_Request": 1, "ATV312_Request": 23,
    "MX2_Request": 11, "IG5A_FaultNumber": 8,
}  # fmt: skip
"""Turns that the stated bound has to spare: the LRC is not summed with itself; a request of a line has fewer bytes;
bits that no fault has are masked;
no more registers that can be written are side by side."""


@functools.cache
def counted() -> EmbeddedLibrary:
    """The library with a count for each line."""
    return EmbeddedEngine(coverage=True).build(sources())


@functools.cache
def inside() -> list[tuple[str, int]]:
    """The first statement in each loop, by file and line."""
    lines = counted().coverage()
    found = []
    for source in sources():
        here = sorted(lines.get(source.path, ()))
        starts = (number for number, text in enumerate(source.text.splitlines(), start=1) if text.endswith(" DO"))
        found += [(source.path, here[bisect_right(here, start)]) for start in starts if here]
    return found


def turns() -> int:
    """How often the first statement in a loop has run, in all files."""
    hits = counted().coverage()
    return sum(hits[path][line] for path, line in inside())


def bound(block: str) -> int:
    """The stated number of loops."""
    numbers = re.findall(r"\d+", ROWS[block][2])
    return int(numbers[-1]) if numbers else 0


@pytest.mark.parametrize("block", WORST)
@pytest.mark.thorough
def test_loops_at_their_worst(block: str) -> None:
    before = turns()
    done = Blocks(counted()).run(block, {pin: value for pin, value in WORST[block].items() if has(block, pin)})
    rounds = turns() - before
    assert rounds <= bound(block)
    assert block in UNTYPED or rounds >= bound(block) - SLACK.get(block, 0), (rounds, done.state())


def has(block: str, pin: str) -> bool:
    """Whether a block has a pin."""
    return re.search(rf"^  {re.split(r'[.[]', pin)[0]} :", TEXTS[block], re.MULTILINE) is not None


@pytest.mark.parametrize("block", [name for name, (_, _, loops) in ROWS.items() if loops == "none"])
def test_blocks_without_loops_have_none_inside(block: str) -> None:
    assert " DO\n" not in TEXTS[block]
    inner = {type_ for _, type_, _, _ in _VARIABLE.findall(TEXTS[block])} & set(ROWS)
    assert all(ROWS[one][2] == "none" for one in inner)


def test_every_block_with_loops_is_tried_at_its_worst() -> None:
    lines = {f"MB_{kind}{slots}" for kind in ("Line", "ByteLine") for slots in (2, 8, 32)}  # tests/line/test_text.py
    lines |= {"MB_Exchange", "MB_Sending", "MB_ReadsMs"}  # in a line
    lines.add("MB_Float")  # a function: tests/line/test_float.py
    assert {name for name, (_, _, loops) in ROWS.items() if loops != "none"} - set(DRIVES) == set(WORST) | lines


DRIVES = [name for name in ROWS if name.endswith("_Drive")]


@pytest.mark.parametrize("block", DRIVES)
def test_the_loops_of_a_drive_block_are_its_own_and_those_inside(block: str) -> None:
    """It comes first in its family; of its own it has none."""
    family = [name for name in ROWS if name.startswith(block.removesuffix("Drive"))]
    assert family[0] == block
    assert " DO\n" not in TEXTS[block]
    inner = {type_ for _, type_, _, _ in _VARIABLE.findall(TEXTS[block])} & set(ROWS)
    assert bound(block) == sum(map(bound, inner))


EXAMPLES = {
    prefix: text for text, prefix in re.findall(r"```\n(PROGRAM (\w+)_Example\n.*?END_PROGRAM\n)```", README, re.DOTALL)
}
REPLY = bytes((1, 3, 2, 0, 1))


@pytest.mark.parametrize("prefix", ["CHF", "JSCC", "SN300G5"])
@pytest.mark.thorough
def test_the_example_of_a_drive_believes_a_reply_and_no_buffer_that_nothing_came_into(prefix: str) -> None:
    """Where one buffer held both frames, a port that received nothing left the request to be read as the reply."""
    source = Source("example.st", EXAMPLES[prefix])
    program = EmbeddedEngine().build([*sources(), source]).instance(f"{prefix}_Example")
    for frame, trouble in ((b"", 20), (rtu_seal(REPLY).data, 0), (rtu_seal(REPLY).data[:-1], 23)):
        program.scan()
        sent = octets(program, "Outgoing", 8)
        assert (program["State"], program["Trouble"], sent) == (1, 0, rtu_seal(sent[:6]).data)
        for index, octet in enumerate(frame):
            program[f"Incoming[{index}]"] = octet
        program["Received"], program["State"] = len(frame), 2
        program.scan()
        assert (program["State"], program["Trouble"]) == (0, trouble)
    program["Received"], program["State"] = 8, 2
    program.scan()
    assert program["Trouble"] != 0
