"""The command: its words, its screens, what a real port asks for; and neither pty nor termios where there are none."""

import re
import subprocess
import sys
from pathlib import Path

import pytest
from click.testing import CliRunner
from tests.desk.run.windows import environment
from tests.simulator.talk import MAPS, pairs, prepared

from driveblocks.bench.simulator.drive import SimulatedDrive
from driveblocks.cli import app
from driveblocks.desk.bus import Bus, Frame
from driveblocks.desk.clock import VirtualClock
from driveblocks.desk.explain.trace import Tracer
from driveblocks.desk.simulate.link import WithoutEcho
from driveblocks.desk.simulate.neighbour import LISTEN_US, Neighbours
from driveblocks.modbus.frame import Mode, seal


def said(*words: str, status: int = 0) -> str:
    """What the command says."""
    result = CliRunner().invoke(app, ["simulate", *words])
    assert result.exit_code == status, result.output
    return result.output


@pytest.mark.parametrize(
    ("words", "says"),
    [
        ([], "name a drive; for example: driveblocks simulate jscc@1"),
        (["jscc", "--tcp", "0.0.0.0:5020"], "this computer only; write --tcp 127.0.0.1:5020"),
        (["jscc", "--tcp", "5020"], "--tcp 5020: a simulator serves this computer only"),
        (["jscc", "--tcp", ":5020", "--pty"], "--tcp and --pty exclude each other"),
        (["jscc@1", "chf@1"], "chf@1: units are 1 to 247, one drive each; write chf@2"),
        (["jscc@248"], "jscc@248: units are 1 to 247"),
        (["nobody"], "there is no drive `nobody`"),
        (["jscc", "--baud", "7"], "--baud 7 is no rate"),
        (["jscc", "--format", "9N1"], "--format 9N1 is no format"),
        (["jscc", "--port", ""], "--port names no port"),
        (["jscc", "--for", "soon"], "--for: `soon` is no time"),
        (["jscc", "--scenario", "nowhere.yaml"], "nowhere.yaml:1:1: this file cannot be read"),
        (["jscc", "--port", "/dev/nowhere"], "/dev/nowhere: "),
    ],
)
def test_wrong_words_are_reported(words: list[str], says: str) -> None:
    assert says in said(*words, status=2)


def test_every_line_says_that_it_is_simulated(tmp_path: Path) -> None:
    path = tmp_path / "day.yaml"
    path.write_text("- at 0 s: trip 3 1\n- at 1 ms: power off 2\n", encoding="utf-8")
    lines = said(
        "jscc:ReferenceScale=10", "chf:60", "--tcp", ":0", "--for", "250ms", "--scenario", str(path)
    ).splitlines()
    assert all(line.startswith("SIMULATED  ") for line in lines)
    place = r"on 127\.0\.0\.1:\d+; Ctrl-C ends"
    assert re.search(rf"JSCC at unit 1, CHF at unit 2; MODBUS RTU, 19200 bit/s 8E1, {place}", lines[0])
    assert lines[1] == "SIMULATED  JSCC at unit 1: maximum 50 Hz, ReferenceScale=10"
    assert lines[2] == "SIMULATED  CHF at unit 2: maximum 60 Hz (100 %), FrequencyScale=0.01,"
    text = "\n".join(lines)
    for part in (
        "trip 3 1",
        "JSCC 0.0 Hz fault 3 Overcurrent",
        "power off 2",
        "CHF 0.0 Hz no power",
        "0.25 s are over",
    ):
        assert part in text
    assert "JSCC at unit 1: 0 requests, 0 replies, 0 of them refusals" in text


@pytest.mark.parametrize("words", [("--tcp", ":0", "--for", "1ms"), ("--pty",)])
def test_what_windows_lacks_is_not_needed_for_tcp(words: tuple[str, ...], tmp_path: Path) -> None:
    command = [sys.executable, "-m", "driveblocks", "simulate", "jscc", *words]
    done = subprocess.run(command, env=environment(tmp_path), capture_output=True, text=True, check=False)
    if words[0] == "--tcp":
        assert (done.returncode, done.stderr) == (0, "")
        return
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith("--pty: this system has no pseudo-terminals; write --tcp 127.0.0.1:5020")


def test_a_trace_says_what_explain_says() -> None:
    prefix, request, reply = next(each for each in pairs() if each[1].id == "read_frequency_rtu_request")
    bus = Bus([prepared(prefix, request, reply)], 19200, 10)
    bus.send(request.correct, 0)
    bus.receive(100_000)
    tracer = Tracer({bus.drives[0].unit: MAPS[prefix]})
    assert [line.strip() for frame in bus.frames for line in tracer.lines(frame)] == [
        "0.004 s > 01 03 20 00 00 01 8F CA",
        "Good RTU request to unit 1: read 1 register from 2000H",
        "0.009 s < 01 03 02 01 F4 B8 53",
        "Good RTU reply of unit 1: 1 register read",
        "2000H  01F4H  Output frequency: 500 = 50.0 Hz; no standstill",
    ]
    assert "Wrong RTU frame" in list(tracer.lines(Frame(0, reply.correct[:-1], reply=True)))[1].strip()


