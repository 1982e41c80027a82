"""The ports of three platforms on the embedded engine, and how a maker's block may end with a frame.

Each port is in three rigs: alone, with a frame offered whenever it takes one, as MB_ByteLine does; with the frames
that a test gives; and in its line.
"""

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from tests.platforms.stock import made

from structured_text.engines.embedded.engine import EmbeddedEngine
from structured_text.engines.engine import Instance, Library, Source

PINS = (
    "xExecute : BOOL; xAbort : BOOL; iChannelIndex : INT; usiListLength : USINT; udiTimeOut : UDINT; szSize : UINT;"
    " szBuffer : UINT;"
)
STAND_IN = """FUNCTION_BLOCK {name}
VAR_INPUT
  {pins} hCom : UINT; pBuffer : MB_LineFrame;
END_VAR
VAR_OUTPUT
  xDone : BOOL; xBusy : BOOL; xError : BOOL; eError : INT; Came : UINT; Heard : MB_Adu; Asked : UINT;
END_VAR
VAR
  Memory : BOOL; (* xExecute of the last call *)
  Calls : UINT;  (* calls since the starting one *)
  Ends : BOOL;   (* test: it ends by itself *)
  Slow : UINT;   (* test: in which call after the starting one; 0: in that itself *)
  Fails : BOOL;  (* test: it ends with an error *)
END_VAR
  Calls := Calls + 1;
  IF xExecute AND NOT Memory THEN
    Asked := Asked + 1;
    Calls := 0;
    xBusy := TRUE;
  END_IF;
  Memory := xExecute;
  IF NOT xExecute OR xAbort THEN
    xDone := FALSE;
    xError := FALSE;
  END_IF;
  IF xAbort THEN
    xBusy := FALSE;
  ELSIF xBusy AND Ends AND (Calls >= Slow) THEN
    xBusy := FALSE;
    xDone := NOT Fails;
    xError := Fails;
    IF Fails THEN
      eError := 5006;
    END_IF;
  END_IF;
END_FUNCTION_BLOCK
"""
PORT = (
    (r"COM\.CAA_Parameter_Constants\.\w+", "7"),
    (r"COM\.PARAMETER\b", "X_Parameter"),
    (r"COM\.(Open|Close|Read|Write)\b", r"X_\1"),
    (r"COM\.PARITY\.EVEN", "0"),
    (r"COM\.PARITY\.ODD", "1"),
    (r"COM\.\w+\.ONESTOPBIT", "0"),
    (r"COM\.\w+\.(NONE|TWOSTOPBITS)", "2"),
    (r", pParameterList := ADR\(Settings\)", ""),
    (r" pBuffer := ADR\(Heard\),", ""),
    (r"ADR\(Frame\)", "Frame"),
    (r"hCom := Opening.hCom", "hCom := 1"),
    (r"Reading\.szSize", "Reading.Came"),
    (r":= Heard\[", ":= Reading.Heard["),
    (r"TIME_TO_UDINT\(TIME\(\)\)", "Clock"),
    (r"  NowMs : UDINT;", "  Clock : UDINT; (* of the test *)\n  NowMs : UDINT;"),
)
"""What the text of CD_Port says by means of CODESYS, and the same in portable ST."""


COM = ("X_Open", "X_Close", "X_Read", "X_Write")


def replaced(blocks: Sequence[str]) -> list[Source]:
    """Stand-ins of these names, and the structure that one of them takes."""
    parameter = "TYPE\n  X_Parameter : STRUCT udiParameterId : UDINT; udiValue : UDINT; END_STRUCT;\nEND_TYPE\n"
    return [Source("parameter", parameter), *(Source(each, STAND_IN.format(name=each, pins=PINS)) for each in blocks)]


def portable() -> str:
    """CD_Port in portable ST."""
    text = made().port("codesys")[0].parts[0].text
    for old, new in PORT:
        text, count = re.subn(old, new, text, flags=re.DOTALL)
        assert count, old
    return text


SCAN_MS = 10
HERE = Path(__file__).parent


@dataclass(frozen=True)
class End:
    """How each frame ends from now on: in which call after the starting one (None: never), and whether in an error."""

    call: int | None
    fails: bool = False

    def __str__(self) -> str:
        """The name of a case."""
        if self.call is None:
            return "never ends"
        return f"{'ERROR' if self.fails else 'DONE'} in call {self.call}"


GOOD = End(0)
NEVER = End(None)
FAILURES = [End(0, fails=True), End(1, fails=True), End(3, fails=True), NEVER]

