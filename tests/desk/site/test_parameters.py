"""A drive's words in a file: all of them, by reads alone, over lines that lose, refuse and fall silent."""

import csv
import re
import signal
import socket
import subprocess
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path

import pytest
from click.testing import CliRunner, Result
from tests.desk.run.desk import maps

from driveblocks.bench.simulator.drive import SimulatedDrive
from driveblocks.cli import app
from driveblocks.desk.bus import Bus
from driveblocks.desk.clock import VirtualClock
from driveblocks.desk.master import Speech
from driveblocks.desk.port import WirePort
from driveblocks.desk.site import saved
from driveblocks.desk.site.reader import LostError, One, Reader, Reads
from driveblocks.desk.site.register import rows, unread, value
from driveblocks.desk.site.saved import Word
from driveblocks.maps.load import load
from driveblocks.maps.problem import Refused
from driveblocks.modbus.frame import seal

MAPS = {each.drive.prefix: (each.path.stem, each.drive) for each in maps()}
SKELETON = Path(__file__).parents[2] / "maps" / "example.yaml"
EXAMPLE = load(SKELETON)
SPEECH = Speech("rtu", 1000)


def one(family: str, unit: int = 1) -> One:
    """A drive to be read."""
    return One(*MAPS[family], unit)


def reads(reader: Reader, found: dict[int, Word] | None = None) -> dict[int, Word]:
    """What a reader adds to what was found."""
    found = {} if found is None else found
    reader.read(found, lambda: None, lambda _: None)
    return found


def always(fate: str | int) -> Callable[[range], str | int]:
    """The same fate for every request."""
    return lambda _: fate


class Unit:
    """A port with one unit on it: a word is its address; `fate` may say `silent` or a refusal's code."""

    late_ms, error = 0, ""

    def __init__(self, clock: VirtualClock, fate: Callable[[range], str | int]) -> None:
        """It replies at once."""
        self.clock, self.fate = clock, fate
        self.sent: list[bytes] = []
        self.said = b""

    def send(self, data: bytes) -> None:
        """A request."""
        self.sent.append(data)
        first, count = int.from_bytes(data[2:4], "big"), int.from_bytes(data[4:6], "big")
        fate = self.fate(range(first, first + count))
        words = b"".join(each.to_bytes(2, "big") for each in range(first, first + count))
        if isinstance(fate, int):
            self.said = seal("rtu", bytes([data[0], data[1] + 0x80, fate]))
        elif fate != "silent":
            self.said = seal("rtu", bytes([data[0], data[1], 2 * count]) + words)

    def receive(self) -> bytes:
        """The reply, once."""
        said, self.said = self.said, b""
        return said

    def close(self) -> None:
        """Nothing to give back."""


@pytest.mark.parametrize(
    ("family", "ascii_mode"), [("CHF", False), ("CHF", True), ("JSCC", False), ("JSCC", True), ("SN300G5", False)]
)
@pytest.mark.parametrize(("drop", "damage"), [(0.0, 0.0), (0.2, 0.1)])
def test_every_word_is_read_by_reads_alone(family: str, ascii_mode: bool, drop: float, damage: float) -> None:
    _, drive = MAPS[family]
    simulated = SimulatedDrive(drive, 1)
    bus, clock = Bus([simulated], 9600, 10, ascii_mode=ascii_mode), VirtualClock()
    bus.loss.drop, bus.loss.damage = drop, damage
    reader = Reader(
        WirePort(bus, clock), clock, one(family), Speech("ascii" if ascii_mode else "rtu", 1042), 60_000_000
    )
    found = reads(reader)
    assert {*found} == {each.address for each in rows(drive)}
    assert all(isinstance(word, int) for word in found.values())
    status = drive.operation.standstill.all[0].register
    assert (
        found[status]
        == reads(Reader(WirePort(bus, clock), clock, one(family), Speech("ascii" if ascii_mode else "rtu", 1042), 0))[
            status
        ]
    )
    assert bool(bus.loss.dropped and bus.loss.damaged) == bool(drop)


