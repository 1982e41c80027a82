"""Single parameters: what passes and what does not, and that no request of one block is taken for another's."""

import re
from functools import cache
from pathlib import Path

import pytest
from tests.blocks.library import sources
from tests.line.vline import NAMES, PARAMETER, Bench, Config

from driveblocks.render.environment import environment
from structured_text.engines.embedded.engine import EmbeddedEngine
from structured_text.engines.engine import Library, Source
from structured_text.language.lint import lint_sources

SCENE = """
FUNCTION_BLOCK T_Drive
VAR_INPUT
  StopConfirmed : BOOL; (* as the drive block has it *)
END_VAR
VAR_OUTPUT
  WriteWaits : BOOL; (* no start *)
END_VAR
VAR_IN_OUT
  Slot : MB_Slot; (* of the drive *)
END_VAR
VAR
  Gate : {{ prefix }}_ParameterGate; (* of the family *)
END_VAR

{% include "drive/drive/parameter.j2" %}
  WriteWaits := Gate.Writes;
END_FUNCTION_BLOCK

FUNCTION_BLOCK T_Scene
VAR_INPUT
  ElapsedMs : UINT;     (* of the line *)
  BitRate : UDINT;      (* of the line *)
  CharacterBits : UINT; (* of the line *)
  Ascii : BOOL;         (* of the line *)
  MaxScanMs : UINT;     (* of the line *)
  Called : BOOL;        (* the drive block is called *)
  Lined : BOOL;         (* the line is called *)
  Asleep : BOOL;        (* Get1, Put1 and Keep are not called *)
END_VAR
VAR_IN_OUT
  Port : MB_Port;     (* of the line *)
  Slots : MB_Slots8;  (* of the line *)
  Stores : UDINT;     (* of Keep *)
END_VAR
VAR
  Get1 : VFD_ReadParameter;  (* before the drive block *)
  Put1 : VFD_WriteParameter; (* before the drive block *)
  Keep : VFD_Store;          (* before the drive block *)
  Drive : T_Drive;          (* the drive block *)
  Get2 : VFD_ReadParameter;  (* after it *)
  Put2 : VFD_WriteParameter; (* after it *)
  Store2 : VFD_Store;        (* after it *)
  Stores2 : UDINT;           (* of Store2 *)
  Line : MB_Line8;          (* the line *)
END_VAR

  IF NOT Asleep THEN
    Get1(Slot := Slots[0]);
    Put1(Slot := Slots[0]);
    Keep(Slot := Slots[0], Stores := Stores);
  END_IF;
  IF Called THEN
    Drive(Slot := Slots[0]);
  END_IF;
  Get2(Slot := Slots[0]);
  Put2(Slot := Slots[0]);
  Store2(Slot := Slots[0], Stores := Stores2);
  IF Lined THEN
    Line(ElapsedMs := ElapsedMs, BitRate := BitRate, CharacterBits := CharacterBits, Ascii := Ascii,
      MaxScanMs := MaxScanMs, Port := Port, Slots := Slots);
  END_IF;
END_FUNCTION_BLOCK
"""
PAGE = (Path(__file__).parents[2] / "docs" / "parameters.md").read_text(encoding="utf-8")
WRITABLE = {"JSCC": 0x0012, "CHF": 0x8007, "PF4": 0x0027, "SN300G5": 0x0200}
"""A register of each family that a ladder user may write."""
ASKING = {"Get1": {"Address": 0x0200}, "Put1": {"Address": 0x0200}, "Keep": {}}
"""One block of each kind, and a request that passes for SN300G5."""


@cache
def library(prefix: str) -> Library:
    """The line, the blocks of parameters, and what a drive block of the family does for them."""
    wanted = re.compile(
        rf"(?:types|vfd|line)/.*|modbus/MB_Hex.*|\w+/{prefix}_(?:CanRead|CanWrite|MayWrite|ParameterGate|ParameterAddress)\.st"
    )
    texts = [each for each in sources() if wanted.fullmatch(each.path)]
    scene = environment().from_string(SCENE).render(prefix=prefix, identity=None)
    return EmbeddedEngine().build([*texts, Source("scene.st", scene)])


