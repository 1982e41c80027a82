"""A line that is only listened to: what is on it is named, nothing is ever sent, and files are whole at any moment."""

import errno
import json
import os
import signal
import socket
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
import serial
from click.testing import CliRunner, Result
from pymodbus.client import ModbusSerialClient
from pymodbus.simulator import SimDevice
from tests.plc.windows import environment
from tests.site.heard import KINDS, LOOK_US, line, listened
from tests.site.test_commission import MAPS
from tests.site.test_peer import UNIT, peer, words

from driveblocks.cli import app
from driveblocks.desk.bus import Bus
from driveblocks.desk.clock import VirtualClock
from driveblocks.desk.port import Tap, WirePort
from driveblocks.modbus.frame import opened, seal
from driveblocks.simulator.drive import SimulatedDrive
from driveblocks.site import listen
from driveblocks.site.findings import Findings, said
from driveblocks.site.found import Way
from driveblocks.site.overheard import Caught, Ear
from driveblocks.site.spoken import plain

READ, REPLY = "010320000002", "01030400110022"
OTHER, OTHER_REPLY = "020321000001", "0203020033"
WRITE = "010610000001"
SEEDS = {"echo": 4, "refused": 3, "late": 1, "twice": 3, "masters": 3}
"""Lines that are heard soon."""
needs_pty = pytest.mark.skipif(sys.platform == "win32", reason="has no pseudo-terminals")


def findings(*frames: tuple[int, str]) -> Findings:
    """What frames say that come after a pause in ms; `!` before a frame damages it."""
    found, ear, at = Findings({}), Ear("rtu", 1000), 0
    for pause, text in frames:
        at += 1000 * pause
        data = seal("rtu", bytes.fromhex(text.removeprefix("!")))
        data = data[:-1] + bytes([data[-1] ^ 1]) if text.startswith("!") else data
        for one in ear.take(at, data):
            found.take(one)
    for one in ear.end():
        found.take(one)
    found.finish()
    return found


def kinds(found: Findings) -> dict[str, int | None]:
    """What is said, and of which unit."""
    return {each.kind: each.unit for each in said(found)}


ROUND = ((100, READ), (20, REPLY), (100, OTHER), (20, OTHER_REPLY))


@pytest.mark.parametrize(
    ("frames", "expected"),
    [
        (4 * ROUND, {}),
        (4 * ((100, READ), (20, REPLY), (100, OTHER)), {"silent": 2}),
        (4 * ((100, READ), (300, OTHER), (5, REPLY), (20, OTHER_REPLY)), {"late": 1}),
        (4 * ((100, READ), (20, REPLY), (3, REPLY)), {"twice": 1}),
        (4 * ((100, READ), (1, READ), (20, REPLY)), {"echo": 1}),
        (4 * ((100, READ), (20, "018302")), {"refused": 1}),
        (4 * ((100, "000610000001"), *ROUND), {}),
        (4 * ((100, WRITE), (10, WRITE)), {"unclear": 1}),
        (4 * ((100, WRITE), (10, WRITE), *ROUND), {}),
        (4 * (*ROUND, (100, READ), (20, "!" + REPLY)), {"damaged": None}),
        (4 * ((100, READ), (80, REPLY), (100, READ), (3, OTHER), (20, OTHER_REPLY)), {"masters": None}),
        (((100, READ), (300, OTHER), (20, OTHER_REPLY), *ROUND, (30, REPLY)), {"late or twice": 1}),
        (((100, OTHER), (20, OTHER_REPLY), (100, "!" + READ), (20, REPLY)), {"damaged": None, "stray": 1}),
        ((*ROUND, (100, "012B0E0100"), (30, "012B0E01010000")), {}),
    ],
)
def test_what_is_unusual_is_named_and_nothing_else(
    frames: tuple[tuple[int, str], ...], expected: dict[str, int | None]
) -> None:
    assert kinds(findings(*frames)) == expected


def test_who_is_asked_how_often() -> None:
    found = findings((0, "!" + READ), *5 * ROUND)
    ask = found.units[1].asks[3, 0x2000, 2]
    assert (ask.times, ask.every_us, ask.gap_us, ask.words, ask.answered) == (5, 240_000, 240_000, (0x11, 0x22), 5)
    assert found.units[1].reply_us == (20_000, 20_000)
    assert (found.good, found.damaged, found.silence_us) == (20, 0, 100_000)
    assert plain(found, Way(9600))["requests"][0]["times"] == 5


