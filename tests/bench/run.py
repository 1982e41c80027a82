"""Every figure of the project, side by side in one run: `python tests/bench/run.py`, some minutes on two cores.

Ratios in one run are the point; the numbers themselves belong to the machine.
"""

import sys
import time
from collections.abc import Callable
from pathlib import Path

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT))

from rich.console import Console  # noqa: E402
from rich.table import Table  # noqa: E402
from tests.bench import maps as map_bench  # noqa: E402
from tests.bench.synthetic import synthetic  # noqa: E402
from tests.host.embedded import bench as engine_bench  # noqa: E402

from driveblocks.host.discovery import survey  # noqa: E402
from driveblocks.host.engine import Source  # noqa: E402
from driveblocks.maps import catalog, load  # noqa: E402
from driveblocks.maps.model import Drive  # noqa: E402
from driveblocks.render import build, library, text  # noqa: E402
from driveblocks.st import speed  # noqa: E402

LANGUAGES = text.languages(["en", "zh"], "utf-8")


def main() -> None:
    """Measure the maps, the front end, the engines and the build, and print one table for each."""
    console = Console(width=110)
    for line in map_bench.lines([10, 100, 1000], 400):
        print(line, flush=True)
    console.print(front_end())
    console.print(engines())
    console.print(builds())


def front_end() -> Table:
    """Lines per second of each step on the generated library."""
    lines = speed.measure(library_text())
    table = Table("front end", "lines/s", "share of parse", title=f"ST front end on {lines.lines} generated lines")
    for step in ("lex", "parse", "check", "lint"):
        rate = getattr(lines, step)
        table.add_row(step, f"{rate:,.0f}", f"{rate / lines.parse:.2f}")
    return table


def library_text() -> str:
    """The library of the shipped drives as one text."""
    return "\n".join(source.text for source in library_sources())


def library_sources() -> list[Source]:
    """The library of the shipped drives as sources, in their order."""
    files = build.files(build.read(catalog.shipped()), LANGUAGES)
    order = files[f"{build.PLATFORM}/order.txt"].split()
    return [Source(name, files[f"{build.PLATFORM}/{name}"]) for name in order]


def engines() -> Table:
    """Build time, CRC and scans of each engine found, with the ratio to the embedded one."""
    table = Table(
        "engine",
        "build library s",
        "CRC MB/s",
        "scans/s",
        "CRC ratio",
        "scan ratio",
        title="engines (matiec builds from its cache)",
    )
    sources = library_sources()
    first: tuple[float, float] | None = None
    for candidate in survey().candidates():
        if candidate.engine is None:
            table.add_row(candidate.name, "-", "-", "-", "-", candidate.note)
            continue
        seconds = once(lambda engine=candidate.engine: engine.build(sources))  # type: ignore[misc]
        crc, scans = engine_bench.crc_rate(candidate.engine), engine_bench.scan_rate(candidate.engine)
        first = first or (crc, scans)
        ratios = f"{crc / first[0]:.2f}", f"{scans / first[1]:.2f}"
        table.add_row(candidate.name, f"{seconds:.2f}", f"{crc:.1f}", f"{scans:,.0f}", *ratios)
    return table


def builds() -> Table:
    """Blocks from maps: the shipped ones from file to text, then growing numbers of synthetic ones."""
    table = Table("maps", "seconds", "ms per map", title="build, after import (synthetic: 400 registers)")
    shipped = once(lambda: build.files(build.read(catalog.shipped()), LANGUAGES))
    each = 1000 * shipped / len(catalog.shipped())
    table.add_row("the shipped drives, read and built", f"{shipped:.2f}", f"{each:.1f}")
    for count in (10, 100, 1000):
        seconds = sum(_rendered(load.loads(synthetic(number, 400), f"{number}.yaml")) for number in range(count))
        table.add_row(f"{count} synthetic", f"{seconds:.2f}", f"{1000 * seconds / count:.1f}")
    return table


def _rendered(drive: Drive) -> float:
    return once(lambda: list(library.drive("synthetic", drive, LANGUAGES)))


def once(work: Callable[[], object]) -> float:
    """Seconds of one run."""
    start = time.perf_counter()
    work()
    return time.perf_counter() - start


if __name__ == "__main__":
    main()