class Scene(Bench):
    """A line with one drive, whose registers hold their own address, and the blocks of parameters."""

    def __init__(self, prefix: str = "JSCC", clock: int = 0) -> None:
        """Begin with a motor that stands; `clock` is what the line says to begin with."""
        super().__init__(Config(drives=1), block=library(prefix).instance("T_Scene"))
        self.block["Slots[0].TimeMs"] = clock
        self.set(Called=True, Lined=True)
        self.block["Drive.StopConfirmed"] = True
        self.drives[0].answer = self.reply
        self.refuses = 0
        self.silent = False
        self.ready()

    def rested(self) -> "Scene":
        """Long after the last store."""
        self.block["Keep.SinceMs"] = self.block["Store2.SinceMs"] = 60_000
        self.put(0, SinceStoreMs=60_000)
        return self

    def reply(self, request: bytes) -> bytes | None:
        address = int.from_bytes(request[2:4], "big")
        polled = address == self.kind.read_address
        if self.silent and not polled:
            return None
        if self.refuses and not polled:
            return bytes([request[0], request[1] + 0x80, self.refuses])
        if request[1] in (3, 4):
            words = b"".join((address + index).to_bytes(2, "big") for index in range(request[5]))
            return request[:2] + bytes([len(words)]) + words
        return request[:6]

    def execute(self, block: str, **pins: int | bool) -> None:
        """A rising edge, with pins."""
        for name, value in {**pins, "Execute": True}.items():
            self.block[f"{block}.{name}"] = value

    def drop(self, block: str) -> None:
        """Execute falls, for a scan."""
        self.block[f"{block}.Execute"] = False
        self.scan()

    def done(self, block: str, ms: int = 300, **pins: int | bool) -> str:
        """Execute and wait; the name of the result."""
        self.execute(block, **pins)
        self.run(ms)
        return self.result(block)

    def result(self, block: str) -> str:
        """The name of the result, empty while there is none; Busy, Done and Error exclude each other."""
        busy, done, error = (self[f"{block}.{name}"] for name in ("Busy", "Done", "Error"))
        assert busy + done + error <= 1
        assert error == (self[f"{block}.ErrorID"] > 0)
        return NAMES[self[f"{block}.ErrorID"]] if done or error else ""

    def written(self) -> list[bytes]:
        """The writes that left, without unit address."""
        return [each.pdu[1:] for each in self.sent if not each.read]


# ---------------------------------------------------------------- what passes


@pytest.mark.parametrize("prefix", sorted(WRITABLE.keys() - {"PF4"}))  # which reads one
def test_up_to_four_registers_are_read(prefix: str) -> None:
    scene = Scene(prefix)
    address = 0x0200 if prefix == "SN300G5" else 0x0012
    assert scene.done("Get1", Address=address, Quantity=4) == "OK"
    names = ("Value", "Value2", "Value3", "Value4")
    assert [scene[f"Get1.{name}"] for name in names] == [address, address + 1, address + 2, address + 3]
    assert scene.done("Get2", Quantity=5) == scene.done("Put1", Quantity=4) == "QUANTITY"


@pytest.mark.parametrize(
    ("prefix", "frame"),
    [("JSCC", "06 0012 0064"), ("CHF", "06 8007 0064"), ("SN300G5", "10 0200 0001 02 0064")],
)
def test_a_write_has_the_form_that_the_family_knows(prefix: str, frame: str) -> None:
    scene = Scene(prefix)
    assert scene.done("Put1", Address=WRITABLE[prefix], Value=0x64) == "OK"
    assert scene.written() == [bytes.fromhex(frame)]


