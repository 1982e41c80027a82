"""Several engines through the same scans, the full state of each compared after every one."""

import struct
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import islice
from math import isnan

from tests.structured_text.engines.compare.cases import Case, Stimulus
from tests.structured_text.engines.compare.scenarios import Inputs

from structured_text.engines.engine import Engine, Library, ScanError, Value

State = dict[str, Value]
ABSENT = b"(no such variable)"


@dataclass(frozen=True)
class Difference:
    """The first thing in which engines disagree; `values` by engine; `scan` counts from 0."""

    case: str
    scan: int
    path: str
    values: Mapping[str, object]
    inputs: Inputs
    clock: int

    def __str__(self) -> str:
        """Print what is needed to run the scan again."""
        values = ", ".join(f"{engine}: {value!r}" for engine, value in self.values.items())
        return f"{self.case}, scan {self.scan}, {self.path}: {values}\n  clock {self.clock}, inputs {self.inputs}"


class Run:
    """One engine with one case, built and started; `name` says which engine in a difference."""

    def __init__(self, engine: Engine, case: Case, name: str = "", library: Library | None = None) -> None:
        """Build the case, or start it from a library that was built from it. Raises BuildError, EngineError."""
        library = library or engine.build(case.sources)
        self.name = name or engine.name
        self.subject = library.instance(case.block)

    def scan(self, stimulus: Stimulus) -> State:
        """Set the inputs, scan once, give back the full state. Raises ScanError."""
        for path, value in stimulus.inputs.items():
            self.subject[path] = value
        self.subject.scan(stimulus.clock)
        return self.subject.state()


def alike(left: Value, right: Value) -> bool:
    """Whether two values are the same to the bit; every NaN is like every other, a BOOL is no number."""
    if type(left) is not type(right):
        return False
    if isinstance(left, float) and isinstance(right, float):
        return (isnan(left) and isnan(right)) or struct.pack("<d", left) == struct.pack("<d", right)
    return left == right


def first_unlike(left: State, right: State) -> str | None:
    """The first path whose values are not alike, in the order of `left`; None if all are."""
    for path, value in left.items():
        if path not in right or not alike(value, right[path]):
            return path
    return next((path for path in right if path not in left), None)


def lockstep(case: Case, runs: Sequence[Run], scans: int, seed: int, but: tuple[str, ...] = ()) -> Difference | None:
    """Drive the runs through this many scans; the first difference from the first run, or None.

    Paths that begin with one of `but` are not compared.
    """
    for number, stimulus in enumerate(islice(case.stimuli(seed), scans)):
        difference = _compare(case, number, stimulus, [_outcome(run, stimulus, but) for run in runs], runs)
        if difference:
            return difference
    return None


def _outcome(run: Run, stimulus: Stimulus, but: tuple[str, ...]) -> State:
    try:
        state = run.scan(stimulus)
    except ScanError as error:
        return {"(error)": str(error).encode()}
    return {path: value for path, value in state.items() if not path.startswith(but)} if but else state


def _compare(
    case: Case, number: int, stimulus: Stimulus, states: Sequence[State], runs: Sequence[Run]
) -> Difference | None:
    for state in states[1:]:
        path = first_unlike(states[0], state)
        if path is not None:
            values = {run.name: each.get(path, ABSENT) for run, each in zip(runs, states, strict=True)}
            return Difference(case.name, number, path, values, stimulus.inputs, stimulus.clock)
    return None
