"""Random walks over events on lines of second models, with the judge of the matrix.

`python -m tests.second.walk SEED` walks a seed again; with the name of a family after it, one of that family.
"""

import sys
from dataclasses import replace
from random import Random

from tests.second.company import COMPANY
from tests.second.events import AIMED, EVENTS, LONG
from tests.second.matrix import Outcome, Run, cells
from tests.second.pf4 import VARIANTS
from tests.second.station import MIXED

from structured_text.engines.engine import Library

STEPS, SLOW_PORT = 5, 6


class Walk(Run):
    """A cell whose first two events are followed by others; every eighth at a slow port."""

    def reach(self) -> None:
        """As there, whatever the port."""
        if self.seed % 8 == SLOW_PORT:
            self.bench.slow_port(on=True)
        super().reach()

    def go(self) -> Outcome:
        """As there; all events are in the message."""
        out = super().go()
        out.told = [f"{each} ({', then '.join(self.events)})" for each in out.told]
        return out

    def happen(self) -> None:
        """Events on each other's heels, with a start between."""
        super().happen()
        b, names = self.bench, [*(each for each in EVENTS if each not in LONG), *COMPANY, *COMPANY]
        for _ in range(STEPS):
            name = self.chance.choice(names)
            self.events.append(name)
            self.judge.kept = set()
            self.stop()
            b.run(self.chance.choice([100, 1000, 4000]))
            self.start()
            b.run(self.chance.choice([40, 1000, 4000]))
            event = (EVENTS | COMPANY)[name]
            event.begins(b, self.chance)
            b.run(event.lasts)
            event.ends(b, self.chance)
            b.run(self.chance.choice([0, 100, 2000]))


def walk(seed: int, stations: Library | None = None, family: str = "") -> Outcome:
    """Walk a seed; with a family that of its own, which is none of those without."""
    chance = Random(f"second {seed}")
    cell = chance.choice([each for each in cells() if each.event not in (*LONG, *AIMED) and each.family in MIXED])
    if cell.family == "PF4":
        cell = replace(cell, family=("PF4", *VARIANTS)[seed % 5])
    if family:
        cell = replace(cell, family=family, mode="full control" if cell.mode == "jog" else cell.mode)
    return Walk(cell, seed, stations).go()


if __name__ == "__main__":
    outcome = walk(int(sys.argv[1]), family="".join(sys.argv[2:]))
    print(outcome.cell)
    print("\n".join(outcome.told) or outcome.not_reached or "every rule has held")
