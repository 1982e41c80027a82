"""The blocks of a platform's serial port, and the first programs at it: they name what only that platform has."""

from collections.abc import Iterator, Mapping

from driveblocks.maps.model import Drive
from driveblocks.platforms import CANONICAL, PLATFORMS
from driveblocks.render.drive import drive_block
from driveblocks.render.environment import render
from driveblocks.render.library import LINE_SIZES, USUAL, File, texts_of
from driveblocks.render.motor import motor
from driveblocks.render.text import Language

HOLDING = 3
"""The function that reads holding registers (MODBUS Application Protocol V1.1b3, 6.3)."""


def adapter(platform: str, languages: list[Language]) -> Iterator[File]:
    """The port and the lines on top of it; none where the program gives and takes the bytes."""
    one = PLATFORMS[platform]
    if one.prefix == "MB":
        return
    yield File(platform, f"{one.prefix}_Port", render(f"{platform}/{one.prefix}_Port.st.j2", where=one.where))
    for slots, extra in LINE_SIZES.items():
        bits = "Bits" if one.parity else "CharacterBits"
        values = {"slots": slots, "where": one.where, "busy": one.busy, "bits": bits}
        line = render(f"{platform}/{one.line}.st.j2", **values, **texts_of(languages))
        yield File(platform, f"{one.line}{slots}", line, extra)


def first_motor(platform: str, drive: Drive) -> File:
    one = PLATFORMS[platform]
    own = CANONICAL if one.prefix == "MB" else platform
    values = {"platform": own, "where": one.where, "line": f"{one.line}{USUAL}", **motor(drive)}
    return File(platform, f"{drive.prefix}_Motor", render("motor/Motor.st.j2", **values))


def master(platform: str, drive: Drive, values: Mapping[str, object], languages: list[Language]) -> File:
    """A program for a PLC that is itself the master."""
    text = render(f"{platform}/Master.st.j2", **values, **texts_of(languages))
    return File(platform, f"{drive.prefix}_Master", text)


def by_words(drive: Drive) -> bool:
    """Whether a motor takes no more than holding registers that are read, and single words that are written."""
    block = drive_block(drive)
    read = all(each.read.function == HOLDING for each in block.reading.reads)
    return read and drive.operation.in_one_word and not block.ordering.referred.pair
