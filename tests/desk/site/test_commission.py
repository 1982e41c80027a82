"""The first hour with a drive: found and named by reads alone, over lines that differ, and kept whole at any moment."""

import socket
import sys
import threading
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from html import escape
from pathlib import Path

import pytest
from click.testing import CliRunner
from tests.desk.run.desk import maps
from tests.shapes import shapes

from driveblocks.bench.simulator.drive import SimulatedDrive
from driveblocks.cli import app
from driveblocks.desk.bus import Bus
from driveblocks.desk.clock import VirtualClock
from driveblocks.desk.port import WirePort
from driveblocks.desk.site import adapter, hour, hunt, kept, sheet, steps
from driveblocks.desk.site.adapter import PortLine
from driveblocks.desk.site.found import Answer, Asker, Found, Measured, Set, Way
from driveblocks.desk.site.found import Line as LineOf
from driveblocks.desk.site.session import Wish, commission
from driveblocks.maps.model import Condition, Identity
from driveblocks.maps.problem import MapError
from driveblocks.meaning.polls import polls
from driveblocks.meaning.setting import in_order
from driveblocks.modbus.frame import opened, seal
from structured_text import files

MAPS = {each.path.stem: each.drive for each in maps()}
BASES = {stem: each.base or stem for stem, each in MAPS.items()}
PAIRS = [(stem, other) for stem in MAPS for other in MAPS if stem == other or BASES[stem] != BASES[other]]
"""Maps and drives, without sisters: their registers may be the same."""
FOREIGN = {stem: next(other for one, other in PAIRS if one == stem != other) for stem in MAPS}
"""One drive of another family for each map; the others are met in the whole suite."""
ABOUT = kept.About("Pump", "jscc", "12345678", "2026-11-23 10:30", "")
WAY = Way(9600)


@dataclass
class Person:
    """Answers by key, else nothing; raises an answer that is an exception."""

    answers: dict[str, str | BaseException] = field(default_factory=lambda: {"alone": "alone"})
    asked: list[str] = field(default_factory=list)
    before: Callable[[str], None] = lambda _: None

    def ask(self, key: str, text: str) -> str:
        assert text
        self.asked.append(key)
        self.before(key)
        answer = self.answers.get(key, "")
        if isinstance(answer, BaseException):
            raise answer
        return answer

    def say(self, what: object) -> None:
        assert what

    def progress(self, done: float, total: float, text: str) -> None:
        assert 0 <= done <= total
        assert text


def nobody(_: int) -> bytes:
    """Nothing comes that nobody asked for."""
    return b""


class Idle(VirtualClock):
    """Time that passes in longer steps while nobody has sent: a quiet minute has many short ones."""

    def __init__(self, line: "Line") -> None:
        super().__init__()
        self.line = line

    def sleep_until(self, us: int) -> None:
        still = self.line.alien is nobody and not (self.line.sent or self.line.said or self.line.gone_us)
        super().sleep_until(us + 9_500 if still else us)


class Line:
    """Units on a wire that speaks in one way; `change` makes of a reply what is heard, `alien` what nobody asked."""

    late_ms, error = 0, ""

    def __init__(self, drives: list[SimulatedDrive], way: Way = WAY) -> None:
        self.clock, self.way, self.tuned = Idle(self), way, way
        bits = 1_000_000 / (way.character_us * way.rate)
        self.bus = Bus(drives, way.rate, round(1 / bits), ascii_mode=way.mode == "ascii")
        self.wire = WirePort(self.bus, self.clock)
        self.sent: list[bytes] = []
        self.change: Callable[[bytes, bytes], bytes] = lambda _, reply: reply
        self.alien: Callable[[int], bytes] = nobody
        self.late_us = 0
        self.said: list[tuple[int, bytes]] = []
        self.gone_us: int | None = None

    def opened(self, way: Way) -> "Line":
        self.tuned, self.said = way, []  # what waits in a port is lost when it is opened again
        return self

    def send(self, data: bytes) -> None:
        self.sent.append(data)
        if replace(self.tuned, mode=self.way.mode) == self.way:
            self.wire.send(data)
            end = self.clock.now_us() + 400_000
            probe = VirtualClock()
            probe.sleep_until(end)
            reply = self.change(data, WirePort(self.bus, probe).receive())
            at = self.clock.now_us() + int(len(data) * self.way.character_us) + 8_000 + self.late_us
            self.said += [(at, reply)] if reply else []

    def receive(self) -> bytes:
        if self.gone_us is not None and self.clock.now_us() > self.gone_us:
            self.error = "the port was unplugged"
            return b""
        if self.said and self.clock.now_us() >= self.said[0][0]:
            return self.said.pop(0)[1]
        return self.alien(self.clock.now_us())

    def close(self) -> None:
        """Nothing to give back."""


