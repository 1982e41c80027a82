"""The blocks of the corpus give the same on all engines, and no scan of them fails."""

from itertools import islice

import pytest
from tests.structured_text.engines.compare.cases import Case, load_cases
from tests.structured_text.engines.compare.lockstep import Run, lockstep
from tests.structured_text.engines.compare.traces import checksums, read

from structured_text.engines.embedded import EmbeddedEngine
from structured_text.engines.engine import Engine
from structured_text.language.lint import lint_sources

CASES = load_cases()
SEED = 7

# What a block of the corpus is about, although the linter keeps the library out of it.
ON_PURPOSE = {"strings": {"string-function"}, "real_maths": {"real-to-int"}, "conversions": {"real-to-int"}}


@pytest.fixture(params=CASES, name="case")
def _case(request: pytest.FixtureRequest) -> Case:
    return CASES[request.param]


def test_the_corpus_is_canonical_text(case: Case) -> None:
    """The linter has nothing to say but about what a block is there to show."""
    found = lint_sources([(source.path, source.text) for source in case.sources])
    assert [str(each) for each in found if each.rule not in ON_PURPOSE.get(case.name, ())] == []
    assert {each.rule for each in found} == ON_PURPOSE.get(case.name, set())


def test_matiec_gives_the_same_state_after_every_scan(case: Case, matiec: Engine) -> None:
    """Every variable of the instance and of all inside it, but the copies of in-outs that only matiec keeps."""
    runs = [Run(EmbeddedEngine(), case), Run(matiec, case)]
    difference = lockstep(case, runs, case.scans, SEED, but=case.handed_on)
    assert difference is None, str(difference)


def test_every_engine_does_what_matiec_was_recorded_to_do(case: Case, engine: Engine) -> None:
    """So a machine without matiec is tested against it; a newer matiec may differ: look at it, then record again."""
    found, recorded = checksums(case, engine), read()[case.name]
    assert len(recorded) == case.trace
    assert [at for at in range(case.trace) if found[at] != recorded[at]][:1] == [], "the first scan that differs"


def test_the_inputs_reach_every_line(case: Case) -> None:
    """What never ran was never compared; no intermediate result leaves its type, or a scan would fail."""
    engine = EmbeddedEngine(coverage=True)
    library = engine.build(case.sources)
    run = Run(engine, case, library=library)
    for stimulus in islice(case.stimuli(SEED), case.scans):
        run.scan(stimulus)
    missed = {path: [line for line, hits in lines.items() if not hits] for path, lines in library.coverage().items()}
    assert not any(missed.values()), missed
