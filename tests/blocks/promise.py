"""Change good maps as authors do: whatever `check` calls good must build, lint clean and pass its generated tests.

    python -m tests.blocks.promise [--count N] [--seed N] [--only N [--write FILE]] [--processes N]

Each change is made from the seed and its own number alone; `--only` repeats one of them. Maps that become the same
blocks are judged once. Exit status 1 when a map that `check` calls good breaks the promise, or makes a step fall over.
"""

import argparse
import hashlib
import json
import multiprocessing
import random
import sys
import time
import traceback
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path

from tests.blocks import authors
from tests.maps import mutate

from driveblocks.docs.page import documents
from driveblocks.maps import catalog, collection
from driveblocks.maps.load import loads
from driveblocks.maps.model import Drive
from driveblocks.maps.problem import MapError
from driveblocks.render import library, text
from driveblocks.testing import runner
from driveblocks.testing.suite import ROOT, drive_suite
from driveblocks.testing.unit import Unit
from structured_text.engines.embedded.engine import EmbeddedEngine
from structured_text.engines.engine import Source
from structured_text.language.lint import lint_sources

OTHERS = Path(__file__).parent / "fourth_drive"
LANGUAGES = text.languages(["en", "zh"], "utf-8")
SECONDS = 600.0
"""Time limit of one test program: only against a hang."""
SHARE_OF_FACTS = 0.15
"""How many of the changes alter one fact of the text; the others are those of authors."""
SHARE = 300
"""Changes that one set of processes takes."""


@dataclass(frozen=True)
class Try:
    """One changed map: its number, what was done, and what became of it."""

    number: int
    said: str
    digest: str = ""
    """What means its blocks; empty for a map that `check` refuses."""
    wrong: tuple[str, ...] = ()


@cache
def originals() -> tuple[mutate.Text, ...]:
    """The shipped maps and the other drives of the tests, but for those with a base."""
    texts = [
        mutate.Text(path.name, path.read_text(encoding="utf-8"))
        for path in (*catalog.shipped(), *sorted(OTHERS.glob("*.yaml")))
    ]
    return tuple(each for each in texts if "\nbase: " not in each.text)


def changed(seed: int, number: int) -> tuple[str, str]:
    """The changed map of a number, and what was done to it."""
    chance = random.Random(f"{seed}:{number}")
    weights = [1 / len(each.text) ** 0.5 for each in originals()]
    original = chance.choices(originals(), weights)[0]
    if chance.random() < SHARE_OF_FACTS:
        change = mutate.change_a_fact(original, chance)
        return change.data.decode(), change.said
    document = mutate.plain(original.root)
    said = authors.change(document, chance)
    return json.dumps(document, ensure_ascii=False, indent=0), f"{original.name}: {said}"


# ---------------------------------------------------------------- the judge


@cache
def shared() -> tuple[library.File, ...]:
    """What every drive's blocks need."""
    return tuple(library.generic(LANGUAGES))


def rendered(map_text: str) -> tuple[Drive, list[library.File]] | None:
    """The drive and its blocks; None for a map that `check` refuses."""
    try:
        drive = loads(map_text, "map.yaml")
    except MapError:
        return None
    return drive, list(library.drive("map", drive, LANGUAGES))


def glance(seed: int, number: int) -> Try:
    """Change a map and make its blocks, as far as it goes."""
    said = ""
    try:
        map_text, said = changed(seed, number)
        made = rendered(map_text)
    except Exception:
        return Try(number, said, "fell over", (traceback.format_exc(limit=-4),))
    if made is None:
        return Try(number, said)
    digest = hashlib.sha256("\0".join(f"{each.path}\0{each.text}" for each in made[1]).encode())
    return Try(number, said, digest.hexdigest())


def judge(seed: int, number: int) -> Try:
    """Build, lint and test the blocks of a changed map."""
    map_text, said = changed(seed, number)
    try:
        return Try(number, said, "judged", tuple(broken(map_text)))
    except Exception:
        return Try(number, said, "judged", (traceback.format_exc(limit=-4),))


