"""The line at length, judged in counts: `python -m tests.line.long [--runs N] [--first SEED] [--page]` (`make line`).

Random lines of every kind around each line of matiec, every planted mistake found, 10^5 scans of walks with the full
state of every engine compared, refresh beside its formula. `--page` writes what was measured into docs/line.md.
Exit status 1 if anything is not as it must be.
"""

import argparse
import re
import sys
import tempfile
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import product
from math import ceil
from pathlib import Path

from tests.blocks.compare.comparison import with_double
from tests.blocks.toolchains import FOUND
from tests.line.cline import WHY_NOT, CLine, Ran, build
from tests.line.planted import PLANTED, Planted
from tests.line.test_engines import twins
from tests.line.walk import walk

from driveblocks.host.discovery import MATIEC_NAMES, survey
from driveblocks.host.matiec.installation import Installation

PAGE = Path(__file__).parents[2] / "docs" / "line.md"
KINDS = {"stops": 1.0, "timing": 0.1, "late": 0.1, "broken": 0.1, "faults": 0.1}
"""Kinds of random lines, and how many of each for one of the first."""
OTHERS = 0.02
"""How many lines run on another line of matiec, and with 32 slots, for one on the first."""
WALKS, SCANS = 100, 1000
SLACK = 1.12
WORDS, TURN_MS = 6, 5


@dataclass(frozen=True)
class Row:
    """One line of the table: what was measured, what came out, and whether it must be so."""

    what: str
    measured: str
    good: bool = True

    def __str__(self) -> str:
        """Print as a row of Markdown."""
        return f"| {self.what} | {self.measured} |"


@dataclass(frozen=True)
class Job:
    """A folder for what is compiled, how many random lines, and their first seed."""

    folder: Path
    runs: int
    first: int

    def line(
        self, slots: int = 8, tool: Installation | None = None, edit: Callable[[str], str] = str, name: str = ""
    ) -> CLine:
        """A compiled line, once per name."""
        place = self.folder / f"{name}{slots}{tool.iec2c.parent.name if tool else ''}"
        if place.exists():
            return CLine(place / f"vline{slots}")
        place.mkdir()
        return build(place, slots, edit, tool)


def main() -> int:
    """Run all of it."""
    parser = argparse.ArgumentParser(description="The line at length.")
    parser.add_argument("--runs", type=int, default=1_000_000, help="random stop scenarios; a tenth of each other kind")
    parser.add_argument("--first", type=int, default=0, help="the first seed")
    parser.add_argument("--page", action="store_true", help="write the figures into docs/line.md")
    options = parser.parse_args()
    if WHY_NOT:
        print(WHY_NOT)
        return 1
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for row in _all(Job(Path(folder), options.runs, options.first)):
            print(row if row.good else f"FAILED {row}", flush=True)
            rows.append(row)
    if options.page:
        write([str(row) for row in rows])
    failed = [row for row in rows if not row.good]
    print(f"{len(failed)} of {len(rows)} are not as they must be")
    return 1 if failed else 0


def _all(job: Job) -> Iterator[Row]:
    for part in (refresh, bus, cost, randoms, planted, sanitized, engines):
        yield from part(job)


def write(rows: list[str]) -> None:
    """Put the table into the page, between its marks."""
    page = PAGE.read_text(encoding="utf-8")
    table = "\n".join(["| what | measured |", "|---|---|", *rows, ""])
    made = re.sub(r"(?s)(<!-- measured -->\n).*?(<!-- end -->)", lambda found: found[1] + table + found[2], page)
    PAGE.write_text(made, encoding="utf-8")


# ---------------------------------------------------------------- refresh


