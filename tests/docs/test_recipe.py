"""What a PLC sends that is its own master, played at second models: the motor runs and stops, nothing breaks."""

from functools import cache

import pytest
from click.testing import CliRunner
from tests.second.drive import Drive
from tests.second.kinds import KINDS, drive

from driveblocks.cli import app
from driveblocks.docs.recipe import HERTZ, Part, Request, recipe
from driveblocks.meaning.pattern import Pattern
from driveblocks.modbus.checksum import crc_bytes

US, S = 1000, 1_000_000
EVERY_US = 100 * US
NAMES = {
    "sn": "SN300G5", "jscc": "JSCC", "chf": "CHF", "atv": "ATV312", "mx": "MX2", "pf": "PF4", "gd": "GD200A",
    "pf40p": "PF40P", "pf4m": "PF4M", "pf400": "PF400", "pf525": "PF525",
    "v20": "V20", "acs355": "ACS355",
}  # fmt: skip
NO_RESET = {"sn", "jscc"}
"""Whose manuals know of no reset by the bus."""
every = pytest.mark.parametrize("kind", KINDS)


@cache
def parts(name: str) -> dict[str, Part]:
    """The recipe of a family by the titles of its parts."""
    from tests.shipped import drives

    return {each.title: each for each in recipe(drives()[name])}


class Master:
    """A PLC that sends one request at a time, and a drive."""

    def __init__(self, kind: str) -> None:
        """Power up a drive that has been set for the bus."""
        more = {"reference_milli_hz": 1000} if kind == "jscc" else {}
        self.drive: Drive = drive(kind, 1, comm_us=2 * S, **more)
        self.now = S
        self.words: dict[int, int] = {}
        self.parts = parts(NAMES[kind])

    def sends(self, one: Request) -> None:
        """Send it, believe its reply, and wait as the page says."""
        self.now += EVERY_US
        found = self.drive.receive(one.frame + crc_bytes(one.frame), self.now)
        assert found, one
        ((at, reply),) = found
        assert reply[1] == one.frame[1], (one, reply.hex())
        self.now = at + len(reply) * self.drive.o.char_us
        if one.function in (3, 4):
            data = reply[3:-2]
            for place in range(len(data) // 2):
                self.words[one.register + place] = int.from_bytes(data[2 * place : 2 * place + 2], "big")
        elif one.function in (1, 2):
            bits = int.from_bytes(reply[3:-2], "little")
            self.words |= {one.register + at: bits >> at & 1 for at in range(8 * reply[2])}
        self.now += US * one.stays_ms
        for _ in range(20):
            if self.holds(one.until):
                return
            self.reads(self.parts["Read"])
        raise AssertionError(one)

    def holds(self, patterns: tuple[Pattern, ...]) -> bool:
        """Whether what was read has these values."""
        return all(each.holds(self.words.get(each.register, ~each.value)) for each in patterns)

    def reads(self, part: Part) -> None:
        """One round."""
        for one in part.requests:
            self.sends(one)

    def plays(self, title: str, most: int = 100) -> None:
        """A part, again until it ends."""
        part = self.parts[title]
        for _ in range(most):
            self.reads(part)
            if self.holds(part.until):
                return
            self.now += US * part.every_ms
        raise AssertionError(title)

    def keeps(self, seconds: int) -> None:
        """What keeps it running, and reads in between."""
        end = self.now + seconds * S
        while self.now < end:
            self.reads(self.parts["Keep it running"])
            self.reads(self.parts["Read"])

    @property
    def hertz(self) -> float:
        """The speed of the shaft."""
        return abs(self.drive.shaft_hz(self.now))


@every
def test_the_page_runs_a_motor_and_stops_it(kind: str) -> None:
    master = Master(kind)
    for title in master.parts:
        if title == "Read":
            break
        master.plays(title)
    assert master.hertz == 0
    master.plays("Start")
    master.keeps(8)
    assert master.drive.fault is None
    if kind != "jscc":  # whose manual prints no scale
        assert master.hertz == pytest.approx(HERTZ, abs=0.3)
    assert master.hertz > 0
    master.plays("Stop again")
    assert (master.hertz, master.drive.output, master.drive.stores) == (0, False, [])


def test_a_page_without_a_reset_is_of_a_manual_without_one() -> None:
    assert {kind for kind in KINDS if "Reset a fault" not in parts(NAMES[kind])} == NO_RESET


@pytest.mark.parametrize("kind", [kind for kind in KINDS if kind not in NO_RESET])
def test_a_fault_is_reset_and_nothing_moves(kind: str) -> None:
    master = Master(kind)
    master.plays("Stop")
    master.drive.trip(master.drive.LINE_LOST, master.now)
    master.now += S
    master.plays("Reset a fault")
    assert master.drive.fault is None
    master.plays("Stop")
    assert (master.hertz, master.drive.output) == (0, False)


def test_the_command_prints_it_and_refuses_what_is_no_address() -> None:
    run = CliRunner().invoke(app, ["sheet", "pf525", "--master", "--address", "3"])
    assert run.exit_code == 0
    assert "| stops the motor | 06 | 2000H | 8193 | 48193 | 0001H = 1 | `03 06 20 00 00 01 42 28` |" in run.output
    wrong = CliRunner().invoke(app, ["sheet", "pf525", "--master", "--address", "248"])
    assert (wrong.exit_code, "1 to 247" in wrong.output) == (2, True)