def test_several_registers_go_in_one_write() -> None:
    scene = Scene("SN300G5")
    assert scene.done("Put2", Address=0x0200, Quantity=3, Value=1, Value2=2, Value3=3) == "OK"
    assert scene.written() == [bytes.fromhex("10 0200 0003 06 0001 0002 0003")]


def test_the_pins_count_as_they_were_at_the_edge() -> None:
    scene = Scene()
    scene.execute("Put1", Address=0x0012, Value=1)
    scene.scan()
    scene.execute("Put1", Address=0x0013, Value=2)
    scene.run(200)
    assert scene.written() == [bytes.fromhex("06 0012 0001")]


# ---------------------------------------------------------------- what does not pass


@pytest.mark.parametrize(
    ("prefix", "address", "why"),
    [
        ("JSCC", 0x1000, "OWNED"),
        ("JSCC", 0x1001, "OWNED"),
        ("JSCC", 0x2001, "NOT_WRITABLE"),
        ("JSCC", 0x4000, "UNKNOWN_ADDRESS"),
        ("CHF", 0x1000, "OWNED"),
        ("CHF", 0x9000, "OWNED"),
        ("CHF", 0x2000, "OWNED"),
        ("CHF", 0xA000, "OWNED"),
        ("CHF", 0x9001, "NOT_WRITABLE"),
        ("CHF", 0x8200, "UNKNOWN_ADDRESS"),
        ("GD200A", 0x8003, "LINE_SETTING"),
        ("GD200A", 0xA000, "OWNED"),
        ("ATV312", 0x0C20, "LINE_SETTING"),
        ("MX2", 0x0901, "NOT_WRITABLE"),
        ("SN300G5", 0x0000, "OWNED"),
        ("SN300G5", 0x0001, "OWNED"),
        ("SN300G5", 0x0181, "LINE_SETTING"),
        ("SN300G5", 0x041C, "LINE_SETTING"),
        ("SN300G5", 0x0420, "LINE_SETTING"),
        ("SN300G5", 0xFFFD, "STORE_REGISTER"),
        ("SN300G5", 0x0398, "UNKNOWN_ADDRESS"),
    ],
)
def test_what_no_ladder_user_writes(prefix: str, address: int, why: str) -> None:
    scene = Scene(prefix)
    assert scene.done("Put1", 50, Address=address, Value=1) == why
    allowed = scene.done("Put2", 200, Address=address, Value=1, AllowUnknown=True)
    assert allowed == ("OK" if why == "UNKNOWN_ADDRESS" else why)
    assert len(scene.written()) == (why == "UNKNOWN_ADDRESS")


@pytest.mark.parametrize(
    ("address", "quantity", "why"),
    [
        (0x0FFF, 2, "OWNED"),
        (0x0FFE, 3, "OWNED"),
        (0x0FFE, 2, "OK"),
        (0xFFFE, 3, "WRAP"),
        (0x00FF, 2, "OK"),
    ],
)
def test_every_register_of_a_write_is_judged(address: int, quantity: int, why: str) -> None:
    scene = Scene("JSCC")
    assert scene.done("Put1", 200, Address=address, Quantity=quantity, AllowUnknown=True) == why


def test_a_family_without_function_10h_writes_one_register() -> None:
    scene = Scene("CHF")
    assert scene.done("Put1", Address=0x8007, Quantity=2) == "QUANTITY"


@pytest.mark.parametrize(
    ("value", "why"), [(727, "RANGE"), (726, "OK"), (0x10000 - 726, "OK"), (0x10000 - 727, "RANGE")]
)
def test_a_value_stays_in_its_range(value: int, why: str) -> None:
    scene = Scene("SN300G5")
    assert scene.done("Put1", Address=0x0007, Value=value) == why


def test_what_is_not_listed_is_read_only_with_allow_unknown() -> None:
    scene = Scene("CHF")
    assert scene.done("Get1", Address=0x4000) == "NOT_READABLE"
    assert scene.done("Get2", Address=0x4000, AllowUnknown=True) == "OK"


# ---------------------------------------------------------------- only while the motor is at standstill