def test_what_is_refused_is_found_in_halves_and_named() -> None:
    clock, bad = VirtualClock(), {0x103, 0x10A, 0x10B}
    unit = Unit(clock, lambda span: 2 if bad & {*span} else "")
    found = reads(Reader(unit, clock, one("SN300G5"), SPEECH, 0))
    assert {address for address, word in found.items() if word == "refused 2"} == bad
    assert all(word == address for address, word in found.items() if address not in bad)
    assert {frame[1] for frame in unit.sent} == {3}
    assert max(int.from_bytes(frame[4:6], "big") for frame in unit.sent) == 16


def test_one_word_that_gets_no_reply_does_not_end_it() -> None:
    clock = VirtualClock()
    unit = Unit(clock, lambda span: "silent" if 0x104 in span else "")
    found = reads(Reader(unit, clock, one("SN300G5"), SPEECH, 0))
    assert [address for address, word in found.items() if word == "no reply"] == [0x104]


def test_a_busy_drive_is_asked_again() -> None:
    clock = VirtualClock()
    busy = iter([8, 8])
    unit = Unit(clock, lambda _: next(busy, ""))
    assert 0x1000 in (found := reads(Reader(unit, clock, one("CHF"), SPEECH, 0)))
    assert not [word for word in found.values() if isinstance(word, str)]


def test_a_line_that_was_lost_is_waited_for_and_what_was_read_is_kept() -> None:
    clock, told = VirtualClock(), list[str]()
    dark = range(1_000_000, 30_000_000)
    unit = Unit(clock, lambda _: "silent" if clock.now_us() in dark else "")
    found: dict[int, Word] = {}
    Reader(unit, clock, one("SN300G5"), SPEECH, 40_000_000).read(found, lambda: None, told.append)
    assert found == {each.address: each.address for each in rows(MAPS["SN300G5"][1])}
    assert told[0].startswith("no reply; waiting for ")
    clock = VirtualClock()
    unit = Unit(clock, lambda _: "silent" if clock.now_us() > 1_000_000 else "")
    partly: dict[int, Word] = {}
    with pytest.raises(LostError, match="unit 1 does not answer"):
        Reader(unit, clock, one("SN300G5"), SPEECH, 5_000_000).read(partly, lambda: None, told.append)
    assert 0 < len(partly) < len(found)
    rest = Unit(VirtualClock(), lambda _: "")
    assert reads(Reader(rest, rest.clock, one("SN300G5"), SPEECH, 0), dict(partly)) == found
    asked = {int.from_bytes(frame[2:4], "big") for frame in rest.sent}
    assert asked & partly.keys() <= {0x0F}  # where the line is listened to


def test_what_was_read_before_is_read_again_before_the_rest_is() -> None:
    clock = VirtualClock()
    unit = Unit(clock, lambda span: 2 if 0x101 in span else "")
    reader = Reader(unit, clock, one("SN300G5"), SPEECH, 0)
    assert (reader.changed({}), unit.sent) == ("", [])
    assert reader.changed({0x20: 5, 0x100: 0x100, 0x101: "refused 2"}) == ""  # what is measured may differ
    assert {int.from_bytes(frame[2:4], "big") for frame in unit.sent} == {0x0F, 0x100, 0x101}
    assert reader.changed({0x100: 7, 0x101: "refused 2"}) == "0100H was 7 and is 256"
    assert reader.changed({0x100: 0x100, 0x101: 9}) == "0101H was 9 and is refused 2"


def test_nothing_but_reads_passes() -> None:
    unit = Unit(VirtualClock(), lambda _: "silent")
    port = Reads(unit)
    frames = [bytes.fromhex(text) for text in ("010300000001", "010600000001", "01100000000102 0001", "000300000001")]
    for body in frames:
        port.send(seal("rtu", body))
    assert [frame[:-2] for frame in unit.sent] == frames[:1]


