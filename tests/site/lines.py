"""A thousand lines for commissioning, each with a second model of a drive that differs in one way or in none.

`python -m tests.site.lines [--runs N] [--first SEED]` (`make lines`) prints how each way was named, and every wrong
finding with its seed; exit status 1 for a wrong one, for a write, or if fewer than 95 % of those with one of the ways
are named. The judge knows what is true of the line, and nothing of how it is looked for.
"""

import argparse
import sys
from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from functools import cache
from random import Random
from typing import Any

from tests.plc.desk import maps
from tests.second.chf import Chf
from tests.second.drive import Drive
from tests.second.frames import ascii_opened, opened, rtu
from tests.second.jscc import Jscc
from tests.second.pf4 import Pf4
from tests.second.sn300g5 import Sn300g5

from driveblocks.maps.model import Drive as Map
from driveblocks.maps.polls import polls
from driveblocks.site.found import Found, Heard, Way
from driveblocks.site.hunt import ways
from driveblocks.site.session import Wish, commission

MAPS: dict[str, Map] = {each.drive.prefix: each.drive for each in maps()}
MODELS = {"CHF": Chf, "JSCC": Jscc, "PF4": Pf4, "SN300G5": Sn300g5}
NONE = "none"
WAYS = (
    "rate", "parity", "unit", "echo", "setting", "scale", "slow", "refused span", "wrong family", "two units", "noise",
    "foreign master",
)  # fmt: skip
REST_US = 2500
HERTZ = 20.0
"""What the keypad shows when a person has started the motor there."""


def model(family: str, unit: int, way: Way, **options: Any) -> Drive:
    """A second model that speaks in a way."""
    given = {"ascii": way.mode == "ascii", "char_us": int(way.character_us), "silence_us": 0, **options}
    kind: Any = MODELS[family]
    made: Drive = kind(unit, replace(kind().o, **given))
    return made


