"""Sections of the page about single blocks: decoders in nanoseconds; instructions and bytes of all of them."""

from collections.abc import Callable, Iterator

from tests.bench.record import Rows
from tests.bench.sections.checksum import LINES
from tests.bench.table import prose, short, table, whole

SHARED = "MB_"
IEC = "IEC"
Cell = Callable[[str], str]
"""Name of a block -> what a column shows of it."""
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
        What takes a drive's words apart or makes them: one scan of a block, one call of a function, over and over with
        one typical input, in nanoseconds. matiec at `-O2` through a driver in C; the embedded engine called from
        Python, which takes most of the time of a function, since it is called by the names of its inputs. A difference
        of less than a nanosecond between two small blocks means nothing.
        """)
    columns = (*_lines(times), "embedded")
    body = [[f"`{name}`", *(short(times[name].get(column)) for column in columns)] for name in decoders(times)]
    yield from table(["block or function", *columns], body)


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
        instance. Where there is one column for matiec, both lines agree in every row.
        """)
    columns = [
        *_columns("instructions", counts, whole),
        *_columns("ns", times, short),
        *_columns("bytes", memory, whole),
        ("bytes, IEC", lambda name: whole(memory.get(name, {}).get(IEC))),
        ("more", lambda name: more(memory.get(name, {}), _lines(memory))),
    ]
    body = [[f"`{name}`", *(cell(name) for _, cell in columns)] for name in counts]
    yield from table(["block or function", *(head for head, _ in columns)], body)
    yield from _sum(_lines(memory), memory)


def _columns(head: str, rows: Rows, text: Callable[[float | None], str]) -> list[tuple[str, Cell]]:
    """A column for each line of matiec, or one if all of them agree everywhere."""
    lines = _lines(rows)
    agree = all(len({columns.get(line) for line in lines}) == 1 for columns in rows.values())
    shown = {lines[0]: "matiec" if len(lines) > 1 else lines[0]} if agree else {line: line for line in lines}
    return [(f"{head}, {name}", _cell(rows, line, text)) for line, name in shown.items()]


def _cell(rows: Rows, line: str, text: Callable[[float | None], str]) -> Cell:
    return lambda name: text(rows.get(name, {}).get(line))


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
