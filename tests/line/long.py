"""The line at length, judged in counts: `python -m tests.line.long [--runs N] [--first SEED] [--page]`.

Random lines of every kind around each line of matiec, refresh beside its formulas.
`--page` writes the table of docs/measured/line.md. Exit status 1 if anything is not as it must be.
"""

import argparse
import sys
import tempfile
import time
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from tests import measured
from tests.blocks.toolchains import FOUND
from tests.line import refresh
from tests.line.cline import WHY_NOT, CLine, Ran, build

from structured_text.engines.discovery import survey
from structured_text.engines.matiec.installation import Installation

PAGE = Path(__file__).parents[2] / "docs" / "measured" / "line.md"
KINDS = {"stops": 1.0, "timing": 0.35, "task": 0.35, "late": 0.1, "broken": 0.1, "faults": 0.1}
"""Kinds of random lines, and how many of each for one of the first."""
OTHERS = 0.2
"""How many lines run on another line of matiec, and with 32 slots, for one on the first."""
JITTER = 10
COSTS = 10
"""Runs that a cost is the least of."""


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

    def line(self, slots: int = 8, tool: Installation | None = None) -> CLine:
        """A compiled line, once each."""
        place = self.folder / f"{slots}{tool.iec2c.parent.name if tool else ''}"
        if place.exists():
            return CLine(place / f"vline{slots}")
        place.mkdir()
        return build(place, slots, tool)


def main() -> int:
    """Run all of it."""
    parser = argparse.ArgumentParser(description="The line at length.")
    parser.add_argument("--runs", type=int, default=1_000_000, help="random stop scenarios; a tenth of each other kind")
    parser.add_argument("--first", type=int, default=0, help="the first seed")
    parser.add_argument("--page", action="store_true", help="write the figures into docs/measured/line.md")
    options = parser.parse_args()
    if WHY_NOT:
        print(WHY_NOT)
        return 1
    rows, tables = [], []
    began = time.monotonic()
    with tempfile.TemporaryDirectory() as folder:
        for part in _all(Job(Path(folder), options.runs, options.first)):
            if isinstance(part, Row):
                print(part if part.good else f"FAILED {part}", flush=True)
                rows.append(part)
            else:
                print("\n".join(part), flush=True)
                tables += ["", *part]
    rows.append(
        Row(
            f"all of this, with {options.runs} lines of kind stops, on one core",
            f"{(time.monotonic() - began) / 60:.0f} minutes",
        )
    )
    if options.page:
        measured.put(PAGE, ["| what | measured |", "|---|---|", *map(str, rows), *tables])
    failed = [row for row in rows if not row.good]
    print(f"{len(failed)} of {len(rows)} are not as they must be")
    return 1 if failed else 0


def _all(job: Job) -> Iterator[Row | list[str]]:
    for part in (refreshed, bus, cost, randoms, sanitized):
        yield from part(job)


# ---------------------------------------------------------------- refresh, late replies, cost