def test_a_unit_of_another_family_is_a_stranger(tmp_path: Path) -> None:
    clock, example = VirtualClock(), One("example", EXAMPLE, 1)
    said: dict[str | int, str] = {
        "": "unit 1 is no EX100: 0031H is 0031H: 01 03 02 00 31 79 90",
        2: "unit 1 does not give the identity of EX100: 01 83 02 C0 F1",
    }
    for fate, why in said.items():
        unit = Unit(clock, always(fate))
        assert Reader(unit, clock, example, SPEECH, 0).stranger({}) == why
        assert {frame[2:4] for frame in unit.sent} == {b"\0\x31"}
    with pytest.raises(LostError, match="unit 1 does not answer"):
        Reader(Unit(clock, lambda _: "silent"), clock, example, SPEECH, 0).stranger({})
    bus = Bus([SimulatedDrive(EXAMPLE, 1)], 9600, 10)
    assert Reader(WirePort(bus, clock), clock, example, SPEECH, 0).stranger({}) == ""
    with simulated("jscc", "--tcp", ":0") as place:
        got = parameters("save", str(SKELETON), str(tmp_path / "a.csv"), "--tcp", place)
    assert (got.exit_code, [*tmp_path.iterdir()]) == (2, [])
    assert got.stderr.startswith("unit 1 is no EX100: 0031H is 0000H: ")


def test_areas_with_forbidden_parameters_are_left_out() -> None:
    (left,) = unread(MAPS["CHF"][1])
    assert left.startswith("0000H to 01FFH are not read: PE, among them")
    assert not [each for each in rows(MAPS["CHF"][1]) if each.address < 0x200]
    assert [(each.address, each.id) for each in rows(MAPS["JSCC"][1]) if each.set][-1] == (0xFF, "255")


def test_words_have_their_sign_scale_and_name() -> None:
    by_address = {row.address: row for row in rows(EXAMPLE)}
    assert [value(by_address[0x11], word, {}) for word in (1, 9)] == [("1 Bus", ""), ("9", "")]
    assert value(by_address[0x12], 1, {}) == ("0001H", "")
    assert [value(by_address[1], 0xFFFF, {0x0F: word}) for word in (0, 1)] == [("-0.01", "%"), ("-1", "% ?")]
    sn = {row.id: row for row in rows(MAPS["SN300G5"][1]) if row.id}
    assert [value(sn["U1-02"], 5000, words) for words in ({}, {0x0F: 0})] == [("5000", "Hz ?"), ("50.00", "Hz")]
    assert [sn[f"A2-{number:02}"].address for number in (1, 32)] == [0x106, 0x125]


# ---------------------------------------------------------------- the file


@pytest.fixture
def pump(tmp_path: Path) -> Path:
    """A file that has some words of a drive."""
    path = tmp_path / "pump.csv"
    stem, drive = MAPS["SN300G5"]
    saved.write(path, stem, drive, 3, {0x0F: 0, 0x20: 5000, 0x21: "refused 2", 0x100: 1})
    return path


def test_a_file_is_read_as_it_was_written_and_says_how_far_it_came(pump: Path) -> None:
    text = pump.read_text(encoding="utf-8")
    assert f"# read: 4 of {len(rows(MAPS['SN300G5'][1]))}\n" in text
    assert "0020H,U1-01,Frequency reference,5000,50.00,Hz,\n" in text
    got = saved.read(pump)
    assert (got.stem, got.unit, got.words) == ("shuen_sn300g5", 3, {0x0F: 0, 0x20: 5000, 0x21: "refused 2", 0x100: 1})


