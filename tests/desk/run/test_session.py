"""A run in virtual time: what goes in and out of a scan, time that is lost, and every way in which it can end."""

import os
import signal
from collections.abc import Callable

import pytest
from tests.desk.run.desk import BOX, EXAMPLE, ONE, SCAN_US, Desk, Line
from tests.maps import bad
from tests.simulator.talk import MAPS

from driveblocks.bench.simulator.drive import SimulatedDrive
from driveblocks.bench.simulator.habits import Habits
from driveblocks.desk import ending
from driveblocks.desk.bus import Bus
from driveblocks.desk.clock import VirtualClock
from driveblocks.desk.ending import Ending
from driveblocks.desk.master import CHATTER_US, REPLY_US, Speech
from driveblocks.desk.port import AGAIN_US, DevicePort
from driveblocks.desk.run.gate import Gate
from driveblocks.desk.run.pace import Pace
from driveblocks.desk.run.stopper import Stop, Stopper
from driveblocks.desk.script import Setting
from driveblocks.maps import load

SECOND = 1_000_000


@pytest.mark.parametrize("text", [ONE, BOX], ids=["bytes", "mailbox"])
def test_a_motor_runs_and_stops(text: str) -> None:
    desk = Desk(text).started()
    assert desk.drives[0].mode == "running"
    assert desk.instance["Motor.OutputFrequencyHz"] == pytest.approx(20)
    desk.instance["Start"] = False
    desk.scan(4000)
    assert desk.drives[0].mode == "standstill"
    assert desk.instance["Motor.StopConfirmed"]
    assert (desk.controller.number("Bus.Bad"), desk.controller.number("Bus.Timeouts")) == (0, 0)


def test_a_program_scales_an_analog_input_in_single_precision() -> None:
    text = ONE.replace("  Start : BOOL;", "  Start : BOOL;\n  Raw : INT := 14000;").replace(
        "END_VAR\n", "END_VAR\n  Hz := (INT_TO_REAL(Raw) / 27648.0 - 0.2) / 0.8 * 50.0;\n", 1
    )
    assert Desk(text).started().instance["Hz"] == 19.147857666015625


def test_a_line_speaks_ascii() -> None:
    text = ONE.replace("BitRate := 19200", "Ascii := TRUE, BitRate := 19200").replace("JSCC", "CHF")
    desk = ended(Desk(text, [SimulatedDrive(MAPS["CHF"], 7, ascii_mode=True)], frozenset({(7, "Motor")})))
    assert desk.line.sent[0].startswith(b":07")
    assert desk.controller.number("Bus.Bad") == 0
    assert desk.drives[0].mode == "standstill"
    assert desk.session.result is not None
    assert desk.session.result.stopped == ("Motor",)


def test_time_is_measured_and_a_late_scan_is_reported() -> None:
    desk = Desk().scan(30)
    assert (desk.instance["Elapsed"], desk.instance["First"]) == (10, False)
    desk.clock.sleep_until(desk.clock.now_us() + 34_000)
    desk.scan(10)
    assert desk.instance["Elapsed"] == 44
    assert desk.controller.number("Bus.LateScans") == 1


def test_five_seconds_of_sleep_act_like_a_restart_and_start_nothing() -> None:
    desk = Desk().started()
    desk.clock.sleep_until(desk.clock.now_us() + 5 * SECOND)
    desk.scan(5000)
    assert desk.drives[0].mode == "standstill"
    assert desk.instance["Motor.Reason"] == 24  # the run pin is held since before


class Lagging(VirtualClock):
    """A clock of a machine that takes its time: each look at it costs some, and one in a hundred much more."""

    looks = 0

    def now_us(self) -> int:
        """The time, a little later each time."""
        self.looks += 1
        self.sleep_until(super().now_us() + (25_000 if self.looks % 100 == 0 else 100))
        return super().now_us()


def test_an_overrun_is_counted_and_the_scans_that_it_cost_are_left_out() -> None:
    desk = Desk()
    desk.clock = desk.session._clock = Lagging()
    desk.session._loop(SECOND)
    pace = desk.session.pace
    assert pace.missed > 0
    assert pace.late > 0
    assert pace.scans + pace.missed == pytest.approx(100, abs=3)
    assert pace.worst_us >= 25_000 - SCAN_US


