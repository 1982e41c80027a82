"""Change every fact of the shipped maps, one at a time, and see that the blocks made from it are judged wrong.

The judges are the manuals' frames and the reference model of the map as it was. Beside them the run says whether the
loader's rules refuse the change, and, if not, whether a test of facts typed from the manuals turns red. A change that
alters a block and that the judges of blocks do not notice has survived them: `survivors.yaml` must say why that is
right. A change that alters no block is only counted. The judges call each block by itself; a drive block, which runs in
time, is judged on a virtual line by tests/drives: what alters it alone must be noticed by rules or by typed facts here.

    python -m tests.blocks.mutation [--rounds N] [--seed S] [--sample N]
"""

import argparse
import random
import re
import sys
import time
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path

import yaml
from tests.blocks import judges
from tests.blocks.library import Blocks, sources
from tests.maps import mutate

from driveblocks.maps import catalog, nodes
from driveblocks.maps.check import check
from driveblocks.maps.decode import decode
from driveblocks.maps.load import load
from driveblocks.maps.model import Drive
from driveblocks.maps.problem import Report
from driveblocks.render import library, text
from structured_text.engines.embedded.engine import EmbeddedEngine
from structured_text.engines.engine import EngineError, Source

LANGUAGES = text.languages(["en", "zh"], "utf-8")
SURVIVORS = Path(__file__).with_name("survivors.yaml")
_COMMENT = re.compile(r"\(\*.*?\*\)", re.DOTALL)
LEFT = re.compile(r"_(Drive|Reads|Orders|ParameterGate|Identity|MayWrite|ParameterAddress)$")
"""Blocks that are judged by tests of their own, with a line and a drive around them: facts have to notice a change."""


@dataclass(frozen=True)
class Original:
    """A shipped map: its text with the places of its facts, the drive, and its blocks by name."""

    text: mutate.Text
    drive: Drive
    blocks: dict[str, str]


@dataclass
class Tally:
    """What became of the changes."""

    seen: Counter[str] = field(default_factory=Counter)
    model_only: Counter[str] = field(default_factory=Counter)
    survived: list[tuple[str, str, str]] = field(default_factory=list)
    seconds: float = 0.0


@cache
def originals() -> tuple[Original, ...]:
    """The shipped maps."""
    found = []
    for path in catalog.shipped():
        data = path.read_text(encoding="utf-8")
        drive = load(path)
        found.append(Original(mutate.Text(path.name, data), drive, rendered(path.stem, drive)))
    return tuple(found)


def rendered(stem: str, drive: Drive) -> dict[str, str]:
    """A drive's blocks by name, but for the revision of its map, which every fact alters."""
    files = library.drive(stem, drive, LANGUAGES)
    return {file.name: file.text for file in files if not file.name.endswith("_Version")}


def changes(original: Original, leaf: mutate.Leaf, chance: random.Random) -> mutate.Change | None:
    """One change of a fact, if there is another value for it."""
    for _ in range(20):
        new = mutate.altered(leaf, chance, original.text)
        if new is not None:
            return mutate.replaced(original.text, leaf, new)
    return None


def verdict(original: Original, change: mutate.Change) -> str:
    """Who notices a change: rules, facts, blocks; else `nothing`, or why there is nothing to notice."""
    drive, refused = read(change, original.text.name)
    if drive is None:
        return "is no map"
    try:
        made = rendered(Path(original.text.name).stem, drive)
    except (ValueError, TypeError, AssertionError, LookupError, ArithmeticError):
        return "makes no block" if refused else "makes no block, noticed by nothing"
    altered = [name for name in original.blocks.keys() | made.keys() if original.blocks.get(name) != made.get(name)]
    if not altered:
        return "alters no block"
    code = [name for name in altered if bare(original.blocks.get(name)) != bare(made.get(name))]
    notice = ["rules"] * refused + ["facts"] * (not refused and by_facts(drive))
    if not code:
        return f"alters comments, noticed by {' and '.join(notice) or 'nothing'}"
    judged = [name for name in code if not LEFT.search(name)]
    if not judged:
        return f"alters what simulated drives judge, noticed by {' and '.join(notice) or 'nothing'}"
    notice += ["blocks"] * by_blocks(original, drive, made, judged)
    return f"noticed by {' and '.join(notice) or 'nothing'}"


def read(change: mutate.Change, name: str) -> tuple[Drive | None, bool]:
    """The changed map even where rules refuse it, and whether they do; None where it has not the form of a map."""
    report = Report(name)
    root = nodes.parse(change.data.decode(), report)
    drive: Drive | None = decode(Drive, root, report) if root is not None else None
    if drive is None or report.problems:
        return None, True
    try:
        check(drive, report)
    except (ValueError, ArithmeticError, LookupError):
        return drive, True
    return drive, bool(report.problems)


