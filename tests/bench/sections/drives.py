"""Section of the page about drive blocks: bytes and nanoseconds of one, of a line of eight, and of one drive more."""

from collections.abc import Iterator

from tests.bench.record import Rows
from tests.bench.sections.checksum import LINES
from tests.bench.table import prose, short, table, whole

SLOT, LINE = "MB_Slot", "MB_Line8"
TIMES = ("ns", "ns of the line", "ns of eight and the line", "ns of one more")


def section(rows: Rows) -> Iterator[str]:
    """A table for each line of matiec."""
    yield from prose("""
        Eight drives of a family on one line, all running at their reference while the line waits for a reply, which is
        most scans: nanoseconds of a scan on matiec at `-O2`, called from C. A block and the line alone by what a scan
        takes less without them; one drive more from lines of four and of eight. The bytes of one drive more are those
        of its block; its slot is there already. Loops are in `blocks/README.md`; what a transaction costs the line is
        in `line.md`.
        """)
    for line in LINES:
        sizes = {name: whole(columns.get(f"{line} bytes")) for name, columns in rows.items()}
        blocks = [name for name in rows if name not in (SLOT, LINE)]
        body = [
            [f"`{name}`", sizes[name], *(short(rows[name].get(f"{line} {each}")) for each in TIMES)] for name in blocks
        ]
        head = ["block", "bytes", "ns", "the line", "eight and the line", "one drive more"]
        yield f"{line}; a slot has {sizes.get(SLOT)} bytes, `{LINE}` {sizes.get(LINE)}:\n"
        yield from table(head, body)
