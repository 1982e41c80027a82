"""`driveblocks listen`: made traces, a master and a server on a cable, and that nothing is ever sent."""

import json
import os
import re
import signal
import socket
import subprocess
import sys
import threading
from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise
from pathlib import Path
from typing import Any, ClassVar

import pytest
import serial
from click.testing import CliRunner
from tests.desk.run.windows import environment
from tests.desk.site.test_commission import MAPS

from driveblocks import console
from driveblocks.cli import app
from driveblocks.desk.clock import VirtualClock
from driveblocks.desk.exchange import Exchanges, Said
from driveblocks.desk.explain.paste import read
from driveblocks.desk.frames import Cutter, Frame
from driveblocks.desk.port import EXCLUSIVE
from driveblocks.desk.site import ear, listen, overheard
from driveblocks.desk.site.found import Way
from driveblocks.modbus.frame import seal
from driveblocks.modbus.layout import Dialect

POSIX = pytest.mark.skipif(sys.platform == "win32", reason="Windows has no pseudo-terminals and no SIGHUP")
DIFFERENT = b"".join(seal("rtu", bytes([1, 3, 0x10, at, 0, 2])) for at in range(3))
KNOWN = ("--rate", "9600", "--format", "8N1")
READ, WORDS = "01 03 10 00 00 02", "01 03 04 00 05 13 88"
WRITE, REFUSED = "01 06 20 00 00 05", "01 83 02"


def heard(
    *frames: tuple[int, str] | str, mode: str = "rtu", traffic: Exchanges | None = None
) -> tuple[Exchanges, list[Said]]:
    """A trace: frames in hexadecimal without checksum, each 30 ms after the one before or as told; `?`: damaged."""
    made, now, said = traffic or Exchanges({}), 0, []
    for each in frames:
        gap_ms, text = each if isinstance(each, tuple) else (30, each)
        now += 1000 * gap_ms
        data = bytes.fromhex(text.removeprefix("?")) if text[0] == "?" else seal(mode, bytes.fromhex(text))
        said.append(made.hear(Frame(now, now + 1000, data, text[0] != "?")))
        now += 1000
    return made, said


def roles(*frames: tuple[int, str] | str, mode: str = "rtu") -> list[str]:
    return [each.role for each in heard(*frames, mode=mode)[1]]


# ------------------------------------------------------------ who said what


@pytest.mark.parametrize("mode", ["rtu", "ascii"])
def test_requests_replies_refusals_and_broadcasts_are_distinguished(mode: str) -> None:
    said = roles(READ, WORDS, READ, REFUSED, "00 06 20 00 00 05", WRITE, WRITE, "01 10 20 00 00 01 02 00 05",
                 "01 10 20 00 00 01", "02 01 00 00 00 09", "02 01 02 FF 01", "01 08 00 00 12 34", "01 08 00 00 12 34",
                 mode=mode)  # fmt: skip
    pair = ["request", "reply"]
    assert said == [*pair, "request", "refusal", "broadcast", *pair, *pair, *pair, *pair]