def test_nothing_is_written_while_the_motor_may_move() -> None:
    scene = Scene()
    scene.block["Drive.StopConfirmed"] = False
    assert scene.done("Put1", Address=0x0012) == "NOT_STOPPED"
    assert scene.done("Get1", Address=0x0012) == "OK"
    assert scene.written() == []


@pytest.mark.parametrize("scans", range(1, 5))
def test_it_is_looked_at_again_when_it_is_sent(scans: int) -> None:
    """The write waits in the slot, or in the mailbox of a port that is busy, and the motor starts meanwhile."""
    scene = Scene()
    scene.port_takes = False
    scene.execute("Put1", Address=0x0012)
    for _ in range(scans):
        scene.scan()
    scene.block["Drive.StopConfirmed"] = False
    scene.scan()
    scene.port_takes = True
    scene.run(300)
    assert scene.result("Put1") == "NOT_STOPPED"
    assert scene.written() == []
    assert not scene["Drive.WriteWaits"]


def test_no_second_attempt_once_the_motor_moves() -> None:
    scene = Scene()
    scene.silent = True
    scene.execute("Put1", Address=0x0012)
    while not scene.written():
        scene.scan()
    scene.block["Drive.StopConfirmed"] = False
    scene.run(300)
    assert len(scene.written()) == 1
    assert scene.result("Put1") == "NOT_STOPPED"


def test_the_drive_block_knows_that_a_write_waits() -> None:
    scene = Scene()
    scene.execute("Put1", Address=0x0012)
    waits = []
    while not scene.result("Put1"):
        scene.scan()
        waits.append(scene["Drive.WriteWaits"])
    first, last = waits.index(True), len(waits) - 1 - waits[::-1].index(True)
    assert all(waits[first : last + 1])
    assert first <= 3
    assert not scene["Drive.WriteWaits"]
    scene.execute("Get1", Address=0x0012)
    while not scene.result("Get1"):
        scene.scan()
        assert not scene["Drive.WriteWaits"], "a read hinders no start"


# ---------------------------------------------------------------- several at once


@pytest.mark.parametrize("apart", range(6))
def test_no_answer_is_lost_or_taken_for_anothers(apart: int) -> None:
    """Reads that pass, reads and writes that are refused, writes: whoever comes when, each gets its own."""
    scene = Scene("SN300G5")
    asked = {
        "Get1": {"Address": 0x0200},
        "Put1": {"Address": 0x0000},
        "Get2": {"Address": 0x0280},
        "Put2": {"Address": 0x0201, "Value": 7},
    }
    found: dict[str, list[str]] = {name: [] for name in asked}
    for number, (name, pins) in enumerate(asked.items()):
        scene.execute(name, **pins)
        for _ in range(apart * (number + 1) % 5):
            scene.scan()
    for _ in range(1500):
        scene.scan()
        for name in asked:
            if said := scene.result(name):
                found[name].append(said)
                scene.block[f"{name}.Execute"] = False
            elif not scene[f"{name}.Busy"]:
                scene.execute(name)
        assert scene["Get1.Value"] in (0, 0x0200)
        assert scene["Get2.Value"] in (0, 0x0280)
    assert set(found["Get1"]) == set(found["Get2"]) == set(found["Put2"]) == {"OK"}
    assert set(found["Put1"]) == {"OWNED"}
    assert min(map(len, found.values())) >= 10, "they take turns"
    assert set(scene.written()) == {bytes.fromhex("10 0201 0001 02 0007")}


@pytest.mark.parametrize("block", ASKING)
def test_who_sleeps_through_its_answer_says_so(block: str) -> None:
    scene = Scene("SN300G5").rested()
    scene.execute(block, **ASKING[block])
    scene.run(40)
    scene.set(Asleep=True)
    assert scene.done("Get2", Address=0x0201) == scene.done("Put2", Address=0x0202, Quantity=3, Value2=7) == "OK"
    scene.set(Asleep=False)
    scene.scan()
    assert scene.result(block) == "LOST"
    assert scene["Keep.Most"] == 0, "what is in the compartment is another's"