def refreshed(job: Job) -> Iterator[Row | list[str]]:
    """Every combination beside both formulas, with steady scans and with scans that vary."""
    found = {each: each.run(job.line) for each in refresh.setups()}
    varied = {each: each.run(job.line, JITTER) for each in refresh.setups()}
    shares = [
        ("as it is", {each: ms / each.formula() for each, ms in found.items()}),
        ("silence in whole ms", {each: ms / each.formula(whole=True) for each, ms in found.items()}),
        (
            f"the same, scans that vary by {JITTER} %",
            {each: ms / each.formula(whole=True, shortest=1 - JITTER / 100) for each, ms in varied.items()},
        ),
    ]
    for name, ratios in shares:
        most = max(ratios.values())
        over = [each for each, ratio in ratios.items() if ratio > refresh.SLACK]
        measured = f"at most {most:.3f}; above {refresh.SLACK}: {'; '.join(map(str, over)) or 'none'}"
        good = all(each.coarse for each in over) if name == shares[0][0] else not over
        yield Row(f"refresh beside its formula, {len(ratios)} lines, {name}", measured, good)
    yield refresh.seven(found)
    yield refresh.families(job.line)


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
    for name, other in (("going on at once", hasty), ("none late", good)):
        measured += f"{100 * (late['refresh_ms'] / other['refresh_ms'] - 1):+.1f} % beside {name}"
        measured += other.told(" ({refresh_ms:.1f} ms); ")
    fine = not late["wrong_readings"] and late["refresh_ms"] <= 1.03 * hasty["refresh_ms"]
    yield Row("1 % of replies late, up to 100 ms", measured.removesuffix("; "), fine)
    for loss in ("loss", "garble"):
        ran = line.run("run", ms=600_000, **{loss: 1000})
        yield Row(f"1 % of replies {'lost' if loss == 'loss' else 'garbled'}", ran.told("{refresh_ms:.1f} ms"))
    for ascii_, pass_ in ((0, 65536), (1, 256)):
        noise = line.run("run", drives=1, ascii=ascii_, scramble=30_000, ms=36_000_000 if ascii_ else 360_000_000)
        theory = noise["scrambled"] / pass_
        measured = noise.told("{wrong_readings:.0f} of {scrambled:.0f} believed; the checksum lets ")
        name = "ASCII" if ascii_ else "RTU"
        fine = noise["wrong_readings"] <= 1.2 * theory + 10
        yield Row(f"{name} replies, every byte after the head random", f"{measured}{theory:.1f} pass", fine)


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
        busy = _least(job.line(slots), drives=slots)
        idle = _least(job.line(slots), drives=slots, poll_ms=30_000)
        times = {
            "idle": idle["idle_ns"] / idle["crc_ns"],
            "waiting": busy["waiting_ns"] / busy["crc_ns"],
            "with a transaction": busy["transaction_ns"] / busy["crc_ns"],
        }
        measured = busy.told("{line_bytes:.0f} bytes, {slot_bytes:.0f} per slot; ") + idle.told("{idle_ns:.0f} ns ")
        measured += busy.told("idle, {waiting_ns:.0f} waiting, {transaction_ns:.0f} with a transaction; ")
        measured += "of the CRC of 256 bytes by a table in C: "
        measured += ", ".join(f"{ratio:.2f} {name}" for name, ratio in times.items())
        fine = busy["line_bytes"] <= 340 * slots + 4060 and busy["slot_bytes"] <= 260
        yield Row(f"line of {slots} slots and drives", measured, fine)


def _least(line: CLine, **keys: int) -> Ran:
    """The least of each figure: for seconds on end, others on a shared machine make everything half as slow again."""
    runs = [line.run("cost", **keys).figures for _ in range(COSTS)]
    return Ran({name: min(each[name] for each in runs) for name in runs[0]}, ())


def _name(tool: Installation) -> str:
    """The line of matiec that an installation belongs to."""
    engines = (each.engine for each in survey().examined if each.iec2c == str(tool.iec2c))
    return next((each.name for each in engines if each is not None), str(tool.iec2c))


# ---------------------------------------------------------------- random lines

SUMS = (
    "{stops:.0f} stops: {lost_stops:.0f} lost, {late_stops:.0f} late, {broken_stops:.0f} late by a broken promise",
    "{ratio:.2f} of `WorstStopMs` at most",
    "{late_lone_stops:.0f} of {lone_stops:.0f} lone ones over `StopAloneMs`",
    "{requests:.0f} requests: {false_timeouts:.0f} false timeouts, {short_silences:.0f} short silences",
    "{parameters:.0f} parameters and the fault resets: {unasked:.0f} that must not be sent",
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
            what = f"{count} random lines of kind {kind}, {slots} slots, {_name(tool)}"
            yield Row(what, ran.told("; ".join(SUMS)), not ran.failures)


def sanitized(job: Job) -> Iterator[Row]:
    """Every kind under AddressSanitizer and UndefinedBehaviorSanitizer, which end the program at what they find."""
    for tool in FOUND:
        place = job.folder / f"sanitized {tool.iec2c.parent.name}"
        place.mkdir()
        flags = ("-O1", "-g", "-fsanitize=address,undefined", "-fno-sanitize-recover=all")
        line = build(place, tool=tool, flags=flags)
        ran = [line.random(job.first, max(10, job.runs // 500), kind) for kind in KINDS]
        scans = sum(each["scans"] for each in ran)
        yield Row(f"{scans:.0f} scans under the sanitizers, {_name(tool)}", "nothing found")


if __name__ == "__main__":
    sys.exit(main())
