"""The page of whatever entry a word was found to mean."""

from collections.abc import Iterator

from rich.console import RenderableType

from driveblocks.maps.lookup import Match
from driveblocks.maps.model import Area, Bit, Drive, ErrorCode, Fault, Frame, Function, Register, Section, Setting
from driveblocks.show import faults, frames, line, register, registers


def pages(drive: Drive, chosen: list[Match], others: list[Match]) -> Iterator[RenderableType]:
    """The pages of the chosen entries, one after the other, and what else the word may mean."""
    if len(chosen) > 1:
        yield "This is several things; all follow: " + "; ".join(match.shown for match in chosen) + "\n"
    for match in chosen:
        yield from page(drive, match)
    for match in others:
        yield f"also: {match.shown}"


def page(drive: Drive, match: Match) -> Iterator[RenderableType]:
    entry = match.entry
    if isinstance(entry, Register | Bit):
        yield from _register(drive, match)
    elif isinstance(entry, Area):
        yield from register.area_page(drive, entry, match.address)
    elif isinstance(entry, Section):
        yield from registers.section(drive, entry)
    elif isinstance(entry, Fault):
        yield from faults.of_fault(drive, entry)
    else:
        yield from _other(drive, entry)


def _register(drive: Drive, match: Match) -> Iterator[RenderableType]:
    """The row that was found, or the row of a bit."""
    for section, row in drive.registers():
        if row is match.entry or (match.address in row.address and match.entry in row.bits):
            yield from register.page(drive, section, row, match.address)


def _other(drive: Drive, entry: ErrorCode | Function | Setting | Frame) -> Iterator[RenderableType]:
    if isinstance(entry, ErrorCode):
        yield faults.of_error(drive, entry)
        yield from faults.recorded(drive, "error", entry.code or 0)
    elif isinstance(entry, Function):
        yield line.of_function(entry)
        yield from faults.recorded(drive, "function", entry.code)
    elif isinstance(entry, Setting):
        yield line.of_setting(drive, entry)
        yield from faults.recorded(drive, "setting", entry.id)
    else:
        yield frames.of_frame(entry)
        yield from faults.recorded(drive, "frame", entry.id)
