"""Single parameters: what passes and what does not, and that no request of one block is taken for another's."""

import re
from functools import cache
from pathlib import Path

import pytest
from tests.blocks.library import sources
from tests.line.vline import NAMES, PARAMETER, POLL, Bench, Config

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
VAR CONSTANT
  BOX_PARAMETER : UINT := 2; (* compartment of the parameter *)
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


# ---------------------------------------------------------------- what does not pass


@pytest.mark.parametrize(
    ("prefix", "address", "why"),
    [
        ("JSCC", 0x1000, "OWNED"),
        ("CHF", 0x9001, "NOT_WRITABLE"),
        ("CHF", 0x8200, "UNKNOWN_ADDRESS"),
        ("SN300G5", 0x0181, "LINE_SETTING"),
        ("SN300G5", 0xFFFD, "STORE_REGISTER"),
    ],
)
def test_what_no_ladder_user_writes(prefix: str, address: int, why: str) -> None:
    scene = Scene(prefix)
    assert scene.done("Put1", 50, Address=address, Value=1) == why
    allowed = scene.done("Put2", 200, Address=address, Value=1, AllowUnknown=True)
    assert allowed == ("OK" if why == "UNKNOWN_ADDRESS" else why)
    assert len(scene.written()) == (why == "UNKNOWN_ADDRESS")


# ---------------------------------------------------------------- only while the motor is at standstill


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


# ---------------------------------------------------------------- several at once


@pytest.mark.parametrize("apart", [0, 3, 5])
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


@pytest.mark.parametrize("scans", range(0, 20, 3))
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


@pytest.mark.parametrize("block", ["Put1", "Put2"])
@pytest.mark.parametrize("within", range(10, 90, 8))
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
    while True:
        mailbox = scene["Line.Exchange.Phase"] == 1
        scene.port_takes = mailbox and scene["Line.Sending.Box"] == POLL
        if mailbox and (scene["Line.Sending.Box"], scene.slot(0, "Answer[2].Tries")) == (PARAMETER, 2):
            break
        scene.scan()
    scene.stop(0)
    scene.port_takes = True
    scene.run(2000)
    stored = [each for each in scene.written() if each[1:3].hex() == "fffd"]
    assert (scene.result("Keep"), len(stored), scene["Stores"]) == ("SILENCE", 2, 2)


@pytest.mark.parametrize("block", ["Keep", "Store2"])
@pytest.mark.parametrize("within", range(10, 90, 16))
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
    assert scene.result(name) in ("OK", "RESTARTED", "OFFLINE", "NOT_SENT", "TAKEN_BACK")
