"""The watchdog of a run: a scan that does not end is given up, and another thread stops the drives past it."""

import threading
from collections.abc import Callable, Iterator
from typing import Any

import pytest
from tests.desk.run.desk import ONE, Desk

from driveblocks.desk.ending import Bell, Ending
from driveblocks.desk.run import gate
from driveblocks.desk.run.gate import Gate, GivenUp
from driveblocks.desk.run.session import STUCK
from driveblocks.desk.run.watchdog import FIRST_US, LIMIT_US, PATIENCE_US, Watchdog
from driveblocks.desk.script import Setting

SECOND = 1_000_000
NET = 600
"""Seconds that no machine needs, for what would hang."""
FUNCTIONS = """FUNCTION Inner : REAL
VAR_INPUT
  X : REAL;
END_VAR
  Inner := X;
  Inner := SQRT(Inner);
END_FUNCTION
FUNCTION Outer : REAL
VAR_INPUT
  X : REAL;
END_VAR
  Outer := Inner(X);
END_FUNCTION
"""
HANGS = FUNCTIONS + ONE.replace("  Divisor", "  Hang : BOOL;\n  Root : REAL;\n  Divisor", 1).replace(
    "  Quotient :=", "  IF Hang THEN\n    Root := Outer(4.0);\n  END_IF;\n  Quotient :=", 1
)
"""With Hang, its scan ends when the test lets it."""


class Time:
    """The time of a watchdog. It passes while the watchdog waits and nothing can ring its bell any more."""

    def __init__(self, passes: Callable[[], bool] = lambda: True) -> None:
        self.us = 0
        self._passes = passes

    def now_us(self) -> int:
        """The time."""
        return self.us

    def wait(self, bell: Bell, within_us: int) -> None:
        """As `heard`."""
        if self._passes():
            self.us += within_us
        else:
            bell.get(timeout=NET)


def watching(limit_us: int = LIMIT_US) -> tuple[Watchdog, Time]:
    """A watchdog, and its time."""
    time = Time()
    return Watchdog(limit_us, time.now_us, time.wait), time


# ------------------------------------------------------------ the time of a scan


@pytest.mark.parametrize(
    ("limit_us", "scans", "bites_at"), [(LIMIT_US, 0, FIRST_US), (LIMIT_US, 1, LIMIT_US), (60 * SECOND, 0, 60 * SECOND)]
)
def test_a_scan_has_its_time_and_the_first_one_longer(limit_us: int, scans: int, bites_at: int) -> None:
    dog, time = watching(limit_us)
    for _ in range(scans):
        dog.begin()
        dog.end()
    dog.begin()
    dog.watch(Ending(), lambda: False)
    assert (dog.bites, time.us) == (True, bites_at)


def test_a_scan_that_begins_meanwhile_has_its_whole_time() -> None:
    dog, time = watching()
    dog.begin()
    dog.end()
    begun: list[int] = []

    def over() -> bool:
        if time.us > 2 * SECOND and not begun:
            begun.append(time.us)
            dog.begin()
        return False

    dog.watch(Ending(), over)
    assert (dog.bites, time.us - begun[0]) == (True, LIMIT_US)


def test_nothing_is_given_up_when_the_scans_are_over() -> None:
    dog, time = watching()
    dog.begin()
    dog.watch(Ending(), lambda: time.us > 0)
    assert not dog.bites


@pytest.mark.parametrize("under_way", [False, True])
def test_who_asks_for_the_end_waits_half_a_second_for_a_scan_under_way(under_way: bool) -> None:
    dog, time = watching(60 * SECOND)
    ending = Ending()
    ending.ask("Ctrl-C")
    if under_way:
        dog.begin()
    dog.watch(ending, lambda: False)
    assert (dog.bites, time.us) == (False, PATIENCE_US if under_way else 0)


