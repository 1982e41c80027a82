"""The program for the two functions that say which registers of a drive may be read and written."""

from collections.abc import Iterator

from driveblocks.bench import kit
from driveblocks.bench.request import Sources, runs
from driveblocks.bench.script import Probe, Script
from driveblocks.maps.form import Span, address_text
from driveblocks.maps.model import Drive
from driveblocks.maps.numbering import at
from driveblocks.reference.permission import readable, writable
from structured_text.language.writing import word

END = 0xFFFF
"""The last address."""


def scripts(drive: Drive, stem: str) -> Iterator[Script]:
    program = kit.script(drive, stem, "Access", "which registers may be read and written, each range from both sides")
    sources = Sources(drive)
    for name, verb, allowed in (("CanRead", "read", readable(drive)), ("CanWrite", "written", writable(drive))):
        for span in runs(at(drive, each) for each in allowed):
            last = f" to {address_text(span.last)}" if len(span) > 1 else ""
            words = f"{address_text(span.first)}{last} may be {verb}"
            probes = (_probe(drive, name, allowed, *asked) for asked in dict.fromkeys(_around(span)))
            program.stage(words, *probes, source=sources.at(span.first))
        rest = [(0, 0), (0, 1), (0, END), (END, 0), (END, 1), (END, 2), (END, END), (1, END)]
        program.stage(f"{verb}: all addresses", *(_probe(drive, name, allowed, *asked) for asked in rest))
    yield program


def _around(span: Span) -> Iterator[tuple[int, int]]:
    """First register and number of registers, at the ends of a range and just beyond."""
    size = len(span)
    before, after = max(span.first - 1, 0), min(span.last + 1, END)
    for address in (before, span.first, span.last, after):
        yield address, 0
        yield address, 1
    yield from ((span.first, size), (span.first, min(size + 1, END)), (before, min(size + 1, END)), (span.last, 2))


def _probe(drive: Drive, name: str, allowed: frozenset[int], address: int, quantity: int) -> Probe:
    """A check of what a function says of some registers; those that run past FFFFH are never allowed, nor is none."""
    expected = quantity > 0 and allowed.issuperset(range(address, address + quantity))
    call = f"{drive.prefix}_{name}(Address := {word(address)}, Quantity := {quantity})"
    return kit.is_flag(call, expected, f"{quantity} from {address_text(at(drive, address))}")
