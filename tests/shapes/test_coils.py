"""A drive that coils command: its reference and output frequency are pairs, its current is an input register."""

from dataclasses import dataclass, field, replace
from decimal import Decimal
from functools import cache
from pathlib import Path
from typing import Any

import pytest
from tests.maps import bad

from driveblocks.maps.collection import Source
from driveblocks.maps.form import SPACES, address_text, span_text
from driveblocks.maps.load import loads
from driveblocks.maps.model import Drive
from driveblocks.maps.polls import polls
from driveblocks.maps.problem import MapError
from driveblocks.output.units import units
from driveblocks.reference.checksum import crc16
from driveblocks.render.text import languages
from driveblocks.simulator.answer import answer
from driveblocks.simulator.machine import Machine
from driveblocks.testing import runner
from driveblocks.testing.unit import Unit
from structured_text.engines.embedded.engine import EmbeddedEngine
from structured_text.engines.engine import Engine, Instance, Library
from structured_text.engines.engine import Source as Text
from structured_text.language.lint import lint_sources

MAP = (bad.FOLDER / "coils.yaml").read_text(encoding="utf-8")
LOW_FIRST = MAP.replace("words: 2,", "words: 2, order: low_first,")
RUN, REVERSE, RESET = 0x0000, 0x0001, 0x0003
STATUS = 0x000E


@cache
def drive(text: str = MAP) -> Drive:
    """The made-up map, or another in its form."""
    return loads(text, "coils.yaml")


@cache
def unit(text: str = MAP) -> Unit:
    """Its blocks and programs."""
    made = units([Source(Path("coils.yaml"), drive(text))], languages(["en"], "utf-8"))
    return next(each for each in made if each.suite.name == "coils")


# ---------------------------------------------------------------- addresses, words and reads


def test_an_address_knows_its_table() -> None:
    run, reference = drive().register_at(SPACES["coil"]), drive().register_at(0)
    assert run is not None
    assert reference is not None
    assert (run.name, reference.name) == ("Run command", "Frequency command")
    assert [span_text(row.address) for row in (run, reference)] == ["coil 0000H", "0000H-0001H"]
    assert address_text(SPACES["input"] + 0x1000) == "input 1000H"


def test_numbers_of_a_manual_have_tables_too() -> None:
    numbering = "numbering: {first: 1, says: the number minus 1 is sent, source: section 1}\nserial:"
    text = MAP.replace("serial:", numbering, 1)
    for number in (
        "0003",
        "000E",
        "000F",
        "0010",
        "0011",
        "0017",
        "0012-0016",
        "1000-1001",
        "1000",
        "0000-0001",
        "0001",
    ):
        ends = "-".join(f"{int(each.rstrip('H'), 16) + 1:04X}H" for each in number.split("-"))
        plain = "-".join(f"{each}H" for each in number.split("-"))
        text = text.replace(f"address: {plain}", f"address! {ends}").replace(f"coil {plain}", f"coil! {ends}")
        text = text.replace(f"input {plain}", f"input! {ends}").replace(f"register: {plain}", f"register! {ends}")
    text = text.replace("coil 0000H", "coil! 0001H").replace("address: 0000H", "address! 0001H")
    text = text.replace("register: 0000H", "register! 0001H").replace("registers: [0011H]", "registers: [0012H]")
    text = text.replace("present: 0011H", "present: 0012H")
    for word in ("address", "register"):
        text = text.replace(f"{word}!", f"{word}:")
    found = loads(text.replace("coil!", "coil").replace("input!", "input"), "numbers.yaml")
    assert [row.address for _, row in found.registers()] == [row.address for _, row in drive().registers()]
    assert found.operation.standstill.all == drive().operation.standstill.all


def test_a_condition_on_a_pair_is_one_on_each_of_its_words() -> None:
    proof = [(address_text(each.register), each.equals) for each in drive().operation.standstill.all]
    assert proof == [("coil 000EH", 0), ("1000H", 0), ("1001H", 0)]
    text = MAP.replace("{register: 1000H, equals: 0}]}", "{register: 1000H, equals: 0}]}\n  commanded_by: {all: "
                       "[{register: 1000H, equals: 305419896}], source: table 2}", 1)  # fmt: skip
    found = loads(text, "x.yaml").operation.commanded_by
    assert found is not None
    assert [each.equals for each in found.all] == [0x1234, 0x5678]


