"""Real drive blocks of all families on a virtual RS-485 line, compiled by matiec, with the second models as drives.

`Crowd` is the compiled library; `Hall` one line in virtual time, in microseconds: what is on its wire, and when. Scans
are made in C, in crowd.c; here are the drives, whatever else speaks on the line, and what those who judge have to know.
"""

import ctypes
import hashlib
import heapq
import re
import subprocess
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from tempfile import gettempdir
from typing import Any

from tests.blocks.library import sources
from tests.blocks.toolchains import COMPILER, FOUND, translate
from tests.line.cline import WHY_NOT
from tests.second.drive import Drive
from tests.second.frames import rtu
from tests.second.kinds import drive as model
from tests.second.line import SETTINGS, path
from tests.second.pf4 import VARIANTS
from tests.shipped import drives

from driveblocks.maps.revision import checked
from structured_text.engines.matiec.installation import Installation

__all__ = ["FAMILIES", "WHY_NOT", "Crowd", "Hall", "crowd"]
HERE = Path(__file__).parent
KINDS = {"ATV312": "atv", "CHF": "chf", "GD200A": "gd", "JSCC": "jscc", "MX2": "mx", "PF4": "pf", "SN300G5": "sn"}
KINDS |= {name: name.lower() for name in VARIANTS}
FAMILIES = tuple(sorted(KINDS))
"""Prefixes of the drive blocks."""
_OURS = re.compile(
    r"types/.*|modbus/MB_Hex.*|line/(?!MB_ByteLine).*|vfd/VFD_(?!ReasonText).*|(?!types|modbus|line|vfd|device)[^/]*/.*"
)
_TEXTS = re.compile(r"[^/]*/[^_]*_(\w+Text..\.|(Request|Reply|Command|Version|(Parameter|Number)Address)\.).*")
SCALARS: dict[str, Any] = {
    "BOOL": ctypes.c_uint8, "USINT": ctypes.c_uint8, "BYTE": ctypes.c_uint8, "UINT": ctypes.c_uint16,
    "WORD": ctypes.c_uint16, "UDINT": ctypes.c_uint32, "DWORD": ctypes.c_uint32, "REAL": ctypes.c_float,
}  # fmt: skip
RUNS = ("RunForward", "RunReverse", "JogForward", "JogReverse")
MOST = 32


class Block(ctypes.Structure):
    """What is seen of a drive block in each call; as in crowd.c."""

    _fields_ = [
        *((name, ctypes.c_int32) for name in (
            "family", "slot", "called", "watched", "age", "over", "over_age", "over_worst",
            "worst", "ready", "lost_starts", "pins", "block_abi", "line_abi", "function", "address", "word", "every",
            "nth", "scans",
        )),
        *((name, ctypes.c_int64) for name in ("over_at", "put_at", "overdue_at", "lost_at", "unknown_at")),
    ]  # fmt: skip


class _State(ctypes.Structure):
    _fields_ = [
        *((name, ctypes.c_int32) for name in (
            "blocks", "slots", "rate", "bits", "keeps", "scan", "jitter", "elapsed", "unused"
        )),
        ("now", ctypes.c_int64),
    ]  # fmt: skip


class _Places(ctypes.Structure):
    _fields_ = [
        ("ready", ctypes.c_int32),
        ("reason", ctypes.c_int32),
        ("age", ctypes.c_int32),
        ("run", ctypes.c_int32 * 4),
    ]


def texts() -> list[str]:
    """Files of the library: lines, and all that drive blocks need."""
    return [each.text for each in sources() if _OURS.fullmatch(each.path) and not _TEXTS.fullmatch(each.path)]


def _members(header: str) -> dict[str, list[tuple[str, str]]]:
    """Scalars of every structure and block by name: their paths in C, and their types."""
    found: dict[str, list[tuple[str, str]]] = {}
    for name, body in re.findall(r"__DECLARE_STRUCT_TYPE\((\w+),(.*?)\n  \)", header, re.DOTALL):
        found[name] = [(member, kind) for kind, member in re.findall(r"(\w+) (\w+);", body) if kind in SCALARS]
    for body, name in re.findall(r"typedef struct \{\n(.*?)\n\} (\w+);", header, re.DOTALL):
        rows: list[tuple[str, str]] = []
        for kind, member in re.findall(r"__DECLARE_VAR\((\w+),(\w+)\)", body.partition("private")[0]):
            inner = (
                [(f"{member}.value.{part}", of) for part, of in found.get(kind, [])] if kind.startswith("VFD") else []
            )
            rows += [(f"{member}.value", kind)] if kind in SCALARS else inner
        found[name] = rows
    return found