def went(line: Line, stem: str, person: Person | None = None, **words: object) -> Found:
    """All steps on a line."""
    others = {name: each for name, each in MAPS.items() if name != stem}
    wish = replace(Wish(MAPS[stem], others), **words)  # type: ignore[arg-type]  # a test names the fields
    found = commission(PortLine(line.opened, line.clock), person or Person(), wish, lambda _: None)
    modes = "rtu", "ascii"
    bodies = [next(body for mode in modes if (body := opened(mode, each)) is not None) for each in line.sent]
    assert {body[1] for body in bodies} <= {1, 2, 3, 4, 17, 43}
    return found


def drive(stem: str, unit: int = 1) -> SimulatedDrive:
    """A drive of a map."""
    return SimulatedDrive(MAPS[stem], unit)


@pytest.mark.parametrize(
    ("stem", "unit", "way"),
    [
        ("invt_chf", 1, Way(9600)), ("invt_chf", 2, Way(38400, "8O1", "ascii")), ("jscc", 3, Way(19200, "8E1")),
        ("jscc", 40, Way(19200, "8E1")), ("shuen_sn300g5", 31, Way(9600, "8E1")), ("shuen_sn300g5", 7, Way(1200)),
    ],
)  # fmt: skip
def test_a_drive_is_found_at_its_rate_format_framing_and_address(stem: str, unit: int, way: Way) -> None:
    person = Person()
    found = went(Line([drive(stem, unit)], way), stem, person)
    assert (found.way, found.unit, found.family, found.faults, found.ended) == (way, unit, "fits", [], "")
    assert found.done == ["quiet", "find", "keypad", "measure", "gaps"]
    assert found.measured is not None
    assert (found.measured.reads, found.measured.unlisted[-7:]) == (200, "refused")
    assert found.measured.longest_ms <= 12
    assert len(person.asked) <= 10
    assert {each.what for each in steps.asked(MAPS[stem])} <= {*found.skipped}


def test_nothing_is_sent_before_a_quiet_minute_and_a_typed_word() -> None:
    line = Line([drive("jscc")])
    waited: list[int] = []
    person = Person({"alone": "yes"}, before=lambda _: waited.append(line.clock.now_us()))
    found = went(line, "jscc", person)
    assert (found.done, line.sent, person.asked) == ([], [], ["alone"])
    assert waited[0] >= hunt.QUIET_US
    for at in (5_000_000, 59_000_000):
        line = Line([drive("jscc")])
        came = iter([b"\x55"])
        line.alien = lambda now, at=at, came=came: next(came, b"") if now > at else b""  # type: ignore[misc]  # bound here
        found = went(line, "jscc")
        assert ([each.kind for each in found.faults], line.sent) == (["noise"], [])


def test_another_master_is_named_where_its_frames_decode() -> None:
    line = Line([drive("jscc")], Way(19200))
    frame = seal("rtu", bytes.fromhex("010320000002"))
    line.alien = lambda now: frame if line.tuned.rate == 19200 and now % 100_000 < 500 else b""
    found = went(line, "jscc")
    assert ([each.kind for each in found.faults], line.sent) == (["foreign"], [])
    assert "19200" in found.faults[0].text


