"""`driveblocks run`: what it refuses, what it writes, the demonstration, and that Windows has all that it needs."""

import os
import re
import subprocess
import sys
import threading
from pathlib import Path

import pytest
from click.testing import CliRunner, Result
from tests.desk.run.desk import EXAMPLE, ONE, maps
from tests.desk.run.windows import environment
from tests.desk.simulate.test_peer import serving
from tests.simulator.talk import MAPS

from driveblocks.bench.simulator.drive import SimulatedDrive
from driveblocks.cli import app
from driveblocks.desk.bus import Bus
from driveblocks.desk.keyboard import Keyboard
from driveblocks.desk.run import demo, probe, source
from driveblocks.desk.run.controller import Controller
from driveblocks.desk.run.options import Options
from driveblocks.desk.run.setup import Setup
from driveblocks.desk.screen import Lines
from driveblocks.desk.simulate.link import TcpLink
from driveblocks.maps import catalog
from driveblocks.maps.problem import Refused

NET = 600
"""Seconds that no machine needs, for what would hang."""
FAST = ("--fast", "--for", "8s", "--script", "run.txt")


def run(*words: str | Path) -> Result:
    """Run the command."""
    return CliRunner().invoke(app, ["run", *map(str, words)])


@pytest.fixture(autouse=True)
def _stays(monkeypatch: pytest.MonkeyPatch) -> None:
    """However slow this machine is, the process of the tests does not end."""
    monkeypatch.setattr(os, "_exit", lambda _: None)


