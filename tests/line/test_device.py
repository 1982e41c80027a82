"""A meter or a sensor beside drives: what it reads and writes, and that no stop waits longer for it."""

from functools import cache

import pytest
from tests.blocks.library import sources
from tests.line.vline import NAMES, STOP, Bench, Config

from structured_text.engines.embedded.engine import EmbeddedEngine
from structured_text.engines.engine import Instance, Library, Source

SCENE = """
FUNCTION_BLOCK T_Devices
VAR_INPUT
  ElapsedMs : UINT;     (* of the line *)
  BitRate : UDINT;      (* of the line *)
  CharacterBits : UINT; (* of the line *)
  Ascii : BOOL;         (* of the line *)
  MaxScanMs : UINT;     (* of the line *)
  StopAll : BOOL;       (* of the line *)
  Restart : BOOL;       (* of the line *)
  Called : BOOL;        (* the devices are called *)
  Lined : BOOL;         (* the line is called *)
  Twice : BOOL;         (* a second block uses the slot of the meter *)
END_VAR
VAR_OUTPUT
  StopOverdue : BOOL; (* of the line *)
  WorstStopMs : UINT; (* of the line *)
  StopAloneMs : UINT; (* of the line *)
  CutToContactMs : UINT; (* of the line *)
END_VAR
VAR_IN_OUT
  Port : MB_Port;      (* of the line *)
  Slots : MB_Slots8;   (* of the line *)
  Words : MB_Words16;  (* of the meter *)
  Sensed : MB_Words16; (* of the sensor *)
END_VAR
VAR
  Meter : MB_Device;   (* slot 0 *)
  Sensor : MB_Device;  (* slot 1 *)
  Second : MB_Device;  (* slot 0, too *)
  Line : MB_Line8;     (* the line *)
END_VAR

  IF Called THEN
    Meter(Slot := Slots[0], Words := Words);
    Sensor(Slot := Slots[1], Words := Sensed);
  END_IF;
  IF Twice THEN
    Second(Address := 1, Slot := Slots[0], Words := Words);
  END_IF;
  IF Lined THEN
    Line(ElapsedMs := ElapsedMs, BitRate := BitRate, CharacterBits := CharacterBits, Ascii := Ascii,
      MaxScanMs := MaxScanMs, StopAll := StopAll, Restart := Restart, Port := Port, Slots := Slots);
  END_IF;
  StopOverdue := Line.StopOverdue;
  WorstStopMs := Line.WorstStopMs;
  StopAloneMs := Line.StopAloneMs;
  CutToContactMs := Line.CutToContactMs;
END_FUNCTION_BLOCK
"""
DEVICES = 2
FIRST = 0x0100
"""First register of the meter; every register holds its own address, input registers 4000H more."""
PARTS = ("types/", "modbus/MB_Hex", "line/", "vfd/VFD_", "device/")


def texts() -> list[Source]:
    """What the scene needs."""
    wanted = [each for each in sources() if each.path.startswith(PARTS) and "Text" not in each.path]
    return [*wanted, Source("scene.st", SCENE)]


@cache
def library() -> Library:
    """The scene on the embedded engine."""
    return EmbeddedEngine().build(texts())