def test_a_file_that_a_spreadsheet_has_saved_is_read_and_its_notes_stay(pump: Path) -> None:
    """It fills all lines up to the longest with commas, and quotes what holds one."""
    before = saved.read(pump)
    text = pump.read_text(encoding="utf-8") + "# ramps, as at pump 2\n"
    cells = [line.split(",") if "," in line and line[0] != "#" else [line] for line in text.splitlines()]
    with pump.open("w", encoding="utf-8", newline="") as file:
        csv.writer(file).writerows([*row, *[""] * (9 - len(row))] for row in cells)
    assert '"# ramps, as at pump 2",,' in pump.read_text(encoding="utf-8")
    assert replace(saved.read(pump), where="") == replace(before, where="")
    saved.write(pump, *MAPS["SN300G5"], 3, {0x20: 1})
    notes = [line for line in pump.read_text(encoding="utf-8").splitlines() if "#" in line]
    assert [line for line in notes if "ramps" in line or "read by" in line] == [
        "# parameters of SN300G5, read by driveblocks",
        '"# ramps, as at pump 2",,,,,,,,',
    ]


def test_a_full_disk_leaves_the_file_that_was_there(pump: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    before = pump.read_bytes()

    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(Path, "replace", full)
    with pytest.raises(OSError, match="No space") as error:
        saved.write(pump, *MAPS["SN300G5"], 3, {0x20: 1})
    assert error.value.filename == str(pump)  # else the message would be of standard output
    assert (pump.read_bytes(), [*pump.parent.iterdir()]) == (before, [pump])


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no such modes and links")
def test_a_link_stays_a_link_and_a_private_file_private(pump: Path, tmp_path: Path) -> None:
    (tmp_path / "there").mkdir()
    path = pump.rename(tmp_path / "there" / "pump.csv")
    path.chmod(0o600)
    pump.symlink_to(path)
    saved.write(pump, *MAPS["SN300G5"], 3, {0x20: 1})
    assert (pump.is_symlink(), path.stat().st_mode & 0o777) == (True, 0o600)
    assert saved.read(path).words == {0x20: 1}
    assert sorted(each.name for each in tmp_path.rglob("*")) == ["pump.csv", "pump.csv", "there"]


def test_all_that_is_wrong_with_a_file_is_reported(pump: Path) -> None:
    text = pump.read_text(encoding="utf-8")
    pump.write_text(f"{text}0022H,U1-03,x,65536,1,A,\nhello\n", encoding="utf-8")
    count = text.count("\n")
    with pytest.raises(Refused) as refused:
        saved.read(pump)
    assert str(refused.value).splitlines() == [
        f"{pump}:{count + 1}:1: 65536 is no word; write 0 to 65535",
        f"{pump}:{count + 2}:1: is no row; write address, id, name, word, value, unit, default",
    ]
    pump.write_text("address\n", encoding="utf-8")
    with pytest.raises(Refused, match="it names no map and no unit"):
        saved.read(pump)


# ---------------------------------------------------------------- the command


@contextmanager
def simulated(*words: str) -> Iterator[str]:
    """Simulated drives in a process of their own; where they are."""
    command = [sys.executable, "-u", "-m", "driveblocks", "simulate", *words]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as served:
        assert served.stdout
        try:
            yield served.stdout.readline().partition(" on ")[2].partition(";")[0]
        finally:
            served.terminate()


def parameters(*words: str) -> Result:
    """Run `driveblocks parameters`."""
    return CliRunner().invoke(app, ["parameters", *words], env={"COLUMNS": "80"})


@pytest.mark.skipif(sys.platform == "win32", reason="has no pseudo-terminals")
@pytest.mark.thorough
def test_ctrl_c_keeps_what_was_read_and_the_same_command_reads_the_rest(tmp_path: Path) -> None:
    path = tmp_path / "pump.csv"
    with simulated("sn300g5", "--pty", "--baud", "1200") as place:
        words = ["parameters", "save", "sn300g5", str(path), "--port", place, "--rate", "1200"]
        command = [sys.executable, "-m", "driveblocks", *words]
        with subprocess.Popen(command, stderr=subprocess.PIPE, text=True) as begun:
            while not path.exists() and begun.poll() is None:
                threading.Event().wait(0.01)
            begun.send_signal(signal.SIGINT)
            said = begun.communicate()[1]
        kept = saved.read(path).words
        assert (begun.returncode, 0 < len(kept) < 388) == (1, True)
        assert said == f"Ctrl-C; {path} has {len(kept)} of 388 registers; the same command reads the rest\n"
        assert [*tmp_path.iterdir()] == [path]
        path.write_text(path.read_text(encoding="utf-8"), encoding="utf-8")
        done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0
    assert done.stdout.startswith(f"SN300G5 at unit 1: 388 registers, in {path}\n")
    assert len(saved.read(path).words) == 388


def test_a_line_on_which_somebody_speaks_is_left_alone(tmp_path: Path) -> None:
    heard = b""
    with socket.create_server(("127.0.0.1", 0)) as server:

        def master() -> None:
            nonlocal heard
            other, _ = server.accept()
            with other:
                other.sendall(b"\x01\x03\x00\x00\x00\x01\x84\x0a")
                heard = other.recv(100)

        speaks = threading.Thread(target=master)
        speaks.start()
        place = f"127.0.0.1:{server.getsockname()[1]}"
        got = parameters("save", "chf", str(tmp_path / "a.csv"), "--tcp", place)
        speaks.join()
    assert (got.exit_code, got.stderr) == (2, f"{place}: somebody else speaks on this line; disconnect the PLC\n")
    assert (heard, [*tmp_path.iterdir()]) == (b"", [])


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (
            ("save", "nobody", "a.csv", "--rate", "5", "--format", "x", "--patience", "soon"),
            [
                "name the port of the drive, by --port or by --tcp",
                "--rate 5 is out of range; write 300 to 1000000 bit/s",
                "--format x is no format; write one of 8N1, 8E1, 8O1, 8N2, 7E1, 7O1, 7N2",
                "--patience: `soon` is no time; write 10ms, 2.5s or 1min",
                "there is no drive `nobody`",
            ],
        ),
        (("save", "chf", "a.csv", "--tcp", "x", "--port", ""), [
            "name the port of the drive, by --port or by --tcp", "--port names no port", "--tcp x is no address",
        ]),
        (("save", "chf", "a.csv", "--port", "/dev/nowhere"), ["/dev/nowhere: there is no such port"]),
        (("compare", "a.csv", "b.csv"), ["a.csv:1:1: cannot be read", "b.csv:1:1: cannot be read"]),
        (("compare", "chf", "jscc", "--tcp", ":1"), ["chf is of invt_chf, jscc of jscc: compare drives of one family"]),
        (("compare", "chf", "chf@2", "--tcp", ":1"), ["the map of CHF names no parameter that may be read; write"]),
    ],
)  # fmt: skip
def test_all_mistakes_are_reported_at_once(words: tuple[str, ...], said: list[str]) -> None:
    got = parameters(*words)
    assert (got.exit_code, got.stdout) == (2, "")
    assert [line[: len(each)] for line, each in zip(got.stderr.splitlines(), said, strict=True)] == said


