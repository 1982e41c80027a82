"""Section of the page about building: how the time grows with maps and with registers."""

from collections.abc import Iterator
from itertools import pairwise

from tests.bench.record import Rows
from tests.bench.table import prose, short, table, whole

STEPS = ("load", "blocks", "page", "tests")


def seconds(steps: dict[str, float]) -> float:
    """All steps together."""
    return sum(steps[step] for step in STEPS if step in steps)


def size(row: str) -> int:
    """The number at the head of a row's name."""
    return int(row.split(" ", maxsplit=1)[0])


def per_map(rows: Rows, kind: str) -> list[float]:
    """Milliseconds of a map, for each number of maps."""
    return [1e3 * seconds(steps) / size(row) for row, steps in rows.items() if row.partition(" ")[2] == kind]


def section(rows: Rows) -> Iterator[str]:
    """The section's text."""
    yield from prose("""
        Seconds of the processor. *load* reads and checks the maps, *blocks* writes the Structured Text of the drives,
        *page* the overview with the sizes of all blocks, *tests* the test programs. Synthetic maps of 400 registers;
        `driveblocks build` does all four steps, and writes files besides.
        """)
    yield from table(["maps", *STEPS, "together", "ms per map", "peak MiB"], list(_maps(rows)))
    yield from prose(f"{_grows(rows)}\n\nOne map that grows:")
    yield from table(["registers", *STEPS, "together", "ms per register"], list(_registers(rows)))
    yield from _slope(rows)


def _maps(rows: Rows) -> Iterator[list[str]]:
    shipped = rows["shipped"]
    yield ["the shipped drives", *_seconds(shipped), "-", whole(shipped["MiB"])]
    pure = rows["shipped without libyaml"]
    yield ["the shipped drives, PyYAML without libyaml", f"{pure['load']:.3f}", "-", "-", "-", "-", "-", "-"]
    for row, steps in rows.items():
        if row.endswith(("maps", "whole")):
            each = short(1e3 * seconds(steps) / size(row))
            yield [whole(size(row)), *_seconds(steps), each, whole(steps.get("MiB"))]


def _registers(rows: Rows) -> Iterator[list[str]]:
    for row, steps in rows.items():
        if row.endswith("registers"):
            yield [whole(size(row)), *_seconds(steps), short(1e3 * seconds(steps) / size(row))]


def _seconds(steps: dict[str, float]) -> list[str]:
    parts = (f"{steps[step]:.3f}" if step in steps else "-" for step in STEPS)
    return [*parts, f"{seconds(steps):.3f}"]


def _grows(rows: Rows) -> str:
    """How the time of one map changes over the numbers of maps."""
    (few, *_, many), (less, *_, more) = per_map(rows, "maps"), per_map(rows, "maps whole")
    return f"""
        Loading and rendering map after map takes {short(few)} ms per map at the least number and {short(many)} ms at
        the most, a whole build {short(less)} and {short(more)} ms."""


def _slope(rows: Rows) -> list[str]:
    found = [(size(row), seconds(steps)) for row, steps in rows.items() if row.endswith("registers")]
    slopes = [1e3 * (more - less) / (many - few) for (few, less), (many, more) in pairwise(found)]
    shown = ", ".join(short(slope) for slope in slopes)
    return prose(f"""
        A map of {found[0][0]} registers costs {short(1e3 * found[0][1])} ms, most of it the test programs; each further
        register costs, from one row to the next, {shown} ms.
        """)
