"""The examples as a user would take them: short, clean, and run against simulated drives by the bytes on the wire."""

import re
from dataclasses import dataclass, field
from itertools import pairwise
from pathlib import Path

import pytest
from tests.blocks.library import built, sources
from tests.examples.port import Port
from tests.shipped import drives

from driveblocks.bench.simulator.drive import SimulatedDrive
from structured_text.engines.engine import Engine, Source
from structured_text.language.lint import lint_sources

ROOT = Path(__file__).parents[2]
FOLDER = ROOT / "examples"
NAMES = ("one_motor", "three_makes", "hand_off_auto", "meter_and_sensor")
PARTS = (
    "types/",
    "modbus/MB_Hex",
    "line/",
    "vfd/VFD_",
    "device/",
    "invt_chf/",
    "invt_gd200a/",
    "jscc/",
    "rockwell_powerflex_4/",
    "shuen_sn300g5/",
)
SPARE = re.compile(r"Text|_Request\.|_Reply\.|_Command\.|32")
"""Blocks that the examples do not use."""
TEXTS = {name: (FOLDER / f"{name}.st").read_text(encoding="utf-8") for name in NAMES}
FILES = [
    *(each for each in sources() if each.path.startswith(PARTS) and not SPARE.search(each.path)),
    *(Source(f"{name}.st", text) for name, text in TEXTS.items()),
]
STOP = bytes.fromhex("010610000005")
JOG_STOP = bytes.fromhex("010610000008")


def test_every_example_is_short_clean_and_tried() -> None:
    assert {path.stem for path in FOLDER.glob("*.st")} == set(NAMES)
    assert all(len(text.splitlines()) < 100 for text in TEXTS.values())
    assert lint_sources((each.path, each.text) for each in FILES) == []


def test_the_readme_leads_to_each() -> None:
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    assert all(f"(examples/{name}.st)" in readme for name in NAMES)