def formula(drives: int, rate: int, bits: int, scan_ms: int, late: int, *, keeps: bool) -> float:
    """Refresh in ms: whole scans of a transaction, of the silence where the line keeps it, of the adapter."""
    wire = (8 + 5 + 2 * WORDS) * bits * 1000 / rate + TURN_MS
    silence = 1.75 if rate > 19200 else 3.5 * bits * 1000 / rate
    scans = ceil((wire + silence) / scan_ms) if keeps else ceil(wire / scan_ms) + int((silence + 1) / scan_ms) + 1
    return drives * (scans + late) * scan_ms


def refresh(job: Job) -> Iterator[Row]:
    """Every combination against the formula."""
    rates, lates = (9600, 19200, 38400, 57600, 115200), range(4)
    for keeps in (True, False):
        shares = []
        for drives, rate, bits, scan, late in product((1, 3, 7, 16, 32), rates, (10, 11), (5, 10, 20), lates):
            wanted = formula(drives, rate, bits, scan, late, keeps=keeps)
            pins = {
                "drives": drives,
                "rate": rate,
                "bits": bits,
                "scan": 1000 * scan,
                "max_scan": scan,
                "rx_late": late,
            }
            ran = job.line(32 if drives > 8 else 8).run(
                "run", jitter=0, keeps=keeps, ms=6000 + 40 * int(wanted), **pins
            )
            where = f"{drives} drives, {rate} bit/s, {bits} bits, {scan} ms scans, {late} late"
            shares.append((ran["refresh_ms"] / wanted, where))
        most, where = max(shares)
        what = f"refresh beside the formula, {len(shares)} lines, the {'port' if keeps else 'line'} keeps the silence"
        yield Row(what, f"at most {most:.2f} of it ({where})", most <= SLACK)


def bus(job: Job) -> Iterator[Row]:
    """Seven drives, six words, 19200 8N1, 10 ms scans, 5 ms turn-round."""
    line = job.line()
    yield from _turns(line)
    good, dead = line.run("run"), line.run("run", dead=1, ms=600_000)
    share = good["refresh_ms"] * 6 / 7
    measured = dead.told("{refresh_ms:.1f} ms for the others; 6/7 would be ") + f"{share:.1f}"
    yield Row("one drive of seven dead", measured, dead["refresh_ms"] <= 1.02 * share)
    pins = {"late": 1000, "longest_ms": 100, "ms": 3_600_000}
    late, hasty = line.run("run", **pins), line.run("run", drain=1, **pins)
    measured = late.told("{refresh_ms:.1f} ms, {wrong_readings:.0f} of {readings:.0f} readings wrong; ")
    measured += hasty.told("{refresh_ms:.1f} ms without waiting for them")
    fine = not late["wrong_readings"] and late["refresh_ms"] <= 1.03 * hasty["refresh_ms"]
    yield Row("1 % of replies late, up to 100 ms", measured, fine)
    for loss in ("loss", "garble"):
        ran = line.run("run", ms=600_000, **{loss: 1000})
        yield Row(f"1 % of replies {'lost' if loss == 'loss' else 'garbled'}", ran.told("{refresh_ms:.1f} ms"))
    noise = line.run("run", drives=1, scramble=30_000, ms=360_000_000)
    theory = noise["scrambled"] / 65536
    measured = noise.told("{wrong_readings:.0f} of {scrambled:.0f} believed; 16 bits let ") + f"{theory:.1f} pass"
    yield Row("replies, every byte behind the head by chance", measured, noise["wrong_readings"] <= 2 * theory + 10)


def _turns(line: CLine) -> Iterator[Row]:
    for keeps, most in ((1, 150), (0, 215)):
        who = f"the {'port' if keeps else 'line'} keeps the silence"
        read, both = line.run("run", keeps=keeps), line.run("run", keeps=keeps, command_ms=1)
        yield Row(f"refresh of seven drives, {who}", read.told("{refresh_ms:.0f} ms"), read["refresh_ms"] <= most)
        measured = both.told("{refresh_ms:.0f} ms; a command answered in {command_ms:.0f} ms")
        yield Row(f"one write and one read per drive and round, {who}", measured)