@pytest.mark.parametrize(
    ("frames", "right", "odd"),
    [
        ([READ, READ, WORDS, READ, WORDS], ["request", "request", "reply", "request", "reply"],
         ["unit 1 left 1 of 3 requests without a reply"]),
        ([READ, READ], ["request", "request"], ["unit 1 never answers; it was asked 2 times"]),
        ([READ, "02 03 10 00 00 01", WORDS, "02 03 02 00 07"], ["request", "request", "late", "reply"],
         ["unit 1 answered once after the master had given up: its timeout is too short, or the drive slow"]),
        ([READ, WORDS, WORDS], ["request", "reply", "twice"],
         ["two replies came to one request to unit 1, once: two units with this address, or a repeater"]),
        ([READ, WORDS, "01 03 04 00 06 13 88"], ["request", "reply", "twice"],
         ["two replies came to one request to unit 1, once: two units with this address, or a repeater"]),
        ([WORDS, READ, WORDS], ["unasked", "request", "reply"], []),
        ([READ, WORDS, (4000, "01 03 06 00 06 13 88 00 01")], ["request", "reply", "unasked"],
         ["unit 1 answered once to what was not heard: a request was damaged, or came before"]),
        # the first frame may be the echo of a request before: nobody can say that it has no reply
        ([WRITE, READ, WORDS], ["request", "request", "reply"],
         ["unit 1: once a write without a reply, or a second reply: they look the same"]),
        ([READ, "?12 34", WRITE, READ, WORDS], ["request", "damaged", "request", "request", "reply"],
         ["damaged bytes came after 1 of 2 requests to unit 1",
          "unit 1: once a write without a reply, or a second reply: they look the same",
          "5.7 % of all bytes made no good frame, once"]),
        ([READ, WORDS, WRITE, WRITE, WRITE, READ, WORDS],
         ["request", "reply", "request", "reply", "request", "request", "reply"],
         ["unit 1: once a write without a reply, or a second reply: they look the same"]),
        ([READ, (1, "02 03 10 00 00 01"), WORDS, "02 03 02 00 07"] * 2, ["request", "request", "late", "reply"] * 2,
         ["2 requests were sent right after another that had no reply: two masters, or one that does not wait for "
          "replies"]),
        ([READ, (1, READ), WORDS], ["request", "echo", "reply"],
         ["a request was heard again at once, once: a repeater or an adapter that echoes, or a master that does not "
          "wait for replies"]),
        ([READ, REFUSED], ["request", "refusal"], ["unit 1 refused 03H at 1000H-1001H 1 of 1 times"]),
    ],
)  # fmt: skip
def test_what_is_odd_is_named(frames: Sequence[Any], right: list[str], odd: list[str]) -> None:
    traffic, said = heard(*frames)
    assert [each.role for each in said] == right
    assert [says for _, says in overheard.odd(traffic)] == odd


def test_words_are_not_those_of_a_late_reply_to_another_request() -> None:
    traffic, _ = heard(READ, (300, "01 03 30 00 00 02"), WORDS)
    assert traffic.units[1].polls[3, 0x3000, 2].words == ()


def test_polls_have_their_times_and_words() -> None:
    traffic, _ = heard(*[(100, READ), (10, WORDS)] * 5, (100, WRITE), (20, WRITE))
    read_, written = (traffic.units[1].polls[key] for key in ((3, 0x1000, 2), (6, 0x2000, 1)))
    assert (read_.count, read_.replies, read_.every_us, read_.words) == (5, 5, 112_000, (5, 5000))
    assert (read_.shortest_us, read_.longest_us) == (10_000, 10_000)
    assert (written.count, written.words, written.every_us) == (1, (5,), 0)
    assert traffic.silence_us == 100_000


def test_a_map_says_its_refusals_and_its_words() -> None:
    drive = MAPS["invt_chf"]
    traffic, said = heard("01 03 30 00 00 01", "01 03 02 13 88", traffic=Exchanges({1: drive}))
    assert [each.role for each in said] == ["request", "reply"]
    shown = json.dumps(overheard.plain(Way(9600), traffic))
    assert '"words": [5000]' in shown
    lines = list(overheard._words(1, (3, 0x3000, 1), traffic.units[1].polls[3, 0x3000, 1], traffic))
    assert lines == ["Running frequency: 5000; no standstill"]


# ------------------------------------------------------------ frames from bytes


@pytest.mark.parametrize("mode", ["rtu", "ascii"])
def test_frames_are_cut_however_their_bytes_are_handed_over(mode: str) -> None:
    bodies = [bytes.fromhex(each) for each in (READ, WORDS, WRITE, WRITE, "3A 03 02 00 01", REFUSED)]
    whole = [seal(mode, each) for each in bodies]
    for size in (*range(1, 40), 1000):
        cutter, found = Cutter([Dialect()], 1042), list[Frame]()
        data = b"".join(whole)
        for at in range(0, len(data), size):
            found += cutter.take(1000 * (at + size), data[at : at + size])
        found += cutter.take(10_000_000, b"")
        assert [(each.data, each.good) for each in found] == [(each, True) for each in whole]
        assert all(each.begin_us <= each.end_us for each in found)
        assert all(one.end_us <= two.begin_us for one, two in pairwise(found))


def test_a_reply_that_begins_as_a_request_would_is_one_frame() -> None:
    frame = seal("rtu", seal("rtu", bytes.fromhex("03 03 06 12 34 56")) + b"\x78")
    for size in (8, 9):
        cutter = Cutter([Dialect()], 1042)
        found = [*cutter.take(0, frame[:size]), *cutter.take(9000, frame[size:]), *cutter.rest()]
        assert [each.data for each in found] == [frame]


