"""The few sentences at the head of the page: what a PLC engineer concludes, derived from the figures."""

from collections.abc import Iterator

from tests.bench.record import Record, Rows
from tests.bench.sections import blocks, checksum, exchange
from tests.bench.table import prose, short

BAUD = 9600
BITS_PER_CHARACTER = 11
"""Start bit, eight data bits, parity or second stop bit, stop bit (MODBUS over Serial Line V1.02, 2.5.1)."""
LARGE = 250
"""Bytes by IEC widths over which an instance holds a frame, and counts in the memory of a controller."""
BYTES = 8 + 25
"""Request and reply of a read of ten registers, RTU."""


def section(record: Record) -> list[str]:
    """One point each, as far as it was measured."""
    points: list[str] = []
    if {"crc", "memory"} <= set(record):
        points.append(_checksum(record["crc"].rows, record["memory"].rows))
    if "exchange" in record:
        points += _exchange(record["exchange"].rows)
    if "times" in record:
        points += _decoders(record["times"].rows)
    if "memory" in record:
        points += _memory(record["memory"].rows)
    return prose("\n\n".join(points))


def _checksum(rows: Rows, memory: Rows) -> str:
    block, compact = (
        [checksum.taken(rows, form, 256, chained=chained) for chained in (False, True)] for form in ("block", "compact")
    )
    saved = memory["MB_Crc16"]["IEC"] - memory["MB_Crc16Compact"]["IEC"]
    forms = [(form, chained) for form in ("block", "called") for chained in (False, True)]
    slowest = max(checksum.taken(rows, form, 256, chained=chained) for form, chained in forms)
    much = max(checksum.ratio(rows, form, 256, chained=chained) for form, chained in forms)
    longer = max(one / other for one, other in zip(compact, block, strict=True))
    return f"""- The CRC of the longest frame takes {short(slowest / 1e3)} µs where a block calls `MB_Crc16`,
        {short(much)} x a plain C table at its worst here;
        `MB_Crc16Compact` saves {saved:.0f} bytes in each instance and takes at most {short(longer)} x as long. Choose
        by memory."""


def _exchange(rows: Rows) -> Iterator[str]:
    found = [exchange.slower(rows[step], "drive") for step in ("ask rtu", "read rtu")]
    took = sum(one for one in found if one is not None)
    line = BYTES * BITS_PER_CHARACTER / BAUD
    if None not in found:
        yield f"""- A read of ten registers, request and reply, takes {short(took / 1e3)} µs of this processor and
            {short(1e3 * line)} ms of an RS-485 line at {BAUD} baud, without the silence between frames and the drive's
            own time: the line decides how often drives are polled, even where a controller is a thousand times
            slower."""


def _decoders(rows: Rows) -> Iterator[str]:
    lines = [line for line in checksum.LINES if any(line in columns for columns in rows.values())]
    if lines:
        found = {name: max(rows[name][line] for line in lines) for name in blocks.decoders(rows)}
        worst = max(found, key=lambda name: found[name])
        family = {name: time for name, time in found.items() if name.startswith("SN300G5_")}
        yield f"""- No decoder or encoder takes more than {short(found[worst])} ns (`{worst}`); all {len(family)} of
            SN300G5, the largest map, take {short(sum(family.values()) / 1e3)} µs together. They can run in every
            scan."""


def _memory(rows: Rows) -> Iterator[str]:
    sums = blocks.total(rows)
    lines = [line for line in checksum.LINES if line in sums]
    if lines:
        much = max(sums[line] for line in lines) / sums["IEC"] - 1
        beyond = {name: blocks.beyond(size, lines) for name, size in rows.items()}
        large = max(beyond[name] for name, size in rows.items() if size["IEC"] > LARGE)
        yield f"""- Over all blocks, instances take {100 * much:.0f} % more on matiec than the sum of the IEC widths;
            those over {LARGE} bytes at most {100 * large:.0f} % more. Small ones are up to
            {short(1 + max(beyond.values()))} x as large, since a byte of flags comes to each BOOL."""