def cost(job: Job) -> Iterator[Row]:
    """Bytes and nanoseconds on matiec."""
    for slots in (8, 32):
        busy = job.line(slots).run("cost", drives=slots)
        idle = job.line(slots).run("cost", drives=slots, poll_ms=30_000)
        measured = busy.told("{line_bytes:.0f} bytes, {slot_bytes:.0f} per slot; ") + idle.told(
            "{idle_ns:.0f} ns idle, "
        )
        measured += busy.told("{waiting_ns:.0f} waiting, {transaction_ns:.0f} with a transaction")
        yield Row(f"line of {slots} slots and drives", measured, busy["line_bytes"] <= 200 * slots + 1200)


# ---------------------------------------------------------------- random lines, planted mistakes, engines

SUMS = (
    "{stops:.0f} stops: {lost_stops:.0f} lost, {late_stops:.0f} late, {broken_stops:.0f} late by a broken promise",
    "{ratio:.2f} of `WorstStopMs` at most",
    "{late_lone_stops:.0f} of {lone_stops:.0f} lone ones over `StopAloneMs`",
    "{requests:.0f} requests: {false_timeouts:.0f} false timeouts, {short_silences:.0f} short silences",
    "{wrong_readings:.0f} of {readings:.0f} readings wrong, {false_acks:.0f} false acknowledgements",
    "{virtual_hours:.0f} h of bus",
)


def randoms(job: Job) -> Iterator[Row]:
    """Random lines of every kind, on each line of matiec, and with 32 slots."""
    for number, (tool, slots) in enumerate([*((tool, 8) for tool in FOUND), (FOUND[0], 32)]):
        line = job.line(slots, tool)
        for kind, share in KINDS.items():
            count = max(1, int(job.runs * share * (OTHERS if number else 1)))
            ran = line.random(job.first, count, kind)
            print("\n".join(ran.failures), end="", flush=True)
            what = f"{count} random lines of kind {kind}, {slots} slots, {tool.iec2c.parent.name}"
            yield Row(what, ran.told("; ".join(SUMS)), not ran.failures)


def planted(job: Job) -> Iterator[Row]:
    """Each planted mistake, until a random line finds it."""
    for number, one in enumerate(PLANTED):
        line = job.line(edit=one.edit, name=f"planted{number}_")
        found = next((ran for ran in _growing(line, one) if ran.failures), None)
        first = found.failures[0].partition(" kind")[0].removeprefix("failure ") if found else "not found"
        yield Row(f"planted: {one.name}", f"{first}, kind {one.kind}", found is not None)


def _growing(line: CLine, one: Planted) -> Iterator[Ran]:
    for count in (1000, 10_000, 100_000):
        yield line.random(0, count, one.kind)


def sanitized(job: Job) -> Iterator[Row]:
    """Every kind under AddressSanitizer and UndefinedBehaviorSanitizer, which end the program at what they find."""
    for tool in FOUND:
        place = job.folder / f"sanitized {tool.iec2c.parent.name}"
        place.mkdir()
        flags = ("-O1", "-g", "-fsanitize=address,undefined", "-fno-sanitize-recover=all")
        line = build(place, tool=tool, flags=flags)
        ran = [line.random(job.first, max(10, job.runs // 100), kind) for kind in KINDS]
        scans = sum(each["scans"] for each in ran)
        yield Row(f"{scans:.0f} scans under the sanitizers, {tool.iec2c.parent.name}", "nothing found")


def engines(_: Job) -> Iterator[Row]:
    """10^5 scans of walks, the full state of both lines of matiec and of the embedded engine after each."""
    for each in survey().candidates():
        if each.engine is not None and each.name in MATIEC_NAMES:
            for seed in range(WALKS):
                walk(seed, SCANS, twins(with_double(each.engine)))
            yield Row(f"{WALKS * SCANS} scans of walks on {each.name} and the embedded engine", "one state after each")


if __name__ == "__main__":
    sys.exit(main())
