"""The programs of the shipped maps, run once: they are green, and reach every reason but for what is explained."""

from collections.abc import Callable

import pytest
from tests import shipped

from driveblocks.testing import runner
from driveblocks.testing.outcome import Run
from driveblocks.testing.scenes.reason import REASONS
from structured_text.engines.embedded import EmbeddedEngine, EmbeddedInstance, EmbeddedLibrary
from structured_text.engines.engine import Value

Seen = dict[str, set[Value]]
"""Program -> each Reason that its drive block has shown at the end of a scan."""


def noting(seen: Seen) -> Callable[[EmbeddedLibrary, str], EmbeddedInstance]:
    """How instances are made, of which every scan notes the Reason."""
    plain = EmbeddedLibrary.instance

    def instance(library: EmbeddedLibrary, name: str) -> EmbeddedInstance:
        made = plain(library, name)
        scan, reasons = made.scan, seen.setdefault(name, set())

        def noted(now_ns: int | None = None) -> None:
            scan(now_ns)
            reasons.add(made["Motor.Reason"])

        if "MOTOR.REASON" in made.state():
            made.scan = noted
        return made

    return instance


@pytest.fixture(scope="module")
def done() -> tuple[Run, Seen]:
    """The run, and what was seen in it."""
    seen: Seen = {}
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(EmbeddedLibrary, "instance", noting(seen))
        run = runner.run(shipped.units(), [EmbeddedEngine()])
    return run, seen


def test_they_are_green_on_the_embedded_engine(done: tuple[Run, Seen]) -> None:
    run, _ = done
    assert [(result.program, outcome.words, outcome.message) for result in run.results for outcome in result.bad] == []
    assert run.passed
    assert {result.unit for result in run.results} == {"modbus", *(each.path.stem for each in shipped.sources())}


@pytest.mark.parametrize("stem", [each.path.stem for each in shipped.sources()])
def test_every_reason_is_reached_or_it_is_said_why_not(done: tuple[Run, Seen], stem: str) -> None:
    suite = next(unit.suite for unit in shipped.units() if unit.suite.name == stem)
    seen = set().union(*(done[1][program.name] for program in suite.programs))
    names = {name for name, number in REASONS.items() if number in seen}
    assert names == REASONS.keys() - suite.unreached.keys()
