"""Sections of the page about single blocks: decoders in nanoseconds; instructions and bytes of all of them."""

from collections.abc import Iterator

from tests.bench.record import Rows
from tests.bench.sections.checksum import LINES
from tests.bench.table import prose, short, table, whole

SHARED = "MB_"
IEC = "IEC"
NO_DECODERS = ("_Request", "_Reply", "_CanRead", "_CanWrite")
TEXTS = ("TextEn", "TextZh")


def decoders(times: Rows) -> list[str]:
    """The blocks that take a drive's words apart or make them: decoders, scales, command, reference, standstill."""
    return [
        name for name in times if not name.startswith(SHARED) and not name.endswith(NO_DECODERS) and not _text(name)
    ]


def _text(name: str) -> bool:
    return name.endswith(TEXTS)


def decoding(times: Rows) -> Iterator[str]:
    """Nanoseconds of each decoder."""
    yield from prose("""
        One scan of a block, one call of a function, over and over with one typical input: matiec at `-O2` through a
        driver in C; the embedded engine called from Python, where a function is called by the names of its inputs.
        Nanoseconds.
        """)
    columns = (*_lines(times), "embedded")
    body = [[f"`{name}`", *(short(times[name].get(column)) for column in columns)] for name in decoders(times)]
    yield from table(["decoder", *columns], body)


def _lines(rows: Rows) -> list[str]:
    return [line for line in LINES if any(line in columns for columns in rows.values())]


def instructions(counts: Rows, memory: Rows, times: Rows) -> Iterator[str]:
    """Instructions, nanoseconds and bytes of every block and function."""
    yield from prose("""
        Instructions of one scan counted by callgrind, which depend on the compiler and its target but not on the speed
        of the machine: of the second of two equal scans, with the typical input that `tests/bench/inputs.py` lists (a
        read of ten registers and its reply; a drive that runs forward). A second count gives the same numbers.

        Bytes of one instance by the C compiler's `sizeof`, beside the sum of the IEC widths that `blocks/README.md`
        prints: matiec adds `EN` and `ENO`, a byte of flags to each variable, and room for alignment. A function has no
        instance.
        """)
    lines = _lines(counts or memory)
    heads = ["block or function", *(f"instructions, {line}" for line in lines), *(f"ns, {line}" for line in lines)]
    heads += [*(f"bytes, {line}" for line in lines), "bytes, IEC", "more"]
    yield from table(heads, [_row(name, lines, counts, memory, times) for name in counts or memory])
    yield from _sum(lines, memory)


def _row(name: str, lines: list[str], counts: Rows, memory: Rows, times: Rows) -> list[str]:
    size = memory.get(name, {})
    return [
        f"`{name}`",
        *(whole(counts.get(name, {}).get(line)) for line in lines),
        *(short(times.get(name, {}).get(line)) for line in lines),
        *(whole(size.get(line)) for line in lines),
        whole(size.get(IEC)),
        more(size, lines),
    ]


def more(size: dict[str, float], lines: list[str]) -> str:
    """How much an instance takes beyond the IEC widths, as text."""
    return f"{100 * beyond(size, lines):.0f} %" if size.get(IEC) and any(line in size for line in lines) else "-"


def beyond(size: dict[str, float], lines: list[str]) -> float:
    """How much an instance takes beyond the IEC widths, as a share of them, on the line that takes most."""
    return max(size[line] for line in lines if line in size) / size[IEC] - 1


def total(memory: Rows) -> dict[str, float]:
    """The sums of one instance of each block."""
    columns = next(iter(memory.values()))
    return {column: sum(size[column] for size in memory.values()) for column in columns}


def _sum(lines: list[str], memory: Rows) -> Iterator[str]:
    sums = total(memory)
    found = ", ".join(f"{whole(sums[line])} bytes on {line}" for line in lines if line in sums)
    if found:
        yield from (f"One instance of each block: {found}, {whole(sums[IEC])} by the IEC widths.", "")
