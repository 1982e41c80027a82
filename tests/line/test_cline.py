"""The virtual line in C, in short: random lines of every kind."""

import pytest
from tests.line.cline import WHY_NOT, CLine, build
from tests.line.refresh import SLACK, Setup

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
def test_the_silence_of_a_drive_after_a_request_that_nobody_answers(line: CLine) -> None:
    """At 38400 bit/s a short scan sees the timeout before 17 ms have passed since the request itself."""
    pins = {"rate": 38400, "scan": 1000, "jitter": 500, "max_scan": 2, "turn_low": 0, "stop_every": 260}
    assert line.run("run", silence_ms=17, keeps=0, loss=36_000, **pins)["short_silences"] == 0


@NEEDS
def test_the_silence_of_a_drive_at_an_adapter_in_its_own_rhythm(line: CLine) -> None:
    """What it keeps a request back for is no silence after that request."""
    pins = {
        "drives": 5,
        "rate": 57600,
        "scan": 40_000,
        "jitter": 20_000,
        "max_scan": 61,
        "turn_low": 0,
        "stop_every": 50,
    }
    ran = line.run("run", silence_ms=60, keeps=0, task=20_000, whole=1, loss=47_000, ms=200_000, **pins)
    assert ran["short_silences"] == 0


def test_the_formula_of_a_round() -> None:
    """By hand, 19200 8N1, 6 words, 10 ms: 13.0 + 5 ms of wire and 1.8 ms of silence; 9600 8E1: 33.6 and 4.01 ms."""
    assert [Setup(keeps=keeps).formula() for keeps in (True, False)] == [7 * 20, 7 * 30]
    slow = Setup(rate=9600, bits=11, scan=5, received=2, keeps=False)
    assert (slow.formula(), slow.formula(whole=True), slow.coarse) == (7 * 50, 7 * 55, True)
    assert round(Setup().limit) == 139


@NEEDS
@pytest.mark.parametrize("late", [{"sent": 2}, {"received": 2}])
@pytest.mark.parametrize("keeps", [False, True])
def test_a_late_adapter_costs_its_scans_and_no_more(line: CLine, late: dict[str, int], keeps: bool) -> None:
    each = Setup(keeps=keeps, **late)
    assert each.run(lambda _: line) <= SLACK * each.formula()


@NEEDS
def test_sizes(line: CLine) -> None:
    sizes = line.run("cost")
    assert sizes["slot_bytes"] <= 260
    assert sizes["line_bytes"] <= 8 * 340 + 4064
    track = 80  # bytes of MB_Track; a line of 32 slots is not compiled for this
    assert sizes["line_bytes"] + 24 * (sizes["slot_bytes"] + track) <= 32 * 340 + 4064
