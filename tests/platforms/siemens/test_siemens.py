"""Target `siemens`: read back by a reader of its own, refused where SCL cannot say it; its port runs on stand-ins."""

import functools
from collections.abc import Callable
from pathlib import Path

import pytest
from tests.platforms.siemens import checks
from tests.platforms.siemens.checks import CHECKS, Read, opened
from tests.shapes import shapes

from driveblocks.platforms.part import Part, Shelf, Volume
from driveblocks.platforms.problem import ExportError
from driveblocks.platforms.siemens.writer import write
from structured_text.engines.embedded.engine import EmbeddedEngine
from structured_text.engines.engine import Library, Source
from structured_text.language.parser import parse

INSTRUCTIONS = Path(__file__).parent / "instructions.st"


@functools.cache
def written() -> checks.Files:
    return write(checks.shelf())


@functools.cache
def whole() -> Read:
    return opened(checks.shelf(), written())


@pytest.mark.parametrize("check", CHECKS, ids=lambda check: check.__name__)
def test_what_was_written_reads_back_equal(check: Callable[[Read], None]) -> None:
    check(whole())


def test_drives_of_other_shapes_read_back_equal_and_those_of_several_writes_have_no_master() -> None:
    stock = checks.stocked({name: drive for name, drive in shapes().items() if name in ("cia402", "active_low")}, [])
    made = write(stock)
    found = opened(stock, made)
    for check in CHECKS:
        check(found)
    assert ("yours/CIA_Master.scl" in made, "yours/LOW_Master.scl" in made) == (False, True)


def test_no_file_is_beside_those_that_the_page_names() -> None:
    assert set(written()) - {"README.md", "Port.md"} == set(checks.importing(checks.shelf()))


def test_a_family_alone_has_the_same_shared_files() -> None:
    stock = checks.shelf()
    folder, drive = next(iter(stock.drives.items()))
    others = stock.drives.keys() - {folder}
    alone = Shelf(tuple(part for part in stock.parts if part.folder not in others), {folder: drive}, stock.languages)
    made = write(alone)
    assert {name: text for name, text in made.items() if not name.endswith(".md")} == {
        name: written()[name] for name in checks.importing(alone)
    }


CANNOT = """
TYPE
  Colour : (Red, Green);
END_TYPE
TYPE
  Grid : ARRAY[0..1] OF Row;
END_TYPE
TYPE
  Row : ARRAY[0..1] OF WORD;
END_TYPE
TYPE
  Plain : STRUCT
    Other : UINT;   (* good *)
    Long : LWORD;   (* an S7-1200 has none *)
  END_STRUCT;
END_TYPE
FUNCTION Half : REAL
VAR_INPUT
  Bits : DWORD; (* pattern *)
END_VAR
VAR
  Kept : UINT := 3; (* starts anew in each call *)
END_VAR
  IF Kept > 2 THEN
    Half := DWORD_TO_REAL(Bits);
  END_IF;
END_FUNCTION
FUNCTION_BLOCK Caller
VAR_INPUT
  Edge : BOOL R_EDGE; (* rising *)
END_VAR
VAR RETAIN
  Held : REAL; (* kept *)
END_VAR
VAR
  Inner : Callee; (* called *)
  Power : LREAL;  (* of ten *)
END_VAR
  Held := Half(Bits := DWORD#1);
  Inner();
  Power := EXPT(Power, 2.0);
  { pragma }
END_FUNCTION_BLOCK
FUNCTION_BLOCK Callee
VAR_IN_OUT
  Shared : Row; (* shared *)
END_VAR
  Shared[0] := WORD#16#0001;
END_FUNCTION_BLOCK
"""
REFUSED = [
    "Caller.st:4:3: Edge: SCL has no such declaration; a plain VAR can be written",
    "Caller.st:7:3: Held: SCL has no such declaration; a plain VAR can be written",
    "Caller.st:14:3: Inner: expected Shared := ..., since SCL has no default for it",
    "Caller.st:15:12: EXPT: SCL has no such function, or means something else by it",
    "Caller.st:16:3: expected a plain (* comment *); SCL would read it as something else",
    "Colour.st:3:3: Colour: SCL has types of structures alone, without an initial value",
    "Grid.st:3:10: SCL has no arrays of arrays; a structure around the inner one can be written",
    "Half.st:2:10: Half: SCL gives no value to a result that a path does not set",
    "Half.st:7:3: Kept: a function has no initial values in SCL; assign it in the body",
    "Half.st:10:13: DWORD_TO_REAL: SCL has no such function, or means something else by it",
    "Plain.st:5:12: LWORD: an S7-1200 has no such type",
]