def test_the_figures_of_a_pace() -> None:
    pace = Pace(10_000)
    for took in (*range(1000, 1980, 10), 9000):
        assert pace.add(took, took - 10_000) == 0
    assert pace.add(34_000, 24_000) == 2
    assert (pace.scans, pace.late, pace.missed, pace.worst_us) == (100, 1, 2, 34_000)
    assert pace.share_us(50) == pytest.approx(1490, abs=20)
    assert pace.share_us(99) == pytest.approx(9000, abs=20)
    assert str(pace) == (
        "100 scans of 10 ms: 97.1 % kept, 2 missed\na scan took 1.50 ms (median), 9.02 ms (99 %), 34.00 ms (worst)"
    )


# ------------------------------------------------------------ how it ends


def ended(desk: Desk, end: Callable[[Desk], None] = lambda _: None, seconds: int = 8) -> Desk:
    """Run, with a start at 2 s; `end` is called at 5 s."""
    desk.session.script = [Setting("Start", True, 2 * SECOND)]
    done: list[int] = []

    def step(at_us: int) -> None:
        if at_us >= 5 * SECOND and not done:
            done.append(at_us)
            assert desk.drives[0].mode == "running"
            end(desk)

    desk.session.steps.append(step)
    desk.session.run(seconds * SECOND)
    return desk


def test_the_end_of_the_time_stops_every_drive() -> None:
    desk = ended(Desk())
    assert desk.drives[0].mode == "standstill"
    result = desk.session.result
    assert result is not None
    assert (result.reason, result.crashed, result.unconfirmed, result.stopped) == (
        "8 s are over",
        False,
        {},
        ("Motor",),
    )
    assert desk.told() == ["8 s are over: stopping every drive"]


def sent(desk: Desk, number: int, *, hurry: bool = False) -> None:
    """A signal has been sent to this process, and was heard."""
    signal.raise_signal(number) if os.name == "nt" else os.kill(os.getpid(), number)
    while not desk.ending.reason or desk.ending.hurry != hurry:
        continue


@pytest.mark.parametrize("number", sorted(ending.caught()))
def test_a_signal_stops_every_drive(number: int) -> None:
    desk = Desk()
    before = signal.getsignal(number)
    with ending.listening(desk.ending):
        ended(desk, lambda desk: sent(desk, number))
    assert signal.getsignal(number) == before
    assert desk.drives[0].mode == "standstill"
    result = desk.session.result
    assert result is not None
    assert (result.crashed, result.stopped) == (False, ("Motor",))
    name = ending.caught()[number]
    assert result.reason == ending.REASONS.get(name, name)


def test_every_signal_that_would_end_the_process_is_caught() -> None:
    known = {
        "SIGINT",
        "SIGTERM",
        "SIGHUP",
        "SIGQUIT",
        "SIGUSR1",
        "SIGUSR2",
        "SIGALRM",
        "SIGXCPU",
        "SIGABRT",
        "SIGBREAK",
    }
    assert set(ending.caught().values()) >= known & {each.name for each in signal.Signals}
    left = {"SIGKILL", "SIGSTOP", "SIGSEGV", "SIGCHLD", "SIGPIPE", "SIGTSTP", "SIGVTALRM"}
    assert not left & set(ending.caught().values())


# ------------------------------------------------------------ a suspension


@pytest.mark.skipif(not hasattr(signal, "SIGTSTP"), reason="nothing is suspended here")
def test_a_real_port_asks_before_it_is_suspended_and_no_terminal_suspends_it() -> None:
    desk = Desk()
    asked: list[bool] = []
    before = [signal.getsignal(getattr(signal, name)) for name in ending.SUSPENDS]
    with ending.listening(desk.ending, lambda: asked.append(True)):
        signal.raise_signal(signal.SIGTSTP)
        assert [signal.getsignal(each) for each in (signal.SIGTTIN, signal.SIGTTOU)] == [signal.SIG_IGN] * 2
    assert asked == [True]
    with ending.listening(desk.ending):
        assert [signal.getsignal(getattr(signal, name)) for name in ending.SUSPENDS] == before
    assert [signal.getsignal(getattr(signal, name)) for name in ending.SUSPENDS] == before


