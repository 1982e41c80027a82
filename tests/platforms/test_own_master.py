"""A drive at a master of the PLC's own, on two platforms: a stop comes first, and a motor runs by an edge alone."""

from functools import cache
from itertools import pairwise

import pytest
from tests.platforms.ports import replaced
from tests.platforms.siemens.test_siemens import INSTRUCTIONS
from tests.platforms.stock import made

from driveblocks.render.channels import channels
from driveblocks.render.motor import master
from structured_text.engines.embedded.engine import EmbeddedEngine
from structured_text.engines.engine import Library, Source, Value


@cache
def built(platform: str) -> Library:
    """The programs of three families for their own master, with a stand-in for that."""
    three = {folder: one for folder, one in made().drives.items() if one.prefix in ("CHF", "JSCC", "SN300G5")}
    parts = [part for part in made().parts if part.folder in three or part.folder not in made().drives]
    stand_ins = replaced(["ModbusChannel"]) if platform == "codesys" else [Source.read(INSTRUCTIONS)]
    own = made().masters(platform, channels if platform == "codesys" else master)
    prefixes = {one.prefix for one in three.values()}
    masters = [Source(name, one.text.replace("slave := Drive1, ", "")) for name, one in own.items() if name in prefixes]
    types, others = ([part for part in parts if (part.folder == "types") == is_type] for is_type in (True, False))
    shared = [[Source(part.unit.path, part.text) for part in some] for some in (types, others)]
    return EmbeddedEngine().build([*shared[0], *stand_ins, *shared[1], *masters])


class Codesys:
    """A program for CODESYS, whose channel ends at once."""

    usual, start = "JSCC", "StartSwitch"

    def __init__(self, prefix: str = usual, **words: int) -> None:
        """With a drive that stands."""
        self.program, self.answers, self.ms = built("codesys").instance(f"{prefix}_Master"), True, 0
        self.turns: list[Value] = []
        for name, value in (
            {"DriveStatusWord": 4, "CountsPerHertz": 10} | words if prefix == "JSCC" else words
        ).items():
            self.program[name] = value
        self.program["Hertz"] = 25

    def scan(self, scans: int) -> list[Value]:
        """The command words that are written in some scans; pauses are passed over."""
        wrote = []
        for _ in range(scans):
            if self.program.state().get("WAITS"):
                self._scan(20)
            self.program["Channel.xDone" if self.answers else "Channel.xError"] = True
            turn, word = self.program["Turn"], self.program["CommandWord"]
            self._scan(20)
            self.turns.append(turn)
            wrote += [word] if turn == 0 else []
        return wrote

    def _scan(self, ms: int) -> None:
        self.program.scan(self.ms * 1_000_000)
        self.ms += ms

    def pauses(self) -> list[int]:
        """Times from a request to the next, ms."""
        begun = list[int]()
        for _ in range(80):
            self.program["Channel.xDone"] = True
            turn, now = self.program["Turn"], self.ms
            self._scan(5)
            begun += [now] if self.program["Turn"] != turn else []
        return [after - before for before, after in pairwise(begun)]


class Siemens:
    """A program for an S7, with a stand-in for Modbus_Master; the drive stands."""

    usual, start = "CHF", "RunForward"

    def __init__(self, prefix: str = usual) -> None:
        """With a reference of half its speed."""
        self.program, self.answers, self.ms = built("siemens").instance(f"{prefix}_Master"), True, 0
        self.wrote, self.ended = list[tuple[Value, Value]](), list[int]()
        given = {"UnitAddress": 1, "Enable": True, "SpeedReferenceHz": 25.0, "MaximumHz": 50.0, "FullScaleHz": 50.0}
        for name, value in {**given, "ReferenceScale": 100.0, "Master.Registers[1]": 3}.items():
            if "." in name or name.upper() in self.program.state():
                self.program[name] = value

    def scan(self, scans: int) -> list[Value]:
        """The command words that are written in some scans."""
        before = len(self.wrote)
        self.program["Master.Silent"] = not self.answers
        for _ in range(scans):
            open_ = self.program["Open"]
            self.program.scan(self.ms * 1_000_000)
            self.ended += [self.ms] if self.program["Open"] != open_ else []
            self.ms += 5
            if self.program["Master.DONE"] and self.program["Mode"]:
                self.wrote.append((self.program["Master.Written"], self.program["Master.Word"]))
        return [word for where, word in self.wrote[before:] if where == self.program["Command.Address"]]

    def pauses(self) -> list[int]:
        """Times from the end of a request to the next, ms."""
        self.scan(100)
        return [begin - end for end, begin in zip(self.ended[1::2], self.ended[2::2], strict=False)]


