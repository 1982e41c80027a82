"""References and measures that no shipped drive has: made-up maps, words typed by hand, and motors that turn."""

import re
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path

import pytest
from click.testing import CliRunner
from tests.examples.port import Port
from tests.shapes import values

from driveblocks.bench import runner
from driveblocks.bench.outcome import Result
from driveblocks.bench.simulator.drive import SimulatedDrive
from driveblocks.bench.unit import Unit
from driveblocks.cli import app
from driveblocks.desk.bus import Bus
from driveblocks.desk.simulate.setup import view
from driveblocks.desk.site.register import rows, value
from driveblocks.maps.collection import Source
from driveblocks.maps.load import loads
from driveblocks.maps.model import USES, Drive
from driveblocks.meaning import conduct
from driveblocks.output.units import units
from driveblocks.platforms.port import by_words
from driveblocks.reference.command import Commands, Pins
from driveblocks.reference.speed import SpeedReference
from driveblocks.render.text import languages
from structured_text.engines.embedded.engine import EmbeddedEngine
from structured_text.engines.engine import Engine
from structured_text.engines.engine import Source as Text
from structured_text.language.lint import lint_sources
from structured_text.language.problems import Problem

CONCERNED = re.compile(r"_Test(Reference|Motor|Scales|Standstill|Command)")


@cache
def drives() -> Mapping[str, Drive]:
    """The maps by name."""
    high_first = values()["pair_signed"]
    low_first = high_first.replace("0000H-0001H, words: 2,", "0000H-0001H, words: 2, order: low_first,")
    texts = {**values(), "low_first": low_first.replace("PSG", "PSL", 1)}
    return {name: loads(text, f"{name}.yaml") for name, text in texts.items()}


@cache
def built() -> dict[str, Unit]:
    """The shared blocks, and the blocks and programs of each; made together, since most of it is shared."""
    sources = [Source(Path(f"{name}.yaml"), drive) for name, drive in drives().items()]
    return {unit.suite.name: unit for unit in units(sources, languages(["en"], "utf-8"))}


@cache
def concerned() -> dict[str, Unit]:
    """Of each the programs that its references and measures concern."""
    made = {name: [one for one in built()[name].suite.programs if CONCERNED.search(one.path)] for name in drives()}
    return {
        name: replace(built()[name], suite=replace(built()[name].suite, programs=tuple(made[name]))) for name in made
    }


@cache
def problems() -> list[Problem]:
    """What the linter finds in the blocks of all."""
    blocks = {each.path: each.text for unit in built().values() for each in unit.blocks}
    return lint_sources(list(blocks.items()))


@cache
def results() -> list[Result]:
    """What came of the programs of all."""
    return runner.run(list(concerned().values()), [EmbeddedEngine()]).results


@pytest.mark.parametrize("name", drives())
@pytest.mark.thorough
def test_their_blocks_are_clean_and_a_motor_runs(name: str) -> None:
    own = {each.path for unit in (built()["modbus"], built()[name]) for each in unit.blocks}
    assert [str(problem) for problem in problems() if problem.path in own] == []
    assert len(concerned()[name].suite.programs) > 4
    found = [each for each in results() if each.unit == name]
    assert len(found) > len(concerned()[name].suite.programs)
    assert [str(each) for each in found if not each.passed] == []


@pytest.mark.parametrize(
    ("name", "pins", "word"),
    [
        # 4000H is what P2.00 says
        ("fraction", (50.0, 50.0, 50.0), 0x4000),
        ("fraction", (25.0, 50.0, 50.0), 0x2000),
        ("fraction", (25.0, 50.0, 100.0), 0x1000),
        ("fraction", (60.0, 50.0, 50.0), 0x4000),
        # 20000 is 60 Hz for good
        ("given", (60.0, 100.0, 0.0), 20000),
        ("given", (30.0, 100.0, 0.0), 10000),
        ("given", (30.0, 15.0, 0.0), 5000),
        ("given", (90.0, 100.0, 0.0), 30000),
        # r/min of a motor with 2, 1 and 3 pole pairs
        ("turns", (50.0, 50.0, 0.0, 2.0), 1500),
        ("turns", (50.0, 50.0, 0.0, 1.0), 3000),
        ("turns", (60.0, 50.0, 0.0, 3.0), 1000),
        ("turns_signed", (25.0, 50.0, 0.0, 2.0), 1500),
        # 0.05 r/min, and 65000 at most
        ("pair_turns", (50.0, 50.0, 0.0, 1.0), 60000),
        ("pair_turns", (60.0, 60.0, 0.0, 1.0), 65000),
        # 20000 is 50 Hz, and 24000 the most
        ("pair_signed", (25.0, 50.0, 0.0), 10000),
        ("pair_signed", (70.0, 100.0, 0.0), 24000),
    ],
)
def test_the_word_of_a_frequency(name: str, pins: tuple[float, ...], word: int) -> None:
    found = SpeedReference(drives()[name]).encode(*pins)
    assert (found.result, found.value) == ("OK", word)


