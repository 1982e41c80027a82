"""A conversation with a second model, written as words: what is written, read, pressed and waited for."""

from typing import Any

from tests.second.atv312 import Atv312, Atv312Options
from tests.second.chf import Chf, ChfOptions
from tests.second.drive import Drive
from tests.second.frames import ascii_, ascii_opened, opened, rtu
from tests.second.gd200a import Gd200a, Gd200aOptions
from tests.second.jscc import Jscc, JsccOptions
from tests.second.mx2 import Mx2, Mx2Options
from tests.second.pf4 import LaterOptions, Pf4, Pf4m, Pf4Options, Pf40p, Pf400, Pf525
from tests.second.sn300g5 import Sn300g5, Sn300g5Options

KINDS: dict[str, tuple[Any, Any]] = {
    "sn": (Sn300g5, Sn300g5Options), "jscc": (Jscc, JsccOptions), "chf": (Chf, ChfOptions),
    "atv": (Atv312, Atv312Options), "mx": (Mx2, Mx2Options),
    "pf": (Pf4, Pf4Options), "gd": (Gd200a, Gd200aOptions), "pf40p": (Pf40p, LaterOptions),
    "pf4m": (Pf4m, LaterOptions), "pf400": (Pf400, LaterOptions), "pf525": (Pf525, LaterOptions),
}  # fmt: skip
WORDS = {
    "sn": {"go": "w1=9C4 w0=1", "back": "w1=9C4 w0=2", "halt": "w0=0", "where": "r10+1 r21+1"},
    "jscc": {"go": "w1001=FA w1000=1", "back": "w1001=FA w1000=2", "halt": "w1000=3", "where": "r2001+1 r2000+1"},
    "chf": {"go": "w2000=1388 w1000=1", "back": "w2000=1388 w1000=2", "halt": "w1000=5", "where": "r1001+1 r3000+1"},
    "gd": {"go": "w2001=9C4 w2000=1", "back": "w2001=9C4 w2000=2", "halt": "w2000=5", "where": "r2100+1 r3000+1"},
    "atv": {
        "go": "w2136=FA w2135=0 w2135=6 w2135=7 w2135=F",
        "back": "w2136=FA w2135=0 w2135=6 w2135=7 w2135=80F",
        "halt": "w2135=7",
        "where": "rC86+1 rC82+1",
    },
    "mx": {"go": "w0=0,9C4 c2=0 c1=1", "back": "w0=0,9C4 c2=1 c1=1", "halt": "c1=0", "where": "sF r1000+2"},
    "pf": {"go": "w2001=FA w2000=12", "back": "w2001=FA w2000=22", "halt": "w2000=1", "where": "r2100+1 r2103+1"},
}
WORDS["pf4m"] = WORDS["pf"]
for _name in ("pf40p", "pf400", "pf525"):
    WORDS[_name] = WORDS["pf"] | {"go": "w2001=9C4 w2000=12", "back": "w2001=9C4 w2000=22"}
"""25 Hz forward and in reverse, a stop, and what proves standstill, of each family."""
POLLED = {"mx": b"\x10\0\0\3", "atv": b"\x0c\x81\0\1", "sn": b"\0\x10\0\1", "jscc": b"\x20\1\0\1", "chf": b"\x10\1\0\1"}
"""Of the others it is 2100H."""
KEYS = ("start", "stop", "reset", "local")
SWITCHES = {"off": ("power", False), "on": ("power", True), "close": ("terminal", True), "open": ("terminal", False),
            "inhibit": ("inhibit", True), "free": ("inhibit", False)}  # fmt: skip
SEEN = ("hz", "by", "state", "stores", "wait")
"""The true motor, who drives it, writes that were stored, and how long the last reply took in us."""


def drive(kind: str, unit: int = 1, **given: Any) -> Drive:
    """A drive of a family with options, and settings in `settings`."""
    settings = given.pop("settings", {})
    made, options = KINDS[kind]
    found: Drive = made(unit, options(**given), **settings)
    return found