class Plant:
    """A program with its drives: set pins, let time pass, read what it says."""

    def __init__(self, engine: Engine, program: str, families: list[str], bits: int) -> None:
        """Drives at unit 1, 2 ... at 9600 bit/s."""
        self.program = built(engine, "examples", FILES).library.instance(program)
        self.drives = [SimulatedDrive(drives()[family], unit) for unit, family in enumerate(families, 1)]
        self.port = Port(self.program, self.drives, bits / 9.6)

    def run(self, ms: int, **pins: bool | float) -> list[bytes]:
        """Let time pass; the writes that went out."""
        for pin, value in pins.items():
            self.program[pin] = value
        before = len(self.port.sent)
        for _ in range(ms // 10):
            self.port.scan()
        return [frame for frame in self.port.sent[before:] if frame[1] != 3]

    def says(self, *paths: str) -> list[object]:
        """What the program shows."""
        return [self.program[path] for path in paths]


def test_one_motor(engine: Engine) -> None:
    plant = Plant(engine, "OneMotor", ["CHF"], 10)
    (drive,) = plant.drives
    # power-up: stopped and confirmed, and the contact of the hard stop waits for its button; then a start, which gives
    # reference and run once each and turns up to speed
    # (a jog is not known to be none, so that its end is sent, too)
    assert set(plant.run(3500, NotStop=True, Hertz=30.0)) == {STOP, JOG_STOP}
    assert plant.says("Standing", "Why", "HardStopOk") == [True, 20, False]
    # the contact closes by a press of the reset button, and with it the hard stop; nothing is sent
    assert plant.run(100, ResetButton=True) == []
    assert plant.run(500, ResetButton=False, HardStopClosed=True) == []
    assert plant.says("Standing", "Why", "HardStopOk") == [True, 1, True]
    started = [*plant.run(100, StartButton=True), *plant.run(900, StartButton=False)]
    assert started[:2] == [bytes.fromhex(each) for each in ("010620001770", "010610000001")]
    assert plant.says("Standing", "Why") == [False, 0]
    assert 0 < drive.hertz < 30
    plant.run(4000)
    assert drive.hertz == 30
    # stop: at once, repeated, confirmed when it stands, and the button that returns starts nothing
    assert plant.run(1000, NotStop=False)[0] == STOP
    assert plant.says("Standing", "Why") == [False, 4]
    plant.run(4000)
    assert plant.says("Standing", "Why") == [True, 1]
    assert plant.run(2000, NotStop=True) == []
    # a trip stops it, with the start button stuck; the reset moves nothing; a new edge does
    plant.run(3000, StartButton=True)
    drive.trip(3)
    plant.run(500)
    assert plant.says("Why", "Motor.FaultCode", "Standing") == [40, 3, False]
    drive.clear_cause()
    plant.run(10000)
    plant.run(3000, ResetButton=True)
    assert plant.says("Why", "Motor.Fault", "Standing") == [1, False, True]
    assert (drive.hertz, drive.fault) == (0, 0)
    plant.run(3000, ResetButton=False, StartButton=False)
    assert drive.hertz == 0
    plant.run(100, StartButton=True)
    plant.run(4000, StartButton=False)
    assert drive.hertz == 30
    # the hard stop opens, and closes again: nothing starts
    assert plant.run(1000, HardStopClosed=False)[0] == STOP
    plant.run(5000)
    plant.run(3000, HardStopClosed=True)
    assert (drive.hertz, plant.says("Run")) == (0, [False])


def test_one_press_is_enough_after_a_stop_at_the_keypad(engine: Engine) -> None:
    """The seal-in drops when the block lets go; a button that is held or stuck starts nothing again."""
    plant = Plant(engine, "OneMotor", ["CHF"], 10)
    (drive,) = plant.drives
    plant.run(4000, NotStop=True, HardStopClosed=True, Hertz=30.0)
    for held in (False, True):
        plant.run(100, StartButton=True)
        plant.run(5000, StartButton=held)
        assert (drive.hertz, plant.says("Run")) == (30, [True])
        drive.reply(STOP)  # somebody else stops it, as the keypad would
        plant.run(8000)
        assert (drive.hertz, plant.says("Standing")) == (0, [True])
        plant.run(100, StartButton=False)
        assert plant.says("Run") == [False]
    plant.run(100, StartButton=True)
    plant.run(5000, StartButton=False)
    assert drive.hertz == 30


def hand(engine: Engine) -> Plant:
    """Hand, off, auto with a motor that has run up to 20 Hz in hand."""
    plant = Plant(engine, "HandOffAuto", ["CHF"], 10)
    plant.run(4000, NotStop=True, HardStopClosed=True, HertzPerS=5.0, Hand=True, AutoHertz=40.0)
    plant.run(4000, Faster=True)
    plant.run(100, Faster=False, StartButton=True)
    plant.run(6000, StartButton=False)
    assert plant.drives[0].hertz == 20
    return plant


def speeds(frames: list[bytes]) -> list[float]:
    """The references of some writes, in Hz: percent of 50 Hz, in hundredths."""
    return [int.from_bytes(frame[4:6], "big") / 200 for frame in frames if frame[2:4] == b"\x20\x00"]


def test_hand_and_auto_change_without_a_bump(engine: Engine) -> None:
    plant = hand(engine)
    (drive,) = plant.drives
    # to auto: it runs on, and its speed leads to that of the process at 5 Hz/s
    written = plant.run(8000, AutoRun=True, Hand=False, Auto=True)
    assert STOP not in written
    way = [20.0, *speeds(written)]
    assert way == sorted(way)
    assert way[-1] == 40
    assert max(b - a for a, b in pairwise(way)) <= 5.0, "no more than a second's worth between two references"
    assert drive.hertz == 40
    # back to hand: it runs on at the speed that it has
    written = plant.run(5000, Hand=True, Auto=False)
    assert STOP not in written
    assert set(speeds(written)) == {40.0}
    assert (drive.hertz, plant.says("Hertz")) == (40, [40.0])
    written = plant.run(2000, Slower=True)
    assert STOP not in written
    plant.run(3000, Slower=False)
    assert 29.9 <= drive.hertz <= 30.1
    # to auto, which does not want it
    assert plant.run(1000, AutoRun=False, Hand=False, Auto=True)[0] == STOP


def test_off_stops_at_once_and_nothing_starts_by_itself(engine: Engine) -> None:
    plant = hand(engine)
    (drive,) = plant.drives
    for selected in ({"Hand": False, "Auto": False}, {"Hand": True, "Auto": True}):
        assert plant.run(1000, **selected)[0] == STOP
        plant.run(6000)
        assert drive.hertz == 0
        plant.run(3000, Hand=True, Auto=False)
        assert drive.hertz == 0, "hand has to be started"
        plant.run(100, StartButton=True)
        plant.run(6000, StartButton=False)
        assert drive.hertz == 20
    # auto: by both, once; a stop elsewhere, or a fault, is no reason to start again
    plant.run(6000, Hand=False)
    plant.run(9000, Auto=True, AutoRun=True)
    assert drive.hertz == 40
    drive.reply(STOP)
    plant.run(12000)
    assert (drive.hertz, plant.says("Run")) == (0, [False])
    plant.run(500, AutoRun=False)
    plant.run(9000, AutoRun=True)
    assert drive.hertz == 40
    drive.trip(3)
    plant.run(10000)
    drive.clear_cause()
    plant.run(3000, ResetButton=True)
    plant.run(5000, ResetButton=False)
    assert (drive.hertz, drive.fault, plant.says("Run")) == (0, 0, [False])


def test_a_speed_that_is_no_number_stops_it_and_hand_is_not_spoilt(engine: Engine) -> None:
    plant = hand(engine)
    plant.run(8000, AutoRun=True, Hand=False, Auto=True)
    assert plant.run(1000, AutoHertz=float("nan"))[0] == STOP
    plant.run(8000)
    assert plant.says("Motor.Reason", "HandHertz") == [32, 40.0]
    plant.run(2000, Hand=True, Auto=False, AutoHertz=40.0)
    plant.run(100, StartButton=True)
    plant.run(9000, StartButton=False)
    assert plant.drives[0].hertz == 40


@dataclass
class Unit:
    """A meter or a sensor: registers by function code and address, and what was written."""

    unit: int
    registers: dict[tuple[int, int], int]
    turn_us: int = 40_000
    alive: bool = True
    written: list[bytes] = field(default_factory=list)

    def step(self, ms: int) -> None:
        """Nothing in it moves."""

    def reply(self, request: bytes) -> bytes | None:
        """What it has, refused where it has nothing."""
        unit, function, address = request[0], request[1], int.from_bytes(request[2:4], "big")
        if not self.alive:
            return None
        if function not in (3, 4):
            self.written.append(request)
            return request[:6]
        words = [self.registers.get((function, address + index)) for index in range(request[5])]
        if None in words:
            return bytes([unit, function + 0x80, 2])
        data = b"".join(word.to_bytes(2, "big") for word in words if word is not None)
        return bytes([unit, function, len(data)]) + data


def test_a_meter_and_a_sensor_beside_a_motor(engine: Engine) -> None:
    plant = Plant(engine, "MeterAndSensor", ["CHF"], 10)
    (drive,) = plant.drives
    meter, sensor = Unit(10, {(4, 0x0100): 0x86A0, (4, 0x0101): 0x0001}), Unit(11, {(3, 0): 250})
    plant.port.drives = [drive, meter, sensor]
    plant.run(5000, HardStopClosed=True)
    assert plant.says("EnergyValid", "BarValid") == [True, True]
    assert plant.says("KilowattHours") == [pytest.approx(1000.0)]
    assert plant.says("Bar") == [pytest.approx(2.5)]
    # the pressure starts the pump, and stops it
    plant.run(6000, Auto=True)
    assert drive.hertz == 40
    sensor.registers[3, 0] = 410
    plant.run(8000)
    assert (drive.hertz, plant.says("Motor.StopConfirmed")) == (0, [True])
    sensor.registers[3, 0] = 0x10000 - 20
    plant.run(8000)
    assert (drive.hertz, plant.says("Bar")) == (40, [pytest.approx(-0.2)])
    # a pressure that nobody knows stops it; the others are still read
    sensor.alive = False
    plant.run(12000)
    assert (drive.hertz, plant.says("BarValid", "EnergyValid", "Motor.CommOk")) == (0, [False, True, True])
    # with a dead sensor a stop is sent within the promised time all the same, and nothing is overdue
    sensor.alive = True
    plant.run(10000)
    assert drive.hertz == 40
    sensor.alive = False
    longest = plant.program["Bus.WorstStopMs"]
    assert isinstance(longest, int)
    assert STOP in plant.run(longest // 10 * 10, HardStopClosed=False)
    plant.run(8000)
    assert plant.says("Motor.StopConfirmed", "Bus.StopOverdue") == [True, False]
    # the counter is set to 0 once by a press
    plant.run(1000, ClearButton=True)
    assert meter.written == [bytes.fromhex("0A0602000005")]


def test_three_makes(engine: Engine) -> None:
    plant = Plant(engine, "ThreeMakes", ["SN300G5", "JSCC", "CHF"], 11)
    names = ("Pump1", "Pump2", "Fan")
    plant.run(4000, PumpHertz=40.0, FanHertz=30.0, CountsPerHertz=100.0)
    assert plant.says("AllStand", "HardStopOk", *(f"{name}.Reason" for name in names)) == [True, False, 1, 1, 1]
    plant.run(100, Reset=True)
    plant.run(500, Reset=False)
    assert plant.says("AllStand", "HardStopOk", *(f"{name}.Reason" for name in names)) == [True, True, 1, 1, 1]
    plant.run(8000, Pump1On=True, Pump2On=True, FanOn=True)
    assert [drive.hertz for drive in plant.drives] == [40, 40, 30]
    assert plant.says("AllStand", *(f"{name}.Running" for name in names)) == [False, True, True, True]
    # one trips and the others run on; reset at its keypad, it waits for a new edge
    pump, fan = plant.drives[0], plant.drives[2]
    pump.trip(7)
    plant.run(1500)
    assert plant.says("Pump1.Reason", "Pump1.FaultCode", "Pump2.Reason", "Fan.Reason") == [40, 7, 0, 0]
    pump.clear_cause()
    plant.run(10000)
    pump.reset()
    plant.run(2000)
    assert (pump.hertz, plant.says("Pump1.Reason", "Pump1.StopConfirmed")) == (0, [24, True])
    plant.run(500, Pump1On=False)
    plant.run(6000, Pump1On=True)
    assert pump.hertz == 40
    # StopAll reaches every drive within the promised time, and none starts again without an edge
    longest = plant.program["Bus.WorstStopMs"]
    assert isinstance(longest, int)
    stopped = plant.run(longest // 10 * 10, StopAll=True)
    assert {frame[0] for frame in stopped} == {1, 2, 3}
    plant.run(8000)
    assert plant.says("AllStand", "HardStopOk") == [True, True]
    plant.run(3000, StopAll=False)
    assert [drive.hertz for drive in plant.drives] == [0, 0, 0]
    plant.run(500, FanOn=False)
    plant.run(6000, FanOn=True)
    assert [drive.hertz for drive in plant.drives] == [0, 0, 30]
    # the fan's fault is reset over the bus, but not while its run pin is held
    fan.trip(2)
    plant.run(15000)
    fan.clear_cause()
    plant.run(1000, Reset=True)
    assert plant.says("Fan.Fault") == [True]
    plant.run(500, Reset=False, FanOn=False)
    plant.run(3000, Reset=True)
    assert plant.says("Fan.Fault", "Fan.Reason", "AllStand") == [False, 1, True]
