"""The text of a map file, read so that no file can hang, flood or confuse the loader."""

import stat
from pathlib import Path

from driveblocks.maps.problem import MapError, Problem

MAX_BYTES = 1 << 20
"""A map of 400 registers takes some 60 kB; a file above this limit is not a map."""

_BOMS = ((b"\xff\xfe", "UTF-16 or UTF-32"), (b"\xfe\xff", "UTF-16"), (b"\x00\x00\xfe\xff", "UTF-32"))
_KINDS = (
    (stat.S_ISDIR, "a directory"),
    (stat.S_ISFIFO, "a named pipe"),
    (stat.S_ISSOCK, "a socket"),
    (stat.S_ISCHR, "a device"),
    (stat.S_ISBLK, "a device"),
)


def read(path: Path) -> str:
    """Return the text of a UTF-8 file of at most MAX_BYTES, without a byte order mark. Raises MapError."""
    try:
        data = _bytes(path)
    except OSError as error:
        raise _refused(path, f"cannot be read: {error.strerror}", "name a readable file") from None
    return _text(path, data)


def _bytes(path: Path) -> bytes:
    mode = path.stat().st_mode
    for is_kind, kind in _KINDS:
        if is_kind(mode):
            raise _refused(path, f"is {kind}", "name a map file, such as my_drive.yaml")
    with path.open("rb") as file:
        data = file.read(MAX_BYTES + 1)
    if len(data) > MAX_BYTES:
        raise _refused(
            path, f"is larger than {MAX_BYTES // 1024} KiB", "a map describes one drive family in a few dozen KiB"
        )
    return data


def _text(path: Path, data: bytes) -> str:
    for mark, name in _BOMS:
        if data.startswith(mark):
            raise _refused(path, f"is {name} text", "save it as UTF-8")
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        good = data[: error.start].decode("utf-8-sig")
        raise _refused(path, f"is not UTF-8: byte {data[error.start]:02X}H", "save it as UTF-8", good) from None
    position = next((i for i, c in enumerate(text) if c < " " and c not in "\t\n\r"), None)
    if position is not None:
        wrong = f"holds the control character {ord(text[position]):02X}H"
        raise _refused(path, wrong, "a map is plain text; remove it", text[:position])
    return text


def _refused(path: Path, wrong: str, right: str, before: str = "") -> MapError:
    line = before.count("\n") + 1
    column = len(before) - before.rfind("\n")
    return MapError([Problem(str(path), line, column, f"this file {wrong}", right)])