MISSING = "322 not compared, for want of a word: 0101H, 0102H, 0103H, 0104H, ..."


def test_what_only_one_file_has_is_not_taken_for_equal(pump: Path, tmp_path: Path) -> None:
    other = tmp_path / "fan.csv"
    saved.write(other, "shuen_sn300g5", MAPS["SN300G5"][1], 4, {0x100: 1, 0x101: 2, 0x20: 4000, 0x0F: 0})
    got = parameters("compare", str(pump), str(other))
    assert (got.exit_code, got.stdout) == (1, f"1 parameters are equal, of 323 in the map\n{MISSING}\n")
    got = parameters("compare", str(pump), str(other), "--all")
    assert got.stdout.splitlines()[-2:] == [
        "1 of 3 registers differ, of 388 in the map",
        "385 not compared, for want of a word: 0000H, 0001H, 0006H, 0007H, ...",
    ]
    (row,) = [line for line in got.stdout.splitlines() if line.startswith("U1-01")]
    assert row.split()[-4:] == ["50.00", "Hz", "40.00", "Hz"]


def test_what_neither_side_has_given_is_not_taken_for_equal(tmp_path: Path) -> None:
    paths, (stem, drive) = [tmp_path / name for name in ("a.csv", "b.csv")], MAPS["SN300G5"]
    for path in paths:
        saved.write(path, stem, drive, 1, {row.address: "no reply" for row in rows(drive)} | {0x100: 1})
    got = parameters("compare", *map(str, paths))
    assert (got.exit_code, got.stdout) == (1, f"1 parameters are equal, of 323 in the map\n{MISSING}\n")
    saved.write(paths[1], stem, drive, 1, {row.address: "refused 2" for row in rows(drive)} | {0x100: 2})
    got = parameters("compare", *map(str, paths))
    assert got.exit_code == 1
    assert got.stdout.splitlines()[-2:] == ["1 of 1 parameters differ, of 323 in the map", *MISSING.split("\n")]
    saved.write(paths[1], stem, drive, 1, {row.address: 7 for row in rows(drive)})
    assert (
        parameters("compare", *map(str, paths)).stdout.splitlines()[-1]
        == "323 of 323 parameters differ, of 323 in the map"
    )