class Scene(Bench):
    """A meter at unit 1, a sensor at unit 2, and drives from unit 3 on."""

    def __init__(self, config: Config | None = None, block: Instance | None = None, /, **pins: int) -> None:
        """Both read from the first scan on; `pins` are of the meter. Their slots hold what drives have left there."""
        super().__init__(config or Config(drives=4), block=block or library().instance("T_Devices"))
        self.attended -= set(range(DEVICES))
        self.set(Called=True, Lined=True)
        self.refuses = 0
        self.written: list[bytes] = []
        for drive in self.drives[:DEVICES]:
            drive.answer = self.reply
        self.wire("Meter", **{"Address": 1, "First": FIRST, "Quantity": 6, "TurnRoundMs": 5, "LongestMs": 30, **pins})
        self.wire("Sensor", Address=2, FunctionCode=4, First=0, Quantity=1, TurnRoundMs=5, LongestMs=30)

    def wire(self, block: str, **pins: int | bool) -> None:
        """Set pins of a device."""
        for name, value in pins.items():
            self.block[f"{block}.{name}"] = value

    def reply(self, request: bytes) -> bytes:
        unit, function, address = request[0], request[1], int.from_bytes(request[2:4], "big")
        if self.refuses:
            return bytes([unit, function + 0x80, self.refuses])
        if function in (3, 4):
            base = address + 0x4000 * (function == 4)
            words = b"".join((base + index).to_bytes(2, "big") for index in range(request[5]))
            return bytes([unit, function, len(words)]) + words
        self.written.append(request)
        return request[:6]

    def words(self, count: int, of: str = "Words") -> list[int]:
        """The first words of a device."""
        return [self[f"{of}[{index}]"] for index in range(count)]

    def error(self, block: str = "Meter") -> str:
        """What a device says is wrong."""
        assert self[f"{block}.Error"] == (self[f"{block}.ErrorID"] > 0)
        return NAMES[self[f"{block}.ErrorID"]]

    def write(self, ms: int = 300, **pins: int | bool) -> str:
        """Write by the meter and wait: the result."""
        self.wire("Meter", Write=False)
        self.scan()
        self.wire("Meter", Write=True, **pins)
        self.run(ms)
        assert self["Meter.WriteBusy"] + self["Meter.WriteDone"] + self["Meter.WriteError"] == 1
        return "" if self["Meter.WriteBusy"] else NAMES[self["Meter.WriteErrorID"]]


def asked(bench: Bench, unit: int = 1) -> set[bytes]:
    """What a unit was asked, each once."""
    return {each.pdu for each in bench.sent if each.unit == unit}


# ------------------------------------------------------------------------ reading


@pytest.mark.parametrize(("pin", "code", "base"), [(0, 3, 0), (3, 3, 0), (4, 4, 0x4000)])
def test_it_reads_what_its_pins_say(pin: int, code: int, base: int) -> None:
    bench = Scene(FunctionCode=pin).ready()
    assert asked(bench) == {bytes([1, code, 1, 0, 0, 6])}
    assert bench.words(16) == [base + FIRST + index for index in range(6)] + [0] * 10
    assert (bench["Meter.Valid"], bench["Meter.CommOk"], bench.error()) == (True, True, "OK")
    assert bench.words(2, "Sensed") == [0x4000, 0]


@pytest.mark.parametrize(
    ("pins", "expected"),
    [
        ({"SwapBytes": True}, [0x0001, 0x0101, 0x0201, 0x0301, 0x0401]),
        ({"SwapWords": True}, [0x0101, 0x0100, 0x0103, 0x0102, 0x0104]),
        ({"SwapBytes": True, "SwapWords": True}, [0x0101, 0x0001, 0x0301, 0x0201, 0x0401]),
    ],
)
def test_the_order_of_bytes_and_words(pins: dict[str, bool], expected: list[int]) -> None:
    """An odd last word has no partner to change places with."""
    bench = Scene(Quantity=5, **pins).ready()
    assert bench.words(16) == expected + [0] * 11


@pytest.mark.parametrize(("stale", "every", "until"), [(0, 0, 5000), (800, 0, 800), (0, 3000, 9000)])
def test_silence_ends_what_is_valid_and_a_reply_begins_it(stale: int, every: int, until: int) -> None:
    bench = Scene(StaleMs=stale, EveryMs=every).ready()
    while not bench["Meter.Fresh"]:
        bench.scan()
    bench.drives[0].alive = False
    bench.run(until - 20)
    assert bench["Meter.Valid"]
    bench.run(40)
    assert not bench["Meter.Valid"]
    bench.run(3 * every + 500)
    assert (bench["Meter.CommOk"], bench.error()) == (False, "OFFLINE")
    assert bench.words(2) == [FIRST, FIRST + 1], "the last words stay to be seen, but are not valid"
    assert bench["Sensor.Valid"]
    assert all(bench.slot(slot, "Online") for slot in (1, 2, 3))
    bench.drives[0].alive = True
    bench.run(9000)
    assert (bench["Meter.Valid"], bench.error()) == (True, "OK")