@pytest.fixture
def program(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A program with one motor."""
    monkeypatch.chdir(tmp_path)
    path = tmp_path / "my.st"
    path.write_text(ONE, encoding="utf-8")
    return path


REFUSED = [
    ("", "name a program, or write --demo"),
    ("my.st --demo", "--demo brings its own program; leave yours out"),
    ("my.st --simulate jscc --port COM3", "--simulate and --port exclude each other: drives are simulated, or real"),
    ("my.st --tcp nowhere", "--tcp nowhere is no address; write HOST:PORT, with a port of 1 to 65535"),
    ("my.st --for " + 400 * "9" + "s", "is no time; write 10ms, 2.5s or 1min"),
    ("my.st --allow-run", "--allow-run is for a real port; simulated drives may always run"),
    ("my.st --tcp 10.0.0.1:502 --simulated", "--simulated is for a simulator of this computer; write --tcp 127.0.0.1:"),
    ("my.st --fast", "--fast needs --for: it would never end"),
    ("my.st --fast --for 1s --port COM3", "--fast is for simulated drives; a port has its own time"),
    ("my.st --scan 0ms", "--scan 0ms is out of range; write 0.001s to 60s"),
    ("my.st --watchdog 1ms", "--watchdog 1ms is out of range; write 0.01s to 600s"),
    ("no.st", "no.st:1:1: cannot be read: No such file or directory"),
    ("my.st --show Motor.Speeed", "--show: the program has no variable Motor.Speeed; did you mean MOTOR."),
    ("my.st --show Motor", "--show: Motor has parts; name one of them"),
    ("my.st --program Other", "my.st:1:1: there is no PROGRAM Other; choose by --program: One"),
    ("my.st --simulate jscc@7,chf@7", "--simulate chf@7: units are 1 to 247, one drive each; write chf@1"),
    ("my.st --script no.txt", "no.txt:1:1: cannot be read"),
    ("my.st --trace no/trace.csv", "no/trace.csv: No such file or directory"),
    ("my.st --trace my.st", "my.st: there is a file that no run has written; name a new one, or move it away"),
    ("my.st --trace x --picture x", "--trace and --picture both name x; name two files"),
    ("my.st --scenario no.yaml", "no.yaml:1:1: this file cannot be read"),
    ("my.st --tcp :1 --simulated --scenario x", "--scenario is for drives that this run simulates"),
    (".", ".:1:1: cannot be read: it is a folder; name a file"),
    ("my.st --script .", ".:1:1: cannot be read: it is a folder; name a file"),
    ("my.st --picture .", ".: Is a directory"),
    ("my.st --port no-such-port", "no-such-port: "),
    ("my.st --port x --format 9X9", "--format 9X9 is no format; write 8N1, 8E1, 8O1, 8N2 or 7E1"),
]  # fmt: skip


@pytest.mark.parametrize(("words", "wrong"), REFUSED, ids=[words for words, _ in REFUSED])
@pytest.mark.usefixtures("program")
def test_what_is_refused_and_why(words: str, wrong: str) -> None:
    result = run(*words.split())
    assert result.exit_code == 2
    assert wrong in result.output


def test_a_wrong_program_and_a_wrong_script_are_reported_with_their_places(program: Path) -> None:
    program.write_text(ONE.replace("Hz : REAL", "Hz : REEL"), encoding="utf-8")
    result = run(program)
    assert (result.exit_code, result.output[:10]) == (2, "my.st:4:8:")
    program.write_text(ONE, encoding="utf-8")
    Path("run.txt").write_text("at 1s: Go := TRUE\n", encoding="utf-8")
    result = run(program, "--script", "run.txt")
    assert (result.exit_code, result.output) == (2, "run.txt:1:8: the program has no variable Go\n")


@pytest.mark.parametrize(
    ("block", "advice"),
    [
        ("ACME_Drive", "if ACME_Drive is of a map of your own, name that by --map"),
        ("LX_Line8", "LX_Line8 is for a platform; take MB_ByteLine8, as in ..._MotorBytes.st of openplc/yours"),
    ],
)
def test_a_block_that_is_not_there_is_reported_with_what_to_do(program: Path, block: str, advice: str) -> None:
    program.write_text(ONE.replace("JSCC_Drive", block), encoding="utf-8")
    done = run(program)
    assert done.exit_code == 2
    assert done.stderr.splitlines()[-1] == advice


def test_a_program_runs_by_a_script_and_leaves_a_trace_and_a_picture(program: Path) -> None:
    Path("run.txt").write_text("at 2s: Start := TRUE; Hz := 10\nat 5s: Start := FALSE\n", encoding="utf-8")
    files = ("--trace", "t.csv", "--picture", "t.svg")
    words = (program, *FAST, *files, "--show", "Motor.Running,Hz", "--simulate", "chf:60,jscc@7")
    assert run(*words).exit_code == 0
    result = run(*words)  # over what the first one wrote
    assert (result.exit_code, result.output[-1:]) == (0, "\n")
    lines = result.output.splitlines()
    assert all(line.startswith("SIMULATED  ") for line in lines)
    assert lines[1] == "SIMULATED  CHF at unit 1: maximum 60 Hz (100 %), FrequencyScale=0.01,"
    assert lines[4] == "SIMULATED  JSCC at unit 7: maximum 50 Hz, ReferenceScale=100"
    assert lines[-1] == "SIMULATED  stopped, and standstill read: Motor"
    rows = Path("t.csv").read_text(encoding="utf-8").splitlines()
    assert rows[:4] == ["# SIMULATED, my.st", "ms,Motor.Running,Hz", "0,0,20", "2000,0,10"]
    assert [row.split(",")[1] for row in rows[2:]] == ["0", "0", "1", "0"]
    drawn = Path("t.svg").read_text(encoding="utf-8")
    told = ("SIMULATED, my.st", "Start := TRUE; Hz := 10.00", "at 5.0 s Start := FALSE", "8 s are over", "forward")
    assert [each for each in told if each not in drawn] == []


def test_a_line_without_rate_and_format_has_those_of_its_block(program: Path) -> None:
    program.write_text(ONE.replace("BitRate := 19200, ", ""), encoding="utf-8")
    made = Setup(Options(program=program, fast=True, length="1s"), Keyboard(0))
    probe = made.probe
    assert (
        (made._line("BitRate"), made._line("CharacterBits"))
        == (probe.number("Bus.Line.Promise.Sums.Rate"), 10)
        == (9600, 10)
    )
    assert probe.number("Bus.Line.Promise.CharUs") == 10 * 1_000_000 // 9600 + 1


def test_a_program_that_fails_ends_with_1_and_says_where(program: Path) -> None:
    Path("run.txt").write_text("at 1s: Divisor := 0\n", encoding="utf-8")
    result = run(program, *FAST)
    assert result.exit_code == 1
    assert "SIMULATED  the program has failed: my.st:17:15: division by zero: stopping every drive" in result.output
    assert "stopped, and standstill read: Motor" in result.output


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no disk is full here")
def test_what_could_not_be_confirmed_is_printed_before_a_file_that_cannot_be_written(program: Path) -> None:
    result = run(program, "--fast", "--for", "1s", "--simulate", "jscc@8", "--picture", "/dev/full")
    assert result.exit_code == 1
    assert result.output.splitlines()[-2:] == [
        "SIMULATED  NOT CONFIRMED: Motor (unit 7): no reply to the stop. Go and look",
        "/dev/full cannot be written: No space left on device",
    ]
    result = run(program, "--fast", "--for", "1s", "--picture", "/dev/full")
    assert result.exit_code == 2
    assert "SIMULATED  stopped, and standstill read: Motor\n" in result.output


def test_a_scenario_happens_to_the_drives_of_a_program(program: Path) -> None:
    Path("day.yaml").write_text("- at 3 s: trip 4 7\n- at 5 s: clear\n- at 7 s: reset\n", encoding="utf-8")
    Path("run.txt").write_text("at 1s: Start := TRUE\n", encoding="utf-8")
    result = run(program, *FAST, "--scenario", "day.yaml", "--show", "Motor.FaultCode")
    assert result.exit_code == 0
    lines = result.output.splitlines()
    assert lines.index("SIMULATED    3.0 s  trip 4 7") < next(
        place for place, line in enumerate(lines) if line.endswith("Motor.FaultCode = 4")
    )


@pytest.mark.parametrize("name", ["invt_chf.yaml", "mine.yaml"])
def test_a_named_map_takes_the_place_of_the_shipped_one(program: Path, name: str) -> None:
    shipped = catalog.resolve("chf")
    Path(name).write_text(shipped.read_text(encoding="utf-8"), encoding="utf-8")
    program.write_text(ONE.replace("JSCC", "CHF"), encoding="utf-8")
    for simulate in ((), ("chf@7",), (f"{name}@7",)):
        maps = () if simulate == (f"{name}@7",) else (name,)
        made = Setup(Options(program=program, maps=maps, simulate=simulate, fast=True, length="1s"), Keyboard(0))
        assert [one.path for line in made._lines for one in line] == [Path(name)]
        assert shipped not in [each.path for each in made._maps]


def test_a_picture_of_somebody_else_and_a_program_stay_as_they_are(program: Path) -> None:
    Path("mine.svg").write_text('<svg xmlns="http://www.w3.org/2000/svg">\n</svg>\n', encoding="utf-8")
    before = {path: path.read_bytes() for path in Path().iterdir()}
    for option in ("--trace", "--picture"):
        for name in ("mine.svg", "my.st"):
            assert run(program, "--fast", "--for", "1s", option, name).exit_code == 2
    assert {path: path.read_bytes() for path in Path().iterdir()} == before


def test_a_run_that_does_not_begin_leaves_the_trace_of_the_last_one(program: Path) -> None:
    assert run(program, "--fast", "--for", "1s", "--trace", "t.csv").exit_code == 0
    before = Path("t.csv").read_bytes()
    Path("mine.svg").write_text("mine", encoding="utf-8")
    for words in (("--port", "no-such-port"), ("--fast", "--for", "2s", "--picture", "mine.svg")):
        assert run(program, *words, "--trace", "t.csv").exit_code == 2
        assert Path("t.csv").read_bytes() == before
    assert run(program, "--fast", "--for", "1s", "--trace", "t.csv", "--show", "Hz").exit_code == 0
    assert Path("t.csv").read_bytes() == b"# SIMULATED, my.st\nms,Hz\n0,20\n"


def test_a_lost_output_is_no_failure_of_the_program(program: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    said = Lines.say

    def lost(screen: Lines, text: str) -> None:
        if "standstill" in text:
            raise BrokenPipeError(32, "Broken pipe")
        said(screen, text)

    monkeypatch.setattr(Lines, "say", lost)
    result = run(program, "--fast", "--for", "1s")
    assert (result.exit_code, result.output.splitlines()[-1]) == (0, "SIMULATED  stopped, and standstill read: Motor")


CALLS = "".join(
    f"FUNCTION F{number} : LREAL\nVAR_INPUT\n  X : LREAL;\nEND_VAR\n  F{number} := {body};\nEND_FUNCTION\n"
    for number, body in ((each, f"F{each - 1}(X) + F{each - 1}(X)" if each else "X") for each in range(31))
)
"""Two to the power of thirty calls, and no loop whose turns could be counted."""


def test_a_first_scan_that_does_not_end_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    released, loaded = threading.Event(), source.load("my.st", ONE, maps())
    monkeypatch.setattr(Controller, "scan", lambda *_: released.wait(NET))
    with pytest.raises(Refused, match=r": the first scan has not ended within 0\.01 s; nothing was sent$"):
        probe.probed(loaded, 10_000, 10_000)
    released.set()


@pytest.mark.thorough
def test_calls_that_do_not_end_are_given_up_and_the_process_ends(program: Path) -> None:
    declared = ONE.replace("  Divisor", "  Endless : BOOL;\n  Sum : LREAL;\n  Divisor", 1)
    body = "  IF Endless THEN\n    Sum := F30(1.0);\n  END_IF;\n  Quotient :="
    program.write_text(CALLS + declared.replace("  Quotient :=", body, 1), encoding="utf-8")
    Path("run.txt").write_text("at 2s: Start := TRUE\nat 5s: Endless := TRUE\n", encoding="utf-8")
    words = [sys.executable, "-m", "driveblocks", "run", str(program), *FAST, "--watchdog", "2s", "--trace", "t.csv"]
    done = subprocess.run(words, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
    lines = done.stdout.splitlines()
    assert (done.returncode, done.stderr, lines[-1]) == (1, "", "SIMULATED  stopped, and standstill read: Motor")
    said = "SIMULATED  the program has failed: a scan has not ended within 2000 ms (--watchdog): it was at "
    (place,) = [line.removeprefix(said) for line in lines if line.startswith(said)]
    assert re.fullmatch(
        r"(.*my\.st:\d+:\d+ in F\d+, called from )?.*my\.st:\d+:\d+ in One: stopping every drive", place
    )
    rows = Path("t.csv").read_text(encoding="utf-8").splitlines()
    assert 2000 <= float(rows[-1].split(",")[0]) < 5000


# ------------------------------------------------------------ the demonstration, and another platform


@pytest.fixture
def windows(tmp_path: Path) -> dict[str, str]:
    """An environment in which every process lacks what Windows lacks."""
    return environment(tmp_path)


@pytest.mark.thorough
def test_the_demonstration_comes_true_without_what_windows_lacks(windows: dict[str, str]) -> None:
    words = [sys.executable, "-m", "driveblocks", "run", "--demo", "--fast"]
    done = subprocess.run(words, env=windows, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")
    lines = done.stdout.splitlines()
    assert [line for line in lines if line.removeprefix("SIMULATED  ") in {act.says for act in demo.ACTS}] == [
        f"SIMULATED  {act.says}" for act in demo.ACTS
    ]
    assert lines[-1] == "SIMULATED  stopped, and standstill read: Pump1, Pump2, Fan"
    assert max(map(len, lines)) <= 80


def test_a_program_runs_in_real_time_at_drives_in_another_process(windows: dict[str, str], program: Path) -> None:
    words = [sys.executable, "-m", "driveblocks", "run", str(program), "--for", "50ms", "--watchdog", "600s"]
    done = subprocess.run(words, env=windows, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
    assert done.stderr == ""
    *lines, scans, took = done.stdout.splitlines()
    assert lines[0] == "SIMULATED  my.st"
    assert "SIMULATED  0.05 s are over: stopping every drive" in lines
    assert " scans of 10 ms: " in scans
    assert took.startswith("a scan took ")


@pytest.mark.parametrize(("words", "label"), [((), "REAL PORT"), (("--simulated",), "SIMULATED")])
def test_what_is_at_an_address_is_real_unless_somebody_says_otherwise(
    words: tuple[str, ...], label: str, program: Path
) -> None:
    """This computer, too, may have a serial port at one of its TCP ports."""
    link = TcpLink(0)
    with serving(Bus([SimulatedDrive(MAPS["JSCC"], 7)], 19200, 10), link):
        result = run(program, "--tcp", link.place, "--for", "1ms", "--watchdog", "600s", *words)
    *lines, _, _ = result.output.splitlines()
    assert (result.exit_code, lines[0]) == (0, f"{label}  {link.place} my.st")
    assert lines[-1] == f"{label}  stopped, and standstill read: Motor"
    assert ("only reads and stops are sent; if a simulator is there, add --simulated" in result.output) == (not words)


def test_what_was_announced_and_did_not_come_true_ends_with_1(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(demo, "FAULT", 0)
    acts = [act if act.says.startswith(("power-up", "start")) else None for act in demo.ACTS]
    kept = tuple(act for act in acts if act)
    monkeypatch.setattr(demo, "ACTS", (*kept, demo.Act("the fan trips", then={"Fan.Fault": True})))
    result = run("--demo", "--fast")
    assert result.exit_code == 1
    assert "the demonstration has failed: stopping every drive" in result.output
    assert "this did not come true: the fan trips" in result.output


def test_the_demonstration_is_the_example() -> None:
    assert demo.path().read_text(encoding="utf-8") == EXAMPLE.read_text(encoding="utf-8")