def test_words_are_not_kept_where_a_reply_may_be_to_an_earlier_request() -> None:
    found = findings((0, READ), (20, REPLY), (100, READ), (300, "010330000002"), (5, "010304AAAABBBB"))
    assert found.units[1].asks[3, 0x3000, 2].words == ()


@pytest.mark.parametrize("kind", KINDS)
def test_a_line_is_named(kind: str) -> None:
    verdict = line(SEEDS.get(kind, 2), kind)
    assert verdict.state == "named", verdict.why


def test_a_reply_that_begins_as_a_request_would_is_one_frame() -> None:
    frame = next(
        each
        for word in range(0x10000)
        if (each := seal("rtu", bytes.fromhex("0303041234") + word.to_bytes(2, "big"))) and opened("rtu", each[:-1])
    )
    for cut in (len(frame), len(frame) - 1):
        ear = Ear("rtu", 1000)
        caught = [*ear.take(0, frame[:cut]), *ear.take(1000, frame[cut:]), *ear.end()]
        assert [one.data for one in caught] == [frame]


@pytest.mark.parametrize("mode", ["rtu", "ascii"])
def test_frames_are_found_in_any_pieces(mode: str) -> None:
    frames = [seal("ascii" if mode == "ascii" else "rtu", bytes.fromhex(each)) for each in (READ, REPLY, OTHER)]
    data = b"\xfe\x01" + frames[0] + frames[1] + b"\x07" + frames[2]
    for size in (1, 2, 7, len(data)):
        ear = Ear("ascii" if mode == "ascii" else "rtu", 1000)
        caught: list[Caught] = []
        for at in range(0, len(data), size):
            caught += ear.take(1000 * at, data[at : at + size])
        caught += ear.end()
        assert [one.data for one in caught if one.body] == frames
        assert b"".join(one.data for one in caught) == data


@pytest.mark.parametrize("stem", MAPS)
def test_refusals_and_names_are_those_of_the_map(stem: str) -> None:
    bus, clock = Bus([SimulatedDrive(MAPS[stem], 7)], 9600, 10), VirtualClock()
    wire, found, ear = WirePort(bus, clock), Findings({7: MAPS[stem]}), Ear("rtu", 1042)
    for _ in range(4):
        request = seal("rtu", b"\x07\x03\xff\xfe\0\1")
        wire.send(request)
        for data in (request, b""):
            clock.sleep_until(clock.now_us() + 60_000)
            for one in ear.take(clock.now_us(), data or wire.receive()):
                found.take(one)
    assert kinds(found) == {"refused": 7}


# ------------------------------------------------------------ at a port


@contextmanager
def spoken(*bodies: str, pause_s: float = 0.01) -> Iterator[tuple[str, Callable[[], None]]]:
    """A terminal at which a master and its drives are heard; its name, and what unplugs it."""
    import tty

    ours, theirs = os.openpty()
    tty.setraw(theirs)
    over, write = threading.Event(), os.write

    def speak() -> None:
        while not over.is_set():
            for each in bodies:
                write(ours, seal("rtu", bytes.fromhex(each)))
                time.sleep(pause_s)
        os.close(ours)

    thread = threading.Thread(target=speak)
    thread.start()

    def unplug() -> None:
        over.set()
        thread.join()

    try:
        yield os.ttyname(theirs), unplug
    finally:
        unplug()
        os.close(theirs)


def typed(*some: str) -> Result:
    """The command in this process."""
    return CliRunner().invoke(app, ["listen", *some])