def test_pairs_and_coils_are_read_together() -> None:
    reads = [(read.function, address_text(read.address), read.words) for read in polls(drive())]
    assert reads == [(1, "coil 000EH", 10), (3, "1000H", 2), (3, "0011H", 1), (4, "input 1000H", 1)]
    assert [read.characters() for read in polls(drive())] == [15, 17, 15, 15]


def test_no_read_ends_inside_a_pair() -> None:
    """Also where words before and after a pair do not fit into one read with it."""
    row = "      - {address: 0011H, access: r, name: Present fault}\n"
    rows = "".join(
        f"      - {{address: {at:04X}H, access: r, name: Value {at}, unit: A, scale: {{factor: 0.1, source: t}}}}\n"
        for at in range(0x0FF2, 0x1000)
    )
    text = MAP.replace(row, row + rows).replace("value: 16", "value: 15")
    made = drive(text)
    spoilt = replace(made.operation.measures[1], register=0x0FF2)
    other = replace(made, operation=replace(made.operation, measures=(made.operation.measures[0], spoilt)))
    for read in polls(other):
        assert (read.address <= 0x1000 < read.address + read.words) == (
            read.address <= 0x1001 < read.address + read.words
        )


def test_an_example_frame_proves_the_scale_of_a_pair() -> None:
    frames = """frames:
  - {id: asked, direction: request, mode: rtu, source: section 2, printed: 01 03 10 00 00 02 C0 CB, checksum: right,
     correct: 01 03 10 00 00 02 C0 CB, means: {says: reads 1000H, unit: 1, function: 03H, address: 1000H, words: 2}}
  - {id: told, direction: reply, mode: rtu, source: section 2, printed: 01 03 04 00 01 00 00 AB F3, checksum: right,
     correct: 01 03 04 00 01 00 00 AB F3, answers: asked, means: {says: it is fast, unit: 1, function: 03H, words: 2,
     byte_count: 4, values: [1, 0], quantities: [{register: 1000H, value: 655.36, unit: Hz}]}}"""
    made = loads(MAP.replace("frames: []", frames), "x.yaml")
    assert made.frames[1].means.quantities[0].value == Decimal("655.36")
    with pytest.raises(MapError, match="but 65536 x "):
        loads(MAP.replace("frames: []", frames.replace("655.36", "655.35")), "x.yaml")


# ---------------------------------------------------------------- blocks and programs


@pytest.mark.parametrize("text", [MAP, LOW_FIRST], ids=["high first", "low first"])
@pytest.mark.thorough
def test_its_blocks_are_clean_and_its_programs_pass(engine: Engine, text: str) -> None:
    blocks = {each.path: each for each in unit(text).blocks}
    if isinstance(engine, EmbeddedEngine):
        assert [str(problem) for problem in lint_sources([(each.path, each.text) for each in blocks.values()])] == []
    assert runner.run([unit(text)], [engine]).passed


# ---------------------------------------------------------------- the simulator


def asked(machine: Machine, body: str) -> str:
    """The reply to a request, both without unit address and checksum."""
    found = answer(machine, bytes([machine.unit]) + bytes.fromhex(body))
    return found[1:].hex(" ").upper() if found else ""


def test_the_simulator_knows_tables_and_pairs() -> None:
    machine = Machine(drive(), 1)
    assert asked(machine, "05 00 00 12 34") == "85 03", "neither set nor cleared"
    assert asked(machine, "05 00 0E FF 00") == "85 02", "read only"
    assert asked(machine, "10 00 00 00 02 04 00 00 13 88") == "10 00 00 00 02"
    assert asked(machine, "10 00 00 00 02 04 00 01 00 00") == "90 03", "beyond its range"
    assert asked(machine, "05 00 01 FF 00") == "05 00 01 FF 00"
    assert asked(machine, "05 00 00 FF 00") == "05 00 00 FF 00"
    machine.step(60_000)
    assert asked(machine, "03 10 00 00 02") == "03 04 00 00 13 88"
    assert asked(machine, "01 00 0E 00 0A") == "01 02 03 00", "it runs, in reverse"
    assert asked(machine, "01 00 0E 00 02") == "01 01 03"
    assert asked(machine, "04 10 00 00 01") != asked(machine, "03 10 00 00 01").replace("03 02", "04 02")
    assert asked(machine, "02 00 0E 00 01") == "82 01", "it has no discrete inputs"
    assert asked(machine, "05 00 00 00 00") == "05 00 00 00 00"
    machine.step(60_000)
    assert machine.hertz == 0


