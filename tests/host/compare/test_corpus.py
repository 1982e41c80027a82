"""The blocks of the corpus give the same on all engines, and the same whatever becomes of an overflow."""

from itertools import islice

import pytest
from tests.host.compare.cases import Case, load_cases
from tests.host.compare.lockstep import Run, lockstep
from tests.host.compare.models import MODELS, double

from driveblocks.host.embedded import EmbeddedEngine
from driveblocks.host.engine import Engine

CASES = load_cases()
SEED = 7


@pytest.fixture(params=CASES, name="case")
def _case(request: pytest.FixtureRequest) -> Case:
    return CASES[request.param]


def test_canonical_text_means_the_same_in_every_model(case: Case) -> None:
    """No intermediate result leaves its type: `fail` never fails, and C's promotion changes nothing."""
    runs = [Run(EmbeddedEngine(model=model), case, model) for model in MODELS]
    difference = lockstep(case, runs, case.scans, SEED, but=case.handed_on)
    assert difference is None, str(difference)


def test_matiec_gives_the_same_state_after_every_scan(case: Case, matiec: Engine) -> None:
    """Every variable of the instance and of all inside it."""
    runs = [Run(double(matiec), case), Run(matiec, case)]
    difference = lockstep(case, runs, case.scans, SEED)
    assert difference is None, str(difference)


def test_the_inputs_reach_every_line(case: Case) -> None:
    """What never ran was never compared."""
    engine = EmbeddedEngine(coverage=True)
    library = engine.build(case.sources)
    run = Run(engine, case, library=library)
    for stimulus in islice(case.stimuli(SEED), case.scans):
        run.scan(stimulus)
    missed = {path: [line for line, hits in lines.items() if not hits] for path, lines in library.coverage().items()}
    assert not any(missed.values()), missed