class Bare(Shelf):
    """A shelf without a port."""

    def port(self, platform: str) -> tuple[Volume, ...]:
        return super().port(platform)[:0]


def test_what_scl_cannot_say_is_refused_with_its_place_and_all_at_once() -> None:
    texts = ["\n".join(each) for each in _elements(CANNOT)]
    with pytest.raises(ExportError) as caught:
        write(Bare(tuple(_part(text) for text in texts), {}, ()))
    assert [str(problem) for problem in caught.value.problems] == REFUSED


def _elements(text: str) -> list[list[str]]:
    found: list[list[str]] = [[]]
    for line in text.strip().splitlines():
        found[-1].append(line)
        if line.startswith(("END_TYPE", "END_FUNCTION")):
            found.append([])
    return found[:-1]


def _part(text: str) -> Part:
    return Part("", parse(f"(* head *)\n{text}", f"{text.split()[1]}.st"))


MORE = """
FUNCTION_BLOCK More
VAR_INPUT
  Title : STRING[20]; (* a word of SCL *)
END_VAR
VAR_TEMP
  Step : DINT; (* counts *)
END_VAR
VAR
  Wait : TON;      (* a time *)
  Edge : R_TRIG;   (* an edge *)
  Table : ARRAY[0..1, 1..2] OF REAL := [1.0, -2.0, 3.0, 4.0]; (* numbers *)
END_VAR
  Wait(IN := Edge.Q, PT := T#500ms);
  Edge(CLK := Title = 'a$'b');
  FOR Step := 0 TO 3 DO
    IF Wait.Q THEN
      EXIT;
    END_IF;
  END_FOR;
  REPEAT
    Step := LIMIT(0, MIN(Step, 7) + 1, 9);
  UNTIL ABS(Step) > 3
  END_REPEAT;
  RETURN;
END_FUNCTION_BLOCK
"""
SAID = """
   VAR_INPUT
      "Title" : String[20];   // a word of SCL
   END_VAR

   VAR
      Wait : TON_TIME;   // a time
      Edge : R_TRIG;   // an edge
      Table : Array[0..1, 1..2] of Real := [
         1.0, -2.0, 3.0, 4.0
      ];   // numbers
   END_VAR

   VAR_TEMP
      Step : DInt;   // counts
   END_VAR

BEGIN
  #Wait(IN := #Edge.Q, PT := T#500ms);
  #Edge(CLK := #"Title" = 'a$'b');
  FOR #Step := 0 TO 3 DO
    IF #Wait.Q THEN
      EXIT;
    END_IF;
  END_FOR;
  REPEAT
    #Step := LIMIT(MN := 0, IN := MIN(IN1 := #Step, IN2 := 7) + 1, MX := 9);
  UNTIL ABS(#Step) > 3
  END_REPEAT;
  RETURN;
END_FUNCTION_BLOCK
"""


def test_what_no_block_uses_yet_is_written_too() -> None:
    made = write(Bare((_part(MORE.strip()),), {}, ()))["shared/DriveBlocks.scl"].replace("\r\n", "\n")
    assert made.partition("// head\n")[2].strip("\n") == SAID.strip("\n")


@functools.cache
def running() -> Library:
    """The library, the port and the first motors of the platform, with stand-ins for its instructions."""
    stock = checks.shelf()
    programs = checks.programs(stock)
    types = [part for part in stock.parts if part.folder == "types"]
    blocks = [part for part in stock.parts if part.folder != "types"]
    sources = [Source(part.unit.path, part.text) for part in types]
    sources.append(Source.read(INSTRUCTIONS))
    port = [part for one in stock.port("siemens") for part in one.parts]
    sources += [Source(part.unit.path, part.text) for part in (*blocks, *port, *programs)]
    return EmbeddedEngine().build(sources)