# ---------------------------------------------------------------- a second model, by hand


@dataclass
class Second:
    """A drive as its manual would have it, from nothing but table 1 to 3 of the map: no code of the simulator."""

    coils: dict[int, int] = field(default_factory=dict)
    words: dict[int, int] = field(default_factory=dict)
    counts: int = 0
    heard: list[bytes] = field(default_factory=list)

    def step(self) -> None:
        """A scan of 20 ms: 5 Hz per scan, up or down."""
        asked = (self.words.get(0, 0) << 16 | self.words.get(1, 0)) if self.coils.get(RUN) else 0
        self.counts = min(asked, self.counts + 500) if asked > self.counts else max(asked, self.counts - 500)

    def reply(self, request: bytes) -> bytes:
        """Without checksums. Raises KeyError for what the drive does not know."""
        self.heard.append(request)
        function, at, number = request[1], int.from_bytes(request[2:4], "big"), int.from_bytes(request[4:6], "big")
        if function == 5:
            assert number in (0, 0xFF00)
            assert at in (RUN, REVERSE, RESET)
            self.coils[at] = number // 0xFF00
            return request
        if function == 16:
            assert (at, number, request[6]) == (0, 2, 4)
            self.words |= {0: int.from_bytes(request[7:9], "big"), 1: int.from_bytes(request[9:11], "big")}
            return request[:6]
        if function == 1:
            shown = {STATUS: int(bool(self.coils.get(RUN) or self.counts)), STATUS + 1: self.coils.get(REVERSE, 0)}
            bits = sum(shown.get(at + place, 0) << place for place in range(number))
            data = bits.to_bytes((number + 7) // 8, "little")
        else:
            table = {(3, 0x1000): self.counts >> 16, (3, 0x1001): self.counts & 0xFFFF, (3, 0x11): 0, (4, 0x1000): 25}
            data = b"".join(table[function, each].to_bytes(2, "big") for each in range(at, at + number))
        return request[:2] + bytes([len(data)]) + data


RIG = """FUNCTION_BLOCK Rig
VAR_INPUT
  ElapsedMs : UINT;
  StopAll : BOOL;
  Skip : BOOL;
  Enable : BOOL;
  Forward : BOOL;
  Reverse : BOOL;
  Reset : BOOL;
  Hz : REAL;
  RxCount : UINT;
END_VAR
VAR_IN_OUT
  RxChars : MB_Adu;
  TxChars : MB_LineFrame;
END_VAR
VAR
  Slots : MB_Slots8;
  Motor : COI_Drive;
  Bus : MB_ByteLine8;
END_VAR
  IF NOT Skip THEN
    Motor(Enable := Enable, RunForward := Forward, RunReverse := Reverse, FaultReset := Reset, SpeedReferenceHz := Hz,
      MaximumHz := 400.0,
      Address := 1, StopWithinMs := 3000, Slot := Slots[0]);
  END_IF;
  Bus(ElapsedMs := ElapsedMs, BitRate := 19200, MaxScanMs := 20, StopAll := StopAll, RxCount := RxCount,
    RxChars := RxChars, TxChars := TxChars, Slots := Slots);
END_FUNCTION_BLOCK
PROGRAM Whole
VAR
  One : Rig;
  Rx : MB_Adu;
  Tx : MB_LineFrame;
  ElapsedMs : UINT;
  StopAll : BOOL;
  Skip : BOOL;
  Enable : BOOL;
  Forward : BOOL;
  Reverse : BOOL;
  Reset : BOOL;
  Hz : REAL;
  RxCount : UINT;
  TxCount : UINT;
END_VAR
  One(ElapsedMs := ElapsedMs, StopAll := StopAll, Skip := Skip, Enable := Enable, Forward := Forward,
    Reverse := Reverse, Reset := Reset, Hz := Hz, RxCount := RxCount, RxChars := Rx, TxChars := Tx);
  TxCount := One.Bus.TxCount;
END_PROGRAM
"""
BUILT: dict[str, Library] = {}


class Stand:
    """A motor on a line with a second model: 20 ms a scan, each request answered in the next but one."""

    def __init__(self, engine: Engine, text: str = MAP, model: Any = None) -> None:
        """Power up a motor of a map, with its model."""
        name = f"{engine.name} {drive(text).prefix}"
        if name not in BUILT:
            blocks = [Text(each.path, each.text) for each in unit(text).blocks]
            BUILT[name] = engine.build([*blocks, Text("rig.st", RIG.replace("COI_", f"{drive(text).prefix}_"))])
        self.whole: Instance = BUILT[name].instance("Whole")
        self.model: Any = model or Second()
        self._reply = b""
        self.whole["Enable"], self.whole["Hz"] = True, 50.0

    def run(self, ms: int, **pins: bool | float) -> list[bytes]:
        """Set pins and scan; what was written meanwhile, without checksums."""
        for name, value in pins.items():
            self.whole[name] = value
        before = len(self.model.heard)
        for _ in range(ms // 20):
            self.whole["ElapsedMs"] = 20
            self.whole["RxCount"] = len(self._reply)
            self.whole["Rx"] = self._reply or b"\xff"
            self.whole.scan()
            sent, count = self.whole["Tx"], self.whole["TxCount"]
            assert isinstance(sent, list)
            assert isinstance(count, int)
            frame = bytes(sent[:count])  # type: ignore[arg-type]  # an array of BYTE
            self._reply = b""
            if frame:
                assert crc16(frame[:-2]) == int.from_bytes(frame[-2:], "little")
                body = self.model.reply(frame[:-2])
                self._reply = body + crc16(body).to_bytes(2, "little")
            self.model.step()
        return [each for each in self.model.heard[before:] if each[1] > 4]

    def pin(self, name: str) -> object:
        """A pin of the motor."""
        return self.whole[f"One.Motor.{name}"]


OFF = bytes([1, 5, 0, 0, 0, 0])
ON = bytes([1, 5, 0, 0, 0xFF, 0])
AHEAD, BACK = bytes([1, 5, 0, 1, 0, 0]), bytes([1, 5, 0, 1, 0xFF, 0])


def speed(counts: int) -> bytes:
    """The write of a reference."""
    return bytes([1, 16, 0, 0, 0, 2, 4]) + counts.to_bytes(4, "big")


def test_a_motor_starts_turns_and_stops(engine: Engine) -> None:
    stand = Stand(engine)
    assert set(stand.run(4000)) == {OFF}, "a stop, and nothing that moves"
    assert stand.pin("Ready") is True
    assert stand.run(1500, Forward=True)[:3] == [speed(5000), AHEAD, ON]
    assert (stand.model.counts, stand.pin("Running"), stand.pin("Reverse")) == (5000, True, False)
    assert stand.pin("OutputFrequencyHz") == 50.0
    assert stand.pin("OutputCurrentA") == 2.5
    assert speed(39000) in stand.run(2000, Hz=390.0)
    assert stand.pin("OutputFrequencyHz") == 390.0
    assert stand.run(3000, Forward=False)[0] == OFF
    assert (stand.model.counts, stand.pin("StopConfirmed"), stand.pin("Running")) == (0, True, False)
    assert [each for each in stand.run(1500, Reverse=True, Hz=20.0) if each != speed(2000)][:2] == [BACK, ON]
    assert stand.pin("Reverse") is True


@pytest.mark.parametrize("how", ["StopAll", "Skip"])
def test_the_line_stops_it_on_its_own(engine: Engine, how: str) -> None:
    stand = Stand(engine)
    stand.run(4000)
    stand.run(1500, Forward=True)
    assert stand.model.counts == 5000
    sent = stand.run(3000, **{how: True})
    assert stand.model.counts == 0
    assert stand.model.coils[RUN] == 0
    assert ON not in sent
