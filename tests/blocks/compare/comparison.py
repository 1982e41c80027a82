"""Every engine through the same scans of one POU, the whole state of each compared after every one."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import islice

from tests.blocks.compare.pou import Pou, Text, shipped
from tests.blocks.compare.stimulus import stimuli
from tests.blocks.compare.subject import EmbeddedSubject, MatiecSubject, Subject
from tests.structured_text.engines.compare.lockstep import ABSENT, Difference, State, first_unlike
from tests.structured_text.engines.compare.scenarios import Inputs

from structured_text.engines.discovery import EMBEDDED
from structured_text.engines.embedded import EmbeddedEngine
from structured_text.engines.embedded.library import EmbeddedLibrary
from structured_text.engines.engine import Engine, Library, ScanError
from structured_text.engines.matiec.library import MatiecLibrary

AS_USERS = 64
"""Every this many scans the states are also read and compared as users read them."""

Libraries = Mapping[str, Library]


def beside(matiec: Engine) -> dict[str, Engine]:
    """A line of matiec, whose state has more in it, and the embedded engine."""
    return {matiec.name: matiec, EMBEDDED: EmbeddedEngine()}


def build(engines: Mapping[str, Engine], text: Text | None = None) -> Libraries:
    """The library, the shipped one or another, on each engine. Raises BuildError, EngineError."""
    sources = (text or shipped()).sources
    return {name: engine.build(sources) for name, engine in engines.items()}


def subjects(libraries: Libraries, pou: Pou) -> list[Subject]:
    """A fresh instance of the POU on each engine."""
    return [_subject(name, library, pou) for name, library in libraries.items()]


def _subject(name: str, library: Library, pou: Pou) -> Subject:
    if isinstance(library, EmbeddedLibrary):
        return EmbeddedSubject(library, pou, name)
    assert isinstance(library, MatiecLibrary)
    return MatiecSubject(library, pou, name)


def compare(pou: Pou, runs: Sequence[Subject], scans: int, seed: int) -> Difference | None:
    """Drive all through this many scans; the first difference from the first run, or the first ScanError, or None."""
    first, others = runs[0], runs[1:]
    for number, inputs in enumerate(islice(stimuli(pou, seed), scans)):
        errors = _step(runs, inputs)
        if errors:
            told = {run.name: errors.get(run.name, "no error") for run in runs}
            return Difference(pou.name, number, "(error)", told, inputs, 0)
        image = first.image()
        for other in others:
            theirs = other.image()
            same = image == theirs or image[: len(theirs)] == theirs
            if not (same and number % AS_USERS) and (path := _unlike(pou, first, other)) is not None:
                values = {run.name: run.state().get(path, ABSENT) for run in runs}
                return Difference(pou.name, number, path, values, inputs, 0)
    return None


def _step(runs: Sequence[Subject], inputs: Inputs) -> dict[str, str]:
    """One scan of each; the errors by engine. One that all engines agree on is as wrong: the library has none."""
    errors: dict[str, str] = {}
    for run in runs:
        try:
            run.step(inputs)
        except ScanError as error:
            errors[run.name] = str(error)
    return errors


def _unlike(pou: Pou, first: Subject, other: Subject) -> str | None:
    """The first path in which two states differ, as users read them."""
    return first_unlike(*(_kept(pou, run, first.follows_c and other.follows_c) for run in (first, other)))


def _kept(pou: Pou, run: Subject, copies: bool) -> State:
    """The state of a run, without the copies of in-outs that not both keep."""
    state = run.state()
    if copies:
        return state
    handed = tuple(each.path for each in pou.leaves if each.handed_on)
    return {path: value for path, value in state.items() if path.partition("[")[0] not in handed}