class Module:
    """SI_Port with its instructions."""

    def __init__(self) -> None:
        self.port = running().instance("SI_Port")

    def receive(self, seconds: float = 0.01, scans: int = 1) -> None:
        """Scans that receive, this many seconds apart."""
        for _ in range(scans):
            self.port["TxCount"], self.port["Meter"] = 0, seconds
            self.port.scan()

    def send(self, frame: bytes) -> None:
        """A call that sends."""
        self.port["TxCount"], self.port["Tx"] = len(frame), frame
        self.port.scan()

    def shown(self, *names: str) -> list[object]:
        """Some variables."""
        return [self.port[name] for name in names]


def test_the_port_measures_time_and_loses_none_of_it() -> None:
    module, told = Module(), []
    for _ in range(5):
        module.receive(0.0124)
        told += module.shown("ElapsedMs")
    assert told == [0, 12, 13, 12, 13]
    module.receive(500.0)
    assert module.shown("ElapsedMs") == [65535]
    module.receive(-1.0)
    assert module.shown("ElapsedMs") == [0]


def test_the_port_gives_all_messages_in_their_order() -> None:
    module = Module()
    module.port["Receive.Waiting"], module.port["Receive.Size"] = 3, 20
    module.receive()
    assert module.shown("RxCount", "ErrorID") == [60, 0]
    heard = module.port["Rx"]
    assert isinstance(heard, list)
    assert heard[:60] == list(range(60))
    module.port["Receive.Waiting"], module.port["Receive.Size"] = 3, 100
    module.receive()
    assert module.shown("RxCount", "Receive.Waiting") == [255, 0]


def test_the_port_sends_once_and_takes_no_other_before_the_end() -> None:
    module = Module()
    module.port["Send.Slow"], module.port["LateMs"] = 3, 40
    module.receive()
    module.send(b"\x01\x03\x10\x01")
    assert module.shown("TxBusy", "Send.Sent", "Send.Bytes") == [True, 1, 4]
    module.port["Tx"] = bytes(4)
    module.receive(scans=2)
    assert module.shown("TxBusy", "Send.Sent") == [True, 1]
    module.receive()
    assert module.shown("TxBusy", "Send.Sent", "ErrorID", "Send.Wire[2]") == [False, 1, 0, 0x10]
    module.send(b"\x02")
    assert module.shown("Send.Sent") == [2]


def test_an_error_of_receiving_is_reported_in_its_scan_whatever_becomes_of_a_frame() -> None:
    module = Module()
    module.receive()
    assert module.shown("Flush.Count") == [1]
    module.port["Send.Slow"] = 1
    module.send(b"\x01")
    module.port["Receive.Fails"] = True
    module.receive()
    assert module.shown("TxBusy", "ErrorID") == [False, 0x80E1]
    module.receive()
    assert module.shown("ErrorID", "SendErrorID", "Flush.Count") == [0, 0, 1]  # the next message may be good


def test_a_module_whose_receiver_stays_broken_is_reset_by_edges() -> None:
    module = Module()
    module.receive()
    before = module.shown("Flush.Count")[0]
    assert isinstance(before, int)
    for _ in range(10):
        module.port["Receive.Fails"] = True
        module.receive()
        assert module.shown("ErrorID") == [0x80E1]
    assert module.shown("Flush.Count") == [before + 4]


def test_the_first_motor_speaks_to_its_drive() -> None:
    for drive in checks.shelf().drives.values():
        motor = running().instance(f"{drive.prefix}_Motor")
        for _ in range(200):
            motor["Bus.Port.Meter"] = 0.01
            motor.scan()
        assert motor["Bus.ElapsedMs"] == 10
        assert motor["Bus.Port.Send.Sent"]
        assert motor["Bus.Port.Send.Wire[0]"] == drive.serial.unit.min
