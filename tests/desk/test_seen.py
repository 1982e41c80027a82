"""What a person sees and keeps of a run: lines, a live table, a trace and a picture, each with whose port it was."""

import csv
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
from driveblocks.desk.record import Trace
from driveblocks.desk.run.look import PINS, _why, look
from driveblocks.desk.run.picture import Timing
from driveblocks.desk.seen import Seen, View
from driveblocks.render.reasons import REASONS, by_name
from structured_text.engines.engine import Value


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


@pytest.mark.parametrize(("height", "said", "rows"), [(24, True, 9), (18, True, 8), (10, False, 6)])
def test_with_less_room_a_remedy_is_cut_and_without_any_only_what_is_to_be_done_is_said(
    height: int, said: bool, rows: int
) -> None:
    drawn = io.StringIO()
    fine = Seen("A", 1, "forward", 9.0, 9.0, "runs as asked")
    bad = Seen("B", 2, "no reply", 9.0, None, "gone", "look " * 20)
    terminal = Console(file=drawn, width=80, height=height)
    view = View(0, (fine, bad, fine), {}, {})
    terminal.print(*screen._parts(screen.Heading("SIMULATED", "my.st", real=False), view, screen.Plots(terminal)))
    assert ("runs as asked" in drawn.getvalue()) is said
    assert "gone - look" in drawn.getvalue()
    assert len(drawn.getvalue().splitlines()) == rows


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


def test_a_text_in_a_trace_is_a_text_and_one_cell() -> None:
    file = io.StringIO()
    trace = Trace(file.write, ("A", "B", "C"), "SIMULATED, my.st")
    trace.add(0, {"A": b"Ground fault", "B": "过流".encode(), "C": b'at 10 "A", or\xb5', "D": b"not asked for"})
    rows = file.getvalue().split("\n", 1)[1]
    assert list(csv.reader(io.StringIO(rows)))[1] == ["0", "Ground fault", "过流", 'at 10 "A", orµ']
    assert "b'" not in rows


# ------------------------------------------------------------ the picture


def pins(reason: str, *true: str, hertz: float | None = 0.0, asked: float = 40.0, state: int = 0) -> dict[str, Value]:
    """What a drive block shows."""
    off: dict[str, Value] = dict.fromkeys(PINS, False)
    return {f"Motor.{name}": value for name, value in (off | dict.fromkeys(true, True) | {
        "OutputFrequencyHz": hertz or 0.0, "Diagnosis.OutputFrequencyValid": hertz is not None,
        "SpeedReferenceHz": asked, "MaximumHz": 50.0, "Reason": by_name(reason).code, "FaultCode": 3,
        "Control.State": state,
    }).items()}  # fmt: skip


@pytest.fixture(scope="module")
def drawn() -> ElementTree.Element:
    """A motor that is started, runs, is stopped, trips and is lost, as a picture."""
    timing = Timing({"Motor": MAPS["JSCC"]}, ("Start", "Hz", "B<1>", "Still"), "SIMULATED, my.st")
    times = (
        (0, pins("READY", "CommOk", "StopConfirmed", state=1), b"Ground fault"),
        (10, pins("RUNS", "CommOk", "Running", "AtSpeed", hertz=40.0, state=4), b"Ground fault"),
        (20, pins("RELEASED", "CommOk", "Running", hertz=20.0), b"Ground fault"),
        (30, pins("FAULT", "CommOk", "Fault", hertz=10.0), "过流".encode()),
        (35, pins("OFFLINE", hertz=None), "过流".encode()),
        (35.5, pins("READY", "CommOk", "StopConfirmed", state=1), "过流".encode()),
        (40, pins("READY", "CommOk", "StopConfirmed", state=1), "过流".encode()),
    )
    for at, shown, said in times:
        own: dict[str, Value] = {"Start": 10 <= at < 20, "Hz": 4.0 * at, "B<1>": said, "Still": 7}
        timing.add(int(at * 1e6), shown | own)
    marks = [(10_000_000, "Start := TRUE"), (10_100_000, "Hz := 40"), (30_000_000, "trip OC 7")]
    return ElementTree.fromstring(timing.svg(marks))  # noqa: S314 - our own


SPACE = "{http://www.w3.org/2000/svg}"


@pytest.mark.parametrize(("layout", "width"), [("wide", 1120), ("narrow", 390)])
def test_a_picture_shows_speed_and_reference_state_and_reason_in_words_and_what_happened(
    drawn: ElementTree.Element, layout: str, width: int
) -> None:
    (sheet,) = (each for each in drawn.iter(f"{SPACE}g") if each.get("class") == layout)
    curves = {
        kind: [
            [tuple(map(float, point.split(","))) for point in way.split("L")]
            for each in sheet.iter(f"{SPACE}path")
            for way in each.get("d", "")[1:].split("M")
            if each.get("class") == kind
        ][1:]  # the first is the sample of the legend
        for kind in ("go", "dashed", "stop")
    }
    speed, after = curves["go"]  # nothing is drawn while it is not known
    zero, one, high = speed[0][1], speed[2][1], speed[4][1]
    assert [round(zero - one), round(zero - high)] == [67, 34], "40 and 20 Hz of 50 are 0.8 and 0.4 of 84 pixels"
    assert speed[-1][0] < after[0][0]
    assert {round(zero - y) for _, y in curves["dashed"][0]} == {67}
    assert [line[0][0] for line in curves["stop"]] == [speed[4][0]], "where the motor is told to stop"
    texts = [each.text or "" for each in sheet.iter(f"{SPACE}text")]
    said = " ".join(texts)
    for words in (
        "SIMULATED, my.st", "Motor", "standstill", "fault 3", "Overcurrent", "Ground fault", "过流", "B<1>", "50",
        "1: at 10.0 s Start := TRUE; Hz := 40", "2: at 30.0 s trip OC 7", "the same all the time: Still = 7",
    ):  # fmt: skip
        assert words in said
    told = [each.text for each in sheet.iter(f"{SPACE}title")]
    assert {"running, at speed, 10.00 to 20.00 s", "no reply, 35.00 to 35.50 s"} <= set(told)
    assert ("state a: running, at speed" in texts) is (layout == "narrow")
    assert "why 14: the drive has stopped answering" in texts, "a band too short for its words has its number"
    for each in sheet.iter(f"{SPACE}text"):
        wide = 5.5 * len(each.text or "") if each.get("text-anchor", "start") == "start" else 0
        assert 0 <= float(each.get("x", "")) <= width - wide


def test_a_picture_in_a_narrow_window_has_the_narrow_layout(drawn: ElementTree.Element) -> None:
    (style,) = drawn.iter(f"{SPACE}style")
    assert "@media (max-width: 1119px)" in (style.text or "")
    assert drawn.get("width") == "1120"


def test_a_picture_forgets_what_is_too_much_and_draws_no_more_than_pixels_show() -> None:
    timing = Timing({}, ("A",), "SIMULATED", most=10)
    for at in range(100):
        timing.add(at, {"A": at % 2})
    assert timing.svg().count(",") < 200
    timing = Timing({}, ("A",), "SIMULATED")
    for at in range(20_000):
        timing.add(1000 * at, {"A": at % 2})
    assert len(timing.svg()) < 150_000
