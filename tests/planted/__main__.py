"""Plant mistakes in a copy of the checkout, one at a time, and see that a judge turns red.

    python -m tests.planted [ID...] [--kind KIND]
    python -m tests.planted draw --seed N [--count M] [--kind python|template|map]
    python -m tests.planted judge --seed N [--count M] [--kind ...] --judge "COMMAND"

Exit status 1 if one is not found. What `survivors.yaml` has a reason for is printed with it, and does not count.
"""

import argparse
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

import yaml
from tests.planted.checkout import ROOT, Checkout
from tests.planted.draw import KINDS, Change, drawn
from tests.planted.table import FOUND, MISSED, judged, places, verdict_of


def survivors() -> dict[str, str]:
    """Changes that nothing can tell from the text, by how their line reads, and why."""
    rows = yaml.safe_load(Path(__file__).with_name("survivors.yaml").read_text(encoding="utf-8"))
    return {row["change"].partition(": ")[2]: row["why"] for row in rows}


def _table(copy: Checkout, options: argparse.Namespace) -> Iterator[str]:
    for one in places():
        if (not options.what or one.id in options.what) and options.kind in (None, one.kind):
            verdict = judged(copy, one)
            print(f"{one.id}: {verdict}", flush=True)
            yield verdict


def _changes(options: argparse.Namespace) -> Iterator[tuple[str, Change]]:
    for kind in KINDS if options.kind is None else (options.kind,):
        for number, one in enumerate(drawn(kind, options.seed, options.count)):
            text = (ROOT / one.file).read_bytes().decode()
            yield f"{kind} {number}: {one.file}:{text.count(chr(10), 0, one.at) + 1}: {one.says(text)}", one


def _drawn(copy: Checkout, options: argparse.Namespace) -> Iterator[str]:
    for said, one in _changes(options):
        before = copy.read(one.file)
        why = survivors().get(one.says(before))
        copy.write(one.file, one.edit(before))
        if why is not None:
            verdict = f"the same: {why}"
        else:
            verdict = verdict_of(copy.run(options.judge)) if copy.build() else f"{FOUND} by the build"
        copy.write(one.file, before)
        print(f"{said}: {verdict}", flush=True)
        yield verdict


def main() -> int:
    """Judge the table, or what is drawn."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", nargs="*")
    parser.add_argument("--kind")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--count", type=int, default=10)
    parser.add_argument("--judge", default="python -m pytest -x")
    options = parser.parse_args()
    if options.what == ["draw"]:
        print("\n".join(said for said, _ in _changes(options)))
        return 0
    with tempfile.TemporaryDirectory() as folder:
        judge = _drawn if options.what == ["judge"] else _table
        verdicts = list(judge(Checkout(Path(folder) / "copy"), options))
    return int(not verdicts or any(each.startswith(MISSED) for each in verdicts))


if __name__ == "__main__":
    sys.exit(main())