def test_no_process_is_suspended_while_a_motor_may_run() -> None:
    desk = Desk()
    halted: list[int] = []
    moments = {SECOND // 10: "before it was heard", 4 * SECOND: "at speed", 8 * SECOND: "at standstill"}
    desk.session.script = [Setting("Start", True, 2 * SECOND), Setting("Start", False, 5 * SECOND)]
    now: list[int] = []

    def step(at_us: int) -> None:
        now[:] = [at_us]
        if at_us in moments:
            desk.session.ask_to_suspend()

    desk.session.steps.append(step)
    desk.session.halt = lambda: halted.append(now[0])
    desk.session.run(9 * SECOND)
    assert halted == [8 * SECOND]
    refused = [line for line in desk.told() if line.startswith("not suspended")]
    assert refused == ["not suspended, since Motor may run; Ctrl-C stops all and ends"] * 2


def fails(desk: Desk) -> None:
    """The program divides by 0."""
    desk.instance["Divisor"] = 0


def breaks(desk: Desk) -> None:
    """Something that nobody has thought of."""
    desk.controller.scan = None  # type: ignore[assignment,method-assign]  # calling it fails


@pytest.mark.parametrize(("crash", "said"), [(fails, "my.st:17:15: division by zero"), (breaks, "TypeError")])
def test_a_crash_stops_every_drive_and_is_reported(crash: Callable[[Desk], None], said: str) -> None:
    desk = ended(Desk(), crash)
    assert desk.drives[0].mode == "standstill"
    result = desk.session.result
    assert result is not None
    assert result.crashed
    assert result.unconfirmed == {}
    assert result.reason.startswith(f"the program has failed: {said}")


def test_a_drive_that_does_not_reply_is_named_after_a_bounded_time() -> None:
    desk = ended(Desk(), lambda desk: setattr(desk.line, "cut", True), seconds=6)
    before = len(desk.line.sent)
    assert desk.session.result is not None
    assert desk.session.result.unconfirmed == {"Motor (unit 7)": "no reply to the stop"}
    assert desk.clock.now_us() == pytest.approx((6 + 15 + 60) * SECOND, abs=2 * SECOND)  # StopWithinMs is 15000
    assert {frame[:6] for frame in desk.line.sent[before - 20 :]} == {bytes.fromhex("07 06 10 00 00 03")}


def test_a_motor_that_runs_on_is_named() -> None:
    desk = Desk()
    ended(desk, lambda desk: setattr(desk.drives[0], "keeps_running", True))
    assert desk.session.result is not None
    why = {"Motor (unit 7)": "stop acknowledged, its status does not prove standstill"}
    assert desk.session.result.unconfirmed == why


def test_who_asks_again_does_not_wait() -> None:
    def twice(desk: Desk) -> None:
        desk.line.cut = True
        desk.line.sent.clear()
        sent(desk, signal.SIGINT)
        sent(desk, signal.SIGINT, hurry=True)

    desk = Desk()
    with ending.listening(desk.ending):
        ended(desk, twice)
    assert desk.clock.now_us() < 6 * SECOND
    assert desk.line.sent[-1][:6] == bytes.fromhex("07 06 10 00 00 03")
    assert desk.session.result is not None
    assert desk.session.result.unconfirmed


def test_a_terminal_that_vanishes_brings_much_at_once_and_every_drive_is_waited_for() -> None:
    def gone(desk: Desk) -> None:
        for reason in ("SIGHUP", "the input has ended", "the screen has failed", "SIGTERM"):
            desk.ending.ask(reason)

    desk = ended(Desk(), gone)
    assert desk.drives[0].mode == "standstill"
    assert desk.session.result is not None
    assert (desk.session.result.reason, desk.session.result.stopped) == ("SIGHUP", ("Motor",))


def test_drives_are_stopped_before_a_first_scan_has_said_where_they_are() -> None:
    desk = Desk()
    desk.session.known = Desk().scan(SCAN_US // 1000).controller
    desk.drives[0].keypad_run(20)
    desk.ending.ask("Ctrl-C")
    assert desk.session.run().stopped == ("Motor",)
    assert desk.session.pace.scans == 0
    assert desk.drives[0].mode == "standstill"


def test_every_drive_gets_its_stop_before_one_is_waited_for() -> None:
    drives = [
        SimulatedDrive(MAPS[name], unit, Habits(ramp=5)) for unit, name in enumerate(("SN300G5", "JSCC", "CHF"), 1)
    ]
    desk = Desk(EXAMPLE.read_text(encoding="utf-8"), drives)
    desk.line.sent.clear()
    for drive in drives:
        drive.keypad_run(20)
    desk.ending.ask("Ctrl-C")
    desk.controller.connect(desk.line, frozenset())
    desk.scan(100)
    desk.line.sent.clear()
    desk.session.run()
    assert [frame[0] for frame in desk.line.sent[:3]] == [1, 2, 3]
    assert [drive.mode for drive in drives] == ["standstill"] * 3
    assert desk.session.result is not None
    assert desk.session.result.unconfirmed == {}


@pytest.mark.parametrize("after_us", range(0, 40_000, 5_000))
def test_a_stop_meets_no_reply_and_keeps_the_silence(after_us: int) -> None:
    """The end is asked for at each moment of a transaction: before, while and after the drive replies."""
    desk = Desk().started()
    heard: list[int] = []
    receive = desk.line.receive

    def noted() -> bytes:
        some = receive()
        heard.extend([desk.clock.now_us()] * bool(some))
        return some

    desk.line.receive = noted  # type: ignore[method-assign]  # noted on the way
    before, good = len(desk.line.sent), desk.controller.number("Bus.Good")
    while len(desk.line.sent) == before:
        desk.scan(SCAN_US // 1000)
    assert desk.controller.number("Bus.Good") >= good
    said = desk.clock.now_us() - SCAN_US
    desk.clock.sleep_until(said + after_us)
    stopped: list[int] = []
    send = desk.line.send

    def sent(data: bytes) -> None:
        stopped.append(desk.clock.now_us())
        send(data)

    desk.line.send = sent  # type: ignore[method-assign]  # noted on the way
    desk.ending.ask("Ctrl-C")
    desk.session.run()
    replied = [at for at in heard if at <= stopped[0]]
    assert replied
    assert stopped[0] - replied[-1] >= 20_000
    assert stopped[0] - said < 100_000
    assert desk.drives[0].mode == "standstill"


def test_a_stop_does_not_wait_for_ever_for_a_reply_or_for_silence() -> None:
    desk = Desk().started()
    desk.line.cut = True
    while not desk.line.sent[-1].startswith(b"\7\3"):
        desk.scan(10)
    said, before = desk.clock.now_us(), len(desk.line.sent)
    desk.line.receive = lambda: b"?"  # type: ignore[method-assign]  # somebody speaks, and never ends
    stopped: list[int] = []

    def sent(_: bytes) -> None:
        stopped.append(desk.clock.now_us())

    desk.line.send = sent  # type: ignore[assignment,method-assign]  # a port that is watched
    desk.ending.ask("Ctrl-C", alone=True)
    desk.session.run()
    assert len(desk.line.sent) == before
    assert stopped[0] - said <= REPLY_US + CHATTER_US + 100_000


# ------------------------------------------------------------ a port that goes


class Device:
    """A port of the machine that can be pulled out."""

    there = True

    def open(self) -> "Device":
        """Plug it in."""
        if not self.there:
            raise OSError(2, "No such device")
        return self

    def write(self, _: bytes) -> None:
        """Send."""
        self.open()

    def read(self) -> bytes:
        """Receive."""
        self.open()
        return b""

    def close(self) -> None:
        """Give it back."""


def test_a_port_that_vanishes_is_reported_to_the_line_and_looked_for_again() -> None:
    desk, device = Desk(), Device()
    port = DevicePort(device.open, desk.clock)
    desk.session.connect(port, None)
    desk.scan(100)
    assert desk.controller.number("Bus.PortErrorID") == 0
    device.there = False
    desk.scan(100)
    assert (port.error, desk.controller.number("Bus.ErrorID")) == ("No such device", 57)
    device.there = True
    desk.scan(AGAIN_US // 1000)
    assert (port.error, desk.controller.number("Bus.PortErrorID")) == ("", 0)


def test_an_ending_keeps_its_first_reason() -> None:
    ending = Ending()
    ending.ask("Ctrl-C")
    assert not ending.hurry
    ending.ask("SIGTERM")
    assert (ending.reason, ending.hurry) == ("Ctrl-C", False)


def test_a_drive_that_coils_command_is_stopped_and_its_standstill_read() -> None:
    """Coils, and a frequency of two registers, which are read in one request."""
    coils = load.load(bad.FOLDER / "coils.yaml")
    drive, clock = SimulatedDrive(coils, 5), VirtualClock()
    drive.keypad_run(20)
    drive.step(5000)
    line = Line(Bus([drive], 19200, 10, ascii_mode=False), clock)
    stopper = Stopper(Gate(line, clock), clock, Ending(), Speech("rtu", 521.0))
    stops = {5: Stop(coils, 1_000_000)}
    stopper.stop(stops)
    assert stops[5].why == ""
    assert drive.mode == "standstill"
    assert {frame[:6].hex() for frame in line.sent} == {"050500000000", "0501000e0001", "050310000002"}