@pytest.mark.parametrize(
    ("name", "word", "hertz"), [("fraction", 0x2000, 25.0), ("given", 10000, 30.0), ("turns", 900, 30.0)]
)
def test_the_frequency_of_a_word(name: str, word: int, hertz: float) -> None:
    drive = SimulatedDrive(drives()[name], 1)
    drive.reply(bytes.fromhex("01 06 10 01") + word.to_bytes(2, "big"))
    drive.reply(bytes.fromhex("01 06 10 00 00 01"))
    drive.step(10_000)
    assert drive.hertz == hertz


@pytest.mark.parametrize(
    ("name", "words", "hertz"),
    [
        ("pair_turns", "00 00 75 30", 50.0),
        ("pair_signed", "00 00 27 10", 25.0),
        ("pair_signed", "FF FF D8 F0", -25.0),
        ("low_first", "D8 F0 FF FF", -25.0),
    ],
)
def test_the_frequency_of_a_pair(name: str, words: str, hertz: float) -> None:
    drive = SimulatedDrive(drives()[name], 1)
    drive.reply(bytes.fromhex("01 10 00 00 00 02 04" + words))
    drive.reply(bytes.fromhex("01 05 00 00 FF 00"))
    drive.step(10_000)
    assert drive.hertz == hertz


@pytest.mark.parametrize(
    ("name", "sent", "words"),
    [
        ("pair_turns", 0xEA60, (0x0000, 0xEA60)),
        ("pair_signed", 0x2710, (0x0000, 0x2710)),
        ("pair_signed", 0xD8F0, (0xFFFF, 0xD8F0)),
        ("low_first", 0x2710, (0x2710, 0x0000)),
        ("low_first", 0xD8F0, (0xD8F0, 0xFFFF)),
    ],
)
@pytest.mark.thorough
def test_the_words_of_a_reference_of_32_bits(name: str, sent: int, words: tuple[int, int]) -> None:
    *types, orders = (
        each for each in built()[name].blocks if re.search(r"/(MB_Words4|MB_Ask|\w+_Orders)\.st$", each.path)
    )
    files = [Text(each.path, each.text) for each in (*types, orders)]
    block = EmbeddedEngine().build(files).instance(Path(orders.path).stem)
    block["Order"], block["ReferenceWord"] = 10, sent
    block.scan()
    assert (block["Ask.Words[0]"], block["Ask.Words[1]"], block["Ask.Quantity"]) == (*words, 2)


def test_no_program_for_a_foreign_master_where_it_takes_coils_or_pairs() -> None:
    """Nor is there a command block for coils: it gives words."""
    for name, has in {"turns_signed": True, "pair_signed": False}.items():
        assert by_words(drives()[name]) == has
        assert any(each.path.endswith("_Command.st") for each in built()[name].blocks) == has


@pytest.mark.parametrize("pairs", [0, 101])
def test_no_speed_without_pole_pairs(pairs: float) -> None:
    assert SpeedReference(drives()["turns"]).encode(25.0, 50.0, 0.0, pairs).result == "NO_SCALE"


@pytest.mark.parametrize(("hertz", "word"), [(50.0, 0xB1E0), (25.0, 0xD8F0), (0.0, 0), (60.0, 0xB1E0)])
def test_a_run_in_reverse_has_a_negative_word(hertz: float, word: int) -> None:
    reference = SpeedReference(drives()["signed"])
    assert reference.encode(hertz, 50.0, reverse=True).value == word
    assert SpeedReference(drives()["fraction"]).encode(25.0, 50.0, 50.0, reverse=True).value == 0x2000


