"""Section of the page about the engines of the host: the embedded one beside matiec, and the front end."""

from collections.abc import Iterator

from tests.bench.record import Rows
from tests.bench.table import prose, short, table, times

FIRST = "embedded"
COLUMNS = ("build s", "CRC MB/s", "scans/s")


def section(rows: Rows) -> Iterator[str]:
    """Both engines, called from Python."""
    yield from prose("""
        Both engines as the tests use them, called from Python scan by scan: building the library of the shipped drives
        once from its text with no cache, a CRC over 256 bytes, and a block of two statements.
        """)
    base = rows[FIRST]
    body = [
        [name, *(f"{short(found[column])} ({times(found[column], base[column])})" for column in COLUMNS)]
        for name, found in rows.items()
    ]
    yield from table(["engine", *COLUMNS], body)
    others = [found for name, found in rows.items() if name != FIRST]
    if others:
        fast = max(found["CRC MB/s"] for found in others) / base["CRC MB/s"]
        slow = base["scans/s"] / max(found["scans/s"] for found in others)
        yield from prose(f"""
            matiec computes {short(fast)} x as many bytes of CRC as the embedded engine in the same time. The embedded
            engine does {short(slow)} x as many small scans, since each is a call within Python, and one of matiec's a
            call from Python into C; and it needs no C compiler.
            """)


def front_end(rows: Rows) -> Iterator[str]:
    """Lines per second of each step."""
    speed = rows["lines/s"]
    yield from (f"Front end, on the {whole_lines(rows)} lines of the library, lines per second of processor time:", "")
    yield from table(["step", "lines/s"], [[step, short(found)] for step, found in speed.items()])


def whole_lines(rows: Rows) -> str:
    """Lines of the library."""
    return f"{int(rows['lines']['library']):,}"