def _prepare(folder: Path, tool: Installation) -> dict[str, list[tuple[str, str]]]:
    translate(tool, texts(), folder)
    header = (folder / "POUS.h").read_text("utf-8")
    lines = sorted(int(each) for each in re.findall(r"\} MB_LINE(\d+);", header))
    made = [f"FAMILY({name})" for name in FAMILIES] + [f"LINE({number})" for number in lines]
    (folder / "families.h").write_text("\n".join([*made, ""]), "utf-8")
    members = _members(header)
    wanted = {
        name: members[name] for name in ["MB_SLOT", *(f"{f}_DRIVE" for f in FAMILIES), *(f"MB_LINE{n}" for n in lines)]
    }
    rows = [f"offsetof({name}, {member})," for name, each in wanted.items() for member, _ in each]
    table = "\n".join(["#include <stddef.h>", "const int32_t crowd_places[] = {", *rows, "};", ""])
    (folder / "places.h").write_text(table, "utf-8")
    return wanted


class Crowd:
    """The compiled library, and where the members of its blocks are."""

    def __init__(self, folder: Path, tool: Installation | None = None) -> None:
        """Compile it in a folder, or take what was compiled there of the same text."""
        tool = tool or FOUND[0]
        text = "\n".join(
            [str(tool.iec2c), (HERE / "crowd.c").read_text("utf-8"), Path(__file__).read_text("utf-8"), *texts()]
        )
        place = folder / hashlib.sha256(text.encode()).hexdigest()[:16]
        program = place / "crowd.so"
        if not program.exists():
            place.mkdir(parents=True, exist_ok=True)
            _prepare(place, tool)
            (place / "unit.c").write_text(f'#include "{HERE / "crowd.c"}"\n#include "places.h"\n', "utf-8")
            headers = ["-isystem", str(tool.library / "C"), "-I", "."]
            made = place / "made.so"
            command = [str(COMPILER), "-O2", "-w", "-shared", "-fPIC", *headers, "unit.c", "-o", made.name]
            done = subprocess.run(command, cwd=place, capture_output=True, text=True, check=False)
            assert done.returncode == 0, done.stderr[:4000]
            made.rename(program)
        self.c = c = ctypes.CDLL(str(program))
        c.crowd_line.restype = c.crowd_block.restype = ctypes.c_void_p
        c.crowd_run.argtypes = [ctypes.c_longlong, ctypes.c_void_p]
        c.crowd_transmit.argtypes = [ctypes.c_longlong, ctypes.c_char_p, ctypes.c_int]
        c.crowd_begin.argtypes = [ctypes.c_uint64, ctypes.c_int]
        self.state, self.blocks = _State.in_dll(c, "hall"), (Block * MOST).in_dll(c, "block")
        header = (place / "POUS.h").read_text("utf-8")
        members = _members(header)
        self.lines = sorted(int(each) for each in re.findall(r"\} MB_LINE(\d+);", header))
        wanted = ["MB_SLOT", *(f"{f}_DRIVE" for f in FAMILIES), *(f"MB_LINE{n}" for n in self.lines)]
        every = [(name, member, kind) for name in wanted for member, kind in members[name]]
        places = (ctypes.c_int32 * len(every)).in_dll(c, "crowd_places")
        self.members: dict[str, dict[str, tuple[int, Any]]] = {name: {} for name in wanted}
        for at, (name, member, kind) in enumerate(every):
            self.members[name][member.replace(".value", "")] = places[at], SCALARS[kind]
        self._look()
        self.slot_base = ctypes.addressof(ctypes.c_char.in_dll(c, "slots"))
        self.slot_size = ctypes.c_int32.in_dll(c, "slot_size").value
        self.request = (ctypes.c_ubyte * 64).in_dll(c, "request")
        self.request_count, self.request_number = (
            ctypes.c_int32.in_dll(c, f"request_{n}") for n in ("count", "number")
        )
        self.request_from, self.request_to = (ctypes.c_int64.in_dll(c, f"request_{n}") for n in ("from", "to"))
        self.short_silences = ctypes.c_long.in_dll(c, "short_silences")

    def _look(self) -> None:
        """Tell where outputs are that are looked at in each call."""
        places = (_Places * MOST).in_dll(self.c, "places")
        for at, family in enumerate(FAMILIES):
            own = self.members[f"{family}_DRIVE"]
            places[at].ready, places[at].reason = own["READY"][0], own["REASON"][0]
            places[at].age = own["DIAGNOSIS.STATUSAGEMS"][0]
            places[at].run[:] = [own[name.upper()][0] for name in RUNS]

    def view(self, kind: str, base: int) -> "View":
        """The members of a block or slot in memory."""
        return View(self.members[kind], base)


