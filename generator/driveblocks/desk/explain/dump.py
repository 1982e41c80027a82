"""Hexdumps: lines of an offset, bytes, and a column of characters, as loggers and hexdump, xxd, od print them."""

import re

from driveblocks.desk.explain import hexadecimal
from driveblocks.desk.explain.unreadable import Spot

_OFFSET = re.compile(r"\s*(?:0x)?(?P<digits>[0-9A-Fa-f]{4,8})h?(?P<end>:[ \t]+|[ \t]{2,}|\t|[ ]|\s*$)")
_GROUPS = re.compile(r"\s*(?:[0-9A-Fa-f]{2,8}(?:[ -](?=[0-9A-Fa-f])|$))+")
_GAP = re.compile(r"[ \t]{2,}|\t|[ ](?=\|)")

_WIDEST = 2 * 513
"""Bytes and characters beyond which a line is none of a dump: it would hold more than any frame."""

Lines = list[tuple[int, str]]


def read(lines: Lines) -> bytes | None:
    """The bytes of a dump; None if the lines are none. Raises Spot for a line of a dump that cannot be read."""
    if _offset(lines[0][1], 0) is None:
        return _columns(lines)
    data = bytearray()
    for place, line in lines:
        if data and _closing(line, len(data)):
            break
        behind = _offset(line, len(data))
        if behind is None:
            wrong = f"this line does not start with the offset {len(data):04X}"
            raise Spot(place, wrong, "paste the dump's lines as they were printed, without gaps")
        end, _ = _split(line[behind:])
        data += hexadecimal.read(line[behind : behind + end], place + behind)
    return bytes(data)


def _offset(line: str, expected: int) -> int | None:
    """Where the bytes of a line start, if it begins with the expected offset; the first may be any round one."""
    match = _OFFSET.match(line)
    if match is None:
        return None
    digits, end = match["digits"], match["end"]
    values = {int(digits, 16)} | ({int(digits, 8)} if re.fullmatch("[0-7]+", digits) else set())
    if expected == 0 and not any(value == 0 or (value % 16 == 0 and end.startswith(":")) for value in values):
        return None
    if expected and expected not in {value & 0xFFF for value in values} | values:
        return None
    single = end == " " and len(digits) < 7
    return None if single or (expected == 0 and not end.strip() and match.end() >= len(line.rstrip())) else match.end()


def _closing(line: str, length: int) -> bool:
    """Whether a line is the last offset alone; a dump of words may have filled up the last one."""
    match = _OFFSET.fullmatch(line.strip())
    return match is not None and int(match["digits"], 16) in (length, length - 1)


def _columns(lines: Lines) -> bytes | None:
    """Lines without an offset, but with a column of characters after the bytes."""
    found = [_split(line) for _, line in lines]
    if not any(column for _, column in found):
        return None
    return b"".join(hexadecimal.read(line[:end], place) for (place, line), (end, _) in zip(lines, found, strict=True))


def _split(line: str) -> tuple[int, bool]:
    """Where the bytes of a line end, and whether a column of characters follows that shows the same bytes."""
    text = line.rstrip("\r\n")
    digits, ends = _ends(text)
    for gap, count in reversed(ends):
        if len(text) - gap.end() > _WIDEST or count > 2 * _WIDEST:
            break
        data = bytes.fromhex(digits[:count]) if count % 2 == 0 else b""
        column = text[gap.end() :].rstrip(" \t")
        bare = column[1:].removesuffix("|") if column.startswith("|") else column
        if data and (_shows(bare, data) or _shows(column, data)):
            return gap.start(), True
    return len(text), False


def _ends(text: str) -> tuple[str, list[tuple[re.Match[str], int]]]:
    """The digits that a line begins with, and every gap after nothing but digits with how many come before it."""
    pieces: list[str] = []
    ends: list[tuple[re.Match[str], int]] = []
    count = start = 0
    for gap in _GAP.finditer(text):
        part = text[start : gap.start()].strip()
        start = gap.end()
        if part:
            if _GROUPS.fullmatch(part) is None:
                break
            pieces.append(re.sub(r"[ -]", "", part))
            count += len(pieces[-1])
            ends.append((gap, count))
    return "".join(pieces), ends


def _shows(column: str, data: bytes) -> bool:
    """Whether a column can be the characters of some bytes: printable ones as they are, the others by some sign."""
    characters = [chr(byte) if 0x20 <= byte < 0x7F else None for byte in data]
    while characters and characters[-1] == " " and len(column) < len(characters):
        characters.pop()
    if characters[:1] == [" "]:
        column = column.rjust(len(characters))
    return (
        len(column) == len(characters)
        and bool(column.strip())
        and all(sign == meant or meant is None for sign, meant in zip(column, characters, strict=True))
    )
