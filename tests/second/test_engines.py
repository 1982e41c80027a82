"""Three drive blocks and their line on every engine: after each compared scan the whole state is the same."""

from tests.blocks.compare.comparison import beside
from tests.line.twins import TwinLibrary
from tests.second.matrix import named, row_of, run
from tests.second.station import built, types_of

from structured_text.engines.engine import Engine

CELL, SEED, EVERY = named("CHF, full control, a trip, at speed"), 0, 20


def test_matiec_and_the_embedded_engine(matiec: Engine) -> None:
    row = row_of(CELL, SEED)
    types = types_of(CELL.family, row["size"], ascii_=row["ascii"])
    engines = TwinLibrary([built(engine, [types]) for engine in beside(matiec).values()], EVERY)
    assert not run(CELL, SEED, engines).rules
