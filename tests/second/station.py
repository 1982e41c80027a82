"""What a user writes around drive blocks, as a block that a test can scan: port, line, drives, a contact, parameters.

The first drive is the one that things happen to. `Twin` is a second block on its slot, for who wires it wrongly; blocks
for parameters are before and after the drives. The adapter hands over whole frames; drive blocks first, then the line.
"""

import re
from collections.abc import Sequence
from functools import cache

from tests.blocks.library import sources
from tests.second import profiles
from tests.second.pf4 import VARIANTS
from tests.shapes import shapes
from tests.shipped import drives

from driveblocks.maps.model import Drive
from driveblocks.render import library as blocks
from structured_text.engines.embedded.engine import EmbeddedEngine
from structured_text.engines.engine import Engine, Library, Source

PINS = ("CommOk", "Ready", "Running", "AtSpeed", "ZeroSpeed", "StopConfirmed", "StopOverdue", "Fault")
"""Outputs that `Seen` holds of each drive, the first one lowest."""
BLOCKS = {"Reader": "VFD_ReadParameter", "Writer": "VFD_WriteParameter", "Storer": "VFD_Store"}
IN_SEEN = 6
"""Drives whose pins `Seen` has bits for; those of the others, and the contact's, are in `More`."""
SIZES = (1, 3, 8)
MIXED = ("CHF", "GD200A", "JSCC", "PF4", "SN300G5")
"""Families that are together on a line."""
NEWER = ("ATV312", "MX2")
ALONE = (*NEWER, *profiles.FAMILIES, *VARIANTS)
FAMILIES = (*MIXED, *ALONE)
RTU_ONLY = ("PF4", "SN300G5", *ALONE)
"""Drives without MODBUS ASCII."""
RIVALS = {"CHF": "JSCC", "GD200A": "PF4", "JSCC": "CHF", "PF4": "GD200A", "SN300G5": "CHF"}
"""Another make that is wired to the slot of the first drive, on lines of three."""
MADE_UP = ("CIA", "PRO", "PUL", "TWO", "LOW")
"""Drives that nobody builds, for what a map can say."""
_WANTED = re.compile(
    r"types/.*(?<!32)\.st|modbus/MB_Hex.*|line/(?!MB_ByteLine|MB_Line2|MB_Line32).*|vfd/VFD_(?!ReasonText).*"
    r"|(?!types|modbus|line|vfd)[^/]*/[^_]*_(?!\w+Text..\.|(Request|Reply|Command|Version|(Parameter|Number)Address)\.).*\.st"
)


def types_of(family: str, number: int, *, ascii_: bool) -> tuple[str, ...]:
    """A line of mixed drives; some have no MODBUS ASCII. Of a variant or a newer family there is one."""
    if family in ALONE:
        return (family, *types_of("CHF", number - 1, ascii_=False))
    others = [each for each in MIXED if not ascii_ or each not in RTU_ONLY]
    at = others.index(family)
    return tuple((others[at:] + others[:at])[i % len(others)] for i in range(number))


STATIONS = sorted(
    {types_of(f, n, ascii_=a) for f in FAMILIES for n in SIZES for a in (False, True) if not a or f not in RTU_ONLY}
)


@cache
def maps() -> dict[str, Drive]:
    """Every drive by the prefix of its blocks: those that ship, and the made-up ones."""
    return {drive.prefix: drive for drive in (*drives().values(), *shapes().values())}


def name_of(types: Sequence[str]) -> str:
    """The station of these drives."""
    return "Station_" + "_".join(types)