def test_a_store_waits_for_its_turn() -> None:
    scene = Scene("SN300G5").rested()
    scene.execute("Put2", Address=0x0200)
    scene.run(20)
    assert scene.done("Keep") == scene.result("Put2") == "OK"
    assert [each[1:3].hex() for each in scene.written()] == ["0200", "fffd"]


@pytest.mark.parametrize("scans", range(20))
def test_no_number_is_used_again_after_a_restart(scans: int) -> None:
    """Whatever was open then: a value is that of its own address, and what is Done was sent."""
    scene = Scene("SN300G5")
    scene.execute("Get1", Address=0x0200)
    scene.execute("Put1", Address=0x0201, Value=1)
    for _ in range(scans):
        scene.scan()
    before = scene.slot(0, "Ask[2].Number")
    scene.scan(took=1_500_000)
    scene.execute("Get2", Address=0x0280)
    scene.execute("Put2", Address=0x0202, Value=2)
    numbers = [before]
    for _ in range(120):
        scene.scan()
        numbers.append(scene.slot(0, "Ask[2].Number"))
    assert numbers == sorted(numbers)
    said = {name: scene.result(name) for name in ("Get1", "Put1", "Get2", "Put2")}
    assert set(said.values()) <= {"OK", "RESTARTED", "OFFLINE"}
    assert scene["Get1.Value"] == (0x0200 if said["Get1"] == "OK" else 0)
    assert scene["Get2.Value"] == (0x0280 if said["Get2"] == "OK" else 0)
    sent = {each[1:3].hex() for each in scene.written()}
    assert "0201" in sent or said["Put1"] != "OK"
    assert "0202" in sent or said["Put2"] != "OK"


def test_a_read_of_one_register_shows_no_other() -> None:
    scene = Scene("SN300G5")
    assert scene.done("Get1", Address=0x0200, Quantity=4) == "OK"
    assert scene.done("Get2", Address=0x0280) == "OK"
    assert [scene[f"Get2.Value{name}"] for name in ("", "2", "3", "4")] == [0x0280, 0, 0, 0]


@pytest.mark.parametrize("block", ["Put1", "Put2"])
@pytest.mark.parametrize("within", range(10, 90, 2))
def test_withdrawn_is_withdrawn_in_any_order_of_calls(block: str, within: int) -> None:
    """Not sent means not sent, also if the block is called after the drive block, which has let it pass."""
    scene = Scene("SN300G5")
    scene.put(0, PollEveryMs=0)
    for _ in range(within % 6):
        scene.scan()
    scene.execute(block, Address=0x0200, Value=1, WithinMs=within)
    while not scene.result(block):
        scene.scan()
    said = scene.result(block)
    scene.run(300)
    assert len(scene.written()) == (0 if said == "NOT_SENT" else 1)


# ---------------------------------------------------------------- results


@pytest.mark.parametrize("block", ASKING)
def test_a_refusal_gives_the_drives_own_code(block: str) -> None:
    scene = Scene("SN300G5").rested()
    scene.refuses = 0x22
    assert scene.done(block, **ASKING[block]) == "REFUSED"
    assert scene[f"{block}.RefusedReason"] == 0x22
    assert scene.slot(0, "Retries") == 0
    scene.drop(block)
    assert scene[f"{block}.RefusedReason"] == 0


def test_a_result_lasts_while_execute_is_true_and_one_scan_at_least() -> None:
    scene = Scene()
    assert scene.done("Get1", Address=0x0012) == "OK"
    scene.run(500)
    assert scene.result("Get1") == "OK"
    scene.drop("Get1")
    assert scene.result("Get1") == ""
    scene.execute("Put1", Address=0x0012)
    scene.scan()
    scene.drop("Put1")
    results = []
    for _ in range(40):
        scene.scan()
        results.append(scene.result("Put1"))
    assert results.count("OK") == 1, "Execute was dropped before the answer"
    assert len(scene.written()) == 1


