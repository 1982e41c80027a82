"""`python -m tests.planted.cell CELL RULE...`: exit status 1 if one of the rules breaks in a cell, by six seeds."""

import sys

from tests.second.matrix import named, run
from tests.second.station import built

from structured_text.engines.embedded.engine import EmbeddedEngine

SEEDS = 6

if __name__ == "__main__":
    stations = built(EmbeddedEngine())
    found = (set(run(named(sys.argv[1]), seed, stations).rules) & set(sys.argv[2:]) for seed in range(SEEDS))
    sys.exit(int(any(found)))
