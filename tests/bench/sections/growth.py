"""Section of the page about building: how the time grows with maps and with registers."""

import statistics
from collections.abc import Iterator

from tests.bench.record import Rows
from tests.bench.table import prose, short, table, whole

STEPS = ("load", "blocks", "page", "tests")
KINDS = {"maps": "map after map", "maps whole": "a whole build"}
EVEN = 1.25
"""Times of a map that lie within this factor, over hundredfold numbers of maps, are called proportional."""


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
        *page* the overview with the sizes of all blocks, *tests* the test programs. `driveblocks build` does all four
        steps, and writes files besides. The maps that are counted are synthetic, of 400 registers each, and measured
        once; the shipped drives and the map that grows are the least of some runs. *Peak* is the most memory that the
        whole process had taken until then.
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
            kind = KINDS[row.partition(" ")[2]]
            yield [f"{whole(size(row))}, {kind}", *_seconds(steps), each, whole(steps.get("MiB"))]


def _registers(rows: Rows) -> Iterator[list[str]]:
    for row, steps in rows.items():
        if row.endswith("registers"):
            yield [whole(size(row)), *_seconds(steps), short(1e3 * seconds(steps) / size(row))]


def _seconds(steps: dict[str, float]) -> list[str]:
    parts = (f"{steps[step]:.3f}" if step in steps else "-" for step in STEPS)
    return [*parts, f"{seconds(steps):.3f}"]


def _grows(rows: Rows) -> str:
    """How the time of one map changes over the numbers of maps."""
    words = []
    for kind, what in KINDS.items():
        found = per_map(rows, kind)
        verdict = "proportional" if max(found) < EVEN * min(found) else "not proportional"
        words.append(
            f"{what} takes {short(min(found))} to {short(max(found))} ms per map, in all {verdict} to their number"
        )
    return f"{'; '.join(words)}.".capitalize()


def line(rows: Rows) -> tuple[float, float]:
    """The straight line nearest to the maps of growing size by least squares: seconds of a map, and of a register."""
    found = [(size(row), seconds(steps)) for row, steps in rows.items() if row.endswith("registers")]
    slope, base = statistics.linear_regression(*zip(*found, strict=True))
    return base, slope


def _slope(rows: Rows) -> list[str]:
    base, slope = line(rows)
    sizes = [size(row) for row in rows if row.endswith("registers")]
    off = max(abs(seconds(rows[f"{count} registers"]) - base - slope * count) for count in sizes)
    return prose(f"""
        A map costs {short(1e3 * base)} ms, most of it the test programs, and {short(1e3 * slope)} ms for each register:
        the straight line by least squares, from which no row is further than {short(1e3 * off)} ms.
        """)