def test_an_edge_while_busy_begins_nothing() -> None:
    scene = Scene()
    scene.execute("Put1", Address=0x0012, Value=1)
    scene.run(40)
    scene.drop("Put1")
    scene.execute("Put1", Value=2)
    scene.run(300)
    assert [each[-1] for each in scene.written()] == [1]
    assert scene.result("Put1") == "OK", "of the first; so the page says to wait"
    assert "An edge of `Execute` while `Busy` is TRUE is ignored" in PAGE


@pytest.mark.parametrize("block", ASKING)
def test_a_drive_block_that_is_not_called_lets_nothing_pass(block: str) -> None:
    scene = Scene("SN300G5").rested()
    scene.set(Called=False)
    assert scene.done(block, 900, **ASKING[block], WithinMs=1000) == ""
    scene.run(150)
    assert scene.result(block) == "NOT_SENT"
    scene.set(Called=True)
    assert scene.done("Get2", Address=0x0200) == "OK", "the compartment is free again"
    assert scene.written() == []


@pytest.mark.parametrize("block", ASKING)
def test_a_line_that_is_not_called(block: str) -> None:
    scene = Scene("SN300G5").rested()
    scene.set(Lined=False)
    assert scene.done(block, 10_100, **ASKING[block]) == "NO_LINE"


def test_a_write_may_have_arrived_before_the_line_is_called_no_more() -> None:
    scene = Scene("SN300G5").rested()
    scene.execute("Put1", Address=0x0200, Value=1)
    while not scene.written():
        scene.scan()
    scene.set(Lined=False)
    scene.run(10_100)
    assert scene.result("Put1") == "NO_LINE"
    (listed,) = re.findall(r"After `ErrorID` ([0-9, or]+) an\s+attempt may have reached the drive", PAGE)
    assert str(scene["Put1.ErrorID"]) in re.findall("[0-9]+", listed)


def test_a_drive_that_keeps_silent() -> None:
    scene = Scene()
    scene.silent = True
    assert scene.done("Put1", Address=0x0012) == "SILENCE"
    assert len(scene.written()) == 2, "ParameterRetries"
    scene.drives[0].alive = False
    scene.run(1500)
    assert scene.done("Get1", Address=0x0012) == "OFFLINE"


@pytest.mark.parametrize("block", ASKING)
def test_what_is_given_up_after_an_attempt_may_have_arrived(block: str) -> None:
    scene = Scene("SN300G5").rested()
    scene.silent = True
    before = len(scene.sent)
    assert scene.done(block, 80, **ASKING[block], WithinMs=60) == "SILENCE"
    scene.run(200)
    asked = [each for each in scene.sent[before:] if each.pdu[2:4] != scene.kind.read_address.to_bytes(2, "big")]
    assert len(asked) == 1, "there is no second attempt"


@pytest.mark.parametrize(("function", "quantity"), [(3, 5), (3, 0), (6, 4), (6, 0), (16, 4)])
def test_whoever_fills_the_compartment_is_judged(function: int, quantity: int) -> None:
    scene = Scene("SN300G5")
    scene.ask(0, PARAMETER, function, 0x0200, quantity=quantity)
    scene.run(100)
    assert NAMES[scene.slot(0, "Ask[2].Words[3]") >> 8] == "QUANTITY"
    assert scene.answer(0, PARAMETER) == ""
    assert scene.done("Get1", Address=0xFFFE, Quantity=3) == "WRAP"
    assert scene.done("Put1", Quantity=4) == "QUANTITY"


# ---------------------------------------------------------------- store


def test_a_store_is_sent_by_its_own_block_alone() -> None:
    scene = Scene("SN300G5").rested()
    assert scene.done("Keep") == "OK"
    assert scene.written() == [bytes.fromhex("10 FFFD 0001 02 0000")]
    assert (scene["Stores"], scene["Keep.Most"], scene["Keep.Worn"]) == (1, 100_000, 0)