def broken(map_text: str) -> Iterator[str]:
    """What the blocks of a map break of the promise; nothing for a map that `check` refuses."""
    made = rendered(map_text)
    if made is None:
        return
    drive, blocks = made
    documents([*shared(), *blocks], [drive])
    files = [each for each in shared() if "Text" not in each.name] + blocks  # no block needs the texts of results
    suite = drive_suite(collection.Source(Path("map.yaml"), drive), LANGUAGES)
    unit = Unit(suite, tuple(Source(each.path, each.text) for each in files))
    own = {each.path for each in blocks} | {ROOT + each.path for each in suite.programs}
    for problem in lint_sources([(each.path, each.text) for each in unit.sources]):
        if problem.path in own:
            yield f"lint: {problem}"
    for result in runner.run([unit], [EmbeddedEngine()], SECONDS).results:
        for outcome in result.bad:
            yield f"test {result.program}: {outcome.words}: {outcome.message}"


# ---------------------------------------------------------------- many of them


def search(seed: int, numbers: Sequence[int], processes: int) -> Iterator[Try]:
    """What each change became, those that are judged in the order in which they end."""
    first: dict[str, int] = {}
    for pool, part in _shares(numbers, processes):
        for each in pool.map(glance, [seed] * len(part), part, chunksize=8):
            known = first.setdefault(each.digest, each.number) if each.digest and not each.wrong else None
            if known != each.number:
                yield each if known is None else replace(each, digest="same")
    for pool, part in _shares(list(first.values()), processes):
        for done in as_completed(pool.submit(judge, seed, number) for number in part):
            yield done.result()


def _shares(numbers: Sequence[int], processes: int) -> Iterator[tuple[ProcessPoolExecutor, Sequence[int]]]:
    """The numbers in shares, each with processes of its own, so that none grows without end."""
    context = multiprocessing.get_context("spawn")
    for start in range(0, len(numbers), SHARE):
        with ProcessPoolExecutor(processes, context) as pool:
            yield pool, numbers[start : start + SHARE]


def report(tries: Iterable[Try], seed: int) -> Iterator[str]:
    """Each find as it comes, then the sum."""
    became: Counter[str] = Counter()
    for each in tries:
        if became.total() and became.total() % 250 == 0:
            yield f"{became.total()} done"
        became["refused" if not each.digest else "find" if each.wrong else each.digest] += 1
        if each.wrong:
            yield f"change {each.number} of seed {seed}: {each.said}"
            yield from (f"    {line}" for wrong in each.wrong[:3] for line in wrong.splitlines()[:12])
            if len(each.wrong) > 3:
                yield f"    and {len(each.wrong) - 3} more"
    judged = became["judged"] + became["find"]
    yield f"{became.total()} changes: {became['refused']} refused by check, {became['same']} like another"
    yield f"{judged} judged, {became['find']} finds"


def main(arguments: Sequence[str] | None = None) -> int:
    """Run from the command line; the exit status is 1 with a find."""
    parser = argparse.ArgumentParser(description="See that what check calls good builds, lints clean and passes.")
    parser.add_argument("--count", type=int, default=3000, help="how many changes (3000)")
    parser.add_argument("--seed", type=int, default=1, help="what they are made from (1)")
    parser.add_argument("--only", type=int, help="repeat the change of this number alone")
    parser.add_argument("--write", type=Path, help="with --only: where to write the changed map")
    parser.add_argument("--processes", type=int, default=2, help="how many at once (2)")
    given = parser.parse_args(arguments)
    numbers = range(given.count) if given.only is None else [given.only]
    if given.only is not None and given.write:
        given.write.write_text(changed(given.seed, given.only)[0], encoding="utf-8")
    start, finds = time.monotonic(), False
    print(f"seed {given.seed}", flush=True)
    try:
        for line in report(search(given.seed, numbers, given.processes), given.seed):
            finds = finds or line.startswith("change ")
            print(line, flush=True)
    except BrokenProcessPool:
        print("a process died, so the run is not whole: repeat it with --processes 1 to see where")
        finds = True
    print(f"seed {given.seed}, {time.monotonic() - start:.0f} s")
    return int(finds)


if __name__ == "__main__":
    sys.exit(main())
