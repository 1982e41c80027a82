"""The text of a map file, read so that no file can hang, flood or confuse the loader."""

import re
from itertools import islice
from pathlib import Path

from driveblocks.maps.problem import MapError, Problem
from structured_text import files

MAX_BYTES = 512 << 10
"""A map of 400 registers takes some 60 kB; a file above this limit is not a map."""

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
        text = files.text(path, MAX_BYTES)
    except files.BadFile as error:
        right = error.right or "name the readable file of one drive family"
        raise MapError([Problem(str(path), *error.at, f"this file cannot be read: {error.why}", right)]) from None
    if hidden := [*islice(HIDDEN.finditer(text), _MOST_HIDDEN)]:
        wrong, right = (
            "this file holds the character U+{:04X}, which has no place in a map",
            "remove it, or type a plain one",
        )
        places = [(files.place(text[: each.start()]), ord(each[0])) for each in hidden]
        raise MapError([Problem(str(path), *at, wrong.format(code), right) for at, code in places])
    return text
