"""The virtual line in C, in short: random lines of every kind, and the place of each planted mistake."""

import pytest
from tests.line.cline import WHY_NOT, CLine, build, texts
from tests.line.planted import PLANTED, Planted

NEEDS = pytest.mark.skipif(bool(WHY_NOT), reason=WHY_NOT)


@pytest.fixture(scope="module")
def line(tmp_path_factory: pytest.TempPathFactory) -> CLine:
    return build(tmp_path_factory.mktemp("line"))


@NEEDS
@pytest.mark.parametrize("kind", ["timing", "stops", "task", "late", "broken", "faults"])
def test_random_lines(line: CLine, kind: str) -> None:
    """A failure names its seed; `python -m tests.line.cline random SEED 1 KIND` runs that line again."""
    assert line.random(0, 1000, kind).failures == ()


@NEEDS
def test_seven_drives(line: CLine) -> None:
    """ABB's library: 450 ms. Judged in virtual time."""
    assert line.run("run")["refresh_ms"] <= 150
    assert line.run("run", keeps=0)["refresh_ms"] <= 215


@NEEDS
def test_the_silence_of_a_drive_within_a_millisecond_of_the_ports_own(line: CLine) -> None:
    """3.5 characters of 4800 8N1 are 7.3 ms, rounded up 8 ms."""
    assert line.run("run", rate=4800, silence_ms=8)["short_silences"] == 0


@NEEDS
def test_the_silence_of_a_drive_behind_a_request_that_nobody_answers(line: CLine) -> None:
    """At 38400 bit/s a short scan sees the timeout before 17 ms have passed since the request itself."""
    pins = {"rate": 38400, "scan": 1000, "jitter": 500, "max_scan": 2, "turn_low": 0, "stop_every": 260}
    assert line.run("run", silence_ms=17, keeps=0, loss=36_000, **pins)["short_silences"] == 0


@NEEDS
def test_sizes(line: CLine) -> None:
    sizes = line.run("cost")
    assert sizes["slot_bytes"] <= 224
    assert sizes["line_bytes"] <= 8 * 200 + 1200


@NEEDS
def test_an_unknown_key_is_refused(line: CLine) -> None:
    with pytest.raises(ValueError, match="unknown: speed=1"):
        line.run("run", speed=1)


@pytest.mark.parametrize("planted", PLANTED, ids=lambda planted: planted.name)
def test_planted_mistakes_have_their_place(planted: Planted) -> None:
    """So that the long form, which builds each of them, does not look for what is no longer there."""
    assert "\n".join(texts()).count(planted.old) == 1