@dataclass
class SecondLine:
    """Models on a wire, as `found.Line` has it; `sent` are all frames of the adapter."""

    drives: list[Drive]
    truth: Way
    echo: bool = False
    noise_us: int = 0
    """Between two bytes of noise."""
    master_us: int = 0
    """Between two frames of another master."""
    tuned: Way | None = None
    now: int = 0
    sent: list[bytes] = field(default_factory=list)
    coming: list[tuple[int, bytes]] = field(default_factory=list)
    """Bytes under way, with the time at which the first of them comes."""

    def now_us(self) -> int:
        """The time."""
        return self.now

    def tune(self, way: Way) -> bool:
        """The port can everything."""
        self.tuned = way
        return True

    def exchange(self, request: bytes, timeout_us: int, expect: int = 0) -> Heard:
        """A request, and what comes."""
        way = self.tuned
        assert way is not None
        began, end = self.now, self.now + int(len(request) * way.character_us)
        data = request if self.echo else b""
        if request:
            self.sent.append(request)
            self.coming += self._replies(request, end)
        first, self.now = 0, end
        while True:
            due = min((at for at, _ in self._all(began)), default=None)
            until = end + timeout_us if not first else self.now + 20_000
            if due is None or due > until or (expect and len(data) >= expect):
                self.now = self.now if first and expect and len(data) >= expect else max(self.now, until)
                return Heard(data, max(0, first - end) if first else 0)
            at, some = min(self._all(began))
            self._take((at, some))
            first = first or at
            data, self.now = data + some, max(self.now, at) + int(len(some) * way.character_us)
            if self.now > end + timeout_us + 1_000_000:
                return Heard(data, max(0, first - end))

    def _replies(self, request: bytes, end: int) -> Iterable[tuple[int, bytes]]:
        """What drives answer; at another rate or format they hear nothing that they know."""
        assert self.tuned is not None
        if (self.tuned.rate, self.tuned.form) != (self.truth.rate, self.truth.form):
            return
        spoken = [each.receive(request, end) for each in self.drives]
        found = [reply for replies in spoken for reply in replies]
        if len(found) == 2 and abs(found[0][0] - found[1][0]) < len(found[0][1]) * self.truth.character_us:
            (at, one), (_, other) = found
            if one != other:  # both drive the wires
                whole = bytes(a & b for a, b in zip(one.ljust(40, b"\xff"), other.ljust(40, b"\xff"), strict=False))
                yield at, whole[: max(len(one), len(other))]
                return
            found = found[:1]
        yield from found

    def _all(self, since: int) -> list[tuple[int, bytes]]:
        """What comes from a time on, with the next of what comes by itself."""
        found = [*self.coming]
        for every, make in ((self.noise_us, self._noise), (self.master_us, self._frame)):
            if every:
                at = -(-max(since, self.now) // every) * every
                found.append((at, make(at)))
        return found

    def _take(self, one: tuple[int, bytes]) -> None:
        if one in self.coming:
            self.coming.remove(one)

    @staticmethod
    def _noise(at: int) -> bytes:
        return bytes([Random(at).randrange(1, 256)])

    def _frame(self, at: int) -> bytes:
        assert self.tuned is not None
        if (self.tuned.rate, self.tuned.form) != (self.truth.rate, self.truth.form):
            return Random(at).randbytes(5)
        return rtu(b"\x21\x03\x10\x01\x00\x01")


@dataclass
class Person:
    """Answers as what is true on the line makes a person answer."""

    wrong: list[str]
    """Ids that differ at the keypad."""
    drive: Drive
    line: SecondLine
    runs: bool

    def ask(self, key: str, text: str) -> str:
        """An answer."""
        if key == "alone":
            return "alone"
        if key == "keypad":
            return ", ".join(self.wrong) or "yes"
        if self.runs and "keypad show" in text:
            return self._started()
        return ""

    def _started(self) -> str:
        self.drive.press("local", self.line.now)
        self.drive.press("start", self.line.now)
        self.line.now += 10_000_000
        return f"{abs(self.drive.shown_hz(self.line.now)):.1f}"

    def say(self, _: object) -> None:
        """Nothing."""

    def progress(self, *_: object) -> None:
        """Nothing."""


@dataclass(frozen=True)
class Verdict:
    """`named`, `open` (could not be found out) or `wrong`, and why."""

    way: str
    kind: str
    why: str


@cache
def spoken(family: str) -> list[Way]:
    """The ways of a family's manual."""
    return ways(MAPS[family])


def line(seed: int, way: str | None = None) -> Verdict:
    """One line, by its seed; a write is a wrong finding."""
    chance = Random(seed)
    kind = way or chance.choice((*WAYS, NONE))
    family = chance.choice(list(MODELS))
    factory = spoken(family)[0]
    truth = chance.choice([each for each in spoken(family) if (each.mode == factory.mode) or kind != "rate"][:6])
    unit = chance.randint(1, 31) if kind == "unit" else 1
    if kind not in ("rate", "parity"):
        truth = factory
    real = chance.choice([each for each in MODELS if each != family]) if kind == "wrong family" else family
    late = chance.choice((300_000, 700_000)) if kind == "slow" else 0
    options: dict[str, Any] = {"reply_us": (5_000 + late, 9_000 + late)}
    if kind == "refused span":
        last = polls(MAPS[family])[-1]
        options["forbidden"] = frozenset({last.address})
    if kind == "scale" and family == "CHF":
        options["monitor_milli_hz"] = chance.choice((10, 100))
    one = model(real, unit, truth, own_hz=HERTZ, **options)
    drives = [one]
    if kind == "two units":
        drives.append(model(real, unit, truth, reply_us=(5_000, 30_000), seed=seed))
    wire = SecondLine(drives, truth, echo=kind == "echo")
    wire.noise_us = chance.choice((700_000, 5_000_000, 20_000_000)) if kind == "noise" else 0
    wire.master_us = chance.choice((100_000, 2_000_000, 25_000_000)) if kind == "foreign master" else 0
    wrong = _unset(one, family, kind)
    person = Person(wrong, one, wire, kind == "scale")
    others = {name: each for name, each in MAPS.items() if name != family}
    found = commission(wire, person, Wish(MAPS[family], others), lambda _: None)
    if written := [
        each for each in wire.sent if (opened(each) or ascii_opened(each) or b"\0\0")[1] not in (1, 2, 3, 4)
    ]:
        return Verdict(kind, "wrong", f"seed {seed}: it writes {written[0].hex()}")
    state, why = _judged(kind, found, unit, wire, one)
    return Verdict(kind, state, f"seed {seed}, {family}: {why}")


def _unset(one: Drive, family: str, kind: str) -> list[str]:
    """A setting that the bus needs is another one; its id in the map."""
    needed = [each for each in MAPS[family].settings if each.needed and each.needed.value is not None]
    if kind != "setting" or not needed:
        return []
    one.set(one.IDS[1], 1, 0)
    return [needed[0].id]


def _judged(kind: str, found: Found, unit: int, wire: SecondLine, one: Drive) -> tuple[str, str]:
    kinds = [each.kind for each in found.faults]
    said = f"{kinds} {found.ended or 'no end'} {found.way} unit {found.unit} {found.family}"
    spoilt = {"wrong family": ("family",), "two units": ("two", "damaged"), "noise": ("noise", "foreign", "damaged")}
    spoilt |= {"foreign master": ("foreign",), "slow": ("slow",), "refused span": ("refused",)}
    if kind in spoilt:
        if any(each in spoilt[kind] for each in kinds):
            return "named", said
        return _open(kind, found, kinds, wire), said
    if found.ended or (found.way, found.unit) != (wire.truth, unit):
        same = found.way is None and kinds and kinds[-1] in ("silent", "bound")
        return ("open" if same else "wrong"), said
    if kind == "setting":
        return ("named" if any(each.told == "no" or each.differs for each in found.settings) else "open"), said
    if kind == "scale":
        return _scale(found, one), f"{said} {found.answers}"
    return ("wrong" if kinds else "named"), said


def _open(kind: str, found: Found, kinds: list[Any], wire: SecondLine) -> str:
    """Whether a line that was not named was claimed to be something else."""
    if kind == "wrong family":
        return "wrong" if found.family == "fits" else "open"
    if kind == "slow":
        return "open" if found.measured and found.measured.longest_ms > 250 else "wrong" if not found.ended else "open"
    if kind in ("noise", "foreign master"):
        every = wire.noise_us or wire.master_us
        return "open" if not kinds or (every > 3_000_000 and "speaks rarely" in found.ended) else "wrong"
    if kind == "two units":
        return "open" if not kinds else "wrong"
    return "open" if found.ended or not kinds else "wrong"


def _scale(found: Found, one: Drive) -> str:
    """A scale is named where the number of the keypad shows it, and is that of the model."""
    given = [each for each in found.answers if each.gives and each.value]
    true = {getattr(one.o, "monitor_milli_hz", 10) / 1000}
    if any(float(each.value) not in true for each in given if each.gives == "FrequencyScale"):
        return "wrong"
    return "named" if given or not isinstance(one, Chf) else "open"


def main() -> int:
    """Run them."""
    parser = argparse.ArgumentParser(description="A thousand lines for commissioning.")
    parser.add_argument("--runs", type=int, default=1000)
    parser.add_argument("--first", type=int, default=0)
    options = parser.parse_args()
    found = [line(seed) for seed in range(options.first, options.first + options.runs)]
    for each in found:
        if each.kind != "named":
            print(f"{each.kind}: {each.way}: {each.why}", flush=True)
    table = Counter((each.way, each.kind) for each in found)
    for way in (*WAYS, NONE):
        print(f"{way:16}" + "".join(f"{kind:>8} {table[way, kind]:4}" for kind in ("named", "open", "wrong")))
    ways_ = [each for each in found if each.way != NONE]
    share = sum(each.kind == "named" for each in ways_) / len(ways_)
    print(f"{len(found)} lines, {share:.1%} of those with one of the ways named")
    return 1 if share < 0.95 or any(each.kind == "wrong" for each in found) else 0


if __name__ == "__main__":
    sys.exit(main())
