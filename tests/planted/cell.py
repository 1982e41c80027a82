"""`python -m tests.planted.cell CELL RULE...`: exit status 1 if one of the rules breaks in a cell, by six seeds.

An engine that ends a scan counts as a broken rule; whatever else goes wrong gives status 2.
"""

import sys

from tests.planted.verdict import ended
from tests.second.matrix import named, run
from tests.second.station import built

from structured_text.engines.embedded.engine import EmbeddedEngine

SEEDS = 6


def found() -> bool:
    """Whether a rule breaks."""
    stations = built(EmbeddedEngine())
    return any(set(run(named(sys.argv[1]), seed, stations).rules) & set(sys.argv[2:]) for seed in range(SEEDS))


if __name__ == "__main__":
    sys.exit(ended(found))
