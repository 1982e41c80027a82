"""What a person sees and keeps of a run: lines, a live table, a trace and a picture, each with whose port it was."""

import io
import re
from collections.abc import Iterator
from dataclasses import replace
from xml.etree import ElementTree

import pytest
from rich.console import Console
from tests.desk.run.desk import Desk
from tests.simulator.talk import MAPS

from driveblocks import console
from driveblocks.desk import screen
from driveblocks.desk.record import Timing, Trace
from driveblocks.desk.run.look import _why, look
from driveblocks.desk.seen import Seen, View
from driveblocks.render.reasons import REASONS, by_name


def views() -> Iterator[View]:
    """A motor that starts, runs, trips, is lost."""
    desk = Desk()

    def seen() -> View:
        return look(desk.controller, ("Hz", "Bus.Good", "Motor.CommOk"), desk.clock.now_us())

    desk.scan(50)
    yield seen()
    desk.started()
    yield seen()
    desk.drives[0].trip(3)
    desk.scan(500)
    yield seen()
    desk.line.cut = True
    desk.scan(9000)
    yield seen()


def test_lines_say_what_has_changed_each_with_whose_port_it_is(capsys: pytest.CaptureFixture[str]) -> None:
    lines = screen.Lines("REAL PORT")
    for view in views():
        lines.show(view)
        lines.show(view)
    said = capsys.readouterr().out.splitlines()
    assert said[:4] == [
        "REAL PORT    0.1 s  Motor no reply; no reply yet",
        "REAL PORT    0.1 s  Hz = 20.00",
        "REAL PORT    0.1 s  Bus.Good = 0",
        "REAL PORT    0.1 s  Motor.CommOk = FALSE",
    ]
    assert said[4] == "REAL PORT    6.0 s  Motor 20.0 Hz forward, at speed; runs as asked"
    assert "Motor 0.0 Hz fault 3; Overcurrent" in said[7]
    assert "Motor STOP OVERDUE; the drive has stopped answering" in "\n".join(said[8:])
    assert all(line.startswith("REAL PORT ") for line in said)


@pytest.mark.parametrize("width", [80, 120])
@pytest.mark.parametrize("real", [False, True])
@pytest.mark.parametrize("kind", [screen.LiveTable, screen.Desk])
def test_a_table_fits_and_says_whose_port_it_is(
    width: int, real: bool, kind: type[screen.LiveTable | screen.Desk], monkeypatch: pytest.MonkeyPatch
) -> None:
    drawn = io.StringIO()
    made = Console(file=drawn, width=width, height=30, force_terminal=True, color_system=None, legacy_windows=False)
    monkeypatch.setattr(console, "terminal", lambda: made)
    label = "REAL PORT /dev/ttyUSB0" if real else "SIMULATED"
    table = kind(screen.Heading(label, "my.st", real))
    for view in views():
        drawn.seek(0)
        drawn.truncate()
        table.show(view)
    table.say("Ctrl-C: stopping every drive")
    table.close()
    text = drawn.getvalue()
    for word in (label, "my.st", "STOP OVERDUE", "Bus.Good", "Ctrl-C: stopping every drive"):
        assert word in text
    assert (screen.HELP in text) == (kind is screen.Desk)
    visible = [re.sub(r"\x1b(\[\??[\d;]*[a-zA-Z]|\d)", "", line) for line in text.splitlines()]
    assert max(len(line.rstrip()) for line in visible) <= width


