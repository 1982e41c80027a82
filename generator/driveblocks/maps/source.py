"""The text of a map file, read so that no file can hang, flood or confuse the loader."""

import os
import re
import stat
from itertools import islice
from pathlib import Path

from driveblocks.maps.problem import MapError, Place, Problem

MAX_BYTES = 512 << 10
"""A map of 400 registers takes some 60 kB; a file above this limit is not a map."""

_BOMS = (
    (b"\xff\xfe\x00\x00", "UTF-32"),
    (b"\x00\x00\xfe\xff", "UTF-32"),
    (b"\xff\xfe", "UTF-16"),
    (b"\xfe\xff", "UTF-16"),
)
_KINDS = (
    (stat.S_ISDIR, "a directory"),
    (stat.S_ISFIFO, "a named pipe"),
    (stat.S_ISSOCK, "a socket"),
    (stat.S_ISCHR, "a device"),
    (stat.S_ISBLK, "a device"),
)
_MOST_HIDDEN = 20
"""Such characters that are named one by one; a file with more is no text."""
HIDDEN = re.compile(
    "[\x00-\x08\x0b\x0c\x0e-\x1f\x7f-\x9f"  # control characters but tab and line ends
    "\xa0\xad\u1680\u180e\u2000-\u200f\u2028-\u202f\u205f-\u206f\ufeff"  # unusual spaces, marks without a shape
    "\ud800-\udfff\ufff0-\uffff\U000e0000-\U000effff]"
)
"""Characters that nobody sees in an editor, and that a terminal or a compiler may take for something else."""


def read(path: Path) -> str:
    """Return the text of a UTF-8 file of at most MAX_BYTES, without a byte order mark. Raises MapError."""
    try:
        data = _bytes(path)
    except OSError as error:
        raise _refused(path, f"cannot be read: {error.strerror}", "name a readable file") from None
    except ValueError:  # a path with a NUL in it
        raise _refused(path, "has no possible name", "name a readable file") from None
    return _text(path, data)


def _bytes(path: Path) -> bytes:
    _regular(path, path.stat().st_mode)
    # without O_NONBLOCK a pipe that took the file's place meanwhile would wait for a writer
    handle = os.open(path, os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0))
    try:
        _regular(path, os.fstat(handle).st_mode)
        with open(handle, "rb", closefd=False) as file:
            data = file.read(MAX_BYTES + 1)
    finally:
        os.close(handle)
    if len(data) > MAX_BYTES:
        wrong = f"is larger than {MAX_BYTES // 1024} KiB"
        raise _refused(path, wrong, "a map describes one drive family in a few dozen KiB")
    return data


def _regular(path: Path, mode: int) -> None:
    for is_kind, kind in _KINDS:
        if is_kind(mode):
            raise _refused(path, f"is {kind}", "name a map file, such as my_drive.yaml")


def _text(path: Path, data: bytes) -> str:
    for mark, name in _BOMS:
        if data.startswith(mark):
            raise _refused(path, f"is {name} text", "save it as UTF-8")
    data = data.removeprefix(b"\xef\xbb\xbf")
    try:
        text = data.decode("utf-8")
    except UnicodeDecodeError as error:
        good = data[: error.start].decode("utf-8")
        raise _refused(path, f"is not UTF-8: byte {data[error.start]:02X}H", "save it as UTF-8", good) from None
    hidden = [_hidden(path, match) for match in islice(HIDDEN.finditer(text), _MOST_HIDDEN)]
    if hidden:
        raise MapError(hidden)
    return text


def _hidden(path: Path, match: re.Match[str]) -> Problem:
    wrong = f"this file holds the character U+{ord(match[0]):04X}, which has no place in a map"
    line, column = _place(match.string[: match.start()])
    return Problem(str(path), line, column, wrong, "remove it, or type a plain one")


def _place(before: str) -> Place:
    return before.count("\n") + 1, len(before) - before.rfind("\n")


def _refused(path: Path, wrong: str, right: str, before: str = "") -> MapError:
    return MapError([Problem(str(path), *_place(before), f"this file {wrong}", right)])
