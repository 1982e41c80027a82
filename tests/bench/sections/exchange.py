"""Section of the page about a read of ten registers: the request built, the reply parsed."""

from collections.abc import Iterator

from tests.bench.record import Rows
from tests.bench.sections.checksum import LINES
from tests.bench.table import prose, short, table, times

STEPS = {
    "ask rtu": "request, RTU",
    "read rtu": "reply, RTU",
    "ask ascii": "request, ASCII",
    "read ascii": "reply, ASCII",
}
WHO = {
    "c": "C by hand",
    "any matiec-beremiz": "shared blocks, matiec-beremiz",
    "any matiec-openplc": "shared blocks, matiec-openplc",
    "drive matiec-beremiz": "a drive's blocks, matiec-beremiz",
    "drive matiec-openplc": "a drive's blocks, matiec-openplc",
    "any embedded": "shared blocks, embedded engine",
    "drive embedded": "a drive's blocks, embedded engine",
    "pymodbus": "pymodbus",
}


def by_hand(row: dict[str, float]) -> float | None:
    """Nanoseconds of the C by hand, which is measured beside each line of matiec: the least."""
    found = [row[f"c {line}"] for line in LINES if f"c {line}" in row]
    return min(found) if found else None


def slower(row: dict[str, float], chain: str) -> float | None:
    """Nanoseconds of a chain of blocks on the slower line of matiec."""
    found = [row[f"{chain} {line}"] for line in LINES if f"{chain} {line}" in row]
    return max(found) if found else None


def figure(row: dict[str, float], who: str) -> float | None:
    """Nanoseconds of one of `WHO`."""
    return by_hand(row) if who == "c" else row.get(who)


def section(rows: Rows) -> Iterator[str]:
    """The section's text."""
    yield from prose("""
        A read of ten registers of unit 1: `JSCC_Request` with `MB_RtuSeal` or `MB_AsciiEncode`, then `MB_RtuOpen` or
        `MB_AsciiDecode` with `JSCC_Reply`, called by a block as a program calls them; the same with `MB_BuildRead` and
        `MB_ParseReply`; C written for this page with the checks that this read needs; and pymodbus called from Python,
        its framer and its PDU, without a port (it does not compare a reply with the request at this place).
        Nanoseconds, and how many times those of the C by hand.
        """)
    body = [[name, *(_cell(rows[step], who) for step in STEPS)] for who, name in WHO.items() if _known(rows, who)]
    yield from table(["who", *STEPS.values()], body)
    yield from prose("""
        C by hand is so far ahead because a processor overlaps one call with the next, and because it copies nothing:
        matiec copies the frame into each block that it is handed to, and out again.
        """)


def _known(rows: Rows, who: str) -> bool:
    return all(figure(rows[step], who) is not None for step in STEPS)


def _cell(row: dict[str, float], who: str) -> str:
    time, base = figure(row, who), by_hand(row)
    if time is None or base is None:
        return short(time)
    return f"{short(time)} ({times(time, base)})"