def test_damaged_replies_never_come_through() -> None:
    bench = Scene(Config(drives=4, garble=20_000))
    bench.run(3000)
    for _ in range(1000):
        bench.scan()
        assert not bench["Meter.Fresh"] or bench.words(7) == [FIRST + index for index in range(6)] + [0]
    assert bench.slot(0, "Bad") > 10
    assert bench["Meter.Valid"]


def test_other_registers_are_never_shown_as_those_of_the_pins() -> None:
    bench = Scene().ready()
    for number in range(60):
        first, quantity = 0x0200 + 16 * number, number % 16 + 1
        bench.wire("Meter", First=first, Quantity=quantity)
        for _ in range(3 + number % 7):
            bench.scan()
            if bench["Meter.Valid"]:
                assert bench.words(quantity) == [first + index for index in range(quantity)]
    bench.run(200)
    assert bench["Meter.Valid"]


@pytest.mark.parametrize(
    ("pins", "error"),
    [
        ({"Address": 0}, "UNIT"),
        ({"Address": 248}, "UNIT"),
        ({"FunctionCode": 6}, "FUNCTION"),
        ({"Quantity": 17}, "QUANTITY"),
        ({"First": 0xFFFB}, "WRAP"),
        ({"StaleMs": 65535}, "BAD_SETTING"),
    ],
)
def test_pins_that_make_no_sense_send_nothing(pins: dict[str, int], error: str) -> None:
    bench = Scene(**pins)
    bench.run(500)
    assert not asked(bench)
    assert (bench["Meter.Valid"], bench["Meter.CommOk"], bench.error()) == (False, False, error)
    assert not bench["StopOverdue"]
    bench.wire("Meter", Address=1, FunctionCode=0, Quantity=6, First=0xFFFA, StaleMs=0)
    bench.run(500)
    assert (bench["Meter.Valid"], bench.error()) == (True, "OK")


def test_what_was_valid_before_the_pins_made_no_sense_is_not_valid_after() -> None:
    bench = Scene().ready()
    bench.wire("Meter", Quantity=17)
    bench.run(10_000)
    bench.drives[0].alive = False
    bench.wire("Meter", Quantity=6)
    bench.run(100)
    assert not bench["Meter.Valid"]


# ------------------------------------------------------------------------ writing


@pytest.mark.parametrize(
    ("pins", "frame"),
    [
        ({"WriteQuantity": 0}, "0106 0010 1234"),
        ({"WriteQuantity": 1, "WriteMultiple": True}, "0110 0010 0001 02 1234"),
        ({"WriteQuantity": 3}, "0110 0010 0003 06 1234 5678 9ABC"),
    ],
)
def test_it_writes_once_by_an_edge(pins: dict[str, int], frame: str) -> None:
    bench = Scene().ready()
    values = {"WriteFirst": 0x0010, "Value": 0x1234, "Value2": 0x5678, "Value3": 0x9ABC}
    assert bench.write(**values, **pins) == "OK"
    assert bench.written == [bytes.fromhex(frame)]
    bench.run(2000)
    assert len(bench.written) == 1
    assert bench["Meter.Valid"]


# ------------------------------------------------------------------------ stops


def test_it_has_no_stop_for_stop_all_and_still_writes() -> None:
    bench = Scene().ready()
    bench.set(StopAll=True)
    sent = bench.run(3000)
    assert {each.unit for each in sent if each.stop} == {3, 4}
    assert all(each.read for each in sent if each.unit <= DEVICES)
    assert not bench["StopOverdue"]
    assert bench["Meter.Valid"]
    assert bench.write(Value=1) == "OK"