def bare(block: str | None) -> str | None:
    """A block's text without its comments."""
    return None if block is None else _COMMENT.sub("", block)


def by_facts(drive: Drive) -> bool:
    """Whether a test of typed facts turns red."""
    try:
        judges.facts(drive)
    except (AssertionError, KeyError, StopIteration, IndexError, AttributeError):
        return True
    return False


def by_blocks(original: Original, drive: Drive, made: dict[str, str], altered: list[str]) -> bool:
    """Whether the blocks of the changed map are judged wrong, or do not compile."""
    try:
        blocks = Blocks(EmbeddedEngine().build([*shared(), *closure(original.drive.prefix, made, altered)]))
        judges.judge(blocks, original.drive, altered, drive)
    except (AssertionError, LookupError, EngineError, ValueError):
        return True
    return False


@cache
def shared() -> tuple[Source, ...]:
    """Types and blocks that every drive uses, without the long texts of results."""
    wanted = (each for each in sources() if each.path.startswith(("types/", "modbus/MB_")))
    return tuple(each for each in wanted if not re.search("ResultText|Pack|Compact", each.path))


def closure(prefix: str, made: dict[str, str], altered: Iterable[str]) -> Iterator[Source]:
    """The altered blocks and those that they belong to, functions first."""
    wanted = set(altered)
    group = {f"{prefix}_{name}" for name in judges.EXCHANGE}
    if wanted & {*group, f"{prefix}_MayWrite"}:
        wanted |= group
    if any("Text" in name for name in wanted):
        wanted |= {name for name in made if "Text" in name}
    for name, block in made.items():
        if name in wanted:
            yield Source(name, block)


def run(rounds: int, seed: int, sample: int | None = None) -> Tally:
    """Change every fact this many times, or a sample of them."""
    judges.shipped_is_good()
    tally, start = Tally(), time.perf_counter()
    whole = [each for each in originals() if not each.drive.base]  # the others say only what is different
    places = [(original, leaf) for original in whole for leaf in original.text.leaves] * rounds
    if sample is not None:
        places = random.Random(seed).sample(places, sample)
    for number, (original, leaf) in enumerate(places):
        change = changes(original, leaf, random.Random(f"{seed} {number}"))
        if change is None:
            tally.seen["has no other value"] += 1
            continue
        name = verdict(original, change)
        tally.seen[name] += 1
        if name == "noticed by blocks":
            tally.model_only[f"{original.drive.prefix} {leaf.kind}"] += 1
        if (name.startswith("noticed") and not name.endswith("blocks")) or name.endswith("nothing"):
            tally.survived.append((original.drive.prefix, dotted(leaf.path), f"{change.said}: {name}"))
    tally.seconds = time.perf_counter() - start
    return tally


def dotted(path: tuple[str | int, ...]) -> str:
    """Keys and indices from the root of a map to a fact, as `survivors.yaml` writes them."""
    return ".".join(map(str, path))


def explained() -> dict[tuple[str, str], str]:
    """Why changes of a fact may survive, by drive and fact."""
    rows = yaml.safe_load(SURVIVORS.read_text(encoding="utf-8"))
    return {(row["drive"], row["fact"]): row["why"] for row in rows}


def unexplained(tally: Tally) -> list[str]:
    """Survivors without an explanation."""
    known = explained()
    return [said for drive, fact, said in tally.survived if (drive, fact) not in known]


def report(tally: Tally) -> str:
    """What a run found."""
    total = tally.seen.total()
    lines = [f"{total} changes in {tally.seconds:.0f} s"]
    lines += [f"  {number:5} {name}" for name, number in tally.seen.most_common()]
    lines += ["noticed by the reference of the map as it was alone, so held by no typed fact:"]
    lines += [f"  {number:5} {kind}" for kind, number in tally.model_only.most_common()]
    why = explained()
    lines += ["survived:"]
    lines += [f"  {said}\n        {why.get((drive, fact), 'NOT EXPLAINED')}" for drive, fact, said in tally.survived]
    return "\n".join(lines)


def main(arguments: Sequence[str] | None = None) -> int:
    """Run over all facts. Exit status 1 when a change survives without an explanation."""
    parser = argparse.ArgumentParser(description="Change every fact of the shipped maps and see that it is noticed.")
    parser.add_argument("--rounds", type=int, default=1, help="changes per fact")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--sample", type=int, help="this many changes at random instead of all")
    given = parser.parse_args(arguments)
    tally = run(given.rounds, given.seed, given.sample)
    print(report(tally))
    return int(bool(unexplained(tally)))


if __name__ == "__main__":
    sys.exit(main())
