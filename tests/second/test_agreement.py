"""The second models and the drives made from the maps, asked the same: where both must agree, and where they differ.

This file alone knows both. A new difference is a wrong belief of one of them: the manual says of which.
"""

from decimal import Decimal
from typing import Any

import pytest
from tests.second.drive import Drive
from tests.second.frames import rtu
from tests.second.kinds import drive
from tests.shipped import drives

from driveblocks.bench.simulator.drive import SimulatedDrive
from driveblocks.bench.simulator.habits import Habits

MAPS = drives()
PREFIX = {
    "atv": "ATV312", "sn": "SN300G5", "jscc": "JSCC", "chf": "CHF", "gd": "GD200A", "mx": "MX2", "pf": "PF4",
}  # fmt: skip
SETTINGS: dict[str, dict[str, Any]] = {
    "sn": {"settings": {"H5_05": 0}, "key_cuts_line": False}, "jscc": {"reference_milli_hz": 10}, "chf": {},
    "gd": {}, "pf": {"comm_us": None}, "atv": {"comm_us": None, "code_after_reset": "zero"}, "mx": {"reset_deaf_us": 0},
}  # fmt: skip
"""The maps' drives have no watchdog unless asked, forget a fault, and have 0.01 Hz where the manual gives no scale."""
CODES: dict[str, tuple[str | int, int]] = {
    "atv": (3, 3), "sn": ("OC", 7), "jscc": (3, 3), "chf": (5, 5), "gd": (4, 4), "mx": (3, 3), "pf": (12, 12),
}  # fmt: skip


class Pair:
    """A drive of each kind, and one clock."""

    def __init__(self, kind: str, **options: Any) -> None:
        """Powered and standing, with the same ramps."""
        self.kind, self.now = kind, 0
        self.second: Drive = drive(kind, **(SETTINGS[kind] | options))
        habits = Habits(
            bus_volts=540 if kind in ("chf", "gd") else 589, scales=dict.fromkeys((0x26, 0x3002), Decimal(1))
        )
        self.map = SimulatedDrive(MAPS[PREFIX[kind]], 1, habits)

    def do(self, step: str) -> tuple[object, object]:
        """A wait in ms, something that happens, or a request; what the drive of the map and the second one give."""
        if step.isdigit() and len(step) < 6:
            self.now += int(step)
            self.map.step(int(step))
        elif step in ("trip", "cure", "off", "on", "stop"):
            self._happens(step)
        else:
            body = bytes.fromhex(step)
            self.do("50")
            replies = self.second.receive(rtu(body), 1000 * self.now)
            reply = self.map.reply(body)
            return ("-" if reply is None else rtu(reply).hex()), (replies[0][1].hex() if replies else "-")
        return round(self.map.hertz, 2), round(self.second.shaft_hz(1000 * self.now), 2)

    def _happens(self, what: str) -> None:
        us, (fault, code) = 1000 * self.now, CODES[self.kind]
        if what == "trip":
            self.map.trip(code)
            self.second.trip(fault, us, cause=True)
        elif what == "cure":
            self.map.clear_cause()
            self.second.clear_cause(us)
        elif what == "stop":
            self.map.keypad_stop()
            self.second.press("stop", us)
        else:
            self.map.power(on=what == "on")
            self.second.power(what == "on", us)


def r(address: str, words: int = 1) -> str:
    """A read."""
    return f"0103{address}{words:04x}"


def w(kind: str, address: str, word: int) -> str:
    """A write of one word."""
    return f"0106{address}{word:04x}" if kind != "sn" else f"0110{address}000102{word:04x}"


RUN = {
    "sn": ("0001", 2500, "0000"),
    "jscc": ("1001", 2500, "1000"),
    "chf": ("2000", 5000, "1000"),
    "gd": ("2001", 2500, "2000"),
    "pf": ("2001", 250, "2000"),
}
WAYS = {"pf": (0x12, 0x22)}
"""Words that run forward and in reverse; 1 and 2 of the others."""
STOP = {"sn": 0, "jscc": 3, "chf": 5, "gd": 5, "pf": 1}
LOOK = {"sn": (r("0010"), r("0021"), r("0014", 5)), "jscc": (r("2000", 2), r("3000")),
        "chf": (r("1001"), r("3000"), r("5000")), "gd": (r("2100"), r("3000"), r("2102")),
        "pf": (r("2103"), r("2101"))}  # fmt: skip