SPOILT: dict[str, Callable[[bytes, bytes], bytes]] = {
    "damaged": lambda _, reply: bytes(each ^ 0x10 for each in reply),
    "half": lambda _, reply: reply[: len(reply) // 2],
    "echo": lambda asked, _: asked,
    "two": lambda _, reply: reply + reply,
    "silent": lambda *_: b"",
}


@pytest.mark.parametrize("kind", SPOILT)
@pytest.mark.parametrize("stem", MAPS)
def test_what_is_wrong_with_a_line_is_named_with_what_to_look_at(stem: str, kind: str) -> None:
    line = Line([drive(stem)])
    line.change = SPOILT[kind]
    found = went(line, stem, rate=9600, form="8N1", mode="rtu", unit=1)
    assert [each.kind for each in found.faults] == [kind]
    assert found.faults[0].look
    assert (found.way, found.ended) == (None, found.faults[0].text)


def test_an_adapter_that_hears_itself_does_no_harm() -> None:
    line = Line([drive("jscc")])
    line.change = lambda asked, reply: asked + reply
    found = went(line, "jscc", rate=9600, form="8N1", unit=1)
    assert (found.ended, found.faults, found.unit) == ("", [], 1)


@pytest.mark.parametrize("late_us", [300_000, 900_000])
def test_a_slow_drive_is_found_and_measured(late_us: int) -> None:
    line = Line([drive("jscc", 2)])
    line.late_us = late_us
    found = went(line, "jscc", rate=9600, form="8N1")
    assert (found.unit, found.ended) == (2, "")
    assert [each.kind for each in found.faults] == ["slow"]
    assert found.measured is not None
    assert late_us / 1000 <= found.measured.longest_ms <= late_us / 1000 + 12
    assert found.measured.turn_round_ms > found.measured.longest_ms


@pytest.mark.parametrize(
    ("stem", "other"),
    [
        pytest.param(*each, marks=[] if each[1] in (each[0], FOREIGN[each[0]]) else pytest.mark.thorough)
        for each in PAIRS
    ],
)
def test_another_family_is_named_and_asked_no_further(stem: str, other: str) -> None:
    found = went(Line([drive(other)]), stem, rate=9600, form="8N1", mode="rtu", unit=1)
    by = "identity" if MAPS[stem].identity else "family"
    right = "identity" if MAPS[stem].identity else "fits"
    assert (found.family, found.measured is None) == ((right, False) if stem == other else ("", True))
    assert [each.kind for each in found.faults] == ([] if stem == other else [by])


def test_an_identity_comes_first_and_a_wrong_one_is_the_end() -> None:
    for word, family, wrong in ((4, "identity", []), (3, "", ["identity"])):
        identity = Identity(all=(Condition(register=0x2001, equals=word),), source="page 1", why="no other")
        line = Line([drive("jscc")])
        wished = replace(MAPS["jscc"], identity=identity)
        found = went(line, "jscc", drive=wished, rate=9600, form="8N1", unit=1)
        first = opened("rtu", line.sent[0])
        assert first is not None
        assert first[2:4] == b"\x20\x01"
        assert (found.family, found.measured is None) == (family, bool(wrong))
        assert [each.kind for each in found.faults] == wrong


def test_a_refused_span_is_named_and_the_rest_is_done() -> None:
    last = polls(MAPS["shuen_sn300g5"])[-1].address.to_bytes(2, "big")
    line = Line([drive("shuen_sn300g5")])
    line.change = lambda asked, reply: seal("rtu", b"\x01\x83\x02") if asked[2:4] == last else reply
    found = went(line, "shuen_sn300g5", rate=9600, form="8N1", unit=1)
    assert ([each.kind for each in found.faults], found.ended, found.family) == (["refused"], "", "fits")


@pytest.mark.parametrize("stem", MAPS)
def test_what_differs_at_the_keypad_is_read_or_asked(stem: str) -> None:
    ids = [each.id for each in in_order(MAPS[stem]) if each.needed]
    person = Person({"alone": "alone", "keypad": ", ".join(ids).lower()})
    found = went(Line([drive(stem)]), stem, person, rate=9600, form="8N1", mode="rtu", unit=1)
    read = [each for each in found.settings if each.read is not None]
    assert [each.id for each in found.settings] == ids
    assert all(each.told == ("" if each in read else "no") for each in found.settings)
    if stem == "shuen_sn300g5":
        assert [each.id for each in found.settings if each.differs] == ["B1-01", "B1-02", "H5-05"], "all are 0"


def test_a_drive_that_answers_nobody_is_told_its_address_first(tmp_path: Path) -> None:
    said: list[str] = []
    person = Person({"alone": "alone", "keypad": "P3.01"})
    person.say = lambda what: said.append(str(what))  # type: ignore[method-assign]
    mine = shapes()["two_registers"]
    found = went(Line([SimulatedDrive(mine, 1)]), "jscc", person, drive=mine, rate=9600, form="8N1", unit=1)
    assert said[0] == "As delivered this drive answers nobody: set P3.00 to an address first."
    assert [(each.id, each.must, each.told) for each in found.settings] == [
        ("P3.00", (), "yes"),
        ("P3.01", (1,), "no"),
    ]
    assert [replace(found.settings[1], read=one).differs for one in (0, 1, 2)] == [True, False, True]
    path = tmp_path / "site.yaml"
    kept.write(path, ABOUT, found)
    (one,) = kept.read(path).values()
    assert [(each.id, each.right) for each in one.settings] == [("P3.00", ()), ("P3.01", (1,))]
    assert "- setting P3.01: by eye not right, must be 1" in list(sheet.report("Pump", one))


@pytest.mark.parametrize(
    ("answer", "right", "asked"),
    [
        ("yes", ["yes"] * 6, 1), ("Yes.", ["yes"] * 6, 1), ("f0.04; FA.03", ["no", *["yes"] * 4, "no"], 1),
        ("no", [""] * 6, 3), ("F004", [""] * 6, 3), ("nothing is right", [""] * 6, 3), ("F0.04 I think", [""] * 6, 3),
    ],
)  # fmt: skip
def test_only_an_answer_that_is_understood_is_kept_of_the_keypad(answer: str, right: list[str], asked: int) -> None:
    person = Person({"alone": "alone", "keypad": answer})
    found = went(Line([drive("jscc")]), "jscc", person, rate=9600, form="8N1", unit=1)
    assert [each.told for each in found.settings] == right
    assert person.asked.count("keypad") == asked
    assert ("keypad" in found.skipped) == ("" in right)


@pytest.mark.parametrize(
    ("answer", "word", "value"),
    [
        ("20.0", 2000, "0.01"), ("20,0 Hz", 200, "0.1"), ("537", 537, "1"), ("20.0", 1985, "0.01"), ("20", 1234, ""),
        ("20", 20, ""), ("none", 2000, ""), ("20", None, ""), ("NaN", 2000, ""), ("-20", 65336, ""), ("0", 0, ""),
    ],
)  # fmt: skip
def test_a_scale_is_a_power_of_ten_that_the_answer_shows(answer: str, word: int | None, value: str) -> None:
    assert steps.scale(answer, word) == value


def test_every_answer_is_read_at_its_moment_and_kept() -> None:
    places = {each.what: each.on_site for each in steps.asked(MAPS["shuen_sn300g5"]) if each.on_site}
    what, place = next((what, each) for what, each in places.items() if each.gives)
    request = (place.read or 0).to_bytes(2, "big") + b"\0\1"
    line = Line([drive("shuen_sn300g5")])
    line.change = lambda asked, reply: seal("rtu", b"\1\3\2\x14\xfa") if asked[2:6] == request else reply
    person = Person({"alone": "alone", what: "537"})
    found = went(line, "shuen_sn300g5", person, rate=9600, form="8N1", unit=1)
    assert found.answers == [Answer(what, "537", 5370, place.gives or "", "0.1")]


@pytest.mark.parametrize("end", [KeyboardInterrupt(), EOFError()])
@pytest.mark.parametrize("key", ["plate", "whether 2000H is negative in reverse"])
def test_an_end_at_any_question_is_kept_with_how_far_it_came(end: BaseException, key: str, tmp_path: Path) -> None:
    path, line = tmp_path / "site.yaml", Line([drive("jscc")])
    wish = Wish(MAPS["jscc"], rate=9600, form="8N1", unit=1)
    person = Person({"alone": "alone", key: end})
    commission(PortLine(line.opened, line.clock), person, wish, lambda found: kept.write(path, ABOUT, found))
    entry = kept.read(path)["Pump"]
    assert entry.ended in {"Ctrl-C", "the terminal was closed"}
    assert entry.finished == ("quiet", "find", *(() if key == "plate" else ("keypad", "measure")))
    assert [*tmp_path.iterdir()] == [path]


@pytest.mark.parametrize("stem", MAPS)
def test_a_byte_while_the_word_is_typed_ends_it_before_anything_is_sent(stem: str) -> None:
    line = Line([drive(stem)])
    frame = seal("rtu", b"\x21\x03\x10\x01\x00\x01")

    def speaks(_: str) -> None:
        line.said.append((line.clock.now_us(), frame))

    found = went(line, stem, Person(before=speaks))
    assert ([each.kind for each in found.faults], line.sent) == (["foreign"], [])


def test_an_unplugged_adapter_is_named_wherever_it_happens() -> None:
    for seconds in (1, 30, 61, 63, 66):
        line = Line([drive("jscc")])
        line.gone_us = 1_000_000 * seconds
        found = went(line, "jscc", rate=9600, form="8N1", unit=1)
        assert [each.kind for each in found.faults] == ["lost"], seconds
        assert "unplugged" in found.ended


def test_what_is_skipped_is_said() -> None:
    found = went(Line([drive("jscc")]), "jscc", skip=frozenset({"keypad", "measure", "gaps", "plate"}))
    assert (found.done, found.skipped) == (["quiet", "find"], ["plate", "keypad", "measure", "gaps"])
    assert (found.settings, found.measured, found.answers) == ([], None, [])


# ------------------------------------------------------------ what is kept, and made of it

FULL = Found(
    way=Way(19200, "8E1"), unit=3, family="fits", plate='5.5 kW "B" <1.02>',
    done=["quiet", "find", "keypad", "measure"],
    settings=[Set("F0.04", "Run", 3, (4,), "why", ""), Set("F0.08", "Speed", None, (8,), "why", "no")],
    measured=Measured(200, 12, 2, 16, "001BH: refused"), tried=["19200 bit/s 8E1 RTU"], skipped=["gaps", "a, b: [c"],
    answers=[Answer("scale of 2000H", "20.0", 2000, "FrequencyScale", "0.01"), Answer("other: {x}", "#no", None)],
)  # fmt: skip


@pytest.fixture
def path(tmp_path: Path) -> Path:
    """A file that has the findings of a pump."""
    kept.write(tmp_path / "site.yaml", ABOUT, FULL)
    return tmp_path / "site.yaml"


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("  line:", "# KEPT 1\n  line:"), ('"jscc"\n', '"jscc"  # KEPT 1\n'), ("Pump:", "Pump:  # KEPT 1"),
        ("Pump:", '"Pump": # KEPT 1'), ("Pump:", "# KEPT 1\nPump :"), ("First:", "---\nFirst: # KEPT 1"),
        ("\n", "\r\n# KEPT 1\r\n"),
        ("  settings:\n", "  settings:  # KEPT 1\n    # KEPT 2\n"), ("Fan:", "\n  # KEPT 1\n\n# KEPT 2\nFan:"),
        ('plate: "5.5 kW', "plate: '5.5 kW # no note', # KEPT 1\n  # \""),
    ],
)  # fmt: skip
def test_a_file_that_a_person_has_edited_is_kept(old: str, new: str, tmp_path: Path) -> None:
    path = tmp_path / "site.yaml"
    for label in ("First", "Pump", "Fan"):
        kept.write(path, replace(ABOUT, label=label), FULL)
    text = path.read_text(encoding="utf-8").replace(old, new)
    if "plate" in old:
        text = text.replace(", # KEPT", " # KEPT")
    path.write_bytes(text.encode())
    assert set(kept.read(path)) == {"First", "Pump", "Fan"}
    for _ in range(2):
        kept.write(path, ABOUT, replace(FULL, unit=4))
        assert {label: one.line.unit for label, one in kept.read(path).items()} == {"First": 3, "Pump": 4, "Fan": 3}
        now = path.read_bytes().decode()
        assert (now.count("# KEPT 1"), now.count("# KEPT 2")) == (text.count("# KEPT 1"), text.count("# KEPT 2"))
        assert now.count("\r\n") in (0, now.count("\n"))


