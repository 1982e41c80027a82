"""Plants drawn at random, judged one by one: `python -m tests.plant.long --first 0 --count 200`."""

import argparse
import sys
import tempfile
from pathlib import Path

from tests.plant.draw import draw

from driveblocks.maps.problem import Refused
from driveblocks.plant.check import judged


def main() -> int:
    """Print each plant that is not good, and how many are; the exit status is 1 if any is not."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--first", type=int, default=0, help="the first seed")
    parser.add_argument("--count", type=int, default=200, help="how many")
    words, bad = parser.parse_args(), 0
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "plant.yaml"
        for seed in range(words.first, words.first + words.count):
            path.write_text(draw(seed), encoding="utf-8")
            try:
                judged(path)
            except Refused as refused:
                bad += 1
                print(f"seed {seed}: {refused}", flush=True)
    print(f"{words.count - bad} of {words.count} plants are good")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