def test_a_wide_terminal_has_room_for_a_plot_of_the_last_seconds() -> None:
    terminal = Console(file=io.TextIOWrapper(io.BytesIO(), encoding="utf-8"), width=screen.WIDE)
    plots, made = screen.Plots(terminal), Seen("Motor", 7, "forward", 40.0, 0.0, "")
    for place in range(2 * screen.PLOTTED):
        made = replace(made, hertz=min(40.0, 10.0 * (place // 10)))
        for at_us in (0, 200_000):
            plots.add(View(place * screen.PLOT_US + at_us, (made,), {}, {}))
    assert plots.line(made) == "▅" * 6 + "▆" * 10 + "█" * 8
    assert plots.fit
    assert not screen.Plots(Console(file=io.StringIO(), width=screen.WIDE - 1)).fit


def test_a_long_name_of_a_fault_and_of_a_drive_are_read_whole_at_80_columns() -> None:
    drawn = io.StringIO()
    fault, drive = "fault 10 Motor thermal overload protection", "Conveyor3.Motor"
    seen = Seen(drive, 247, fault, -50.0, 400.0, "123456 requests heard", "look at it", 400.0)
    heading = screen.Heading("SIMULATED", "my.st", real=False)
    terminal = Console(file=drawn, width=80)
    terminal.print(*screen._parts(heading, View(0, (seen,), {}, {}), screen.Plots(terminal)))
    for word in (*fault.split(), drive, "-50.0", "400.0", f"{seen.why} - {seen.remedy}"):
        assert word in drawn.getvalue()
    assert max(map(len, drawn.getvalue().splitlines())) <= 80


@pytest.mark.parametrize(
    ("hertz", "asked", "most", "drawn", "plain"),
    [
        (0.0, 40.0, 50.0, "░░░░░░░░░░░░░░░░····", "----------------...."),
        (-25.0, -40.0, 50.0, "██████████░░░░░░····", "##########------...."),
        (40.0, 20.0, 50.0, "████████▓▓▓▓▓▓▓▓····", "########++++++++...."),
        (70.0, 50.0, 50.0, "████████████████████", "####################"),
        (None, 20.0, 50.0, "", ""),
        (20.0, 20.0, 0.0, "", ""),
    ],
)
def test_a_bar_shows_the_speed_and_what_is_asked_as_a_share_of_the_maximum(
    hertz: float | None, asked: float, most: float, drawn: str, plain: str
) -> None:
    seen = Seen("Motor", 7, "forward", asked, hertz, "", most_hz=most)
    for encoding, bar in (("utf-8", drawn), ("ascii", plain)):
        terminal = Console(file=io.TextIOWrapper(io.BytesIO(), encoding=encoding))
        assert screen.Plots(terminal).bar(seen) == bar


@pytest.mark.parametrize(("height", "said"), [(24, True), (14, False)])
def test_without_room_only_what_is_to_be_done_is_said_of_a_drive(height: int, said: bool) -> None:
    drawn = io.StringIO()
    fine, bad = Seen("A", 1, "forward", 9.0, 9.0, "runs as asked"), Seen("B", 2, "no reply", 9.0, None, "gone", "look")
    terminal = Console(file=drawn, width=80, height=height)
    view = View(0, (fine, bad, fine), {}, {})
    terminal.print(*screen._parts(screen.Heading("SIMULATED", "my.st", real=False), view, screen.Plots(terminal)))
    assert ("runs as asked" in drawn.getvalue()) is said
    assert "gone - look" in drawn.getvalue()


@pytest.mark.parametrize(
    ("family", "reason", "fault", "why", "remedy"),
    [
        ("SN300G5", "FAULT", 1, "Fuse blown", "remove the cause; clears it: nothing on the bus; reset it at the drive"),
        (
            "PF525",
            "FAULT",
            12,
            "Hardware overcurrent",
            "check the settings: boost A530, voltage of the DC brake; clears it:",
        ),
        ("CHF", "FAULT", 4, "fault: see FaultCode", "remove the cause, then a rising FaultReset; with SpeedOnly or"),
        ("SN300G5", "NO_RESET", 0, "no reset was sent,", "FaultReset was pressed: this drive takes none over the bus"),
        ("JSCC", "OFFLINE", 3, "the drive has stopped answering", "cable, supply; the counters of the slot say more"),
        ("JSCC", "READY", 0, "stopped; a rising run or jog pin starts it", ""),
        ("JSCC", "RAMPING", 0, "on its way to the reference", ""),
    ],
)
def test_a_reason_has_its_remedy_and_a_fault_that_of_its_map(
    family: str, reason: str, fault: int, why: str, remedy: str
) -> None:
    said, does = _why(MAPS[family], by_name(reason).code, fault)
    assert said.startswith(why)
    assert does.startswith(remedy) if remedy else not does


def test_what_is_said_on_a_screen_has_no_marks_of_a_page() -> None:
    for drive in MAPS.values():
        for reason in REASONS:
            assert not re.search(r"[`\]\[]", _why(drive, reason.code, 0)[1])
    assert _why(MAPS["JSCC"], 99, 0) == ("reason 99", "")


def test_frames_that_were_not_sent_stand_in_the_table() -> None:
    view = View(0, (), {}, {}, dropped=7, port_error="No such device")
    parts = screen._parts(screen.Heading("REAL PORT", "my.st", True), view, screen.Plots(Console(width=80)))
    text = "\n".join(map(str, parts))
    assert "7 frames not sent: only reads and stops are" in text
    assert "the port does not work: No such device" in text


def test_a_trace_has_a_row_for_every_change() -> None:
    file = io.StringIO()
    trace = Trace(file.write, ("A", "B"), "SIMULATED, my.st")
    for at, a, b in ((0, False, 1.0), (10_000, False, 1.0), (20_000, True, 1.0), (30_000, True, 1.5)):
        trace.add(at, {"A": a, "B": b})
    assert file.getvalue() == "# SIMULATED, my.st\nms,A,B\n0,0,1\n20,1,1\n30,1,1.5\n"


def test_a_picture_has_a_lane_for_each_variable_and_whose_port_it_was() -> None:
    timing = Timing(("A", "B<1>"), "SIMULATED, my.st")
    for at in range(0, 3_000_001, 10_000):
        timing.add(at, {"A": at >= 1_000_000, "B<1>": at / 100_000})
    root = ElementTree.fromstring(timing.svg())  # noqa: S314 - our own
    space = "{http://www.w3.org/2000/svg}"
    texts = [each.text for each in root.iter(f"{space}text")]
    assert texts[0] == "SIMULATED, my.st"
    assert {"A", "B<1>", "30", "0 s", "3 s"} <= set(texts)
    lanes = [each.get("points", "").split() for each in root.iter(f"{space}polyline")]
    # low until 1 s, a third of the way; then high
    assert lanes[0] == ["200.0,68.0", "456.7,68.0", "456.7,42.0", "970.0,42.0", "970.0,42.0"]


def test_a_picture_forgets_what_is_too_much() -> None:
    timing = Timing(("A",), "SIMULATED", most=10)
    for at in range(100):
        timing.add(at, {"A": at % 2})
    assert timing.svg().count(",") < 40