OWN = {
    # a path of words; and coils beside a pair of registers
    "atv": {
        "go": [w("atv", "2136", 250), *(w("atv", "2135", each) for each in (0x0000, 0x0006, 0x0007, 0x000F))],
        "back": [w("atv", "2136", 250), *(w("atv", "2135", each) for each in (0x0000, 0x0006, 0x0007, 0x080F))],
        "halt": [w("atv", "2135", 7)], "slower": [w("atv", "2136", 50)], "look": [r("0C82"), r("1BD1"), r("2135")],
    },
    "mx": {
        "go": ["01100000000204000009c4", "010500010000", "01050000ff00"],
        "back": ["01100000000204000009c4", "01050001ff00", "01050000ff00"],
        "halt": ["010500000000"], "slower": ["01100000000204000001f4"],
        "look": ["0101000e0003", "010100170001", r("1000", 2), r("0011"), r("0000", 2)],
    },
}  # fmt: skip
"""Words of drives that are not run by a reference and one word."""
AGREED = [
    "", "go 1000 look 3000 look halt 1000 look 3000 look", "back 4000 look go 1000 look 1500 look 5000 look",
    "go 4000 slower 500 look 4000 look", "go 4000 trip look 1000 look halt 9000 cure look",
    "go 4000 stop 900 look 9000 look", "go 4000 off 1000 look on 100 look 9000 look", "go 4000 halt 500 go 500 look",
    "slower look go look halt look",
]  # fmt: skip
ALONE = {
    "sn": [r("0026", 2), r("0000"), r("0000", 2), r("0010", 3), "010800001234", "010600000001", "010300000000",
           "010300000011", r("4000"), w("sn", "0010", 1), w("sn", "4000", 1), w("sn", "fffd", 0),
           "0110000000020400010064", "020300100001", "0103001000", "010800010000", r("0013")],
    "jscc": [r("0005"), w("jscc", "0005", 7), r("4000"), w("jscc", "2000", 1), w("jscc", "4000", 1), "010400000001",
             "010300000000", "01030000000d", "0110100000020400010064", w("jscc", "1000", 0)],
    "chf": [r("0005"), w("chf", "0005", 7), r("0005"), w("chf", "8005", 9), r("0005"), r("8005"), r("4000"),
            w("chf", "3000", 1), w("chf", "4000", 1), "010400000001", "010300000000", "010300000011",
            w("chf", "2000", 10001), w("chf", "2000", 0xD8EF), w("chf", "2000", 0xD8F0), r("1000"), r("5001"),
            r("3000", 3)],
    "gd": [r("0005"), w("gd", "0005", 7), r("0005"), r("8005"), r("4000"), w("gd", "3000", 1), w("gd", "4000", 1),
           "010400000001", "010800001234", "01102000000204000103e8",
           r("2000", 2), r("2102"), r("3001")],
    "atv": [r("0C20"), w("atv", "0C20", 400), r("4000"), w("atv", "0C82", 1), w("atv", "4000", 1), "010400000001",
            "010300000000", "01032136001e", r("2138"), r("2135", 2), "0110213600020400640000"],
    "mx": [r("4000"), w("mx", "4000", 1), "010400000001", "010300000000", "010300000011", "01050000ff00",
           "010500000001", "010100000000", "010100000004", "010110000001", "010800001234", r("0900"), r("1204")],
    "pf": [r("2102"), r("4000"), w("pf", "2100", 1), w("pf", "4000", 1), "010400000001", "010300000000", r("2001"),
           w("pf", "0069", 1), r("0069"), r("2100", 2), r("0068")],
}  # fmt: skip


def steps(kind: str, text: str) -> list[str]:
    """The words of AGREED as steps."""
    short = OWN.get(kind) or _short(kind)
    return [step for word in text.split() for step in short.get(word, [word])]


