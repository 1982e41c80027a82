"""Finds the rate, format and framing of a line that others speak on, by what decodes."""

from collections.abc import Callable
from dataclasses import dataclass

from driveblocks.desk.clock import Clock
from driveblocks.desk.port import Tap
from driveblocks.maps.model import Drive
from driveblocks.site import hunt
from driveblocks.site.found import Way
from driveblocks.site.line import RATES
from driveblocks.site.overheard import Ear

LOOK_US = 1000
"""Between two looks at the port."""
BOUND_US = 300_000_000
"""The search for rate and format ends after this time."""
SLICE_US, PATIENT_US = 3_000_000, 12_000_000
"""How long a rate is listened at after its first byte: where nothing decodes, and where something does."""
ENOUGH_BYTES, PAUSE_US = 48, 20_000
"""So many without a good frame, and silence after them, are enough to try another rate."""
BETTER = 0.1
"""By so much a later format has to decode more, since several may decode the same."""
FEW, SURE, SHARE = 2, 4, 0.75
"""Good frames at the least, and so many that nothing more is waited for; their share of the bytes."""
LIKELY = (9600, 19200)
FORMS = ("8N1", "8E1", "8O1")
"""8N2 sounds as 8N1 does, and seven bits show there with their parity as the eighth."""


Chunk = tuple[int, bytes]
"""When bytes came, and which."""


def ways(drives: list[Drive], rate_: int | None, form_: str | None) -> list[Way]:
    """Rates and formats that are tried, unless they are given: those of the maps and the usual ones first."""
    found = [(each.rate, each.form) for drive in drives for each in hunt.ways(drive)]
    found += [(rate, form) for form in FORMS[:2] for rate in LIKELY]
    found += [(rate, form) for form in FORMS for rate in RATES]
    return list(dict.fromkeys(Way(rate_ or rate, form_ or form) for rate, form in found))


@dataclass
class Try:
    """A way, and how much of what comes decodes in it."""

    way: Way
    ear: Ear
    frames: int = 0
    good: int = 0
    """Bytes in good frames."""

    def take(self, at_us: int, data: bytes) -> None:
        """Bytes, or only time."""
        for one in self.ear.take(at_us, seven(data) if self.way.form[0] == "7" else data):
            if one.body is not None:
                self.frames, self.good = self.frames + 1, self.good + len(one.data)


@dataclass
class Search:
    """Looks for the rate and format of a line by what decodes."""

    tap: Tap
    clock: Clock
    over: Callable[[], bool]
    """Whether a person has ended it."""
    say: Callable[[str], None]
    bytes: int = 0
    """Heard so far, at any rate."""

    def find(self, every: list[Way], mode: str | None) -> tuple[Way | None, list[Chunk]]:
        """The way, and what was heard in it; None where it could not be found out. Raises OSError."""
        until = self.clock.now_us() + BOUND_US
        best: tuple[float, Way] | None = None
        while best is None and self.clock.now_us() < until and not self.over():
            for way in every:
                if self.clock.now_us() >= until or self.over():
                    break
                if not self.tap.tune(way.rate, way.form):
                    continue
                self.say(f"listening at {way.rate} bit/s {way.form}, {self.bytes} bytes so far")
                chunks, tried, share = self._slice(way, mode, until)
                if tried.frames < FEW or (best is not None and share <= best[0] + BETTER):
                    continue
                if share >= SHARE and self.tap.tune(tried.way.rate, tried.way.form):
                    seven_bits = tried.way.form[0] == "7"
                    return tried.way, [(at, seven(data) if seven_bits else data) for at, data in chunks]
                best = share, tried.way
        if best is None or self.over() or not self.tap.tune(best[1].rate, best[1].form):
            return None, []
        return best[1], []

    def _slice(self, way: Way, mode: str | None, until: int) -> tuple[list[Chunk], Try, float]:
        """What comes in some time, the better framing, and its share of the bytes."""
        tries = [Try(each, Ear(each.mode, each.character_us)) for each in framings(way, mode)]
        chunks: list[Chunk] = []
        many = first = last = 0
        while (now := self.clock.now_us()) < until and not self.over():
            if data := self.tap.receive():
                chunks, first, last, many = [*chunks, (now, data)], first or now, now, many + len(data)
                self.bytes += len(data)
            for each in tries:
                each.take(now, data)
            best = max(tries, key=lambda each: each.good)
            if first and now > last and _enough(best, many, now - first, now - last):
                break
            self.clock.sleep_until(now + LOOK_US)
        best = max(tries, key=lambda each: each.good)
        return chunks, best, best.good / max(1, many)


def framings(way: Way, mode: str | None) -> list[Way]:
    """RTU and ASCII, unless one is chosen; seven bits carry ASCII alone, and may be heard as eight."""
    found = [Way(way.rate, way.form, "rtu")] if mode != "ascii" and way.form[0] == "8" else []
    if mode == "rtu" and found:
        return found
    found.append(Way(way.rate, way.form, "ascii"))
    return [*found, Way(way.rate, "7E1", "ascii")] if way.form == "8N1" else found


def seven(data: bytes) -> bytes:
    """Characters without what is in their eighth bit."""
    return bytes(byte & 0x7F for byte in data)


def _enough(best: Try, many: int, heard_us: int, silent_us: int) -> bool:
    """Whether a way has been listened at for long enough."""
    if best.frames:
        return (best.frames >= SURE and best.good >= SHARE * many) or heard_us > PATIENT_US
    return (many > ENOUGH_BYTES and silent_us > PAUSE_US) or heard_us > SLICE_US