def test_two_blocks_on_one_slot_are_reported_and_overdue() -> None:
    """One of them might be a drive's."""
    bench = Scene().ready()
    bench.set(Twice=True)
    bench.run(100)
    assert (bench.error(), bench.error("Second"), bench["Meter.Valid"]) == ("SHARED", "SHARED", False)
    assert bench["StopOverdue"]


@pytest.mark.parametrize("address", [9, 0])
def test_it_is_over_once_the_address_is_another_or_none(address: int) -> None:
    bench = Scene()
    bench.wire("Meter", Address=3)
    bench.run(300)
    assert bench["Slots[2].LineErrorID"] == bench["Meter.ErrorID"] == 55
    bench.wire("Meter", Address=address)
    bench.run(100)
    assert bench["Slots[2].LineErrorID"] == 0


def figures(bench: Bench) -> tuple[int, int, int]:
    """How late a stop can be."""
    bench.ready()
    return bench["StopAloneMs"], bench["WorstStopMs"], bench["CutToContactMs"]


def test_it_counts_as_a_drive_that_is_never_stopped() -> None:
    """Six drives with two devices whose reads are no longer than theirs: a stop is as late as without."""
    alone, worst, cut = figures(Bench(Config(drives=6, words=11)))
    bench = Scene(Config(drives=8, words=11), EveryMs=30_000)
    assert figures(bench)[:2] == (alone, worst)
    assert cut < figures(bench)[2] < cut + 8 * worst, "its time between reads delays nobody"
    # sixteen words are 8 characters more than twelve
    bench = Scene(Config(drives=8, words=11), Quantity=16)
    longer = figures(bench)[0] - alone
    assert longer == 8 * 10 * 1000 // 19200
    assert figures(bench)[1] == worst + longer


@pytest.mark.parametrize("alive", [(True, True), (True, False), (False, False)])
@pytest.mark.parametrize("slow", [5, 60])
def test_no_stop_is_later_than_the_line_says(alive: tuple[bool, bool], slow: int) -> None:
    """Six drives and two devices that read sixteen words and write all the time, at every moment of their round."""
    config = Config(drives=8, words=12, max_scan=10)
    worst = 0.0
    for moment in range(0, 40, 4):
        bench = Scene(config, Quantity=16, TurnRoundMs=slow, LongestMs=slow)
        bench.ready()
        for drive, lives in zip(bench.drives, alive, strict=False):
            drive.alive, drive.turn_us = lives, slow * 1000
        for scan in range(60 + moment):
            bench.wire("Meter", Write=scan % 2 == 0, WriteQuantity=3)
            bench.scan()
        began = bench.now / 1000
        for slot in range(DEVICES, 8):
            bench.stop(slot)
        first: dict[int, float] = {}
        for each in bench.run(bench["WorstStopMs"] + 20):
            if each.stop:
                first.setdefault(each.unit, each.ms - began)
        assert set(first) == set(range(DEVICES + 1, 9))
        worst = max(worst, *(ms / bench["WorstStopMs"] for ms in first.values()))
        assert all(bench.answer(slot, STOP) == "OK" for slot in range(DEVICES, 8))
    assert 0.4 < worst <= 1


def test_a_drive_block_on_its_slot_keeps_its_stop() -> None:
    """Two blocks on one slot: the line stops what may have a motor, in whatever order they are called."""
    scene = Scene()
    scene.run(500)
    for _ in range(100):
        scene.put(0, Alive=(scene.slot(0, "Alive") + 1) % 256, UnitAddress=1, HasStop=True)
        scene.fill(0, STOP, 6, 0x1000, word=5)
        scene.scan()
    assert scene.error() == "SHARED"
    assert bytes([1, 6, 0x10, 0x00, 0, 5]) in scene.written
