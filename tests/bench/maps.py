"""Measure loading and checking of maps: the real ones, and growing numbers of synthetic ones, side by side in one run.

`python tests/bench/maps.py [--counts 10,100,1000] [--registers 400]`. Times are after import; the time per synthetic
map should not grow with their number.
"""

import argparse
import resource
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT))

import yaml  # noqa: E402
from tests.bench.synthetic import synthetic  # noqa: E402

from driveblocks.maps import load, nodes  # noqa: E402

TARGET = 0.3
"""Seconds that loading and checking the real maps may take."""


@dataclass(frozen=True)
class Taken:
    """What one measurement took: seconds of the wall clock and of the processor, and peak memory in MiB."""

    wall: float
    cpu: float
    mib: float


def taken(work: Callable[[], object], rounds: int = 1) -> Taken:
    """The least that a piece of work takes in some rounds."""
    best = Taken(float("inf"), float("inf"), 0)
    for _ in range(rounds):
        wall, cpu = time.perf_counter(), time.process_time()
        work()
        wall, cpu = time.perf_counter() - wall, time.process_time() - cpu
        peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
        best = Taken(min(best.wall, wall), min(best.cpu, cpu), peak)
    return best


def real_maps() -> Taken:
    """Loading and checking all vendor maps, once each, from their files."""
    paths = sorted((ROOT / "vendor_maps").glob("*.yaml"))
    return taken(lambda: [load.load(path) for path in paths], rounds=5)


def synthetic_maps(count: int, registers: int) -> Taken:
    """Loading and checking `count` synthetic maps; writing their texts is not measured."""
    total = Taken(0, 0, 0)
    for number in range(count):
        text = synthetic(number, registers)
        one = taken(lambda text=text, number=number: load.loads(text, f"{number}.yaml"))  # type: ignore[misc]
        total = Taken(total.wall + one.wall, total.cpu + one.cpu, one.mib)
    return total


def lines(counts: Sequence[int], registers: int) -> Iterator[str]:
    """The figures as text."""
    real = real_maps()
    verdict = "within" if real.wall <= TARGET else "ABOVE"
    yield f"real maps: {real.wall * 1e3:.0f} ms, {real.cpu * 1e3:.0f} ms of processor; {verdict} {TARGET * 1e3:.0f} ms"
    parser, nodes._LOADER = nodes._LOADER, yaml.SafeLoader
    pure = real_maps()
    nodes._LOADER = parser
    yield f"real maps without libyaml: {pure.wall * 1e3:.0f} ms, {pure.cpu * 1e3:.0f} ms of processor"
    size = len(synthetic(0, registers).encode()) // 1024
    yield f"synthetic maps of {registers} registers, {size} KiB each:"
    first: float | None = None
    for count in counts:
        found = synthetic_maps(count, registers)
        per_map = found.cpu / count
        first = first or per_map
        wall = found.wall / count * 1e3
        yield (
            f"  {count:5} maps: {found.wall:6.2f} s, per map {wall:5.1f} ms, {per_map * 1e3:5.1f} ms of processor, "
            f"ratio {per_map / first:.2f}, peak memory {found.mib:.0f} MiB"
        )


def main() -> None:
    """Run from the command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--counts", default="10,100,1000", help="how many synthetic maps (10,100,1000)")
    parser.add_argument("--registers", type=int, default=400, help="registers of each (400)")
    wanted = parser.parse_args()
    for line in lines([int(count) for count in wanted.counts.split(",")], wanted.registers):
        print(line, flush=True)


if __name__ == "__main__":
    main()
