"""Pasted text -> bytes: hexadecimal in any usual spelling, a hexdump, or the characters of an ASCII frame.

What cannot be understood is reported with its line and column; nothing is guessed or left out silently.
"""

import re
from dataclasses import dataclass
from typing import Literal

from driveblocks.desk.explain import characters, dump, hexadecimal
from driveblocks.desk.explain.unreadable import Spot
from driveblocks.maps.problem import Refused

LONGEST = 1 << 16
"""Characters; an ASCII frame has 513, and a hexdump of some of them is still far below this."""

_WIDE = {code: code - 0xFEE0 for code in range(0xFF01, 0xFF5F)}
_LIKE = _WIDE | str.maketrans("\u3000\xa0\u3001\ufeff\u200b\u201c\u201d\u2013", '  ,  ""-')
"""Characters that mean an ASCII one, each for one, so that columns stay right."""

_LABEL = re.compile(
    r"""\s*(?:
    \[?(?:\d{4}[-/.]\d\d[-/.]\d\d[T ]\s*)?\d{1,2}:\d\d:\d\d(?:[.,]\d+)?\]?[ ]+   # a logger's time
    | \[(?:tx|rx|send|recv|out|in)\]
    | (?:tx|rx|tx[ ]?data|rx[ ]?data|sen[dt]|recv|receive[d]?|request|reply|response|query|answer|master|slave|out|in
        |发送|接收|请求|应答|主机|从机)(?![A-Za-z0-9]):?
    | (?:[-=]?>+|<+[-=]?)(?=\s)
    | :\s+(?=:)
    )""",
    re.VERBOSE | re.IGNORECASE,
)

Form = Literal["hexadecimal", "hexdump", "characters"]


@dataclass(frozen=True)
class Paste:
    """The bytes, how they were written, and what was understood on the way that a person should know."""

    data: bytes
    form: Form
    notes: tuple[str, ...] = ()


def read(text: str, name: str = "frame") -> Paste:
    """Read a pasted frame; `name` is for messages. Raises Refused with `name:line:column: wrong; right`."""
    try:
        return _read(text.translate(_LIKE))
    except Spot as spot:
        raise Refused(spot.told(text, name)) from None


def _read(text: str) -> Paste:
    if len(text) > LONGEST:
        raise Spot(LONGEST, "this is too long for a frame", "paste one frame")
    lines = list(_lines(text))
    if not lines:
        raise Spot(0, "there is nothing", "paste a frame, such as 01 03 20 00 00 01 8F CA or :010320000001DB")
    if len(lines) == 1 and hexadecimal.is_literal(lines[0][1]):
        return Paste(hexadecimal.read(lines[0][1], lines[0][0]), "hexadecimal")
    if characters.fits([line for _, line in lines]):
        data, notes = characters.read(lines)
        return Paste(data, "characters", notes)
    dumped = dump.read(lines)
    if dumped is not None:
        return Paste(dumped, "hexdump")
    data = b"".join(hexadecimal.read(line, start) for start, line in lines)
    if not data:
        raise Spot(lines[0][0], "there are no bytes", "write them as 01 03 20 00 00 01 8F CA")
    return Paste(data, "hexadecimal")


def _lines(text: str) -> list[tuple[int, str]]:
    """Every line that is neither blank nor a remark, without a logger's label, with the place where it starts."""
    found, place = [], 0
    for whole in text.splitlines(keepends=True):
        start = _unlabelled(whole)
        if whole[start:].strip() and not whole.startswith("#"):
            found.append((place + start, whole[start:]))
        place += len(whole)
    return found


def _unlabelled(line: str) -> int:
    """Where a line's content starts, after a time, TX, RX and the like; at its start if nothing would be left."""
    start, end = 0, len(line.rstrip())
    while (match := _LABEL.match(line, start)) and match.end() < end:
        start = match.end()
    return start