def test_a_bell_wakes_the_watchdog() -> None:
    dog, ending = Watchdog(NET * SECOND), Ending()
    watch = threading.Thread(target=dog.watch, args=(ending, lambda: False))
    watch.start()
    ending.ask("Ctrl-C")
    watch.join(NET)
    assert not watch.is_alive()


# ------------------------------------------------------------ a scan that does not end


class Hanging:
    """A program whose scan goes on and on from 5 s on, with its motor at speed since before."""

    def __init__(self, patch: pytest.MonkeyPatch) -> None:
        self.desk = Desk(HANGS)
        self.desk.session.script = [Setting("Start", True, 2 * SECOND), Setting("Hang", True, 5 * SECOND)]
        self.hangs, self.released = threading.Event(), threading.Event()
        objects = self.desk.controller._library.compiler.objects
        (name,) = [each for each in objects if each.removeprefix("std_") == "SQRT"]
        patch.setitem(objects, name, self._root)
        self.watched()

    def watched(self, limit_us: int = LIMIT_US, *, asked: bool = False) -> Time:
        """A watchdog whose time passes when the scan hangs, or, if `asked`, when the end has been asked for."""
        time = Time(lambda: bool(self.desk.ending.reason) if asked else self.hangs.is_set())
        self.desk.session.watchdog = Watchdog(limit_us, time.now_us, time.wait)
        return time

    def _root(self, _: float) -> float:
        self.hangs.set()
        self.desk.ending.bell.put(None)
        assert self.released.wait(NET)
        return 2.0

    def release(self) -> None:
        """Let the scan go on, until its thread has ended."""
        self.released.set()
        for thread in threading.enumerate():
            if "_scans" in thread.name:
                thread.join(NET)
                assert not thread.is_alive()


@pytest.fixture
def hanging(monkeypatch: pytest.MonkeyPatch) -> Iterator[Hanging]:
    """Such a program; in the end its thread is let go."""
    made = Hanging(monkeypatch)
    yield made
    made.release()


def test_a_scan_that_does_not_end_is_given_up_and_every_drive_is_stopped(hanging: Hanging) -> None:
    desk, time = hanging.desk, hanging.watched()
    result = desk.session.run()
    assert time.us == LIMIT_US
    assert desk.drives[0].mode == "standstill"
    assert (result.crashed, result.unconfirmed, result.stopped) == (True, {}, ("Motor",))
    text = HANGS.splitlines()
    inner, outer = (1 + text.index(line) for line in ("  Inner := SQRT(Inner);", "    Root := Outer(4.0);"))
    place = f"my.st:{inner}:12 in Inner, called from my.st:{outer}:13 in One"
    assert result.reason == (
        f"the program has failed: a scan has not ended within 500 ms (--watchdog): it was at {place}"
    )
    assert desk.told()[-1] == f"{result.reason}: stopping every drive; Ctrl-C again gives them up"


def test_a_scan_that_was_given_up_sends_nothing_when_it_goes_on(hanging: Hanging) -> None:
    desk = hanging.desk
    desk.session.run()
    before, scans = len(desk.line.sent), desk.session.pace.scans
    desk.controller.lines[0]._mailbox.take = lambda: b"what it wants to send"  # type: ignore[method-assign]  # the program writes, given up
    hanging.release()
    assert (len(desk.line.sent), desk.session.pace.scans) == (before, scans)
    assert desk.drives[0].mode == "standstill"


def test_a_drive_that_is_not_reached_is_named_when_its_time_to_stop_is_over(hanging: Hanging) -> None:
    desk = hanging.desk
    desk.ending.alone = True
    desk.session.steps.append(lambda at_us: setattr(desk.line, "cut", at_us >= 5 * SECOND))
    assert desk.session.run().unconfirmed == {"Motor (unit 7)": "no reply to the stop"}
    assert desk.clock.now_us() == pytest.approx((5 + 15 + 60) * SECOND, abs=2 * SECOND)  # StopWithinMs is 15000


