"""Drive blocks on their line: bytes and nanoseconds of one, of a line of eight, and what one more drive costs."""

import time
from collections.abc import Iterable, Iterator

from tests.bench.record import Rows
from tests.second.line import Bench
from tests.second.station import MIXED, built, name_of

from structured_text.engines.engine import EngineError, Library
from structured_text.engines.matiec import MatiecEngine
from structured_text.engines.matiec.library import MatiecInstance

FEW, MANY = 4, 8
"""Drives on a line; what one more costs is taken from the difference."""
SCANS = 20
"""Scans of 1 ms that follow each other: the drive has longer to answer. Then all is as it was before the first."""
LINE, SLOT = "MB_Line8", "MB_Slot"


def measure(engines: Iterable[MatiecEngine], rounds: int = 300) -> Rows:
    """Columns by engine: bytes, and nanoseconds of a scan while all motors run and the line waits for a reply."""
    rows: Rows = {}
    for engine in engines:
        library = built(engine, [[family] * drives for family in MIXED for drives in (FEW, MANY)])
        for family in MIXED:
            for row, column, figure in _family(library, family, rounds):
                rows.setdefault(row, {})[f"{engine.name} {column}"] = figure
    return rows


def _family(library: Library, family: str, rounds: int) -> Iterator[tuple[str, str, float]]:
    few, many = (Scans(library, family, drives, rounds) for drives in (FEW, MANY))
    block = f"{family}_Drive"
    for row, path in ((block, "Drive0"), (LINE, "TheLine"), (SLOT, "Slots[0]")):
        yield row, "bytes", many.bytes_of(path)
    all_, line, nothing = many.called(MANY), many.called(0), many.called(0, line=False)
    least = few.called(FEW) - few.called(0, line=False)
    yield block, "ns", (all_ - line) / MANY
    yield block, "ns of the line", line - nothing
    yield block, "ns of eight and the line", all_ - nothing
    yield block, "ns of one more", (all_ - nothing - least) / (MANY - FEW)


class Scans:
    """A line of drives that all run."""

    def __init__(self, library: Library, family: str, drives: int, rounds: int) -> None:
        """Start them one after the other."""
        types = [family] * drives
        bench = Bench(*types, stations=library)
        for drive in range(drives):
            bench.until(lambda drive=drive: bench.out("Ready", drive), 12_000)  # type: ignore[misc]  # a default
            bench.put(drive, RunForward=True)
        bench.until(lambda: all(bench.out("AtSpeed", drive) for drive in range(drives)), 20_000)
        bench.until(lambda: bench.block["TheLine.Exchange.Phase"], 1000)
        if not isinstance(bench.block, MatiecInstance):
            raise EngineError(f"{name_of(types)} is not timed on this engine")
        self.block, self.drives, self.rounds = bench.block, drives, rounds
        self.block["ElapsedMs"] = 1
        self.before = self.block._memory.raw

    def bytes_of(self, path: str) -> int:
        """Bytes of a variable."""
        return self.block._block.paths.find(path).node.size

    def called(self, drives: int, *, line: bool = True) -> float:
        """Nanoseconds of a scan in which this many drive blocks are called: the least of all rounds."""
        least = float("inf")
        for _ in range(self.rounds):
            self.block._memory.raw = self.before
            for drive in range(self.drives):
                self.block[f"Skip{drive}"] = drive >= drives
            self.block["SkipLine"] = not line
            start = time.perf_counter_ns()
            self.block.scan_many(SCANS)
            least = min(least, (time.perf_counter_ns() - start) / SCANS)
        if not all(self.block[f"Drive{drive}.AtSpeed"] for drive in range(drives)):
            raise EngineError("a motor has stopped while its block was timed")
        return least
