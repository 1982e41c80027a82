"""Starts and running time in Diagnosis: by the status of the drive, and anew at a restart."""

import pytest
from tests.drives.bench import Bench
from tests.drives.station import FAMILIES, MADE_UP

SLOW_MS = 100
"""Time between two scans where minutes must pass: they are counted from what is measured, however long a scan is."""


def counts(bench: Bench) -> tuple[float, float]:
    """Starts, and whole minutes of running."""
    return bench.number("Diagnosis.Starts"), bench.number("Diagnosis.RunMinutes")


class Clock:
    """How long the drive has shown that it runs."""

    def __init__(self, bench: Bench) -> None:
        """Look at every scan."""
        self.ms = 0
        bench.watch.append(self.look)

    def look(self, bench: Bench) -> None:
        """One scan more."""
        self.ms += bench.ms * bench.shows("Running")


@pytest.mark.parametrize("kind", [*FAMILIES, *MADE_UP])
def test_starts_and_running_time_are_counted_and_begin_anew_at_a_restart(kind: str) -> None:
    bench = Bench(kind, ms=SLOW_MS).line(MaxScanMs=SLOW_MS).stopped()
    clock = Clock(bench)
    assert counts(bench) == (0, 0)
    bench.running()
    assert counts(bench) == (1, 0)
    bench.wait(125_000)
    assert counts(bench) == (1, 2)
    bench.put(RunForward=False).stopped().wait(70_000)
    assert counts(bench) == (1, clock.ms // 60_000), "at standstill nothing is counted"
    bench.running().wait(235_000 - clock.ms)
    while clock.ms < 239_900:
        bench.scan()
    assert counts(bench) == (2, 3), "both runs together"
    bench.run(200)
    assert counts(bench) == (2, 4)
    bench.restart().run(20)
    assert counts(bench) == (0, 0)
    bench.run(500)
    assert counts(bench)[0] == 0, "a motor that runs when it is first seen was started before"


def test_starts_at_the_keypad_count_too() -> None:
    bench = Bench("CHF").put(MonitorOnly=True)
    bench.run(1500)
    for number in (1, 2, 3):
        bench.drives[0].keypad_run(20.0)
        bench.until(lambda: bench.shows("Running"))
        bench.run(4000)
        bench.drives[0].keypad_stop()
        bench.run(9000)
        assert counts(bench)[0] == number


def test_a_start_that_is_not_followed_is_none() -> None:
    bench = Bench("CHF").stopped()
    bench.drives[0].inhibit(on=True)
    bench.put(RunForward=True).run(9000)
    assert bench.shows("Running") is False
    assert counts(bench) == (0, 0)


def test_a_silence_is_no_start_and_no_running_time() -> None:
    bench = Bench("CHF").put(MonitorOnly=True, StaleMs=300)
    bench.run(1500)
    bench.drives[0].keypad_run(20.0)
    clock = Clock(bench)
    for _ in range(40):
        bench.until(lambda: bench.shows("Running"))
        bench.run(1000)
        bench.drives[0].unit = 9
        bench.until(lambda: not bench.shows("CommOk"))
        bench.run(200)
        bench.drives[0].unit = 1
    assert counts(bench) == (1, clock.ms // 60_000) == (1, 0)