def _short(kind: str) -> dict[str, list[str]]:
    speed, full, command = RUN[kind]
    ahead, back = WAYS.get(kind, (1, 2))
    return {
        "go": [w(kind, speed, full), w(kind, command, ahead)], "back": [w(kind, speed, full), w(kind, command, back)],
        "halt": [w(kind, command, STOP[kind])], "slower": [w(kind, speed, full // 5)], "look": list(LOOK[kind]),
    }  # fmt: skip


@pytest.mark.parametrize("kind", PREFIX)
@pytest.mark.parametrize("text", AGREED)
def test_both_agree(kind: str, text: str) -> None:
    pair = Pair(kind)
    for step in steps(kind, text):
        of_map, of_second = pair.do(step)
        assert of_map == of_second, step


SAME = [
    # what registers say again, and what the manual refuses: words before, request, reply of both, and why
    ("sn", "go 4000", r("002b"), "010302 0031", "002BH is 0010H once more: line 392"),
    ("sn", "go 4000", r("0020"), "010302 09c4", "0020H is the frequency reference: line 381"),
    ("sn", "trip", r("0080"), "010302 0007", "0080H is the present fault"),
    ("sn", "", w("sn", "0001", 5001), "0190 21", "control data have limits: line 862"),
    ("sn", "go 4000 trip", r("0081"), "010302 0007", "0081H is the past fault, 0083H its output frequency"),
    ("sn", "go 4000 trip", r("0083"), "010302 09c4", "lines 411 and 413"),
    ("jscc", "", w("jscc", "1000", 4), "0186 03", "1000H is 0 to 3: lines 105 to 108"),
    ("chf", "", w("chf", "1000", 0), "010650010005", "1000H is 1 to 8: lines 319 to 326"),
    ("chf", "", w("chf", "1000", 9), "010650010005", "1000H is 1 to 8"),
    ("chf", "go 4000", r("3001"), "010302 09c4", "3001H is the set frequency: line 334"),
]  # fmt: skip
DIFFER = [
    # what the map's drive cannot know, or knows otherwise: words before, request, reply of the second, and why
    ("sn", "", w("sn", "0180", 5), "0190 21", "b1-01 is 0 to 4: line 49"),
    ("sn", "", "0110000000000000", "0190 03", "a number of words outside 1 to 16: line 861"),
    ("sn", "", "011000000001040001", "0190 03", "as if the number were wrong"),
    ("sn", "", r("0035", 4), "010308 0000000000000000", "refused only if no address is registered: line 860"),
    ("sn", "", w("sn", "041c", 0x21), "0190 21", "H5-01 is 0 to 20, read as hexadecimal: line 51"),
    ("sn", "", w("sn", "0002", 1), "011000020001", "a row that says unused is not called read-only"),
    ("jscc", "go 4000", w("jscc", "0005", 1), "0186 07", "open: whether parameters are written while it runs"),
    ("jscc", "", w("jscc", "1001", 5001), "0186 03", "above the drive's own maximum"),
    ("gd", "", "010300000000", "0183 03", "a number of words that no frame may have: page 143"),
    ("gd", "", "010300000011", "0183 03", "the same, above 16: page 132"),
    ("atv", "", r("0C81"), "010302 0660", "bits that no condition of the map names: page 13"),
    ("mx", "", "010100000021", "0181 03", "01H reads 32 coils at most: I585 page 6-5"),
    ("mx", "", "0105000eff00", "0185 23", "a coil that is read-only; the map has no reason for that code: page 6-18"),
    ("mx", "", "011000000002040000138d", "0190 21", "above the maximum frequency: page 6-18"),
    ("chf", "go 4000", w("chf", "0005", 1), "010650010006", "some are not changed while it runs: line 312"),
    ("chf", "go 4000 010610000003 4000", r("3000"), "010302 09c4", "open: whether a jog ends a run"),
    ("chf", "go 4000 trip cure 010610000007", r("1001"), "010302 0003", "open: whether it is reset while it coasts"),
]  # fmt: skip


@pytest.mark.parametrize("kind", PREFIX)
def test_both_answer_alike(kind: str) -> None:
    for step in ALONE[kind]:
        of_map, of_second = Pair(kind).do(step)
        assert of_map == of_second, step


@pytest.mark.parametrize(("kind", "before", "request_", "reply", "why"), SAME)
def test_both_say_again_and_refuse_alike(kind: str, before: str, request_: str, reply: str, why: str) -> None:
    pair = Pair(kind)
    for step in steps(kind, before):
        pair.do(step)
    of_map, of_second = pair.do(request_)
    assert of_map == of_second == rtu(bytes.fromhex(reply)).hex(), why


@pytest.mark.parametrize(("kind", "before", "request_", "reply", "why"), DIFFER)
def test_where_they_differ(kind: str, before: str, request_: str, reply: str, why: str) -> None:
    pair = Pair(kind)
    for step in steps(kind, before):
        pair.do(step)
    of_map, of_second = pair.do(request_)
    assert of_second == rtu(bytes.fromhex(reply)).hex(), why
    assert of_map != of_second, "they agree: this row belongs to ALONE"
