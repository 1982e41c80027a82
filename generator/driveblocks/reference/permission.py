"""Which addresses of a drive may be read and written, and how many words a frame may carry."""

from collections.abc import Iterator
from dataclasses import dataclass

from driveblocks.maps.model import Drive

MOST_READ, MOST_WRITTEN = 125, 123
"""MODBUS Application Protocol V1.1b3, 6.3 and 6.12."""

READ_HEAD, WRITE_HEAD = 1, 5
"""Data bytes that are no words: the byte count of a read reply; address, quantity and byte count of a 10H request."""


def readable(drive: Drive) -> frozenset[int]:
    """Every address that may be read: readable rows, those not in use included, and readable areas."""
    rows = [row.address for section, row in drive.registers() if "r" in (row.access or section.access)]
    areas = [area.addresses for area in drive.areas if "r" in area.access]
    return frozenset(address for span in (*rows, *areas) for address in span)


def writable(drive: Drive) -> frozenset[int]:
    """Every address that may be written: rows in use, areas, and what writes to RAM alone."""
    return frozenset((*_written_rows(drive), *_written_areas(drive), *ram_only(drive)))


def _written_rows(drive: Drive) -> Iterator[int]:
    for section, row in drive.registers():
        if "w" in (row.access or section.access) and not row.unused:
            yield from row.address


def _written_areas(drive: Drive) -> Iterator[int]:
    for area in drive.areas:
        if "w" in area.access:
            yield from area.addresses


def ram_only(drive: Drive) -> Iterator[int]:
    """The addresses of the parameter area moved by what the storage rule adds: a write there is not stored."""
    for area in drive.areas:
        if area.id == drive.storage.area and drive.storage.add is not None:
            for address in area.addresses:
                yield address + drive.storage.add


@dataclass(frozen=True)
class Most:
    """Most words that one frame may read and write."""

    read: int
    write: int


def most(drive: Drive, *, ascii_mode: bool) -> Most:
    """The drive's limits of words, and what fits into its data field in a mode."""
    limits = drive.limits
    field = limits.ascii_data_bytes if ascii_mode else limits.data_bytes
    read = limits.read_words.value if limits.read_words else MOST_READ
    write = min(limits.write_words.value if limits.write_words else MOST_WRITTEN, MOST_WRITTEN)
    if field is None:
        return Most(read, write)
    return Most(min(read, (field.value - READ_HEAD) // 2), min(write, (field.value - WRITE_HEAD) // 2))
