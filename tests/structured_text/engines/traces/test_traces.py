"""The embedded engine replays what matiec was recorded to do: a machine without matiec still tests against it."""

import math

import pytest
from tests.structured_text.engines.compare.cases import Case, load_cases
from tests.structured_text.engines.compare.lockstep import ABSENT, State, alike, states
from tests.structured_text.engines.traces.trace import SEED, path_of, read

from structured_text.engines.embedded import EmbeddedEngine
from structured_text.engines.engine import Engine, Value

CASES = load_cases()
# Two steps of a single-precision number: what one library may round differently from another.
TOLERANCE = 2.5e-7


@pytest.fixture(params=CASES, name="case")
def _case(request: pytest.FixtureRequest) -> Case:
    return CASES[request.param]


def test_the_embedded_engine_replays_the_trace(case: Case) -> None:
    """Every variable after every scan, but the copies of in-outs that only matiec keeps."""
    but = case.handed_on
    trace = read(path_of(case.name))
    replayed = states(case, EmbeddedEngine(), len(trace.states), trace.seed)
    for number, (state, recorded) in enumerate(zip(replayed, trace.states, strict=True)):
        unlike = _unlike(case, state, recorded)
        assert {path: both for path, both in unlike.items() if not (but and path.startswith(but))} == {}, number


def test_matiec_still_does_what_was_recorded(case: Case, matiec: Engine) -> None:
    """A newer matiec, or another C compiler: if this fails, look at the difference, then record again."""
    trace = read(path_of(case.name))
    replayed = states(case, matiec, len(trace.states), trace.seed)
    for number, (state, recorded) in enumerate(zip(replayed, trace.states, strict=True)):
        assert _unlike(case, state, recorded) == {}, number


def _unlike(case: Case, state: State, recorded: State) -> dict[str, tuple[Value, Value]]:
    paths = {**recorded, **state}
    both = {path: (state.get(path, ABSENT), recorded.get(path, ABSENT)) for path in paths}
    return {path: pair for path, pair in both.items() if not _same(path in case.library, *pair)}


def _same(from_library: bool, found: Value, recorded: Value) -> bool:
    if from_library and isinstance(found, float) and isinstance(recorded, float):
        return math.isclose(found, recorded, rel_tol=TOLERANCE)
    return alike(found, recorded)


def test_every_case_has_its_trace_and_no_other(case: Case) -> None:
    """The record has as many scans as the corpus asks for, from both lines."""
    trace = read(path_of(case.name))
    assert (trace.case, trace.seed, len(trace.states)) == (case.name, SEED, case.trace)
    assert trace.engines == ("matiec-beremiz", "matiec-openplc")