class View:
    """Members of a structure in memory by their names in ST."""

    def __init__(self, members: dict[str, tuple[int, Any]], base: int) -> None:
        """At an address."""
        self._members, self._base, self._found = members, base, dict[str, Any]()

    def __getitem__(self, name: str) -> float:
        """Read."""
        value: float = self.place(name).value
        return value

    def __setitem__(self, name: str, value: float) -> None:
        """Write."""
        self.place(name).value = value

    def __contains__(self, name: str) -> bool:
        """Whether there is such a member."""
        return name.upper() in self._members

    def place(self, name: str) -> Any:
        """The member itself."""
        if name not in self._found:
            offset, kind = self._members[name.upper()]
            self._found[name] = kind.from_address(self._base + offset)
        return self._found[name]


@cache
def crowd() -> Crowd:
    """The library, compiled once for a text of it."""
    return Crowd(Path(gettempdir()) / "driveblocks-crowd")


def default_pins(family: str, address: int) -> dict[str, float]:
    """Pins of a drive block that can start its second model, by their places in the block."""
    pins = SETTINGS | {"Address": address, "StopWithinMs": 20_000}
    pins["ManualChecked"] = checked(drives()[family])
    return {path(0, name).partition(".")[2]: float(value) for name, value in pins.items()}


@dataclass
class Exchange:
    """A request of ours that was on the wire: when it was, and what the drives answered."""

    begins: int
    end: int
    data: bytes
    good: bool = True
    """Nothing has spoilt it."""
    replies: list[tuple[int, int, bytes]] = field(default_factory=list)
    """Begin and end of each, and what it says."""


