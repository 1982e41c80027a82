"""Which registers may be read and written: every address with each quantity, against the reference model."""

import tempfile
from array import array
from collections.abc import Iterator, Sequence
from pathlib import Path

from tests.native.exhaustive.bench import Bench, Finding
from tests.shipped import drives

from driveblocks.reference.permission import readable, writable

ALLOWED = {
    f"{prefix}_{use}": which(drive)
    for prefix, drive in drives().items()
    for use, which in (("CanRead", readable), ("CanWrite", writable))
}
"""Each function with the addresses that it must permit."""


def table() -> str:
    """The functions for the driver."""
    rows = [f'    {{"{name}", {name.upper()}}},' for name in ALLOWED]
    return "\n".join(["static const Permitting PERMITTING[] = {", *rows, "    {NULL, NULL},", "};", ""])


def runs(allowed: frozenset[int]) -> bytes:
    """For each address how many permitted registers follow in a row: as many are permitted."""
    longest = array("I", bytes(4 * 0x10000))
    for address in reversed(range(0x10000)):
        if address in allowed:
            longest[address] = 1 + (longest[address + 1] if address < 0xFFFF else 0)
    return longest.tobytes()


def permissions(benches: Sequence[Bench], _short: bool) -> Iterator[Finding]:
    """65536 addresses with 132 quantities for each function; short enough to be whole."""
    for name, allowed in ALLOWED.items():
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, "runs")
            path.write_bytes(runs(allowed))
            for bench in benches:
                yield bench.command("permission", name, path)
