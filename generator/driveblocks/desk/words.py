"""What several commands take from the command line alike: ports, times, and how they refuse what they are given."""

import re

from driveblocks.desk import script

NO_PORT = "--port names no port; write one such as /dev/ttyUSB0 or COM3"
LOOPBACK = ("", "127.0.0.1", "localhost")


class Refused(Exception):  # noqa: N818  (bad input is no error of the program)
    """What is wrong with the words of the command line, or with what they name."""


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