ALONE = """PROGRAM X_Alone
VAR
  Port : {port}; Rx : MB_Adu; Tx : MB_LineFrame; Offered : UINT; {more}
END_VAR
  Port(TxCount := 0, {pins}Rx := Rx, Tx := Tx{buffers});
  IF NOT Port.TxBusy THEN
    Offered := Offered + 1;
    Port(TxCount := 8, Rx := Rx, Tx := Tx{buffers});
  END_IF;
END_PROGRAM
"""
GIVEN = """PROGRAM X_Given
VAR
  Port : {port}; Send : UINT; Rx : MB_Adu; Tx : MB_LineFrame; {more}
END_VAR
  Port(TxCount := 0, {pins}Rx := Rx, Tx := Tx{buffers});
  IF Send > 0 THEN
    Port(TxCount := Send, Rx := Rx, Tx := Tx{buffers});
  END_IF;
END_PROGRAM
"""
LINED = """PROGRAM X_Lined
VAR
  Bus : {line}; Slots : MB_Slots8; {more}
END_VAR
  Bus(Slots := Slots{buffers});
END_PROGRAM
"""


@dataclass(frozen=True)
class Maker:
    """A platform: its blocks, its numbers of a frame that failed and of one that did not end, what a frame may take."""

    target: str
    sender: str
    failure: int
    overtime: int
    limit_ms: int
    pins: str = ""
    buffers: str = ""
    more: str = ""

    def __str__(self) -> str:
        """The name of a case."""
        return self.target

    def sources(self) -> Iterable[Source]:
        """Stand-ins, port and line."""
        parts = {part.name: part.text for one in made().port(self.target) for part in one.parts}
        if self.target == "codesys":
            yield from replaced(COM)
            parts["CD_Port"] = portable()
        elif self.target == "siemens":
            yield Source.read(HERE / "siemens" / "instructions.st")
        else:
            yield Source.read(HERE / "com.st")
        port, line = [name for name in parts if not name.endswith(("Line2", "Line32"))]
        yield from (Source(name, parts[name]) for name in (port, line))
        shared = {"buffers": self.buffers, "more": self.more}
        yield Source("X_Alone", ALONE.format(port=port, pins=self.pins, **shared))
        yield Source("X_Given", GIVEN.format(port=port, pins=self.pins, **shared))
        yield Source("X_Lined", LINED.format(line=line, **shared))


MAKERS = [
    Maker("siemens", "Send", 0x80D1, 1, 20 + 9, "BitRate := 9600, CharacterBits := 10, LateMs := 20, "),
    Maker("codesys", "Writing", 5006, 5001, 60 + 9, "BitRate := 9600, CharacterBits := 10, LateMs := 60, "),
    Maker(
        "twincat", "Sender", 2, 0x1008, 40, "PortLateMs := 40, ", ", TxBuffer := TxBuffer, RxBuffer := RxBuffer",
        "TxBuffer : ComBuffer; RxBuffer : ComBuffer;",
    ),
]  # fmt: skip
SIEMENS, CODESYS, TWINCAT = MAKERS


@cache
def library(maker: Maker) -> Library:
    """All rigs of a platform."""
    shared = [Source(part.unit.path, part.text) for part in made().parts if part.folder in ("types", "line", "modbus")]
    types = [source for source in shared if source.text.lstrip().startswith("(*") and "END_TYPE" in source.text]
    return EmbeddedEngine().build([*types, *maker.sources(), *(source for source in shared if source not in types)])


class Rig:
    """A port, alone or in its line, that is scanned every 10 ms."""

    def __init__(self, maker: Maker, program: str) -> None:
        """With its port open, and frames that end well at once."""
        self.maker, self.port = maker, "Port" if program == "X_Alone" else "Bus.Port"
        self.program: Instance = library(maker).instance(program)
        self.ms = 0
        self.end(GOOD)
        if maker.target == "codesys":
            for block in ("Opening", "Closing", "Reading"):
                self.program[f"{self.port}.{block}.Ends"] = True
                self.program[f"{self.port}.{block}.Slow"] = 2

    def end(self, end: End) -> None:
        """How each frame ends from now on."""
        sender = f"{self.port}.{self.maker.sender}"
        self.program[f"{sender}.Slow"] = end.call or 0
        self.program[f"{sender}.Fails"] = end.fails
        if self.maker.target == "codesys":
            self.program[f"{sender}.Ends"] = end.call is not None
        else:
            self.program[f"{sender}.Never"] = end.call is None

    def scan(self) -> None:
        """One scan; the terminal takes what is in its buffer."""
        self.ms += SCAN_MS
        if self.maker.target == "siemens":
            self.program[f"{self.port}.Meter"] = SCAN_MS / 1000
        elif self.maker.target == "codesys":
            self.program[f"{self.port}.Clock"] = self.ms
        else:
            self.program[f"{self.port}.Clock.cpuCntLoDW"] = self.ms * 10_000
        self.program.scan()
        if self.maker.target == "twincat":
            self.program["TxBuffer.Count"] = 0

    def number(self, name: str) -> int:
        """A variable of the rig."""
        value = self.program[name]
        assert isinstance(value, int)
        return value

    @property
    def attempts(self) -> int:
        """Frames that the maker's block was asked to send: it sees an edge of each."""
        names = {"siemens": f"{self.port}.Send.Sent", "codesys": f"{self.port}.Writing.Asked", "twincat": "Offered"}
        return self.number(names[self.maker.target])
