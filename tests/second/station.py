"""What a user writes around the drive blocks for the second models: a contact, a twin, parameter blocks on every side.

The first drive is the one that things happen to. `Twin` is a second block on its slot, for who wires it wrongly.
"""

from collections.abc import Sequence
from functools import cache

from tests.drives import station as first
from tests.drives.station import PINS
from tests.second.pf4 import VARIANTS

from structured_text.engines.embedded.engine import EmbeddedEngine
from structured_text.engines.engine import Engine, Library, Source

BLOCKS = {"Reader": "VFD_ReadParameter", "Writer": "VFD_WriteParameter", "Storer": "VFD_Store"}
METER = "  IF UseMeter THEN\n    Meter(Slot := Slots[7], Words := MeterWords);\n  END_IF;\n"
"""A unit without a motor, in the last slot, where no drive is there."""
IN_SEEN = 6
"""Drives whose pins `Seen` has bits for; those of the others, and the contact's, are in `More`."""
SIZES = (1, 3, 8)
NEWER = ("ATV312", "MX2")
ALONE = (*NEWER, *VARIANTS)
FAMILIES = (*first.FAMILIES, *ALONE)
RTU_ONLY = (*first.RTU_ONLY, *ALONE)


def types_of(family: str, number: int, *, ascii_: bool) -> tuple[str, ...]:
    """A line of mixed drives; some have no MODBUS ASCII. Of a variant or a newer family there is one."""
    if family in ALONE:
        return (family, *types_of("CHF", number - 1, ascii_=False))
    others = [each for each in first.FAMILIES if not ascii_ or each not in RTU_ONLY]
    at = others.index(family)
    return tuple((others[at:] + others[:at])[i % len(others)] for i in range(number))


STATIONS = sorted(
    {types_of(f, n, ascii_=a) for f in FAMILIES for n in SIZES for a in (False, True) if not a or f not in RTU_ONLY}
)


def name_of(types: Sequence[str]) -> str:
    """The station of these drives."""
    return "Second_" + "_".join(types)


def station(types: Sequence[str]) -> str:
    """Like that of tests/drives, with more around it."""
    beyond = list(enumerate(types))[IN_SEEN:]
    aside = range(min(len(types), 3))
    declared = "".join(f"  Skip{i} : BOOL;\n  Drive{i} : {kind}_Drive;\n" for i, kind in beyond)
    declared += "".join(
        f"  {name}{i} : {block};\n  Stores{i} : UDINT;\n" if name == "Storer" else f"  {name}{i} : {block};\n"
        for i in aside
        for name, block in BLOCKS.items()
    )
    after = "".join(f"  IF NOT Skip{i} THEN\n    Drive{i}(Slot := Slots[{i}]);\n  END_IF;\n" for i, _ in beyond)
    after += "  IF UseTwin THEN\n    Twin(Slot := Slots[0]);\n  END_IF;\n"
    after += "".join(
        f"  Reader{i}(Slot := Slots[{i}]);\n  Writer{i}(Slot := Slots[{i}]);\n"
        f"  Storer{i}(Stores := Stores{i}, Slot := Slots[{i}]);\n"
        for i in aside
    )
    more = [(f"Drive{i}.{pin}", 8 * (i - IN_SEEN) + place) for i, _ in beyond for place, pin in enumerate(PINS)]
    more.append(("Contact.HardStopOk", 16))
    seen = "".join(f"  IF {pin} THEN\n    More := More + {1 << place};\n  END_IF;\n" for pin, place in more)
    text = first.station(types[:IN_SEEN]).replace(first.name_of(types[:IN_SEEN]), name_of(types))
    for old, new in (
        ("END_VAR\nVAR\n", "  More : UDINT;\nEND_VAR\nVAR\n"),
        ("END_VAR\n  Index := 0;\n", f"{declared}  UseTwin : BOOL;\n  Twin : {types[0]}_Drive;\n"
         "  Contact : VFD_HardStop;\n  SlowPort : BOOL;\n  Found : UINT;\n"
         f"  UseMeter : BOOL;\n  Meter : MB_Device;\n  MeterWords : MB_Words16;\nEND_VAR\n  Index := 0;\n"),
        ("  IF NOT SkipLine THEN\n", f"{after}{METER}  IF NOT SkipLine THEN\n"),
        ("  Port.TxTaken := Port.TxNumber;\n  Seen := UINT_TO_ULINT(Port.TxNumber);\n",
         "  Contact(Overdue := TheLine.StopOverdue);\n"
         "  IF (Port.TxCount > 0) AND (NOT SlowPort OR (Port.TxNumber = Found)) THEN\n"
         "    Port.TxTaken := Port.TxNumber;\n  END_IF;\n"
         "  Found := Port.TxNumber;\n  Seen := UINT_TO_ULINT(Port.TxTaken);\n"),
        ("END_FUNCTION_BLOCK", f"  More := 0;\n{seen}END_FUNCTION_BLOCK"),
    ):  # fmt: skip
        assert text.count(old) == 1, old
        text = text.replace(old, new)
    return text


def built(engine: Engine, stations: Sequence[Sequence[str]] = STATIONS) -> Library:
    """The stations on an engine."""
    texts = [each for each in first.texts(kinds=FAMILIES) if each.path != "stations.st"]
    return engine.build([*texts, Source("stations.st", "\n".join(map(station, stations)))])


@cache
def library() -> Library:
    """Every station on the embedded engine."""
    return built(EmbeddedEngine())
