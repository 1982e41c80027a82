"""What a user writes around drive blocks: a program with a port, a line and drives, as a block that a test can scan."""

import re
from collections.abc import Callable, Sequence
from functools import cache

from tests.blocks.library import sources
from tests.shapes import shapes
from tests.shipped import drives

from driveblocks.maps.model import Drive
from driveblocks.render import library as blocks
from structured_text.engines.embedded.engine import EmbeddedEngine
from structured_text.engines.engine import Engine, Library, Source

Edit = Callable[[str], str]
FAMILIES = ("CHF", "GD200A", "JSCC", "PF4", "SN300G5")
RTU_ONLY = ("PF4", "SN300G5")
"""Drives without MODBUS ASCII."""
MADE_UP = ("CIA", "PRO", "PUL", "TWO", "LOW")
PINS = ("CommOk", "Ready", "Running", "AtSpeed", "ZeroSpeed", "StopConfirmed", "StopOverdue", "Fault")
"""Outputs that `Seen` holds of each drive, the first one lowest."""
STATIONS = (*((each,) for each in (*FAMILIES, *MADE_UP)), ("CHF", "CHF"), FAMILIES)
_WANTED = re.compile(
    r"types/.*(?<!32)\.st|modbus/MB_Hex.*|line/(?!MB_ByteLine|MB_Line32).*|vfd/VFD_(?!ReasonText).*"
    r"|(?!types|modbus|line|vfd)[^/]*/[^_]*_(?!\w+Text..\.|(Request|Reply|Command|Version|(Parameter|Number)Address)\.).*\.st"
)


@cache
def maps() -> dict[str, Drive]:
    """Every drive by the prefix of its blocks: those that ship, and the made-up ones."""
    return {drive.prefix: drive for drive in (*drives().values(), *shapes().values())}


def texts(edit: Edit = str, kinds: Sequence[str] = (*FAMILIES, *MADE_UP)) -> list[Source]:
    """The files that the stations of these drives need, each edited, and the stations."""
    made = [file for name in MADE_UP for file in blocks.drive(name.lower(), maps()[name], [])]
    found = [*sources(), *(Source(each.path, each.text) for each in made)]
    others = tuple(f"{name}_" for name in maps() if name not in kinds)
    wanted = [each for each in found if _WANTED.fullmatch(each.path) and not each.path.split("/")[1].startswith(others)]
    stations = [station(types) for types in STATIONS if set(types) <= set(kinds)]
    return [*(Source(each.path, edit(each.text)) for each in wanted), Source("stations.st", "\n".join(stations))]


def name_of(types: Sequence[str]) -> str:
    """The station of these drives."""
    return "Station_" + "_".join(types)


def station(types: Sequence[str]) -> str:
    """The text of a station: the adapter hands over whole frames; drive blocks first, then the line."""
    drives = "".join(f"  Skip{i} : BOOL;\n  Drive{i} : {kind}_Drive;\n" for i, kind in enumerate(types))
    calls = "".join(f"  IF NOT Skip{i} THEN\n    Drive{i}(Slot := Slots[{i}]);\n  END_IF;\n" for i in range(len(types)))
    seen = "".join(
        f"  IF Drive{i}.{pin} THEN\n    Seen := Seen + {1 << (16 + 8 * i + place)};\n  END_IF;\n"
        for i in range(len(types))
        for place, pin in enumerate(PINS)
    )
    return f"""FUNCTION_BLOCK {name_of(types)}
VAR_INPUT
  ElapsedMs : UINT;
END_VAR
VAR_OUTPUT
  Seen : ULINT;
END_VAR
VAR
  Text : MB_RxRing;
  Count : UINT;
  Index : UINT;
  SkipLine : BOOL;
  Port : MB_Port;
  Slots : MB_Slots8;
  TheLine : MB_Line8;
  Reader : VFD_ReadParameter;
  Writer : VFD_WriteParameter;
  Storer : VFD_Store;
  Stores : UDINT;
{drives}END_VAR
  Index := 0;
  WHILE Index < Count DO
    Port.Rx[Port.RxIn] := Text[Index];
    Port.RxIn := (Port.RxIn + 1) MOD 256;
    Index := Index + 1;
  END_WHILE;
  Count := 0;
  Reader(Slot := Slots[0]);
  Writer(Slot := Slots[0]);
  Storer(Stores := Stores, Slot := Slots[0]);
{calls}  IF NOT SkipLine THEN
    TheLine(ElapsedMs := ElapsedMs, Port := Port, Slots := Slots);
  END_IF;
  Port.TxTaken := Port.TxNumber;
  Seen := UINT_TO_ULINT(Port.TxNumber);
{seen}END_FUNCTION_BLOCK
"""


@cache
def library() -> Library:
    """Every station on the embedded engine."""
    return built(EmbeddedEngine())


def built(engine: Engine, edit: Edit = str, kinds: Sequence[str] = (*FAMILIES, *MADE_UP)) -> Library:
    """The stations of these drives on an engine."""
    return engine.build(texts(edit, kinds))
