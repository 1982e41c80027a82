"""The matrix at length, `make long WHAT=matrix`: `python -m tests.second.long [--times N] [--only WORDS] [--walks N]
[--family NAME]`.

With `--store FILE` it goes on where it was ended; `--part 1` to `--part 4` are the walks of 90 minutes each.

Every cell this many times, each time with other options, other moments and, every second time, a second event on the
heels of the first; then random walks with the same judge. On matiec where it is found, else on the embedded engine; in
two processes. Prints each failure, then the table of cells by the rule that broke first; exit status 1 where one fails.
"""

import argparse
import gc
import json
import sys
from collections import Counter, defaultdict
from collections.abc import Sequence
from concurrent.futures import Future, ProcessPoolExecutor, as_completed
from dataclasses import asdict
from functools import cache
from pathlib import Path

from tests.second.matrix import MODES, STATES, Cell, Outcome, cells, run
from tests.second.station import built
from tests.second.walk import walk

from structured_text.engines.discovery import MATIEC_NAMES, survey
from structured_text.engines.engine import Engine, Library

JOBS = 2
CHUNK = 28
PART = 2800
"""Walks of a part, with seeds of its own."""
SHORT = {"full control": "full", "SpeedOnly": "speed", "MonitorOnly": "monitor"}


def fastest() -> Engine:
    """The engine of matiec where it is found, else the embedded one."""
    found = {each.name: each.engine for each in survey().candidates() if each.engine is not None}
    return found[next((each for each in MATIEC_NAMES if each in found), "embedded")]


@cache
def stations() -> Library:
    """The stations on the fastest engine, once per process; what that leaves in memory is not searched for garbage."""
    made = built(fastest())
    gc.freeze()
    gc.set_threshold(100_000)
    return made


def some(chosen: Sequence[Cell], seed: int) -> list[Outcome]:
    """Cells with a seed."""
    return [run(cell, seed, stations()) for cell in chosen]


def walks(first: int, number: int, family: str = "") -> list[Outcome]:
    """Random walks from a seed on, of one family where it is named."""
    return [walk(seed, stations(), family) for seed in range(first, first + number)]


def table(outcomes: Sequence[Outcome]) -> str:
    """Runs that failed of those of each event and state, by mode; `-` is a cell that was never reached."""
    runs: dict[tuple[str, str, str], list[Outcome]] = defaultdict(list)
    for each in outcomes:
        runs[each.cell.event, each.cell.mode, each.cell.state].append(each)
    lines = [f"{'event':28} {'mode':8}" + "".join(f"{state:>14}" for state in STATES)]
    for event in dict.fromkeys(each.cell.event for each in outcomes):
        for mode in MODES:
            found = [_field(runs[event, mode, state]) for state in STATES]
            if set(found) == {"-"}:
                continue
            lines.append(f"{event[:28]:28} {SHORT.get(mode, mode):8}" + "".join(f"{each:>14}" for each in found))
    return "\n".join(lines)


def _field(runs: Sequence[Outcome]) -> str:
    reached = [each for each in runs if not each.not_reached or each.rules]
    failed = Counter(each.rules[0] for each in reached if each.rules)
    if not reached:
        return "-"
    return " ".join(f"{name}:{count}" for name, count in failed.most_common(2)) or "."


def main() -> int:
    """Run all of it."""
    parser = argparse.ArgumentParser(description="The matrix at length.")
    parser.add_argument("--times", type=int, default=4, help="runs of each cell")
    parser.add_argument("--first", type=int, default=0, help="the first seed")
    parser.add_argument("--only", default="", help="cells whose name holds these words")
    parser.add_argument("--walks", type=int, default=2000, help="random walks")
    parser.add_argument("--family", default="", help="walks of this family alone")
    parser.add_argument("--part", type=int, default=0, help="1 to 4: walks alone, of other seeds in each part")
    parser.add_argument("--jobs", type=int, default=JOBS, help="processes")
    parser.add_argument("--store", type=Path, help="what is done; it is not run again")
    options = parser.parse_args()
    stations()  # compiled once, for all processes
    chosen = [each for each in cells() if options.only in str(each)] if not options.part else []
    parts = [chosen[at : at + CHUNK] for at in range(0, len(chosen), CHUNK)]
    begin, number = (options.part * PART, PART) if options.part else (0, options.walks)
    outcomes, known = _stored(options.store)
    with ProcessPoolExecutor(options.jobs) as pool:
        waiting: dict[Future[list[Outcome]], str] = {}
        for seed in range(options.first, options.first + options.times):
            for at, part in enumerate(parts):
                if (name := f"cells {options.only} {at} {seed}") not in known:
                    waiting[pool.submit(some, part, seed)] = name
        for first in range(begin, begin + number, CHUNK):
            count = min(CHUNK, begin + number - first)
            if (name := f"walks {options.family} {first} {count}".replace("  ", " ")) not in known:
                waiting[pool.submit(walks, first, count, options.family)] = name
        for each in as_completed(waiting):
            outcomes += each.result()
            _store(options.store, waiting[each], each.result())
    return report(outcomes)


def _stored(place: Path | None) -> tuple[list[Outcome], set[str]]:
    """What was done, and the names of it."""
    rows = [json.loads(row) for row in place.read_text("utf-8").splitlines()] if place and place.exists() else []
    found = [Outcome(**{**each, "cell": Cell(**each["cell"])}) for row in rows for each in row["outcomes"]]
    return found, {row["name"] for row in rows}


def _store(place: Path | None, name: str, outcomes: Sequence[Outcome]) -> None:
    if place:
        place.parent.mkdir(parents=True, exist_ok=True)
        with place.open("a", encoding="utf-8") as file:
            file.write(json.dumps({"name": name, "outcomes": [asdict(each) for each in outcomes]}) + "\n")


def report(outcomes: Sequence[Outcome]) -> int:
    """Print failures and table; 1 where there is one."""
    bad = [each for each in outcomes if each.rules]
    for each in bad:
        print(f"{each.cell}, seed {each.seed}: {', '.join(each.rules)}: {each.told[0][:300]}")
    print(table([each for each in outcomes if len(each.events) <= 2]))  # walks have more
    reasons = Counter((each.cell.family, each.cell.mode, each.not_reached) for each in outcomes if each.not_reached)
    for (family, mode, why), count in sorted(reasons.items()):
        print(f"not reached {count} times: {family}, {mode}: {why}")
    print(f"{len(outcomes)} runs, {len(bad)} fail")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