@pytest.mark.parametrize(
    ("text", "wrong"),
    [
        ("  Pump: {entry}", "2:3: `Pump` does not begin its line"),
        ("{{Pump: {entry}}}", "2:2: `Pump` does not begin its line"),
        ("Pump: {entry}\nPUMP: {entry}", "3:1: `PUMP` and `Pump` are one name in a PLC"),
    ],
)
def test_a_file_that_could_not_be_kept_is_refused_before(text: str, wrong: str, tmp_path: Path) -> None:
    path = tmp_path / "site.yaml"
    line = "{rate: 9600, form: 8N1, mode: rtu, unit: 3}"
    entry = f"{{map: jscc, revision: '1', date: today, family: fits, line: {line}}}"
    path.write_text("# head\n" + text.format(entry=entry), encoding="utf-8")
    with pytest.raises(MapError) as error:
        kept.read(path)
    assert wrong in str(error.value)


def test_what_is_kept_is_read_again(tmp_path: Path) -> None:
    path = tmp_path / "site.yaml"
    kept.write(path, replace(ABOUT, who="a\tb\x1b\u202e'\"\\ ü"), FULL)
    one = kept.read(path)["Pump"]
    assert (one.who, one.plate, one.skipped) == ("a b??'\"\\ ü", FULL.plate, ("gaps", "a, b: [c"))
    assert [(each.id, each.read, each.must, each.told) for each in one.settings] == [
        ("F0.04", 3, 4, None), ("F0.08", None, 8, "no"),
    ]  # fmt: skip
    assert [(each.gap, each.answer, each.word, each.value) for each in one.answers] == [
        ("scale of 2000H", "20.0", 2000, "0.01"), ("other: {x}", "#no", None, None),
    ]  # fmt: skip
    assert one.ended is None


