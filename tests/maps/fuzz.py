"""Change good maps at random and see that the loader never fails, and notices what it can notice.

`python tests/maps/fuzz.py [--count N] [--seed N] [--only N]`: exit status 1 when the loader raised anything but a
MapError, or took a map for good in which a pinned fact was changed. A mutation is made from the seed and its own number
alone; `--only` repeats one and prints what it did. Without `--seed` a seed is drawn, and printed.
"""

import argparse
import random
import sys
import tempfile
import traceback
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT))

from tests.maps import mutate, pins  # noqa: E402

from driveblocks.maps import load, nodes  # noqa: E402
from driveblocks.maps.problem import MapError, Report  # noqa: E402

FACTS = 0.6
"""Share of the mutations that change one fact; the others change bytes or lines."""


@dataclass
class Tally:
    """What became of the mutations."""

    tried: Counter[str] = field(default_factory=Counter)
    survived: Counter[str] = field(default_factory=Counter)
    pinned: Counter[str] = field(default_factory=Counter)
    failures: list[str] = field(default_factory=list)


EXAMPLE = ROOT / "tests/maps/example.yaml"


def text(path: Path) -> mutate.Text:
    """A map with the places of its facts."""
    return mutate.Text(path.name, path.read_text(encoding="utf-8"))


@cache
def maps() -> list[mutate.Text]:
    """The good maps: the example, and those vendor maps and other drives of the tests that load and are whole."""
    folders = (ROOT / "vendor_maps", ROOT / "tests/blocks/fourth_drive")
    paths = [EXAMPLE, *(path for folder in folders for path in sorted(folder.glob("*.yaml")))]
    return [text(path) for path in paths if _loads(path) and not load.load(path).base]


def _loads(path: Path) -> bool:
    try:
        load.load(path)
    except MapError:
        return False
    return True


def fuzz(texts: Sequence[mutate.Text], seed: int, numbers: Sequence[int]) -> Tally:
    """Try the mutations with these numbers; small maps more often than large ones."""
    tally = Tally()
    weights = [1 / len(text.text) for text in texts]
    documents = {text.name: pins.Document(mutate.plain(text.root)) for text in texts}
    with tempfile.TemporaryDirectory() as folder:
        for number in numbers:
            rng = random.Random(f"{seed}:{number}")
            text = rng.choices(texts, weights)[0]
            change = (mutate.change_a_fact if rng.random() < FACTS else mutate.change_bytes)(text, rng)
            path = Path(folder) / text.name
            path.write_bytes(change.data)
            for wrong in _judge(text, documents[text.name], change, path, tally):
                tally.failures.append(f"mutation {number} of seed {seed}: {change.said}\n  {wrong}")
    return tally


def _judge(
    text: mutate.Text, document: pins.Document, change: mutate.Change, path: Path, tally: Tally
) -> Iterator[str]:
    """Load a mutated map and count it; yield what the loader did wrong."""
    tally.tried[change.kind] += 1
    try:
        passed = _loads(path)
    except Exception:
        yield traceback.format_exc()
        return
    facts = [(change.path, change.new)] if change.path else list(_facts(text, change)) if passed else []
    held = [pins.kind_of(fact) for fact, new in facts if pins.pinned(document, fact, new)]
    tally.pinned[change.kind] += bool(held)
    if passed:
        tally.survived[change.kind] += 1
        if held:
            yield f"the map passes, though a relation pins {', '.join(held)}"


def _facts(text: mutate.Text, change: mutate.Change) -> Iterator[tuple[pins.Path, str]]:
    """The facts that a change of bytes changed, where the map kept its entries: their paths and new values."""
    root = nodes.parse(change.data.decode("utf-8-sig"), Report(text.name))
    old, new = mutate.plain(text.root), mutate.plain(root) if root is not None else None
    if _skeleton(old) == _skeleton(new) and _unordered(old) != _unordered(new):
        for leaf in text.leaves:
            value = pins.Document(new).at(leaf.path)
            if mutate.meaning(leaf, value) != mutate.meaning(leaf, leaf.scalar.text):
                yield leaf.path, value


def _skeleton(value: pins.Plain) -> object:
    if isinstance(value, dict):
        return {key: _skeleton(inner) for key, inner in value.items()}
    return [_skeleton(inner) for inner in value] if isinstance(value, list) else None


def _unordered(value: pins.Plain) -> str:
    """A document whose lists of entries are sorted: rows that change places change no fact."""
    if isinstance(value, dict):
        return str({key: _unordered(inner) for key, inner in sorted(value.items())})
    if isinstance(value, list) and value and isinstance(value[0], dict):
        return str(sorted(_unordered(inner) for inner in value))
    return str(value)


def report(tally: Tally) -> Iterator[str]:
    """What survived by kind, with the number of tries; a kind without survivors is only counted."""
    yield f"{sum(tally.tried.values())} mutations, {sum(tally.survived.values())} passed"
    yield f"{sum(tally.pinned.values())} changed a pinned fact; {len(tally.failures)} failures"
    silent = [kind for kind in tally.tried if not tally.survived[kind]]
    yield f"no survivor in {len(silent)} of {len(tally.tried)} kinds; survivors, none of them pinned:"
    for kind, count in sorted(tally.survived.items(), key=lambda item: (-item[1], item[0])):
        if count:
            yield f"  {count:5} of {tally.tried[kind]:5}  {kind}"
    yield from tally.failures


def main() -> int:
    """Run from the command line; the exit status is 1 when the loader failed."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=10_000, help="how many mutations (10000)")
    parser.add_argument("--seed", type=int, default=random.randrange(10**9), help="the seed (at random)")
    parser.add_argument("--only", type=int, help="repeat the mutation of this number alone")
    wanted = parser.parse_args()
    numbers = range(wanted.count) if wanted.only is None else [wanted.only]
    print(f"seed {wanted.seed}", flush=True)
    tally = fuzz(maps(), wanted.seed, numbers)
    for line in report(tally):
        print(line)
    return 1 if tally.failures else 0


if __name__ == "__main__":
    sys.exit(main())
