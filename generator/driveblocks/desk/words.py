"""What several commands take from the command line alike: ports, times, files, and how they refuse them."""

import errno
import re
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from driveblocks.desk import script
from driveblocks.desk.port import reason
from driveblocks.maps.problem import Refused
from driveblocks.meaning.serial import FORMS
from structured_text import files

NO_PORT = "--port names no port; write one such as /dev/ttyUSB0 or COM3"
LOOPBACK = ("", "127.0.0.1", "localhost")


def is_port(number: str) -> bool:
    """Whether digits are the number of a TCP port that one can connect to."""
    return bool(re.fullmatch("[0-9]{1,5}", number)) and 0 < int(number) <= 0xFFFF


def time(word: str, text: str, least: int, most: int) -> int:
    """A time of the command line in microseconds. Raises Refused."""
    try:
        us = script.duration_us(text)
    except ValueError as error:
        raise Refused(f"{word}: {error}") from None
    if not least <= us <= most:
        raise Refused(f"{word} {text} is out of range; write {least / 1e6:g}s to {most / 1e6:g}s")
    return us


def wrong_speech(rate: int | None, form: str | None) -> Iterator[str]:
    """What is wrong with a bit rate and a format, where they are named."""
    if rate is not None and not 300 <= rate <= 1_000_000:
        yield f"--rate {rate} is out of range; write 300 to 1000000 bit/s"
    if form is not None and form.upper() not in FORMS:
        yield f"--format {form} is no format; write one of {', '.join(FORMS)}"


@contextmanager
def opening(place: str, instead: str = "") -> Iterator[None]:
    """Say why a port cannot be opened, and what to do instead. Raises Refused."""
    try:
        yield
    except ImportError as error:
        raise Refused(f"--port needs pyserial, which does not run here: {error}") from None
    except (OSError, ValueError, OverflowError) as error:
        raise Refused(f"{place}: {reason(error)}{instead}") from None


def spare(path: Path, head: bytes, writer: str) -> None:
    """Raises OSError for a file that holds anything but what `writer` writes, which begins with the pattern `head`."""
    if not path.is_file():
        return
    begin = files.head(path, 4096)
    if begin and not re.match(head, begin):
        why = f"there is a file that {writer} has written; name a new one, or move it away"
        raise OSError(errno.EEXIST, why, str(path))