def test_all_mistakes_of_the_file_are_reported_at_once(path: Path) -> None:
    text = path.read_text(encoding="utf-8").replace("Pump:", "Pump 1:").replace("rate: 19200", "rate: fast")
    path.write_text(text, encoding="utf-8")
    with pytest.raises(MapError) as error:
        kept.read(path)
    assert [(each.line, each.wrong[:12]) for each in error.value.problems] == [(3, "`Pump 1` is "), (7, "`rate: fast`")]


@pytest.mark.parametrize(
    ("old", "new", "wrong"),
    [
        ('value: "0.01"', 'value: "0,01"', "`value: 0,01` is not allowed; did you mean `0.01`?"),
        ('value: "0.01"', 'value: "-1"', "`value: -1` is not allowed"),
        ('value: "0.01"', 'value: "1.0; MotorRun := TRUE"', "`value: 1.0; MotorRun := TRUE` is not allowed"),
        (
            "turn_round_ms: 50",
            "turn_round_ms: 70000",
            "`turn_round_ms: 70000` is not a time of a PLC; write 0 to 65535",
        ),
        ("reply_ms: 500", "reply_ms: 65536", "`longest_reply_ms: 65536` is not a time of a PLC; write 0 to 65535"),
    ],
)
def test_only_what_a_plc_takes_becomes_a_setting(old: str, new: str, wrong: str, path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    assert text.count(old) == 1
    path.write_text(text.replace(old, new), encoding="utf-8")
    got = CliRunner().invoke(app, ["site", str(path)])
    assert (got.exit_code, got.stdout) == (2, "")
    ((line, row),) = [(at, row) for at, row in enumerate(text.splitlines(), 1) if old in row]
    column = row.index(old) + old.index(": ") + 3
    assert got.stderr.startswith(f"{path}:{line}:{column}: {wrong}")


@pytest.mark.parametrize("target", ["beremiz", "siemens"])
def test_a_date_of_a_persons_own_stays_a_comment(target: str, path: Path) -> None:
    text = path.read_text(encoding="utf-8").replace("2026-11-23 10:30", "*)\\nMotorRun := TRUE; (*")
    path.write_text(text, encoding="utf-8")
    got = CliRunner().invoke(app, ["site", str(path), "--to", target])
    assert got.exit_code == 0
    begin, end = ("//", "") if target == "siemens" else ("(*", "*)")
    (line,) = [each for each in got.stdout.splitlines() if "MotorRun" in each]
    assert (line.startswith(begin), line.endswith(end), line.count("*)")) == (True, True, len(end) // 2)


@pytest.mark.parametrize(("target", "line"), [
    ("codesys", "PumpSettings.FrequencyScale := 0.01;"), ("siemens", "#PumpSettings.FrequencyScale := 0.01;"),
])  # fmt: skip
def test_each_label_gets_settings_of_its_own(target: str, line: str, tmp_path: Path) -> None:
    kept.write(tmp_path / "site.yaml", ABOUT, FULL)
    kept.write(tmp_path / "site.yaml", replace(ABOUT, label="Fan"), replace(FULL, measured=None, answers=[]))
    got = CliRunner().invoke(app, ["site", str(tmp_path / "site.yaml"), "--to", target])
    assert (got.exit_code, got.stderr) == (0, "")
    lines = got.stdout.splitlines()
    assert line in lines
    assert {each.split(" : ")[0] for each in lines if " : " in each} == {"PumpSettings", "FanSettings"}
    assert not [each for each in lines if each.lstrip("#").startswith("FanSettings.")]


@pytest.mark.parametrize("target", ["beremiz", "codesys", "twincat", "openplc"])
def test_settings_compile_as_they_are_printed(target: str, tmp_path: Path) -> None:
    path, source = tmp_path / "site.yaml", tmp_path / "machine.st"
    answers = [
        Answer(f"gap {at}", "20", 20, f"{name}Scale", value)
        for at, (name, value) in enumerate(
            {"Frequency": "1", "Current": "0.1", "Voltage": "0.0001", "DcVoltage": "0.01", "Power": "0.001"}.items()
        )
    ]
    slow = replace(FULL.measured or Measured(1, 1, 1, 1, ""), longest_ms=2200)
    kept.write(path, ABOUT, replace(FULL, answers=answers, measured=slow))
    kept.write(path, replace(ABOUT, label="If"), FULL)
    said = CliRunner().invoke(app, ["site", str(path), "--to", target]).stdout
    declared, _, assigned = said.partition("\n\n")
    source.write_text(f"PROGRAM Machine\nVAR\n{declared}\nEND_VAR\n{assigned}END_PROGRAM\n", encoding="utf-8")
    got = CliRunner().invoke(app, ["lint", "--for", target, str(source)])
    assert (got.exit_code, got.stdout) == (0, "")
    assert assigned.count(":=") == 10


def test_the_page_and_the_report_say_what_was_found_and_escape_it(tmp_path: Path) -> None:
    path, page = tmp_path / "site.yaml", tmp_path / "site.html"
    kept.write(path, replace(ABOUT, who="Anna"), FULL)
    got = CliRunner().invoke(app, ["site", str(path), "--html", str(page), "--report", "Pump"])
    assert got.exit_code == 0
    got = CliRunner().invoke(app, ["site", str(path), "--html", str(page), "--report", "Pump"])
    assert got.exit_code == 0  # the page is its own
    assert "Anna" not in got.stdout
    assert "- setting F0.08: by eye not right, must be 8" in got.stdout
    assert "- gap `scale of 2000H`: 20.0; word 2000; FrequencyScale 0.01" in got.stdout
    text = page.read_text(encoding="utf-8")
    assert "5.5 kW &quot;B&quot; &lt;1.02&gt;" in text
    assert "signature" in text
    assert all(escape(what) in text for what, _ in steps.script(MAPS["jscc"]))
    got = CliRunner().invoke(app, ["site", str(path), "--report", "Fan"])
    assert (got.exit_code, got.stderr) == (2, f"{path} has no Fan; it has Pump\n")


def test_all_wrong_words_are_reported_at_once(tmp_path: Path) -> None:
    words = ["--rate", "5", "--format", "x", "--unit", "0", "--label", "1!", "--skip", "find"]
    got = CliRunner().invoke(app, ["commission", "nobody", *words, "--file", str(tmp_path / "a.yaml")])
    assert (got.exit_code, got.stdout) == (2, "")
    assert [line.split(" ")[0] for line in got.stderr.splitlines()] == [
        "name", "--rate", "--format", "--unit", "--label", "--skip", "there",
    ]  # fmt: skip


def test_what_was_found_before_is_not_replaced_unasked(path: Path) -> None:
    before = path.read_bytes()
    words = ["commission", "jscc", "--tcp", "127.0.0.1:1", "--file", str(path)]
    for label, wrong in (
        ("Pump", "Pump is kept there, of 2026-11-23 10:30; name another --label, or add --replace"),
        ("PUMP", "PUMP and Pump are one name in a PLC; name another --label"),
    ):
        got = CliRunner().invoke(app, [*words, "--label", label])
        assert (got.exit_code, got.stderr) == (2, f"{path}: {wrong}\n")
    got = CliRunner().invoke(app, [*words, "--label", "Pump", "--replace"])
    assert "127.0.0.1:1" in got.stderr
    assert path.read_bytes() == before


def test_what_is_replaced_is_copied_first(capsys: pytest.CaptureFixture[str], path: Path, tmp_path: Path) -> None:
    before = path.read_bytes()
    (tmp_path / "site.1.yaml").write_text("mine", encoding="utf-8")
    begun = Found(way=FULL.way, unit=3, family="fits", done=["quiet", "find"], ended="the terminal was closed")

    def closed(_line: object, _asker: object, _wish: object, keep: Callable[[Found], None]) -> Found:
        keep(begun)
        keep(begun)
        return begun

    with socket.create_server(("127.0.0.1", 0)) as server:
        place = f"127.0.0.1:{server.getsockname()[1]}"
        words = hour.Words(map="jscc", tcp=place, label="Pump", file=path, replace=True)
        hour.run(words, lambda _: "", closed)
        hour.run(replace(words, label="Fan"), lambda _: "", closed)
    assert (tmp_path / "site.2.yaml").read_bytes() == before
    assert (kept.read(path)["Pump"].measured, kept.read(tmp_path / "site.2.yaml")["Pump"].plate) == (None, FULL.plate)
    assert {each.name for each in tmp_path.iterdir()} == {"site.yaml", "site.1.yaml", "site.2.yaml"}
    said = "".join(capsys.readouterr().out.split())
    assert "".join(f"What {path} had before, Pump among it, is in {tmp_path / 'site.2.yaml'}".split()) in said


def test_nothing_is_replaced_where_it_could_not_be_copied(
    monkeypatch: pytest.MonkeyPatch, path: Path, tmp_path: Path
) -> None:
    before = path.read_bytes()

    def full(file: files.Output, data: bytes) -> None:
        file.write(data[:10])
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(files.Output, "add", full)
    shelf = hour.Shelf(path, ABOUT, replaces=True)
    shelf.keep(replace(FULL, unit=4))
    assert (shelf.wrong, shelf.copy) == ("No space left on device", None)
    assert (path.read_bytes(), [*tmp_path.iterdir()]) == (before, [path])


def test_a_folder_that_is_not_there_is_named_before_anything_is_sent(tmp_path: Path) -> None:
    path = tmp_path / "no" / "site.yaml"
    got = CliRunner().invoke(app, ["commission", "jscc", "--tcp", "127.0.0.1:1", "--file", str(path)])
    assert (got.exit_code, got.stderr) == (2, f"{path}: No such file or directory\n")


def test_what_cannot_be_written_is_shown_at_the_end(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    words = hour.Words(map="jscc", label="Pump", file=tmp_path / "gone" / "site.yaml")
    shelf = hour.Shelf(words.file, ABOUT)
    found = replace(FULL)
    shelf.keep(found)
    hour.told(adapter.Person(lambda _: ""), words, MAPS["jscc"], found, shelf)
    said = capsys.readouterr().out
    assert f"{words.file} could not be written: No such file or directory" in " ".join(said.split())
    assert kept.text(ABOUT, found) in said


def test_the_page_of_a_map_of_ones_own(tmp_path: Path) -> None:
    own, path, page = tmp_path / "mine.yaml", tmp_path / "site.yaml", tmp_path / "site.html"
    own.write_bytes(next(each.path for each in maps() if each.path.stem == "jscc").read_bytes())
    kept.write(path, replace(ABOUT, map="mine"), FULL)
    got = CliRunner().invoke(app, ["site", str(path), "--html", str(page)])
    assert (got.exit_code, page.exists()) == (2, False)
    assert "mine" in got.stderr
    got = CliRunner().invoke(app, ["site", str(path), "--html", str(page), "--map", str(own)])
    assert (got.exit_code, got.stderr) == (0, "")
    assert "mine, revision 12345678" in page.read_text(encoding="utf-8")


PAGE = Path(__file__).parents[3] / "docs" / "first-hour.md"
TYPED = ["alone", "4 kW, V2.31", "F0.04", "yes", "", "", "", ""]


def test_the_session_of_the_page_is_what_a_person_sees(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("COLUMNS", "80")
    answers, others = iter(TYPED), {name: each for name, each in MAPS.items() if name != "jscc"}

    def read(text: str) -> str:
        answer = next(answers)
        sys.stdout.write(f"{text}{answer}\n")
        return answer

    line, person = Line([drive("jscc", 5)], Way(9600, "8E1")), adapter.Person(read)
    found = commission(PortLine(line.opened, line.clock), person, Wish(MAPS["jscc"], others), lambda _: None)
    words = hour.Words(map="jscc", label="Pump")
    hour.told(person, words, MAPS["jscc"], found, hour.Shelf(words.file, ABOUT))
    assert found.ended == ""
    said = "\n".join(each.rstrip() for each in capsys.readouterr().out.splitlines())
    shown = PAGE.read_text(encoding="utf-8").partition("<!-- session:begin -->\n```\n")[2]
    assert shown.partition("\n```\n<!-- session:end -->")[0] == said


# ------------------------------------------------------------ real ports


def quickly(line: LineOf, asker: Asker, wish: Wish, keep: Callable[[Found], None]) -> Found:
    """All steps; the quiet minute takes a tenth of a second, and the reply time comes from 20 reads."""
    return commission(line, asker, replace(wish, quiet_us=100_000, reads=20), keep)


def test_a_port_that_is_not_there_is_named(tmp_path: Path) -> None:
    got = CliRunner().invoke(app, ["commission", "chf", "--port", "/dev/nowhere", "--file", str(tmp_path / "a.yaml")])
    assert (got.exit_code, got.stderr) == (2, "/dev/nowhere: there is no such port\n")
    assert [*tmp_path.iterdir()] == []


def test_the_command_ends_with_1_where_it_ends_early(tmp_path: Path) -> None:
    with socket.create_server(("127.0.0.1", 0)) as server:
        place = f"127.0.0.1:{server.getsockname()[1]}"

        def leave() -> None:
            server.accept()[0].close()

        gone = threading.Thread(target=leave)
        gone.start()
        got = CliRunner().invoke(app, ["commission", "chf", "--tcp", place, "--file", str(tmp_path / "a.yaml")])
        gone.join()
    assert (got.exit_code, got.stderr, "Ended early: " in got.stdout) == (1, "", True)


@pytest.mark.thorough
def test_pages_say_what_one_drive_has_shown_only_where_they_are_built_with_it(tmp_path: Path) -> None:
    path, out = tmp_path / "site.yaml", tmp_path / "out"
    kept.write(path, replace(ABOUT, who="Anna"), replace(FULL, plate="4 <kW> | V2"))
    kept.write(path, replace(ABOUT, label="Lift", map="other"), FULL)
    words = ["build", "jscc", "-o", str(out), "--lang", "en", "--to", "iec61131"]
    pages = {}
    for site in ([], ["--site", str(path)]):
        got = CliRunner().invoke(app, [*words, *site])
        assert (got.exit_code, got.stderr) == (0, "")
        assert ("other is not built here" in got.stdout) == bool(site)
        if site:
            assert CliRunner().invoke(app, [*words, *site, "--check"]).exit_code == 0
        pages[bool(site)] = {
            each.relative_to(out): each.read_text("utf-8") for each in out.rglob("*") if each.is_file()
        }
    differs = {each.name for each in pages[True] if pages[True][each] != pages[False][each]}
    assert differs == {"JSCC_Drive.md", ".driveblocks.json"}
    shown = pages[True][Path("docs/JSCC_Drive.md")]
    for line in ("## Measured on one drive", "### Pump", "| plate | 4 \\<kW> \\| V2 |", "| longest reply | 12 ms"):
        assert line in shown
    assert "Anna" not in shown
    assert "Lift" not in shown
    assert "Measured on one drive" not in pages[False][Path("docs/JSCC_Drive.md")]
    path.write_text("Pump: {map: 3}\n", encoding="utf-8")
    got = CliRunner().invoke(app, [*words, "--site", str(path)])
    assert got.exit_code == 2
    assert f"{path}:1:" in got.stderr