class Talk:
    """What is said to a drive, one word after the other; what comes of it is in `seen`."""

    def __init__(self, kind: str, one: Drive, at_us: int = 1_000_000) -> None:
        """Begin at a time."""
        self.kind, self.drive, self.now, self.seen = kind, one, at_us, list[str]()
        self.waited = 0

    def send(self, body: bytes, end: bytes = b"") -> bytes | None:
        """A request without checksum, after enough silence; the reply without checksum, None for silence."""
        coded = ascii_ if self.drive.o.ascii else rtu
        frame = coded(body) + end
        self.now += 20_000 + len(frame) * self.drive.o.char_us
        replies = self.drive.receive(frame, self.now)
        if not replies:
            return None
        self.waited = replies[0][0] - self.now
        self.now = replies[0][0] + len(replies[0][1]) * self.drive.o.char_us
        return ascii_opened(replies[0][1]) if self.drive.o.ascii else opened(replies[0][1])

    def say(self, text: str) -> str:
        """Words of `_word`; what was seen since the last time, with spaces between."""
        for word in text.split():
            for part in WORDS[self.kind].get(word, word).split():
                self._word(part)
        found, self.seen = " ".join(self.seen), []
        return found

    def _word(self, word: str) -> None:
        """`w1=2,3` writes, `r1+2` reads 2, `x...` sends, `2s` and `5ms` wait; keys, switches, what is to be seen.

        Of coils by the manual's numbers `c1=1` writes one, and `sF+3` reads 3.
        """
        head, _, rest = word.partition(":")
        if word in SEEN:
            self._see(word)
        elif word in KEYS:
            self.drive.press(word, self.now)  # type: ignore[arg-type]  # one of them
        elif word in SWITCHES:
            getattr(self.drive, SWITCHES[word][0])(SWITCHES[word][1], self.now)
        elif head in ("trip", "trip!", "set", "cure", "busy"):
            self._happens(head, rest)
        elif word.startswith("poll"):  # the status every 100 ms, for this many seconds
            for _ in range(10 * int(word[4:-1])):
                self.now += 100_000
                self.send(bytes([self.drive.unit, 3]) + POLLED.get(self.kind, b"\x21\0\0\1"))
        elif word[0] in "cs":
            self._coils(word)
        elif word.endswith("s"):
            self.now += int(word.rstrip("ms")) * (1000 if word.endswith("ms") else 1_000_000)
        else:
            self._request(word)

    def _happens(self, what: str, rest: str) -> None:
        one = self.drive
        if what == "cure":
            one.clear_cause(self.now)
        elif what == "busy":
            one.be_busy(self.now, 500_000)
        elif what == "set":
            name, _, value = rest.partition("=")
            one.set(name, int(value), self.now)
        else:
            one.trip(int(rest) if rest.isdigit() else rest, self.now, cause=what == "trip!")

    def _see(self, word: str) -> None:
        one = self.drive
        hz = one.shaft_hz(self.now)
        values = {"hz": f"{round(hz, 1) + 0:g}", "by": one.by, "state": one.state(self.now), "wait": str(self.waited)}
        self.seen.append(values.get(word, str(len(one.stores))) or "nobody")

    def _coils(self, word: str) -> None:
        number, _, rest = word[1:].partition("=" if word[0] == "c" else "+")
        place = (int(number, 16) - 1).to_bytes(2, "big")
        asked = b"\5" + place + (b"\xff\0" if rest == "1" else b"\0\0")
        if word[0] == "s":
            asked = b"\1" + place + int(rest or "1").to_bytes(2, "big")
        reply = self.send(bytes([self.drive.unit]) + asked)
        if reply is None or reply[1] & 0x80:
            self._answer(word[0], b"", reply)
        elif word[0] == "s":
            self.seen.append(f"{int.from_bytes(reply[3:], 'little'):x}")

    def _request(self, word: str) -> None:
        address, _, rest = word[1:].partition("=" if word[0] == "w" else "+")
        if word[0] == "x":
            reply = self.send(bytes.fromhex(word[1:]))
            self.seen.append("-" if reply is None else reply.hex())
            return
        unit = 0 if word[0] == "W" else self.drive.unit
        place = bytes([unit, 3]) + int(address.split("=")[0], 16).to_bytes(2, "big")
        if word[0] == "r":
            reply = self.send(place + int(rest or "1").to_bytes(2, "big"))
        else:
            words = [int(each, 16).to_bytes(2, "big") for each in word.split("=")[1].split(",")]
            data = b"".join(words)
            many = bytes([0, len(words), len(data)])
            single = len(words) == 1 and self.kind != "sn"
            head = bytes([unit, 6 if single else 16]) + place[2:]
            reply = self.send(head + (data if single else many + data))
        if unit:
            self._answer(word[0], place, reply)

    def _answer(self, asked: str, place: bytes, reply: bytes | None) -> None:
        if reply is None:
            self.seen.append("-")
        elif reply[1] & 0x80 or reply[2:4] == b"\x50\x01":
            self.seen.append(f"!{reply[-1]:X}")
        elif asked == "r":
            self.seen += [
                reply[at : at + 2].hex().lstrip("0") or "0" for at in range(4 - len(reply) % 2, len(reply), 2)
            ]
        elif reply[2:4] != place[2:4]:
            self.seen.append("?")