def test_what_the_map_does_not_list_now_is_not_passed_over(tmp_path: Path) -> None:
    paths, (stem, drive) = [tmp_path / name for name in ("a.csv", "b.csv")], MAPS["SN300G5"]
    words: dict[int, Word] = {row.address: 1 for row in rows(drive)}

    def compared(left: str, right: str) -> tuple[int, list[str]]:
        for path, more in zip(paths, (left, right), strict=True):
            saved.write(path, stem, drive, 1, words)
            path.write_text(path.read_text(encoding="utf-8") + more, encoding="utf-8")
        got = parameters("compare", *map(str, paths))
        return got.exit_code, " ".join(got.stdout.split()).splitlines()

    equal = "323 parameters are equal, of 323 in the map"
    says = f"{equal} 1 that the map does not list now differ, or were not read on both sides: FFF0H"
    row, gone, silent = "FFF0H,,x,7,7,,\n", "FFF0H,,x,8,8,,\n", "FFF0H,,x,no reply,,,\n"
    assert compared(row, row) == (0, [equal])
    for left, right in ((row, gone), (row, ""), ("", row), (silent, silent), (silent, row)):
        assert compared(left, right) == (1, [says])
    status, (said,) = compared("".join(f"FF{at:02X}H,,x,{at},,,\n" for at in range(9)), "")
    assert status == 1
    assert said.startswith("323 parameters are equal, of 323 in the map 9 that")
    assert said.endswith(", FF07H, ...")


def test_files_of_a_map_of_ones_own_are_compared(tmp_path: Path) -> None:
    paths = [str(tmp_path / name) for name in ("a.csv", "b.csv")]
    for path in paths:
        saved.write(Path(path), "example", EXAMPLE, 1, {each.address: 0 for each in rows(EXAMPLE)})
    assert parameters("compare", *paths).stderr.startswith("there is no drive `example`")
    got = parameters("compare", *paths, "--all", "--map", str(SKELETON))
    assert (got.exit_code, got.stdout) == (
        0,
        f"{len(rows(EXAMPLE))} registers are equal, of {len(rows(EXAMPLE))} in the map\n",
    )


def test_another_drives_file_is_not_continued(pump: Path) -> None:
    before = pump.read_bytes()
    for drive, why in (("sn300g5@1", "is of shuen_sn300g5 at unit 3"), ("chf@3", "is of shuen_sn300g5 at unit 3")):
        got = parameters("save", drive, str(pump), "--tcp", ":1")
        assert (got.exit_code, got.stderr) == (2, f"{pump} {why}; name another file\n")
    pump.write_text(re.sub("revision [0-9A-F]{8}", "revision 00000000", before.decode()), encoding="utf-8")
    got = parameters("save", "sn300g5@3", str(pump), "--tcp", ":1")
    assert (got.exit_code, got.stderr) == (2, f"{pump} is of another revision of the map; name another file\n")