def test_a_broadcast_after_a_reply_begins_a_frame_of_its_own() -> None:
    frames = [seal("rtu", bytes.fromhex(each)) for each in ("01 03 02 EC DD", "00 06 20 00 00 05")]
    cutter = Cutter([Dialect()], 1042)
    assert [each.data for each in (*cutter.take(0, b"".join(frames)), *cutter.rest())] == frames
    reply = seal("rtu", bytes.fromhex("03 03 04 12 34 56") + seal("rtu", bytes.fromhex("03 03 04 12 34 56"))[6:7])
    assert reply[-1] == 0
    for size in (8, 9):
        found = [*cutter.take(0, reply[:size]), *cutter.take(1000, reply[size:]), *cutter.take(30_000, b"")]
        assert [each.data for each in found] == [reply]


def test_damaged_bytes_do_not_take_good_frames_with_them() -> None:
    good = [seal("rtu", bytes.fromhex(each)) for each in (READ, WORDS)]
    odd = bytes.fromhex("07 41 05 06")  # a function that is not known here, with a good CRC
    cutter = Cutter([Dialect()], 1042)
    found = [*cutter.take(0, b"\x00\xff" + good[0]), *cutter.take(50_000, good[1]), *cutter.take(100_000, b"\x01\x03")]
    found += [*cutter.take(130_000, b""), *cutter.take(140_000, seal("rtu", odd)), *cutter.rest()]
    assert [(each.data, each.good) for each in found] == [
        (b"\x00\xff", False), (good[0], True), (good[1], True), (b"\x01\x03", False), (seal("rtu", odd), True)
    ]  # fmt: skip


def test_noise_without_an_end_is_cut_and_good_frames_are_heard_after_it() -> None:
    cutter, frame = Cutter([Dialect()], 100), seal("rtu", bytes.fromhex(READ))
    found = [each for at in range(100) for each in cutter.take(1000 * at, bytes([at] * 20))]
    assert found
    assert not any(each.good for each in found)
    found = [*cutter.rest(), *cutter.take(200_000, frame), *cutter.take(220_000, b"")]
    assert found[-1].data == frame
    assert found[-1].good


def test_frames_among_noise_without_a_pause_stay_whole() -> None:
    good = [seal("rtu", bytes.fromhex(each)) for each in (READ, WORDS)]
    cutter, found = Cutter([Dialect()], 1042), list[Frame]()
    for turn in range(60):
        noise = bytes([0x45, turn, 0xE0 ^ turn][: 1 + turn % 3])
        found += cutter.take(10_000 * turn, noise + good[turn % 2])
    found += cutter.rest()
    assert [each.data for each in found if each.good] == 30 * good


# ------------------------------------------------------------ rate and format


class Coarse(VirtualClock):
    """Looks at the line every 20 ms instead of each."""

    def sleep_until(self, us: int) -> None:
        super().sleep_until(us + 19_000)


class Tape:
    """A line that says a frame every 100 ms, and gibberish to those who hear it at another rate or format."""

    def __init__(self, clock: VirtualClock, way: Way | None, mode: str = "rtu", refused: str = "") -> None:
        self.clock, self.way, self.mode, self.refused = clock, way, mode, refused
        self.tuned, self.said = Way(9600), 0

    def tune(self, way: Way) -> bool:
        self.tuned = way
        return way.form != self.refused

    def receive(self) -> bytes:
        turn = self.clock.now_us() // 100_000
        if self.way is None or turn == self.said:
            return b""
        self.said = turn
        right = (self.tuned.rate, self.tuned.form) == (self.way.rate, self.way.form)
        return seal(self.mode, bytes.fromhex(READ)) if right else bytes([turn & 255, 0xFF, 0x00])

    def close(self) -> None: ...


@pytest.mark.parametrize("mode", ["rtu", "ascii"])
@pytest.mark.parametrize("way", ear.ways(None, None), ids=str)
def test_rate_and_format_are_those_at_which_frames_decode(way: Way, mode: str) -> None:
    clock = Coarse()
    found, came = ear.find(Tape(clock, way, mode), clock, ear.ways(None, None), [Dialect()], lambda *_: None)
    assert found == replace(way, mode="rtu" if mode == "rtu" else "ascii")
    assert came > 0


@pytest.mark.parametrize("way", [None, Way(14400)])
def test_a_line_that_does_not_decode_is_given_up_within_eight_minutes(way: Way | None) -> None:
    clock = Coarse()
    found, came = ear.find(Tape(clock, way, refused="7E1"), clock, ear.ways(None, None), [Dialect()], lambda *_: None)
    assert (found, came > 0) == (None, way is not None)
    assert clock.now_us() <= 8 * 60_000_000


