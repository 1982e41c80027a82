"""The line at length, judged in counts: `python -m tests.line.long [--runs N] [--first SEED] [--page]` (`make line`).

Random lines of every kind around each line of matiec, every planted mistake found, 10^5 scans of walks with the full
state of every engine compared, refresh beside its formula. `--page` writes what was measured into docs/line.md.
Exit status 1 if anything is not as it must be.
"""

import argparse
import re
import sys
import tempfile
from collections.abc import Iterator
from itertools import product
from math import ceil
from pathlib import Path

from tests.blocks.compare.comparison import with_double
from tests.blocks.toolchains import FOUND
from tests.line.cline import WHY_NOT, CLine, Ran, build
from tests.line.planted import PLANTED
from tests.line.test_engines import twins
from tests.line.walk import walk

from driveblocks.host.discovery import MATIEC_NAMES, survey

PAGE = Path(__file__).parents[2] / "docs" / "line.md"
KINDS = {"stops": 1.0, "timing": 0.1, "late": 0.1, "broken": 0.1, "faults": 0.1}
"""Kinds of random lines, and how many of each for one of the first."""
WALKS, SCANS = 100, 1000
SLACK = 1.12


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
    with tempfile.TemporaryDirectory() as folder:
        told = list(_all(Path(folder), options.runs, options.first))
    failed = [line for good, line in told if not good]
    if options.page:
        _write([line for _, line in told])
    print(f"{len(failed)} of {len(told)} are not as they must be")
    return 1 if failed else 0


def _all(folder: Path, runs: int, first: int) -> Iterator[tuple[bool, str]]:
    for part in (_refresh, _bus, _random, _planted, _engines, _cost):
        for good, line in part(folder, runs, first):
            print(line if good else f"FAILED {line}", flush=True)
            yield good, line


def _line(folder: Path, slots: int = 8) -> CLine:
    """A line of the first matiec, built once."""
    place = folder / f"line{slots}"
    if (place / f"vline{slots}").exists():
        return CLine(place / f"vline{slots}")
    place.mkdir()
    return build(place, slots)


# ---------------------------------------------------------------- refresh


def formula(
    drives: int, rate: int, bits: int, scan_ms: int, keeps: bool, late: int, words: int = 6, turn: int = 5
) -> float:
    """Refresh in ms: whole scans per transaction, those of the silence where the line keeps it, those of the adapter."""
    wire = (8 + 5 + 2 * words) * bits * 1000 / rate + turn
    silence = 1.75 if rate > 19200 else 3.5 * bits * 1000 / rate
    scans = ceil((wire + silence) / scan_ms) if keeps else ceil(wire / scan_ms) + int((silence + 1) / scan_ms) + 1
    return drives * (scans + late) * scan_ms


def _refresh(folder: Path, *_: int) -> Iterator[tuple[bool, str]]:
    """Every combination against the formula."""
    worst: dict[bool, tuple[float, str]] = {True: (0, ""), False: (0, "")}
    count = 0
    rates, bits, scans = (9600, 19200, 38400, 57600, 115200), (10, 11), (5, 10, 20)
    for drives, rate, bit, scan, keeps, late in product((1, 3, 7, 16, 32), rates, bits, scans, (True, False), range(4)):
        ran = _line(folder, 8 if drives <= 8 else 32).run(
            "run", drives=drives, rate=rate, bits=bit, scan=1000 * scan, jitter=0, max_scan=scan, keeps=int(keeps), rx_late=late,
            ms=6000 + 40 * int(formula(drives, rate, bit, scan, keeps, late)),
        )  # fmt: skip
        share = ran["refresh_ms"] / formula(drives, rate, bit, scan, keeps, late)
        worst[keeps] = max(
            worst[keeps], (share, f"{drives} drives, {rate} bit/s, {bit} bits, {scan} ms, {late} scans late")
        )
        count += 1
    for keeps, (share, where) in worst.items():
        who = "port" if keeps else "line"
        yield (
            share <= SLACK,
            f"| refresh beside the formula, {count // 2} lines, silence kept by the {who} | at most {share:.2f} ({where}) |",
        )