def test_what_a_drive_shows_beside_its_frequency() -> None:
    """At 20 Hz of 50 Hz, two pole pairs, half of the load; the scales of the map."""
    drive = SimulatedDrive(drives()["measured"], 1)
    drive.keypad_run(20.0, reverse=True)
    drive.step(10_000)
    shown = [
        int.from_bytes(drive.word(address).to_bytes(2, "big"), "big", signed=True) for address in range(0x2003, 0x200A)
    ]
    assert shown == [-600, 500, 200, 40, 500, 100, 120]


def test_the_command_block_alone_cannot_reverse_by_a_sign() -> None:
    """It knows no reference, so that its RunReverse is a stop and an error."""
    told = Commands(drives()["signed"]).step(Pins(run_reverse=True))
    assert (told.value, told.result, told.stopping) == (3, "NOT_ABLE", True)


def test_a_full_scale_that_no_parameter_holds_needs_no_pin() -> None:
    assert SpeedReference(drives()["fraction"]).encode(25.0, 50.0).result == "NO_FULL_SCALE"
    assert SpeedReference(drives()["given"]).encode(25.0, 50.0).result == "OK"


def test_what_is_read_at_an_address_is_not_what_was_written_there() -> None:
    known = drives()["one_place"]
    rows = [known.register_at(0x1000, use) for use in USES]
    assert [row.name for row in rows if row] == ["Drive status", "Run command"]
    drive = SimulatedDrive(known, 1)
    drive.reply(bytes.fromhex("01 06 10 01 13 88"))
    drive.reply(bytes.fromhex("01 06 10 00 00 02"))
    drive.step(10_000)
    assert drive.hertz == -50.0
    # status: running, and no bit of the command; no fault, and not the reference
    assert drive.reply(bytes.fromhex("01 03 10 00 00 02")) == bytes.fromhex("01 03 04 00 01 00 00")


@pytest.mark.parametrize(
    ("frame", "request_", "told"),
    [
        ("01 06 10 00 00 01 4C CA", "", "1000H Run command"),
        ("01 03 10 00 00 01 80 CA", "", "1000H Drive status"),
        ("01 03 02 00 01 79 84", "01 03 10 00 00 01 80 CA", "Drive status"),
        ("01 06 10 01 00 01 1D 0A", "", "1001H Speed reference"),
    ],
)
def test_a_register_is_called_by_what_a_frame_does_with_it(
    frame: str, request_: str, told: str, tmp_path: Path
) -> None:
    file = tmp_path / "one_place.yaml"
    file.write_text(values()["one_place"], encoding="utf-8")
    asked = ["--request", request_] if request_ else []
    shown = CliRunner().invoke(app, ["explain", frame, "--drive", str(file), *asked])
    assert shown.exit_code == 0, shown.stdout
    assert told in shown.stdout
    pages = CliRunner().invoke(app, ["show", str(file), "1000H"]).stdout
    written = pages.index("Run command\n  address")
    read = pages.index("Drive status\n  address")
    assert read < pages.index("running: 1000H bit 0") < written < pages.index("run forward: write 1")


def test_a_warning_has_its_code_and_its_text(tmp_path: Path) -> None:
    drive = SimulatedDrive(drives()["warned"], 1)
    asked, quiet = bytes.fromhex("01 03 20 02 00 01"), bytes.fromhex("01 03 02 00 00")
    assert drive.reply(asked) == quiet
    drive.warning = True
    assert drive.reply(asked) == bytes.fromhex("01 03 02 01 00")
    drive.trip(1)
    assert drive.reply(asked) == bytes.fromhex("01 03 02 01 01")
    drive.warning = False
    assert drive.reply(asked) == bytes.fromhex("01 03 02 00 01")
    file = tmp_path / "warned.yaml"
    file.write_text(values()["warned"], encoding="utf-8")

    def said(*words: str) -> str:
        return CliRunner().invoke(app, [words[0], *words[1:]]).stdout

    told = said("explain", "01 03 02 14 00 B7 44", "--drive", str(file), "--request", "01 03 20 02 00 01 2E 0A")
    assert re.search(r"^ fault .*no fault", told, re.MULTILINE)
    assert re.search(r"^ warning .*Motor overheating$", told, re.MULTILINE)
    assert "WAR  warning 01H (1)  CE1" in said("show", str(file), "CE1")
    assert "Warning codes: 2" in said("show", str(file), "faults")
    assert re.search(r"^warning code +2002H bits 8-F", said("show", str(file)), re.MULTILINE)