def switched(one: Codesys | Siemens, on: bool, scans: int = 60) -> list[Value]:
    """What is written after the start switch."""
    one.program[one.start] = on
    return one.scan(scans)


platforms = pytest.mark.parametrize("platform", [Codesys, Siemens])


@platforms
def test_it_stops_first_and_runs_by_an_edge_alone(platform: type[Codesys | Siemens]) -> None:
    one = platform()
    stop, *rest = switched(one, True)
    assert {*rest} <= {stop}, "a switch that was closed starts nothing"
    assert one.program["StopConfirmed"] is True
    switched(one, False, 5)
    assert switched(one, True)[-1] != stop
    assert one.program["StopConfirmed"] is False
    assert switched(one, False, 20)[-1] == stop


@platforms
def test_it_believes_a_standstill_only_after_the_stop(platform: type[Codesys | Siemens]) -> None:
    one = platform()
    seen = []
    for on, scans in ((False, 60), (True, 60), (False, 1), (False, 40)):
        switched(one, on, scans)
        seen.append(one.program["StopConfirmed"])
    assert seen == [True, False, False, True]


@platforms
def test_it_stops_after_a_loss_and_asks_for_a_new_edge(platform: type[Codesys | Siemens]) -> None:
    one = platform()
    stop = switched(one, False)[0]
    run = switched(one, True)[-1]
    one.answers = False
    assert {*one.scan(20)[4:]} <= {stop}, "nothing but the stop"
    one.answers = True
    assert {*one.scan(40)} == {stop}
    switched(one, False, 5)
    assert switched(one, True)[-1] == run != stop


@platforms
@pytest.mark.parametrize(("prefix", "least"), [("CHF", 0), ("JSCC", 11)])
def test_it_keeps_the_silence_that_the_drive_asks_for(
    platform: type[Codesys | Siemens], prefix: str, least: int
) -> None:
    """JSCC wants more than 10 ms between frames; 3.5 characters are the master's own."""
    pauses = platform(prefix).pauses()
    assert len(pauses) > 10
    assert min(pauses) >= least
    assert max(pauses) <= least + 10


def test_for_codesys_it_reads_before_it_writes_and_runs_no_drive_whose_reference_means_something_else() -> None:
    one = Codesys()
    switched(one, False, 5)
    assert one.turns == [2, 0, 1, 2, 3]
    other = Codesys("SN300G5", DriveStatusWord=2, CommandSelectionWord=1)
    switched(other, False, 8)
    assert {*switched(other, True, 12)} == {0}
    other.program["CommandSelectionWord"] = 0
    assert 1 in other.scan(12)


@pytest.mark.parametrize("prefix", ["CHF", "JSCC", "SN300G5"])
def test_for_an_s7_it_gives_the_speed_after_the_stop_and_no_retry_holds_a_stop_back(prefix: str) -> None:
    one = Siemens(prefix)
    (stop,) = switched(one, False)
    reference = one.program["Reference.Address"], one.program["Reference.Value"]
    assert one.wrote == [(one.program["Command.Address"], stop), reference]
    assert (one.program["Load.RETRIES"], one.program["Load.RESP_TO"]) == (0, 500)
    assert switched(one, True)[0] != stop
    one.answers = False
    one.scan(10)
    assert one.program["Status"] == 0x80C8