def test_a_flood_makes_nobody_deaf_for_long() -> None:
    prefix, request, reply = next(each for each in pairs() if each[1].id == "read_frequency_rtu_request")
    bus = Bus([prepared(prefix, request, reply)], 19200, 10)
    for at_us in range(0, 1_000_000, 10_000):
        bus.send(bytes(4096), at_us)
    bus.send(request.correct, 5_000_000)
    assert bus.receive(5_100_000) == reply.correct


@pytest.mark.parametrize(("what", "kept"), [("drop", 0), ("damage", 1)])
def test_what_is_lost_and_damaged_is_counted(what: str, kept: int) -> None:
    prefix, request, reply = next(each for each in pairs() if each[1].id == "read_frequency_rtu_request")
    bus = Bus([prepared(prefix, request, reply)], 19200, 10)
    setattr(bus.loss, what, 0.4)
    heard = b""
    for number in range(100):
        bus.send(request.correct, number * 100_000)
        heard += bus.receive(number * 100_000 + 99_000)
    counts, loss = bus.counts[1], bus.loss
    lost = loss.dropped + loss.damaged
    replies = sum(frame.reply for frame in bus.frames)
    assert counts.heard == counts.replied == replies
    gone = 100 - counts.heard + replies - heard.count(reply.correct)
    assert lost == sum(bool(frame.fate) for frame in bus.frames) == gone
    assert len(heard) == len(reply.correct) * (replies if kept else heard.count(reply.correct))
    assert 0 < counts.heard < 100
    assert lost > 100 - counts.heard


# ------------------------------------------------------------ a real port


class Line:
    """A line with real units in virtual time, perhaps with a master and with an echo of the adapter."""

    late_ms = 0
    error = ""

    def __init__(self, clock: VirtualClock, units: tuple[int, ...], master: bytes = b"", *, echo: bool = False) -> None:
        self.clock, self.echo, self.master = clock, echo, master
        self.wire = Bus([SimulatedDrive(MAPS["JSCC"], unit) for unit in units], 19200, 10)
        self.waiting = b""
        self.next_us = 0

    def send(self, data: bytes) -> None:
        self.wire.send(data, self.clock.now_us())
        self.waiting += data if self.echo else b""

    def receive(self) -> bytes:
        now = self.clock.now_us()
        if self.master and now >= self.next_us:
            self.next_us = now + 300_000
            self.wire.send(self.master, now)
            self.waiting += self.master
        data, self.waiting = self.waiting + self.wire.receive(now), b""
        return data

    def close(self) -> None:
        """Nothing to give back."""


def judged(units: tuple[int, ...], master: bytes = b"", *, echo: bool = False) -> tuple[str, Neighbours, list[str]]:
    """Whether units 1 and 2 may be simulated beside real ones."""
    clock, told = VirtualClock(), list[str]()
    neighbours = Neighbours(
        Line(clock, units, master, echo=echo), clock, {1: MAPS["JSCC"], 2: MAPS["CHF"]}, ascii_mode=False
    )
    why = neighbours.found(told.append)
    assert clock.now_us() >= LISTEN_US
    return why, neighbours, told


POLL = seal("rtu", bytes.fromhex("02 03 20 00 00 01"))
WRITE = seal("rtu", bytes.fromhex("02 06 10 00 00 03"))
OTHER = seal("rtu", bytes.fromhex("09 03 20 00 00 01"))


@pytest.mark.parametrize("master", [b"", POLL, WRITE, OTHER], ids=["quiet", "poll", "write", "other"])
@pytest.mark.parametrize("echo", [False, True])
def test_it_refuses_where_a_real_unit_answers_the_master_or_the_question(master: bytes, echo: bool) -> None:
    why, _, told = judged((2, 9), master, echo=echo)
    assert why.startswith("a real unit answers at address 2: ")
    assert told[0] == "listening for 3 s for real units at 1, 2"
    assert len(told) == (1 if master in (POLL, WRITE) else 3)


@pytest.mark.parametrize("master", [b"", POLL, OTHER], ids=["quiet", "poll", "other"])
@pytest.mark.parametrize("echo", [False, True])
def test_it_goes_on_beside_others_and_learns_of_an_echo(master: bytes, echo: bool) -> None:
    why, neighbours, _ = judged((9,), master, echo=echo)
    assert (why, neighbours.echo) == ("", echo)


def test_an_echo_is_taken_out_and_a_request_is_not() -> None:
    line = Line(VirtualClock(), (), echo=True)
    link = WithoutEcho(line)
    link.send(b"reply")
    assert link.receive() == b""
    link.send(b"reply")
    line.waiting += POLL
    assert link.receive() == POLL
    line.waiting = b"reply"
    assert link.receive() == b"reply"


@pytest.mark.parametrize("ascii_mode", [False, True])
def test_a_request_is_heard_after_the_frames_of_others(ascii_mode: bool) -> None:
    """On a busy line no pause is long enough to say where it begins."""
    mode: Mode = "ascii" if ascii_mode else "rtu"
    bus = Bus([SimulatedDrive(MAPS["JSCC"], 1)], 19200, 10, ascii_mode=ascii_mode)
    other = seal(mode, bytes.fromhex("09 03 02 12 34"))
    for number, request in enumerate(("01 03 20 00 00 01", "01 10 10 00 00 01 02 00 04")):
        bus.send(other + seal(mode, bytes.fromhex(request)), number * 1_000_000)
        assert bus.receive(number * 1_000_000 + 900_000)
    assert bus.strange == 2 * len(other)
