"""What is set before each scan of a POU: first nothing, then every landmark in turn, then at random without end.

The inputs depend on the POU's text, on the maps and on the seed alone. A pin that a scan does not name stays as it was,
arrays too, so that what a block has left there meets the next scan.
"""

from __future__ import annotations

from collections.abc import Iterator

from tests.blocks.compare.pou import Pou
from tests.blocks.compare.scenario import SCENARIOS, kind_of, scenario
from tests.blocks.compare.value import Values
from tests.structured_text.engines.compare.draws import Draws
from tests.structured_text.engines.compare.scenarios import Inputs

from structured_text.language.types import Kind

SCENARIO = 0.75
LANDMARK = 0.2
HANGING_TOGETHER, ON_ITS_OWN = 1500, 200
MIDDLE, LARGE = 512, 32767
CHANGE = 0.8
CHANGE_OF_ARRAY = 0.3


def stimuli(pou: Pou, seed: int) -> Iterator[Inputs]:
    """The inputs before each scan, without end."""
    draws = Draws(pou.name, seed)
    values = Values(pou, draws, seed)
    known = [*_landmarks(pou, draws)]
    yield {}
    yield from known
    pins = [(pin.path, values.of(pin), CHANGE_OF_ARRAY if pin.length else CHANGE) for pin in pou.pins]
    special = scenario(pou, values, seed)
    while True:
        if special is not None and draws.chance(SCENARIO):
            yield next(special)
        elif special is None and known and draws.chance(LANDMARK):
            yield draws.one_of(known)
        else:
            yield {path: draw() for path, draw, change in pins if draws.chance(change)}


def enough(pou: Pou) -> int:
    """Scans that reach every line and outcome: all landmarks, then fewer or more at random as it hangs together."""
    return 1 + landmarks(pou) + (HANGING_TOGETHER if kind_of(pou) in SCENARIOS else ON_ITS_OWN)


def landmarks(pou: Pou) -> int:
    """How many scans, after the first, are no chance."""
    return sum(1 for _ in _landmarks(pou, Draws()))


def _landmarks(pou: Pou, draws: Draws) -> Iterator[Inputs]:
    """Each arm of a CASE, or each input at each literal of the text with small to large others; each BOOL alone TRUE.

    The REALs are all alike, once at each power of ten.
    """
    switches = {pin.path: False for pin in pou.of_kind(Kind.BOOL)}
    reals = pou.of_kind(Kind.REAL)
    wholes = pou.of_kind(Kind.BITS, Kind.INTEGER)
    if pou.arms:
        for arm in pou.arms:
            yield {**dict(arm)}
    elif len(wholes) <= 5:
        for pin, value in ((pin, value) for pin in wholes for value in pou.whole):
            if pin.span[0] <= value <= pin.span[1]:
                for rest in (0, 1, 2, draws.whole(0, 20), MIDDLE, LARGE):
                    yield {**{each.path: min(rest, each.span[1]) for each in wholes}, pin.path: value}
    if reals:
        for power in range(5):
            yield {each.path: 10.0**power for each in reals}
    for name in switches:
        yield {**switches, name: True}
