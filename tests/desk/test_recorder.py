"""What keeps a run: never waited for by a scan, however slow its file is; what is lost is counted and told."""

import os
import threading
from collections.abc import Iterator
from pathlib import Path

import pytest

from driveblocks.desk import recorder
from driveblocks.desk.recorder import MOST_WAITING, Recorder, Row
from driveblocks.desk.run.departure import Departure

NET = 600
"""Seconds that no machine needs, for what would hang."""


class Slow:
    """A file that takes one row, and no more until it is released."""

    def __init__(self) -> None:
        self.took, self.released = threading.Event(), threading.Event()
        self.rows: list[Row] = []

    def keep(self, rows: Iterator[Row]) -> None:
        """Keep rows."""
        for row in rows:
            self.rows.append(row)
            self.took.set()
            assert self.released.wait(NET)


@pytest.fixture
def slow() -> Iterator[Slow]:
    """In the end it is released."""
    made = Slow()
    yield made
    made.released.set()


def test_a_file_that_takes_nothing_keeps_no_scan_waiting_and_what_is_lost_is_counted(slow: Slow) -> None:
    made = Recorder("run.csv", slow.keep)
    made.add(0, {})
    assert slow.took.wait(NET)
    for at in range(MOST_WAITING):
        made.add(at, {})
    assert made.news() == ""
    made.add(0, {})
    made.add(0, {})
    assert made.news() == "run.csv: rows are dropped, since nobody takes them"
    assert made.news() == ""
    assert made.finish(0.01) == f"run.csv is not whole, since nobody takes it: {MOST_WAITING + 2} rows dropped"
    slow.released.set()
    assert made.finish(NET) == "run.csv: 2 rows dropped"
    assert len(slow.rows) == MOST_WAITING + 1
    assert not made.failed


def test_a_scan_whose_time_is_reckoned_waits_for_its_file(slow: Slow) -> None:
    slow.released.set()
    made = Recorder("run.csv", slow.keep, waits=True)
    for at in range(3 * MOST_WAITING):
        made.add(at, {})
    assert made.finish(NET) == ""
    assert [at for at, _ in slow.rows] == list(range(3 * MOST_WAITING))


def test_a_file_that_cannot_be_written_is_reported_and_keeps_no_scan_waiting() -> None:
    def keep(_: Iterator[Row]) -> None:
        raise OSError(28, "No space left on device")

    made = Recorder("run.csv", keep, waits=True)
    for at in range(2 * MOST_WAITING):
        made.add(at, {})
    wrong = "run.csv cannot be written: No space left on device"
    assert made.finish(NET) == wrong
    assert (made.news(), made.failed) == (wrong, True)


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no named pipes here")
def test_a_trace_into_a_pipe_that_nobody_opens_or_reads_keeps_no_scan_waiting(tmp_path: Path) -> None:
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    made = recorder.trace(pipe, ("Elapsed",), "SIMULATED", waits=False)
    for at in range(8000):
        made.add(10_000 * at, {"Elapsed": 10})
    assert "is not whole, since nobody takes it: 8000 rows dropped" in made.finish(0.01)
    with pipe.open("rb") as reader:
        assert reader.read().startswith(b"# SIMULATED\nms,Elapsed\n0,10\n")
    assert "3000 rows dropped" in made.finish(NET)


# ------------------------------------------------------------ the way out


class Left:
    """A process that would have ended."""

    def __init__(self) -> None:
        self.over = threading.Event()
        self.status: int | None = None

    def __call__(self, status: int) -> None:
        self.status = status
        self.over.set()


@pytest.fixture
def left(monkeypatch: pytest.MonkeyPatch) -> Left:
    """Stands for the end of this process."""
    made = Left()
    monkeypatch.setattr(os, "_exit", made)
    return made


@pytest.mark.parametrize("printed", [True, False])
def test_what_is_stuck_does_not_keep_the_process_and_the_verdict_is_printed(
    printed: bool, left: Left, capfd: pytest.CaptureFixture[str]
) -> None:
    way = Departure(0.01, aside_s=NET)
    way.printed = printed
    way.begin(1, "NOT CONFIRMED: Motor\n")
    assert left.over.wait(NET)
    assert left.status == 1
    assert capfd.readouterr().err == ("" if printed else "NOT CONFIRMED: Motor\n")


def test_a_process_that_ends_by_itself_is_left_alone(left: Left) -> None:
    way = Departure(NET)
    way.begin(1, "")
    way.done.set()
    for thread in threading.enumerate():
        if "_bound" in thread.name:
            thread.join(NET)
    assert left.status is None