@pytest.mark.parametrize("reason", ["Ctrl-C", "SIGTERM"])
def test_who_asks_for_the_end_does_not_wait_for_a_scan_that_does_not_end(reason: str, hanging: Hanging) -> None:
    desk, time = hanging.desk, hanging.watched(NET * SECOND, asked=True)

    def asked() -> None:
        assert hanging.hangs.wait(NET)
        desk.ending.ask(reason)

    person = threading.Thread(target=asked)
    person.start()
    result = desk.session.run()
    person.join(NET)
    assert time.us == PATIENCE_US
    assert (result.reason, result.crashed, result.stopped) == (reason, False, ("Motor",))
    assert desk.drives[0].mode == "standstill"
    assert desk.told()[-2].startswith("a scan was given up: it was at my.st:")


# ------------------------------------------------------------ the port


class Blocked:
    """A port whose calls do not come back."""

    late_ms = 0
    error = ""

    def __init__(self, bell: Bell) -> None:
        self._bell = bell
        self.entered, self.released = threading.Event(), threading.Event()

    def send(self, _: bytes) -> None:
        """Send nothing."""
        self.entered.set()
        self._bell.put(None)
        assert self.released.wait(NET)

    def receive(self) -> bytes:
        """Nothing has come."""
        return b""

    def close(self) -> None:
        """Nothing to give back."""


def test_a_port_that_was_taken_is_closed_to_its_program() -> None:
    desk = Desk()
    port = Gate(desk.line, desk.clock)
    port.send(b"one")
    assert port.take()
    for use in (lambda: port.send(b"two"), port.receive, port.check):
        with pytest.raises(GivenUp):
            use()
    assert desk.line.sent == [b"one"]


def test_no_stop_is_sent_past_a_call_that_is_stuck_in_the_port(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(gate, "PATIENCE_S", 0.01)
    desk = Desk()
    port = Blocked(desk.ending.bell)
    time = Time(port.entered.is_set)
    desk.session.watchdog = Watchdog(LIMIT_US, time.now_us, time.wait)
    desk.session.connect(port, None)
    result = desk.session.run()
    assert result.crashed
    assert result.unconfirmed == {"Motor (unit 7)": STUCK}
    port.released.set()


class Reopened(Blocked):
    """A port that is being opened again: its first call comes back late, all after it at once."""

    def __init__(self, desk: Desk) -> None:
        super().__init__(desk.ending.bell)
        self._line = desk.line

    def send(self, data: bytes) -> None:
        """After the first, onto the line."""
        if not self.released.is_set():
            super().send(data)
        self._line.send(data)

    def receive(self) -> bytes:
        """From the line."""
        return self._line.receive()


def test_the_last_stop_waits_for_a_port_that_is_being_opened_again(monkeypatch: pytest.MonkeyPatch) -> None:
    desk = Desk()
    port = Reopened(desk)
    time = Time(port.entered.is_set)
    desk.session.watchdog = Watchdog(LIMIT_US, time.now_us, time.wait)
    desk.session.connect(port, None)
    take, taken = Gate.take, list[bool]()

    def late(self: Gate, *words: Any) -> bool:
        if taken:
            port.released.set()
        taken.append(take(self, *words))
        return taken[-1]

    monkeypatch.setattr(Gate, "take", late)
    try:
        result = desk.session.run()
    finally:
        port.released.set()
    assert (taken, result.crashed, result.unconfirmed, result.stopped) == ([False, True], True, {}, ("Motor",))
    assert "the port takes nothing yet: the stop waits for it; Ctrl-C ends the waiting" in desk.told()


def test_a_port_is_not_waited_for_by_who_hurries(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(gate, "PATIENCE_S", 0)
    desk = Desk()
    port, looks = Gate(desk.line, desk.clock), list[bool]()

    def hurries() -> bool:
        looks.append(len(looks) == 2)
        return looks[-1]

    with port._lock:
        assert not port.take(10 * SECOND, hurries)
        assert looks == [False, False, True]
        assert not port.take(SECOND, hurries)
    assert len(looks) == 5
    assert port.take()
