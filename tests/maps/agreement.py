"""libyaml and PyYAML's own parser must make the same of every text: random texts, read with libyaml and without.

`python -m tests.maps.agreement [--count N] [--seed N] [--only N]`: exit status 1 when a text got other nodes, places or
messages. A text is made from the seed and its own number alone; `--only` repeats one and prints it. Without `--seed` a
seed is drawn, and printed. What is found becomes a text of FOUND in tests/maps/test_agreement.py.
"""

import argparse
import random
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path

import pytest

from driveblocks.maps import nodes
from driveblocks.maps.nodes import Node
from driveblocks.maps.problem import MapError, Problem, Report

MAPS = (Path(__file__).parent / "example.yaml", Path(__file__).parents[1] / "blocks/fourth_drive/baumhof.yaml")
EVERYDAY = (
    "a", "b", "0", ".", "。", "€", " ", "  ", "\n", "\n ", "\n  ", "-", "- ", "\n- ", "a: ", "b: ", ":", ": ", ",",
    ", ", "[", "]", "{", "}", "#", " #", '"', "'", "|", ">", "|\n  ", ">-\n ", "|2", "---", "...", "\n---\n",
)  # fmt: skip
"""What good maps are made of; a text of these alone is often good YAML."""
SELDOM = (
    "?", "? ", "%", "!", "![", "!!", "&", "*", "@", "`", "~", "=", "<", "<<: ", "+", ";", "\\", "\\x", "\\U", "\r",
    "\r\n", "\t", "\0", "\x7f", "\x85", "\xa0", "\u2028", "\ufeff", "\ud800", "😀",
)  # fmt: skip
LINES = (
    "a:", "b: c", "- d", "- e: f", "-", "  ", "# c", "g: [h, i]", "j: {k: l, m: n}", 'o: "p', 'q"', "r: 's", "t'",
    "u: |", "v: >-", "w: |+", "x: |2-", "y z", ": aa", "bb : cc", "---", "...", "- - dd", "[ee,", "]", "{ff: gg,", "}",
    "hh,", 'kk: "l\\"m"', '"ii": jj', "'kk':ll", "- [", 'nn: [a:b, "c":d, e: f, :g]', "pp: }", "qq: !x y", "rr: &s t",
    "uu: *v", "ww: @x", "- |", "- >", "zz: 50 % # c", '"a', "{a, b: , : c}", "[a: b, c]", "- {a: b}", "--- a", "--- |",
    "... #x", "-a", "a:b", "::", "- : a", "- :",
)  # fmt: skip

Outcome = tuple[Node | None, tuple[Problem, ...]]


def outcome(text: str, *, libyaml: bool) -> Outcome:
    """What the loader makes of a text: nodes with their places, and messages."""
    report = Report("map.yaml")
    with pytest.MonkeyPatch.context() as patch:
        if not libyaml:
            patch.setattr(nodes, "_LIBYAML", None)
        try:
            root = nodes.parse(text, report)
        except MapError as error:
            return None, error.problems
    return root, tuple(report.problems)


def text(seed: int, number: int) -> str:
    """A random text: of pieces, of lines, or a damaged part of a map."""
    rng = random.Random(f"{seed}:{number}")
    return rng.choices((_pieces, _lines, _damaged), (45, 50, 5))[0](rng)


def _pieces(rng: random.Random) -> str:
    chosen = EVERYDAY + SELDOM if rng.random() < 0.3 else EVERYDAY
    return "".join(rng.choices(chosen, k=rng.randrange(1, rng.choice((4, 8, 16, 30))))) + rng.choice(("\n", "\n", ""))


def _lines(rng: random.Random) -> str:
    lines = [" " * rng.choice((0, 0, 0, 1, 2, 2, 4)) + rng.choice(LINES) for _ in range(rng.randrange(1, 9))]
    end = rng.choice(("\n", "\n", "\n", "\r\n", "\r"))
    return _with_pieces(end.join(lines) + end, rng, rng.randrange(3))


def _damaged(rng: random.Random) -> str:
    lines = rng.choice(MAPS).read_text(encoding="utf-8").split("\n")
    first = rng.randrange(len(lines))
    return _with_pieces("\n".join(lines[first : first + rng.randrange(1, 40)]) + "\n", rng, rng.randrange(1, 4))


def _with_pieces(whole: str, rng: random.Random, count: int) -> str:
    for _ in range(count):
        place = rng.randrange(len(whole) + 1)
        whole = whole[:place] + rng.choice((*EVERYDAY, *SELDOM, "")) + whole[place + rng.choice((0, 0, 1, 3)) :]
    return whole


def search(seed: int, numbers: Sequence[int]) -> Iterator[str]:
    """A line on each text that is not read alike."""
    for number in numbers:
        made = text(seed, number)
        fast, slow = outcome(made, libyaml=True), outcome(made, libyaml=False)
        if fast != slow:
            yield f"text {number} of seed {seed}: {made!r}\n  with libyaml: {fast}\n  without: {slow}"


def main(arguments: Sequence[str] | None = None) -> int:
    """Run from the command line; the exit status is 1 when a text was not read alike."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=200_000, help="how many texts (200000)")
    parser.add_argument("--seed", type=int, default=random.randrange(10**9), help="the seed (at random)")
    parser.add_argument("--only", type=int, help="repeat the text of this number alone")
    wanted = parser.parse_args(arguments)
    seed = wanted.seed
    numbers = range(wanted.count) if wanted.only is None else [wanted.only]
    print(f"seed {seed}: {len(numbers)} texts", flush=True)
    if wanted.only is not None:
        print(repr(text(seed, wanted.only)))
    failures = 0
    for line in search(seed, numbers):
        failures += 1
        print(line, flush=True)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