def test_a_warning_is_seen_in_a_simulation() -> None:
    known = drives()["warned"]
    bus = Bus([SimulatedDrive(known, 1)], 9600, 10, ascii_mode=False)
    bus.drives[0].warning = True
    (seen,) = view(bus, {1: known}, 0, counted=False).drives
    assert seen.state == "standstill, warning CE1"


@dataclass
class Words:
    """A drive that stands and answers with these words, and takes every write."""

    words: dict[int, int]
    unit: int = 1
    turn_us: int = 20_000

    def step(self, ms: int) -> None:
        """Nothing moves."""

    def reply(self, request: bytes) -> bytes | None:
        """Without checksums."""
        if request[1] == 6:
            return request
        first, count = int.from_bytes(request[2:4], "big"), int.from_bytes(request[4:6], "big")
        data = b"".join(self.words.get(each, 0).to_bytes(2, "big") for each in range(first, first + count))
        return request[:2] + bytes([len(data)]) + data


WHOLE = """PROGRAM Whole
VAR
  Reset : BOOL;
  StopAll : BOOL;
  RxCount : UINT;
  RxChars : MB_Adu;
  TxCount : UINT;
  TxChars : MB_LineFrame;
  Slots : MB_Slots8;
  Motor : {prefix}_Drive;
  Bus : MB_ByteLine8;
END_VAR
  Motor(Enable := TRUE, FaultReset := Reset, SpeedReferenceHz := 50.0, MaximumHz := 400.0, Address := 1,
    StopWithinMs := 3000, Slot := Slots[0]);
  Bus(ElapsedMs := 10, BitRate := 19200, MaxScanMs := 20, StopAll := StopAll, RxCount := RxCount, RxChars := RxChars,
    TxChars := TxChars, Slots := Slots);
  TxCount := Bus.TxCount;
END_PROGRAM
"""