def test_stores_are_apart_and_counted() -> None:
    scene = Scene("SN300G5", clock=59_000)
    assert scene.done("Keep", MinimumS=0) == "TOO_SOON", "so soon after power-up"
    scene.drop("Keep")
    scene.rested().silent = True
    scene.block["Stores"] = 99_998
    assert scene.done("Keep") == "SILENCE"
    assert (scene["Stores"], scene["Keep.Worn"]) == (100_000, 1), "both attempts may have stored"
    scene.drop("Keep")
    scene.run(58_000)
    assert scene.done("Keep") == "TOO_SOON"
    assert len(scene.written()) == 2
    scene.drop("Keep")
    scene.run(2000)
    scene.silent = False
    assert scene.done("Keep") == "OK"


@pytest.mark.parametrize("apart", [0, 1, 3, 50])
def test_two_blocks_store_in_one_drive_a_minute_apart(apart: int) -> None:
    scene = Scene("SN300G5").rested()
    scene.execute("Keep")
    for _ in range(apart):
        scene.scan()
    scene.execute("Store2")
    scene.run(500)
    assert {scene.result("Keep"), scene.result("Store2")} == {"OK", "TOO_SOON"}
    assert len(scene.written()) == 1
    assert scene["Stores"] + scene["Stores2"] == 1
    scene.drop("Keep")
    scene.drop("Store2")
    scene.run(59_000)
    assert scene.done("Store2") == "TOO_SOON"
    scene.drop("Store2")
    scene.run(2000)
    assert scene.done("Store2") == "OK"


@pytest.mark.parametrize("scans", range(12))
def test_a_store_counts_only_its_own_attempts(scans: int) -> None:
    """The line and the drive block restart meanwhile; another block's write is under way."""
    scene = Scene("SN300G5").rested()
    scene.execute("Put1", Address=0x0200, Value=7)
    scene.execute("Keep")
    for _ in range(scans):
        scene.scan()
    scene.scan(took=1_500_000)
    scene.run(600)
    stored = [each for each in scene.written() if each[1:3].hex() == "fffd"]
    assert scene["Stores"] == len(stored)
    assert (scene.result("Keep") == "OK") is (len(stored) == 1 and scene["Keep.ErrorID"] == 0)


@pytest.mark.parametrize(("prefix", "stands", "why"), [("SN300G5", False, "NOT_STOPPED"), ("JSCC", True, "NOT_ABLE")])
def test_where_no_store_passes(prefix: str, stands: bool, why: str) -> None:
    scene = Scene(prefix).rested()
    scene.block["Drive.StopConfirmed"] = stands
    assert scene.done("Keep") == why
    assert (scene.written(), scene["Stores"]) == ([], 0)


def test_the_example_of_the_page_runs_and_lints_clean() -> None:
    (program,) = re.findall(r"```\n(PROGRAM .*?END_PROGRAM)\n```", PAGE, re.DOTALL)
    wanted = re.compile(r"types/.*|vfd/.*|line/MB_(?:Plus|Minus)\.st|\w+/SN300G5_ParameterAddress\.st")
    texts = [each for each in sources() if wanted.fullmatch(each.path)]
    texts.append(Source("example.st", program + "\n"))
    assert list(lint_sources([(each.path, each.text) for each in texts])) == []
    example = EmbeddedEngine().build(texts).instance("Parameters")
    example["SetRamp"] = True
    for _ in range(4):
        example.scan()
    assert example["Slots[0].Ask[2].Address"] == 0x0200