def station(types: Sequence[str]) -> str:
    """The text of a station."""
    drives, aside = range(len(types)), range(min(len(types), 3))
    declared = "".join(f"  Skip{i} : BOOL;\n  Drive{i} : {kind}_Drive;\n" for i, kind in enumerate(types))
    declared += "".join(
        f"  {name}{i} : {block};\n" for i in ("", *aside) for name, block in (*BLOCKS.items(), ("Stores", "UDINT"))
    )
    rival = RIVALS.get(types[0], "") if len(types) == SIZES[1] else ""
    declared += f"  UseOther : BOOL;\n  Other : {rival}_Drive;\n" if rival else ""
    called = "  IF UseOther THEN\n    Other(Slot := Slots[0]);\n  END_IF;\n" if rival else ""
    calls = "".join(f"  IF NOT Skip{i} THEN\n    Drive{i}(Slot := Slots[{i}]);\n  END_IF;\n" for i in drives)
    bits = [(f"Drive{i}.{pin}", 8 * i + place) for i in drives for place, pin in enumerate(PINS)]
    seen = "".join(_shown("Seen", pin, 16 + place) for pin, place in bits if place < 8 * IN_SEEN)
    beyond = [*((pin, place - 8 * IN_SEEN) for pin, place in bits if place >= 8 * IN_SEEN), ("Contact.HardStopOk", 16)]
    seen += "".join(_shown("More", pin, place) for pin, place in beyond)
    return f"""FUNCTION_BLOCK {name_of(types)}
VAR_INPUT
  ElapsedMs : UINT;
END_VAR
VAR_OUTPUT
  Seen : ULINT;
  More : UDINT;
END_VAR
VAR
  Text : MB_RxRing;
  Count : UINT;
  Index : UINT;
  SkipLine : BOOL;
  Port : MB_Port;
  Slots : MB_Slots8;
  TheLine : MB_Line8;
{declared}  UseTwin : BOOL;
  Twin : {types[0]}_Drive;
  Contact : VFD_HardStop;
  SlowPort : BOOL;
  Found : UINT;
  UseMeter : BOOL;
  Meter : MB_Device;
  MeterWords : MB_Words16;
END_VAR
  Index := 0;
  WHILE Index < Count DO
    Port.Rx[Port.RxIn] := Text[Index];
    Port.RxIn := (Port.RxIn + 1) MOD 256;
    Index := Index + 1;
  END_WHILE;
  Count := 0;
{_parameters("", 0)}{calls}  IF UseTwin THEN
    Twin(Slot := Slots[0]);
  END_IF;
{called}{"".join(_parameters(str(i), i) for i in aside)}  IF UseMeter THEN
    Meter(Slot := Slots[7], Words := MeterWords);
  END_IF;
  IF NOT SkipLine THEN
    TheLine(ElapsedMs := ElapsedMs, Port := Port, Slots := Slots);
  END_IF;
  Contact(Overdue := TheLine.StopOverdue);
  IF (Port.TxCount > 0) AND (NOT SlowPort OR (Port.TxNumber = Found)) THEN
    Port.TxTaken := Port.TxNumber;
  END_IF;
  Found := Port.TxNumber;
  Seen := UINT_TO_ULINT(Port.TxTaken);
  More := 0;
{seen}END_FUNCTION_BLOCK
"""


def _shown(output: str, pin: str, place: int) -> str:
    return f"  IF {pin} THEN\n    {output} := {output} + {1 << place};\n  END_IF;\n"


def _parameters(name: str, slot: int) -> str:
    return (
        f"  Reader{name}(Slot := Slots[{slot}]);\n  Writer{name}(Slot := Slots[{slot}]);\n"
        f"  Storer{name}(Stores := Stores{name}, Slot := Slots[{slot}]);\n"
    )


def texts(stations: Sequence[Sequence[str]]) -> list[Source]:
    """The files that some stations need, and the stations."""
    kinds = {kind for types in stations for kind in (*types, RIVALS.get(types[0], types[0]))}
    made = [file for name in MADE_UP if name in kinds for file in blocks.drive(name.lower(), maps()[name], [])]
    found = [*sources(), *(Source(each.path, each.text) for each in made)]
    others = tuple(f"{name}_" for name in maps() if name not in kinds)
    wanted = [each for each in found if _WANTED.fullmatch(each.path) and not each.path.split("/")[1].startswith(others)]
    return [*wanted, Source("stations.st", "\n".join(map(station, stations)))]


def built(engine: Engine, stations: Sequence[Sequence[str]] = STATIONS) -> Library:
    """Stations on an engine; those of the second models unless others are named."""
    return engine.build(texts(stations))


@cache
def library() -> Library:
    """Every station of second models on the embedded engine."""
    return built(EmbeddedEngine())


@cache
def simulated() -> Library:
    """A station for each drive that the simulator has alone, the made-up ones, too, on the embedded engine."""
    return built(EmbeddedEngine(), [(kind,) for kind in (*MIXED, *MADE_UP)])