# ------------------------------------------------------------ nothing is ever sent


class Fake:
    """What pyserial is, as far as a listener may use it."""

    made: ClassVar[list[Any]] = []

    def __init__(self, **options: Any) -> None:
        self.options, self.is_open, self.rts, self.dtr, self.port = options, False, True, True, ""
        self.said = DIFFERENT
        Fake.made.append(self)

    def open(self) -> None:
        assert (self.rts, self.dtr, self.port) == (False, False, "COM3")
        self.is_open = True

    def read(self, _: int) -> bytes:
        said, self.said = self.said, b""
        if not said:
            raise KeyboardInterrupt  # nothing else will come
        return said

    def close(self) -> None:
        self.is_open = False


def test_a_port_is_opened_once_with_both_signals_low_and_nothing_to_send_with(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(serial, "Serial", Fake)
    Fake.made.clear()
    way, traffic, ended, wrong = listen.run(listen.Words(port="COM3", rate=19200, form="8e1"), VirtualClock())
    (port,) = Fake.made
    assert (way, traffic.requests, ended, wrong) == (Way(19200, "8E1"), 3, "", [])
    assert port.options == {"timeout": 0, "exclusive": EXCLUSIVE}
    assert [vars(port)[each] for each in ("baudrate", "bytesize", "parity", "is_open")] == [19200, 8, "E", False]
    for each in (ear.SerialEar, ear.TcpEar):
        assert not {name for name in vars(each) if re.search("write|send", name)}


# ------------------------------------------------------------ at a port, from beginning to end


def test_a_line_is_heard_to_its_end_and_kept(tmp_path: Path) -> None:
    log, table = tmp_path / "line.log", tmp_path / "line.csv"
    said = ["05 03 30 00 00 02", "05 03 04 00 00 00 07", "05 03 77 77 00 01", "05 83 02"] * 5
    with socket.create_server(("127.0.0.1", 0)) as server:

        def speak() -> None:
            other, _ = server.accept()
            with other:
                other.sendall(b"".join(seal("rtu", bytes.fromhex(each)) for each in said))

        line = threading.Thread(target=speak)
        line.start()
        place = f"127.0.0.1:{server.getsockname()[1]}"
        words = ["listen", "chf@5", "--tcp", place, "--log", str(log), "--csv", str(table), "--json"]
        got = CliRunner().invoke(app, words)
        line.join()
    assert (got.exit_code, got.stderr) == (1, "Ended early: the other side has closed the connection\n")
    found = json.loads(got.stdout)
    (five,) = found["units"]
    assert (found["requests"], found["damaged"], five["unit"]) == (10, 0, 5)
    counts = {(each["function"], each["address"]): (each["replies"], each["refusals"]) for each in five["polls"]}
    assert counts == {(3, 0x3000): (5, 0), (3, 0x7777): (0, 5)}
    assert [each["says"] for each in found["odd"]] == ["unit 5 refused 03H at 7777H 5 of 5 times"]
    first, *frames, last = log.read_text(encoding="utf-8").splitlines()
    assert (first[0], last[0], len(frames)) == ("#", "#", 20)
    assert last.endswith("ended: the other side has closed the connection")
    assert all(len(read(each).data) >= 5 for each in frames)
    rows = table.read_text(encoding="utf-8").splitlines()
    assert (rows[0], len(rows)) == (",".join(overheard.COLUMNS), 21)


@POSIX
@pytest.mark.parametrize(
    ("number", "status", "last"), [("SIGINT", 0, " ended"), ("SIGHUP", 1, " ended: the terminal was closed")]
)
def test_a_log_says_how_far_it_came(number: str, status: int, last: str, tmp_path: Path) -> None:
    import tty

    master, side = os.openpty()
    tty.setraw(side)
    log = tmp_path / "line.log"
    words = [sys.executable, "-m", "driveblocks", "listen", "--port", os.ttyname(side), *KNOWN]
    with subprocess.Popen([*words, "--log", str(log)], stdout=subprocess.PIPE, stderr=subprocess.STDOUT) as done:
        while not (log.exists() and " > " in log.read_text(encoding="utf-8")):
            os.write(master, seal("rtu", bytes.fromhex(READ)))
            threading.Event().wait(0.01)
            assert done.poll() is None
        done.send_signal(getattr(signal, number))
        done.communicate()
    assert done.returncode == status
    text = log.read_text(encoding="utf-8")
    assert text.splitlines()[-1].endswith(last)
    assert text.endswith("\n")


COM3 = """
import sys, types
from driveblocks.cli import main
FRAME = bytes.fromhex("01 03 10 00 00 02 C0 CB")

class Serial:
    is_open = False
    def __init__(self, **_):
        self.said = [FRAME] * 4
    def open(self):
        assert self.port == "COM3"
        self.is_open = True
    def read(self, most):
        return self.said.pop() if self.said else b""
    def close(self):
        self.is_open = False

sys.modules["serial"] = types.SimpleNamespace(Serial=Serial)
main()
"""


def test_a_port_of_windows_is_listened_to(tmp_path: Path) -> None:
    words = ["listen", "--port", "COM3", *KNOWN, "--for", "300ms", "--log", str(tmp_path / "line.log")]
    done = subprocess.run(
        [sys.executable, "-c", COM3, *words], env=environment(tmp_path), capture_output=True, text=True, check=False
    )
    assert (done.returncode, done.stderr) == (0, "")
    assert "9600 bit/s" in done.stdout


@POSIX
@pytest.mark.parametrize("log", [False, True])
def test_a_full_disk_takes_nothing_of_what_was_heard(log: bool, tmp_path: Path) -> None:
    table, other = tmp_path / "line.csv", tmp_path / "line.log"
    limit = "import resource\nresource.setrlimit(resource.RLIMIT_FSIZE, (120, resource.RLIM_INFINITY))\n"
    words = ["listen", "--port", "COM3", *KNOWN, "--for", "300ms", "--csv", str(table), *["--log", str(other)] * log]
    done = subprocess.run([sys.executable, "-c", limit + COM3, *words], capture_output=True, text=True, check=False)
    paths = [*[other] * log, table]
    assert done.stderr.splitlines() == [f"{each} is not complete: File too large" for each in paths]
    assert done.returncode == 1
    assert "4 frames, " in done.stdout
    for path in paths:
        text = path.read_text(encoding="utf-8")
        assert text.endswith("\n")
        assert 1 < len(text.splitlines()) < 4
    rows = [line.split(",") for line in table.read_text(encoding="utf-8").splitlines()]
    assert {len(each) for each in rows} == {len(overheard.COLUMNS)}


def test_all_wrong_words_are_reported_at_once(tmp_path: Path) -> None:
    mine = tmp_path / "mine.log"
    mine.write_text("mine", encoding="utf-8")
    words = ["nothing", "chf@0", "chf", "jscc", "--tcp", "x", "--rate", "1", "--format", "9N1", "--for", "soon"]
    got = CliRunner().invoke(app, ["listen", *words, "--log", str(mine), "--csv", str(mine)])
    assert got.exit_code == 2
    for wrong in ("--tcp x is no address", "--rate 1 is out of range", "--format 9N1", "mine.log is there already",
                  "--log and --csv name one file", "--for", "nothing", "chf@0: write MAP@UNIT",
                  "jscc: only one map may be without a unit"):  # fmt: skip
        assert wrong in got.stderr, wrong
    assert mine.read_text(encoding="utf-8") == "mine"


PAGE = Path(__file__).parents[3] / "docs" / "listen.md"
SESSION = [
    *[(40, "01 03 30 00 00 02"), (8, "01 03 04 13 88 13 88"), (40, "02 03 20 00 00 01"), (12, "02 03 02 00 01"),
      (40, "01 06 20 00 0F A0"), (9, "01 06 20 00 0F A0"), (40, "07 03 00 00 00 01")] * 20,
    (200, "?00 FF 13"), (40, "01 03 30 00 00 02"), (8, "01 03 04 13 88 13 88"), (1, "01 03 04 13 88 13 89"),
]  # fmt: skip


def test_the_session_of_the_page_is_what_a_person_sees(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("COLUMNS", "100")
    traffic, _ = heard(*SESSION, traffic=Exchanges({1: MAPS["invt_chf"], 2: MAPS["jscc"]}))
    console.write(*overheard.tables(Way(19200), traffic))
    shown = PAGE.read_text(encoding="utf-8").partition("<!-- session:begin -->\n```\n")[2]
    assert capsys.readouterr().out == shown.partition("```\n<!-- session:end -->")[0]