def _bus(folder: Path, *_: int) -> Iterator[tuple[bool, str]]:
    """Seven drives, six words, 19200 8N1, 10 ms scans, 5 ms turn-round."""
    line = _line(folder)
    good, own = line.run("run"), line.run("run", keeps=0)
    yield good["refresh_ms"] <= 150, f"| refresh, 7 drives, silence kept by the port | {good['refresh_ms']:.0f} ms |"
    yield own["refresh_ms"] <= 215, f"| refresh, 7 drives, silence kept by the line | {own['refresh_ms']:.0f} ms |"
    for keeps in (1, 0):
        both = line.run("run", keeps=keeps, command_ms=1)
        told = f"{both['refresh_ms']:.0f} ms, a command answered behind {both['command_ms']:.0f} ms, {both['command_worst_ms']:.0f} at most"
        yield (
            True,
            f"| one write and one read per drive and round, {'port' if keeps else 'line'} keeps the silence | {told} |",
        )
    dead = line.run("run", dead=1, ms=600_000)
    yield (
        dead["refresh_ms"] <= 1.02 * 6 / 7 * good["refresh_ms"],
        f"| one drive of seven dead | {dead['refresh_ms']:.1f} ms for the others; 6/7 would be {6 / 7 * good['refresh_ms']:.1f} |",
    )
    late = line.run("run", late=1000, longest_ms=100, ms=3_600_000)
    hasty = line.run("run", late=1000, longest_ms=100, drain=1, ms=3_600_000)
    share = late["refresh_ms"] / hasty["refresh_ms"]
    yield (
        not late["wrong_readings"] and share < 1.03,
        (
            f"| 1 % of replies late, up to 100 ms | {late['refresh_ms']:.1f} ms, {late['wrong_readings']:.0f} of {late['readings']:.0f} readings wrong; "
            f"going on at once {hasty['refresh_ms']:.1f} ms, {hasty['wrong_readings']:.0f} wrong |"
        ),
    )
    for loss in ("loss", "garble"):
        yield (
            True,
            f"| 1 % of replies {'lost' if loss == 'loss' else 'garbled'} | {line.run('run', ms=600_000, **{loss: 1000})['refresh_ms']:.1f} ms |",
        )
    noise = line.run("run", drives=1, scramble=30_000, ms=360_000_000)
    theory = noise["scrambled"] / 65536
    yield (
        noise["wrong_readings"] <= 2 * theory + 10,
        (
            f"| replies with every byte behind the head by chance | {noise['wrong_readings']:.0f} of {noise['scrambled']:.0f} believed; "
            f"a checksum of 16 bits lets {theory:.1f} pass |"
        ),
    )


# ---------------------------------------------------------------- random lines and planted mistakes


def _sums(ran: Ran) -> str:
    parts = [f"{ran['stops']:.0f} stops: {ran['lost_stops']:.0f} lost, {ran['late_stops']:.0f} late, {ran['broken_stops']:.0f} late by a broken promise",
             f"highest {ran['ratio']:.2f} of `WorstStopMs`, {ran['late_lone_stops']:.0f} of {ran['lone_stops']:.0f} lone ones over `StopAloneMs`",
             f"{ran['requests']:.0f} requests, {ran['false_timeouts']:.0f} false timeouts, {ran['short_silences']:.0f} short silences",
             f"{ran['wrong_readings']:.0f} of {ran['readings']:.0f} readings wrong, {ran['false_acks']:.0f} false acknowledgements",
             f"{ran['virtual_hours']:.0f} h of bus"]  # fmt: skip
    return "; ".join(parts)


def _random(folder: Path, runs: int, first: int) -> Iterator[tuple[bool, str]]:
    for tool, slots in [*((tool, 8) for tool in FOUND), (FOUND[0], 32)]:
        name = f"{tool.iec2c.parent.name}{slots}"
        place = folder / name
        place.mkdir()
        line = build(place, slots, tool=tool)
        main_line = tool is FOUND[0] and slots == 8
        for kind, share in KINDS.items():
            count = max(1, int(runs * share * (1 if main_line else 0.02)))
            ran = line.random(first, count, kind)
            for failure in ran.failures:
                print(failure, flush=True)
            yield (
                not ran.failures,
                f"| {count} random lines of kind {kind}, {slots} slots, {tool.iec2c.parent.name} | {_sums(ran)} |",
            )


def _planted(folder: Path, *_: int) -> Iterator[tuple[bool, str]]:
    for number, planted in enumerate(PLANTED):
        place = folder / f"planted{number}"
        place.mkdir()
        line, found = build(place, edit=planted.edit), 0
        for count in (1000, 10_000, 100_000):
            ran = line.random(0, count, planted.kind)
            if ran.failures:
                found = count
                break
        first = ran.failures[0].partition(" kind")[0].removeprefix("failure ") if ran.failures else "not found"
        yield (
            found > 0,
            f"| planted: {planted.name} | {first}, {ran['failures']:.0f} of {count} lines of kind {planted.kind} |",
        )


def _engines(*_: object) -> Iterator[tuple[bool, str]]:
    """10^5 scans of walks, the full state of both lines of matiec and of the embedded engine after each."""
    for each in survey().candidates():
        if each.engine is not None and each.name in MATIEC_NAMES:
            for seed in range(WALKS):
                walk(seed, SCANS, twins(with_double(each.engine)))
            yield (
                True,
                f"| {WALKS * SCANS} scans of walks, full state after each | {each.name} and the embedded engine alike |",
            )


def _cost(folder: Path, *_: int) -> Iterator[tuple[bool, str]]:
    for slots in (8, 32):
        line = _line(folder, slots)
        ran, idle = line.run("cost", drives=slots), line.run("cost", drives=slots, poll_ms=30_000)
        yield (
            ran["line_bytes"] <= 200 * slots + 1200,
            (
                f"| line of {slots} slots and drives | {ran['line_bytes']:.0f} bytes, {ran['slot_bytes']:.0f} per slot; {idle['idle_ns']:.0f} ns idle, "
                f"{ran['waiting_ns']:.0f} waiting, {ran['transaction_ns']:.0f} with a transaction |"
            ),
        )


def _write(lines: list[str]) -> None:
    """Put the table into the page, between its marks."""
    page = PAGE.read_text(encoding="utf-8")
    table = "\n".join(["| what | measured |", "|---|---|", *lines])
    made = re.sub(r"(?s)(<!-- measured -->\n).*?(<!-- end -->)", lambda found: found[1] + table + "\n" + found[2], page)
    PAGE.write_text(made, encoding="utf-8")


if __name__ == "__main__":
    sys.exit(main())
