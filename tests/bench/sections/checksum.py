"""Section of the page about the CRC: what the blocks cost beside C, what would be faster, and at what price."""

from collections.abc import Iterator

from tests.bench.record import Rows
from tests.bench.table import prose, short, table, times

AIM = 1.2
"""Most that the table block may take of the time of a plain C table, 64 and 256 bytes, on matiec as it stands."""
SIZES = (8, 64, 256)
LINES = ("matiec-beremiz", "matiec-openplc")
FORMS = {
    "table": "C, one table of 256 words",
    "two_tables": "C, two tables of 256 bytes",
    "bitwise": "C, bit by bit",
    "block": "MB_Crc16",
    "called": "MB_Crc16, called by a block",
    "compact": "MB_Crc16Compact",
    "function": "FUNCTION with a table",
}


def lines_of(rows: Rows) -> list[str]:
    """The lines of matiec that were measured."""
    return [line for line in LINES if any(column.startswith(line) for columns in rows.values() for column in columns)]


def taken(rows: Rows, form: str, size: int, *, chained: bool = False, build: str = "stock") -> float:
    """Nanoseconds of a call, on the slower line of matiec."""
    row = rows[f"{form} {size} {'chained' if chained else 'independent'}"]
    return max(row[f"{line} {build}"] for line in lines_of(rows))


def ratio(rows: Rows, form: str, size: int, *, chained: bool = False, build: str = "stock") -> float:
    """How much longer than the plain C table of the same program; of both lines of matiec the larger."""
    kind = f"{size} {'chained' if chained else 'independent'}"
    return max(
        rows[f"{form} {kind}"][f"{line} {build}"] / rows[f"table {kind}"][f"{line} {build}"] for line in lines_of(rows)
    )


def section(rows: Rows) -> Iterator[str]:
    """The section's text."""
    yield from prose("""
        One call over a frame of 8, 64 and 256 bytes, in nanoseconds, and how much longer than the plain C table beside
        it in the same program. *Chained*: the frame begins with a byte of the result before, so that each call waits
        for the one before it, as a program waits for its checksum; otherwise a processor overlaps the calls.
        """)
    for line in lines_of(rows):
        yield from (f"Through {line}, `-O2`:", "")
        yield from _table(rows, line)
    yield from _words(rows)


def _table(rows: Rows, line: str) -> list[str]:
    heads = ["form", *(f"{size} bytes{kind}" for size in SIZES for kind in (", chained", ""))]
    body = [[name, *_cells(rows, form, line, "stock")] for form, name in FORMS.items()]
    for form in ("block", "compact"):
        body.append([f"{FORMS[form]}, nothing can be forced", *_cells(rows, form, line, "unforced")])
    return table(heads, body)


def _cells(rows: Rows, form: str, line: str, build: str) -> Iterator[str]:
    for size in SIZES:
        for kind in ("chained", "independent"):
            time, base = (rows[f"{one} {size} {kind}"][f"{line} {build}"] for one in (form, "table"))
            yield f"{short(time)} ({times(time, base)})"


def _words(rows: Rows) -> Iterator[str]:
    middle, found = ratio(rows, "block", 64), ratio(rows, "block", 256)
    verdict = "within" if max(middle, found) <= AIM else "above"
    small, chained = ratio(rows, "block", 8), ratio(rows, "block", 8, chained=True)
    free = ratio(rows, "block", 256, build="unforced")
    yield from prose(f"""
        `MB_Crc16` takes {short(middle)} x the plain C table over 64 bytes and {short(found)} x over 256: {verdict} the
        aim of {AIM} x. It takes two bytes at a time from two tables, which halves the writes; writes are what
        costs, since matiec asks before each one whether a debugger holds the variable. Compiled so that nothing can be
        forced, the same block takes {short(free)} x over 256 bytes. Called by another block, the frame is copied in and
        out, which is how matiec passes an in-out. Over 8 bytes the calls themselves count: {short(small)} x, or
        {short(chained)} x where each waits for the one before.

        A FUNCTION over the whole frame with the table inside is no way out: matiec copies the table to the stack on
        every call, and not every compiler takes a function with an array as in-out (IronPLC refuses it).

        The least of all rounds is shown; over 256 bytes the median of the calmest process lies within {spread(rows)} %
        of it.
        """)


def spread(rows: Rows) -> str:
    """Largest distance of a median from its least, in per cent, over 256 bytes as shipped."""
    worst = max(
        columns[f"{line} stock median"] / columns[f"{line} stock"] - 1
        for row, columns in rows.items()
        for line in lines_of(rows)
        if " 256 " in row
    )
    return short(100 * worst)