class Hall:
    """One line: blocks, models, and events on the wire by their times."""

    def __init__(self, library: Crowd, seed: int, *, slots: int, rate: int = 19200, bits: int = 10, keeps: bool = True,
                 scan_us: int = 10_000,
                 jitter_us: int = 0, before: "Hall | None" = None) -> None:  # fmt: skip
        """A line without drives, or with those of another PLC program that has ended; its first scan is the first."""
        self.library = library
        number = next(each for each in library.lines if each >= slots)
        library.c.crowd_begin(seed, number)
        self.state = state = library.state
        state.rate, state.bits, state.keeps, state.scan, state.jitter = rate, bits, keeps, scan_us, jitter_us
        self.line = library.view(f"MB_LINE{number}", library.c.crowd_line())
        self.line["BitRate"], self.line["CharacterBits"] = rate, bits
        self.line["MaxScanMs"] = (scan_us + jitter_us) // 1000 + 1
        library.c.crowd_keeps(int(keeps))
        self.line["Restart"] = 1
        state.now = before.now if before else 0
        self._elapsed = ctypes.addressof(self.line.place("ElapsedMs"))
        self.char_us = -(-bits * 1_000_000 // rate)
        self.now: int = before.now if before else 0
        """Until when all has happened; the last scan was a little before."""
        self.time = 0
        """Of the event that happens."""
        self.drives: list[View] = []
        self.slots: list[View] = []
        self.families: list[str] = []
        self.models: dict[int, list[Drive]] = before.models if before else {}
        """What hangs on the wire, by unit address."""
        self.deaf: set[int] = set()
        """Units that hear nothing any more."""
        self.events: list[tuple[int, int, Callable[[], None]]] = []
        self._count = 0
        self.watch: list[Callable[[Exchange], None]] = []
        """Told of each request of ours, after the drives have heard it."""

    # ------------------------------------------------------------ what is there

    def drive(self, family: str, address: int, slot: int | None = None, **pins: float) -> int:
        """A drive block in a slot; its number."""
        at, library = len(self.drives), self.library
        library.c.crowd_new(at, FAMILIES.index(family), at if slot is None else slot)
        view = library.view(f"{family}_DRIVE", library.c.crowd_block(at))
        for name, value in (default_pins(family, address) | pins).items():
            place = view.place(name.replace("__", "."))
            place.value = value if isinstance(place, ctypes.c_float) else int(value)
        self.drives.append(view)
        self.families.append(family)
        self.slots.append(library.view("MB_SLOT", library.slot_base + library.slot_size * library.blocks[at].slot))
        self.state.blocks = at + 1
        return at

    def model(self, family: str, unit: int, **options: Any) -> Drive:
        """A second model at a unit address."""
        if family == "JSCC":
            options.setdefault("reference_milli_hz", 10)
        one = model(KINDS[family], unit, char_us=self.char_us, silence_us=0, **options)
        self.models.setdefault(unit, []).append(one)
        return one

    def put(self, at: int, **pins: float) -> None:
        """Set pins of a drive block; what they were already asks for nothing new."""
        drive, block = self.drives[at], self.library.blocks[at]
        wanted = {name.replace("__", "."): value for name, value in pins.items()}
        if any(drive[name] != value for name, value in wanted.items()):
            block.put_at = -1
        for name, value in wanted.items():
            drive[name] = value
        if not set(pins) <= set(RUNS):
            block.ready = 0

    def seen(self, at: int) -> Block:
        """What was seen of a drive block."""
        return self.library.blocks[at]

    # ------------------------------------------------------------ time

    def at(self, time: int, does: Callable[[], None]) -> None:
        """Something happens at a time."""
        self._count += 1
        heapq.heappush(self.events, (time, self._count, does))

    def run(self, until: int) -> None:
        """Let time pass."""
        run, library, events = self.library.c.crowd_run, self.library, self.events
        while True:
            most = min(until, events[0][0]) if events else until
            if run(most, self._elapsed):
                raw = bytes(library.request[: library.request_count.value])
                exchange = Exchange(library.request_from.value, library.request_to.value, raw[:-2])
                number = library.request_number.value
                self.at(exchange.end, lambda exchange=exchange, number=number: self._heard(exchange, number))  # type: ignore[misc]
            elif events and events[0][0] <= until:
                self.time, _, does = heapq.heappop(events)
                does()
            else:
                self.now = until
                return

    def restart(self) -> None:
        """The PLC's first scan."""
        self.line["Restart"] = 1
        self.run(self.now + self.state.scan + self.state.jitter)
        self.line["Restart"] = 0

    # ------------------------------------------------------------ wire

    def _heard(self, exchange: Exchange, number: int) -> None:
        exchange.good = not self.library.c.crowd_spoilt(number)
        if exchange.good:
            self.answer(exchange.data, exchange.end, exchange)
        for each in self.watch:
            each(exchange)

    def answer(self, data: bytes, end: int, exchange: Exchange | None = None) -> int:
        """What drives do with a whole request; the end of the last reply, or 0."""
        last = 0
        for one in self.models.get(data[0], []):
            if one.unit != data[0] or data[0] in self.deaf:
                continue
            for at, text in one.receive(rtu(data), end):
                self.library.c.crowd_transmit(at, text, len(text))
                last = max(last, at + self.char_us * len(text))
                if exchange is not None:
                    exchange.replies.append((at, at + self.char_us * len(text), text[:-2]))
        return last

    def transmit(self, data: bytes, begins: int) -> tuple[int, int]:
        """Somebody else's frame: its number, and its end."""
        text = rtu(data)
        return self.library.c.crowd_transmit(begins, text, len(text)), begins + self.char_us * len(text)

    def call(self, at: int, *, on: bool) -> None:
        """Whether a drive block is called."""
        self.library.blocks[at].called = on

    def hz(self, one: Drive) -> float:
        """The true speed of a shaft."""
        return one.shaft_hz(self.now)