class Stand:
    """A motor of a map on a line with a model of its drive."""

    def __init__(self, engine: Engine, text: str, model: Words) -> None:
        """Power up."""
        drive = loads(text, "made_up.yaml")
        made = units([Source(Path("made_up.yaml"), drive)], languages(["en"], "utf-8"))
        blocks = [Text(each.path, each.text) for unit in made if unit.suite.name == "made_up" for each in unit.blocks]
        whole = engine.build([*blocks, Text("whole.st", WHOLE.format(prefix=drive.prefix))]).instance("Whole")
        self.port = Port(whole, [model], 10 / 19.2)

    def run(self, ms: int, **pins: bool) -> None:
        """Set pins and scan."""
        for name, on in pins.items():
            self.port.program[name] = on
        for _ in range(ms // 10):
            self.port.scan()

    def pin(self, name: str) -> object:
        """A pin of the motor."""
        return self.port.program[f"Motor.{name}"]


def test_a_register_chooses_the_decimals_of_a_measure(engine: Engine, tmp_path: Path) -> None:
    text = values()["decimals"]
    model = Words({0x2003: 1234, 0x2004: 0x0200})
    stand = Stand(engine, text, model)
    stand.run(3000)
    for chosen, amperes in ((0x0200, 12.34), (0x0100, 123.4), (0x00FF, 1234.0)):
        model.words[0x2004] = chosen
        stand.run(1000)
        assert stand.pin("Diagnosis.OutputCurrentValid") is True
        assert stand.pin("OutputCurrentA") == pytest.approx(amperes, rel=1e-6)
    model.words[0x2004] = 0x0300
    stand.run(1000)
    assert stand.pin("Diagnosis.OutputCurrentValid") is False
    last = ", when: {register: 2004H, bit: 8-F, equals: 0}, source"
    assert last in text
    other = Stand(engine, text.replace(last, ", source").replace("DEC", "DEO", 1), model)
    other.run(4000)
    assert (other.pin("Diagnosis.OutputCurrentValid"), other.pin("OutputCurrentA")) == (True, 1234.0)
    model.words[0x2004] = 0x0100
    other.run(1000)
    assert other.pin("OutputCurrentA") == pytest.approx(123.4, rel=1e-6)
    file = tmp_path / "decimals.yaml"
    file.write_text(text, encoding="utf-8")
    frame = ["01 03 02 04 D2 3A D9", "--request", "01 03 20 03 00 01 7F CA"]
    told = " ".join(CliRunner().invoke(app, ["explain", *frame, "--drive", str(file)]).stdout.split())
    assert "1234 = 12.34 A; only while 2004H bits 8-F = 2; 123.4 A while 2004H bits 8-F = 1" in told
    row = next(each for each in rows(drives()["decimals"]) if each.address == 0x2003)
    assert value(row, 1234, {0x2004: 0x0100}) == ("123.4", "A")
    assert value(row, 1234, {0x2004: 0x0300}) == ("1234", "A ?")


@dataclass
class Deaf(Words):
    """It trips, and answers nothing for 1.5 s once it has answered a reset."""

    resets: tuple[int, int] = (0x1000, 7)
    ms: int = 0
    unheard: int = 0

    def step(self, ms: int) -> None:
        """Time passes."""
        self.ms = max(0, self.ms - ms)

    def reply(self, request: bytes) -> bytes | None:
        """Nothing while it is deaf."""
        if self.ms:
            self.unheard += 1
            return None
        if request[1] == 6 and (int.from_bytes(request[2:4], "big"), request[5]) == self.resets:
            self.ms, self.words[0x2002] = 1500, 0
        return super().reply(request)


@pytest.mark.parametrize(
    ("name", "resets", "told"),
    [("deaf", (0x1000, 7), True), ("deaf_in_between", (0x1002, 1), True), ("deaf", (0x1000, 7), False)],
)
def test_a_drive_that_is_silent_after_its_reset_is_not_lost(
    name: str, resets: tuple[int, int], told: bool, engine: Engine
) -> None:
    text = values()[name] if told else values()[name].replace(" silent_ms: 1500,", "").replace("DEA", "DEN")
    model = Deaf({0x2002: 1}, resets=resets)
    stand = Stand(engine, text, model)
    stand.run(4000)
    assert (stand.pin("Fault"), stand.pin("StopConfirmed")) == (True, True)
    lost = 0
    for scan in range(200):
        stand.run(20, Reset=scan > 0)
        lost += stand.pin("CommOk") is not True
    assert (stand.pin("Fault"), stand.pin("Ready")) == (False, True)
    if told:
        assert (lost, model.unheard, stand.port.program["Slots[0].Timeouts"]) == (0, 0, 0)
    else:
        assert lost > 10
        assert model.unheard > 2


def test_a_stop_passes_while_the_drive_is_silent(engine: Engine) -> None:
    model = Deaf({0x2002: 1})
    stand = Stand(engine, values()["deaf"], model)
    stand.run(4000)
    stand.run(20)
    stand.run(400, Reset=True)
    assert model.ms > 800
    before = model.unheard
    stand.run(100, StopAll=True)
    assert model.unheard > before


def test_a_simulated_drive_is_silent_after_its_reset() -> None:
    drive = SimulatedDrive(drives()["deaf_in_between"], 1)
    asked, write = bytes.fromhex("01 03 20 00 00 01"), bytes.fromhex("01 06 10 02 00 01")
    assert drive.reply(write) == write
    drive.step(1400)
    assert drive.reply(asked) is None
    drive.step(200)
    assert drive.reply(asked) == bytes.fromhex("01 03 02 00 00")
    assert drive.reply(bytes.fromhex("01 06 10 02 00 00")) is not None
    assert drive.reply(asked) is not None
    told = "it answers nothing for 1500 ms after write 1 of 2 of a fault reset"
    assert (conduct.silenced(drives()["deaf_in_between"]) or "").startswith(told)