@pytest.mark.parametrize(
    ("letter", "group", "number", "address"),
    [
        ("H", 5, 2, 0x041D),
        ("A", 1, 0, 0x0100),
        ("A", 2, 32, 0x0125),
        ("C", 3, 5, 0x0242),
        ("C", 5, 8, 0x0241),
        ("U", 1, 23, 0x0036),
        ("U", 1, 24, -1),
        ("U", 1, 26, 0x0039),
        ("A", 1, 6, -1),
        ("A", 3, 1, -1),
        ("G", 1, 1, -1),
    ],
)
def test_the_manuals_ids_of_sn300g5(letter: str, group: int, number: int, address: int) -> None:
    """Typed from the manual; C3-05 and C5-08 stand apart from their groups, U1-24 has no row."""
    pins = {"Letter": ord(letter), "Group": group, "Number": number}
    assert library("SN300G5").call("SN300G5_ParameterAddress", pins) == address


@pytest.mark.parametrize(("prefix", "last"), [("JSCC", 0xFF), ("CHF", 0x1FF)])
def test_the_numbers_of_an_area(prefix: str, last: int) -> None:
    found = [
        library(prefix).call(f"{prefix}_ParameterAddress", {"Number": number}) for number in (0, 18, last, last + 1)
    ]
    assert found == [0, 18, last, -1]


def test_no_number_is_one_that_was_answered_long_ago() -> None:
    """The next one after 65535 was; the write was Done, and never sent."""
    scene = Scene()
    assert scene.done("Put1", Address=0x0012, Value=5) == "OK"
    assert scene.slot(0, "Answer[2].Number") == 1
    scene.drop("Put1")
    scene.block["Drive.StopConfirmed"] = False  # so that what has this number is never sent
    scene.block["Slots[0].Ask[2].Number"] = 65535
    scene.scan()
    scene.block["Drive.StopConfirmed"] = True
    assert scene.done("Put1", Address=0x0012, Value=7) == "OK"
    assert [each[-1] for each in scene.written()] == [5, 7]


def test_an_attempt_that_is_withdrawn_from_the_port_gives_no_more_of_them() -> None:
    """A stop withdraws the second attempt of a store that nobody answers; a third was sent, and not counted."""
    scene = Scene("SN300G5").rested()
    scene.drives[0].answer = lambda each: None if each[2:4] == b"\xff\xfd" else scene.reply(each)
    scene.execute("Keep", WithinMs=30_000)
    while not scene.written():
        scene.scan()
    scene.port_takes = False
    while (scene["Line.Phase"], scene["Line.Box"], scene.slot(0, "Answer[2].Tries")) != (1, PARAMETER, 2):
        scene.scan()
    scene.stop(0)
    scene.port_takes = True
    scene.run(2000)
    stored = [each for each in scene.written() if each[1:3].hex() == "fffd"]
    assert (scene.result("Keep"), len(stored), scene["Stores"]) == ("SILENCE", 2, 2)


@pytest.mark.parametrize("block", ["Keep", "Store2"])
@pytest.mark.parametrize("within", range(10, 90, 8))
def test_a_store_that_was_not_sent_counts_none(block: str, within: int) -> None:
    """Called after the drive block it said "not sent" in the scan that sent it, and counted nothing."""
    scene = Scene("SN300G5").rested()
    scene.put(0, PollEveryMs=0)
    scene.execute(block, WithinMs=within)
    while not scene.result(block):
        scene.scan()
    said = scene.result(block)
    scene.run(300)
    sent = len([each for each in scene.written() if each[1:3].hex() == "fffd"])
    assert sent == (0 if said == "NOT_SENT" else 1)
    assert scene["Stores" if block == "Keep" else "Stores2"] == sent


@pytest.mark.parametrize("scans", range(5))
@pytest.mark.parametrize("name", ["Get1", "Put1", "Keep"])
def test_another_address_while_it_is_busy_is_no_missing_call(name: str, scans: int) -> None:
    """It said "not called while Busy", though it was called in every scan."""
    scene = Scene("SN300G5").rested()
    scene.execute(name, **ASKING[name])
    scene.run(10 * scans)
    scene.put(0, UnitAddress=9)
    scene.run(6000)
    assert scene.result(name) in ("OK", "RESTARTED", "OFFLINE", "NOT_SENT")
