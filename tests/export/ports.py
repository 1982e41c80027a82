"""The ports of three platforms on the embedded engine, and how a maker's block may end with a frame.

Each port is in two rigs: alone, with a frame offered whenever it takes one, as MB_ByteLine does; and in its line.
"""

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from tests.export.stock import made
from tests.export.test_codesys_port import COM, portable, replaced

from structured_text.engines.embedded.engine import EmbeddedEngine
from structured_text.engines.engine import Instance, Library, Source

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
ENDS = [GOOD, End(1), End(3), *FAILURES]

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
        parts = {part.name: part.text for part in made().adapter(self.target)}
        if self.target == "codesys":
            yield from replaced(COM)
            parts["CD_Port"] = portable()
        elif self.target == "siemens":
            yield Source.read(HERE / "siemens" / "instructions.st")
        else:
            yield Source.read(HERE / "com.st")
        port, line = [name for name in parts if not name.endswith("32")]
        yield from (Source(name, parts[name]) for name in (port, line))
        shared = {"buffers": self.buffers, "more": self.more}
        yield Source("X_Alone", ALONE.format(port=port, pins=self.pins, **shared))
        yield Source("X_Lined", LINED.format(line=line, **shared))


MAKERS = [
    Maker("siemens", "Send", 0x80D1, 1, 20 + 9, "BitRate := 9600, CharacterBits := 10, LateMs := 20, "),
    Maker("codesys", "Writing", 5006, 5001, 60 + 9, "BitRate := 9600, CharacterBits := 10, LateMs := 60, "),
    Maker(
        "twincat", "Sender", 2, 0x1008, 40, "PortLateMs := 40, ", ", TxBuffer := TxBuffer, RxBuffer := RxBuffer",
        "TxBuffer : ComBuffer; RxBuffer : ComBuffer;",
    ),
]  # fmt: skip


@cache
def library(maker: Maker) -> Library:
    """Both rigs of a platform."""
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