@needs_pty
def test_nothing_is_ever_written_to_the_port(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    written: list[object] = []
    log, table = tmp_path / "line.log", tmp_path / "line.csv"
    with spoken(READ, REPLY, WRITE, WRITE) as (name, _):
        monkeypatch.setattr(os, "write", lambda *some: written.append(some))
        monkeypatch.setattr(serial.Serial, "write", lambda *some: written.append(some))
        got = typed("jscc@1", "--port", name, "--for", "1s", "--log", str(log), "--csv", str(table))
    assert (got.exit_code, got.stderr, written) == (0, "", [])
    assert "Output frequency" in got.stdout
    assert "1,3,2000H,,Output frequency,read," in table.read_text("utf-8")
    lines = log.read_text("utf-8").splitlines()
    assert lines[0].startswith(f"# driveblocks listen {name}, ")
    assert lines[-1].startswith("# ended, its time is over: ")
    assert sum(" > " in each for each in lines) > 3
    for one in ("\n".join(lines[:6]), next(each for each in lines if " > " in each)):
        explained = CliRunner().invoke(app, ["explain", "-", "--drive", "jscc"], input=one)
        assert "Traceback" not in explained.output
        assert "2000H" in explained.stdout or "1000H" in explained.stdout


def test_nothing_is_ever_written_to_a_connection(monkeypatch: pytest.MonkeyPatch) -> None:
    sent: list[object] = []
    with socket.create_server(("127.0.0.1", 0)) as server:
        over = threading.Event()

        def speak() -> None:
            peer_, _ = server.accept()
            while not over.is_set():
                for each in (READ, REPLY):
                    os.write(peer_.fileno(), seal("rtu", bytes.fromhex(each)))
                    time.sleep(0.01)
            peer_.close()

        thread = threading.Thread(target=speak)
        thread.start()
        for name in ("send", "sendall"):
            monkeypatch.setattr(socket.socket, name, lambda *some: sent.append(some))
        got = typed("--tcp", f"127.0.0.1:{server.getsockname()[1]}", "--rate", "19200", "--for", "1s", "--json")
        over.set()
        thread.join()
    found = json.loads(got.stdout)
    assert (got.exit_code, sent, found["rate"], found["mode"], found["findings"]) == (0, [], 19200, "rtu", [])
    assert found["requests"][0]["address"] == 0x2000


@needs_pty
def test_an_adapter_that_is_unplugged(tmp_path: Path) -> None:
    log = tmp_path / "line.log"
    with spoken(READ, REPLY) as (name, unplug):
        threading.Timer(1, unplug).start()
        got = typed("--port", name, "--rate", "9600", "--format", "8N1", "--log", str(log))
    assert got.exit_code == 1
    assert got.stderr.startswith("the port does not work any more: ")
    assert "2000H" in got.stdout
    assert "# ended, the port does not work any more: " in log.read_text("utf-8").splitlines()[-1]


@needs_pty
@pytest.mark.parametrize("number", [signal.SIGINT, getattr(signal, "SIGHUP", 0), signal.SIGTERM])
def test_the_log_says_how_far_it_came_whatever_ends_it(number: int, tmp_path: Path) -> None:
    log, table = tmp_path / "line.log", tmp_path / "line.csv"
    with spoken(READ, REPLY) as (name, _):
        command = [
            sys.executable,
            "-m",
            "driveblocks",
            "listen",
            "--port",
            name,
            "--log",
            str(log),
            "--csv",
            str(table),
        ]
        with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
            while not (log.exists() and log.read_bytes().count(b"\n") > 10):
                assert process.poll() is None
                time.sleep(0.02)
            process.send_signal(number)
            process.communicate()
    lines = log.read_text("utf-8").splitlines()
    assert process.returncode == 0
    assert lines[-1].startswith(f"# ended, {listen.NAMES[signal.Signals(number).name]}: ")
    assert all(each[0] == "#" or each.endswith(seal("rtu", bytes.fromhex(READ)).hex(" ").upper())
               or each.endswith(seal("rtu", bytes.fromhex(REPLY)).hex(" ").upper()) for each in lines)  # fmt: skip
    assert table.read_text("utf-8").count("\n") == 3
    assert [each.name for each in tmp_path.iterdir() if each.name.endswith(".part")] == []


@needs_pty
@pytest.mark.parametrize("stem", ["jscc"])
def test_pymodbus_and_its_client_are_heard_at_a_third_end(stem: str) -> None:
    import tty

    (client, client_end), (ear, ear_end) = os.openpty(), os.openpty()
    for each in (client_end, ear_end):
        tty.setraw(each)
    over = threading.Event()
    with peer("pty", SimDevice(UNIT, words(stem, everything=True))) as place:
        drive = os.open(place, os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK)

        def carry() -> None:
            os.set_blocking(client, False)
            while not over.is_set():
                for said_, heard in ((client, drive), (drive, client)):
                    try:
                        data = os.read(said_, 4096)
                    except BlockingIOError:
                        continue
                    os.write(heard, data)
                    os.write(ear, data)
                time.sleep(0.001)

        def ask() -> None:
            with ModbusSerialClient(os.ttyname(client_end), baudrate=9600) as master:
                while not over.is_set():
                    master.read_holding_registers(0x2000, count=2, device_id=UNIT)
                    time.sleep(0.02)

        threads = [threading.Thread(target=each) for each in (carry, ask)]
        for thread in threads:
            thread.start()
        got = typed(f"{stem}@{UNIT}", "--port", os.ttyname(ear_end), "--for", "1s", "--json")
        over.set()
        for thread in threads[::-1]:
            thread.join()
        os.close(drive)
    found = json.loads(got.stdout)
    assert (found["damaged"], found["findings"]) == (0, [])
    (request,) = found["requests"]
    assert (request["unit"], request["function"], request["address"], request["quantity"]) == (UNIT, 3, 0x2000, 2)
    assert abs(request["answered"] - request["times"]) <= 1


COM3 = """
import socket, sys, types
from driveblocks.cli import main

class Serial:
    order = []
    def __setattr__(self, name, value):
        self.order.append(name)
        object.__setattr__(self, name, value)
    def apply_settings(self, settings):
        assert set(settings) == {"baudrate", "bytesize", "parity", "stopbits"}
    def get_settings(self):
        return {}
    def open(self):
        assert self.port == "COM3" and self.rts is self.dtr is False
        self.link = socket.create_connection(("127.0.0.1", PORT))
        self.link.setblocking(False)
    def close(self):
        self.link.close()
    def read(self, most):
        try:
            return self.link.recv(most)
        except BlockingIOError:
            return b""

sys.modules["serial"] = types.SimpleNamespace(Serial=Serial)
main()
"""
"""What pyserial is on Windows, without any way to send."""


def test_a_port_of_windows_is_heard_with_rts_and_dtr_off_from_the_first_moment(tmp_path: Path) -> None:
    with socket.create_server(("127.0.0.1", 0)) as server:
        code = COM3.replace("PORT", str(server.getsockname()[1]))
        command = [sys.executable, "-c", code, "listen", "--port", "COM3", "--for", "1s"]
        with subprocess.Popen(
            command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, env=environment(tmp_path), text=True
        ) as process:
            link, _ = server.accept()
            while process.poll() is None:
                try:
                    link.sendall(seal("rtu", bytes.fromhex(READ)) + seal("rtu", bytes.fromhex(REPLY)))
                except OSError:
                    break
                time.sleep(0.02)
            out, err = process.communicate()
            link.close()
    assert (process.returncode, err) == (0, "")
    assert "2000H-2001H" in out


# ------------------------------------------------------------ words, files, ports that fail


def test_all_wrong_words_are_reported_at_once(tmp_path: Path) -> None:
    there = tmp_path / "there.log"
    there.write_text("mine", encoding="utf-8")
    some = ["--rate", "5", "--format", "x", "--for", "soon", "--log", str(there), "--csv", str(there), "nobody"]
    got = typed(*some)
    assert (got.exit_code, got.stdout, there.read_text("utf-8")) == (2, "", "mine")
    assert [each.split(" ")[0] for each in got.stderr.splitlines()] == [
        "name", "--rate", "--format", "--for:", "--log", "--csv", "there",
    ]  # fmt: skip
    got = typed("chf", "jscc", "--port", "x")
    assert got.stderr == "two maps without a unit: write which unit each is for, as chf@1 jscc@2\n"
    got = typed("--port", "/dev/no-such-port")
    assert got.stderr == "/dev/no-such-port: there is no such port\n"


class Full:
    """A disk without room."""

    def write(self, _: str) -> int:
        raise OSError(errno.ENOSPC, "No space left on device")

    def close(self) -> None:
        """Nothing to give back."""


def test_a_full_disk_ends_the_log_and_not_the_listening(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Path, "open", lambda *_, **__: Full())
    made, heard = listened(2, "plain", tmp_path / "line.log")
    assert heard.findings is not None
    assert heard.findings.good > 10 < len(made.pieces)
    assert heard.failed == [f"{tmp_path / 'line.log'} ends early: No space left on device"]


def test_a_port_that_refuses_a_rate_is_not_listened_at() -> None:
    clock = VirtualClock()
    tap = Tap(lambda: b"", lambda _rate, _form: False, lambda: None)
    chosen = listen.Words(port="x", rate=9600, form="8N1", mode="rtu")
    heard = listen.Desk(chosen, tap, clock, {}, None, lambda: "", lambda _found, _way: None).hear()
    assert heard.failed == ["the port refuses 9600 bit/s 8N1 RTU"]
    assert LOOK_US > 0
