"""Parameters beside a drive block that runs a motor: a write and a start never meet, whoever comes first."""

import pytest
from tests.second.line import Bench, Frame

from driveblocks.render.results import code

WRITABLE = {"CHF": 0x8007, "JSCC": 0x0012}


def both(kind: str, apart: int) -> tuple[Bench, list[Frame], list[Frame]]:
    """A write, and this many scans later (or before) an edge of RunForward; the writes, and what else was written."""
    bench = Bench(kind).stopped()
    before = len(bench.frames)
    for scan in range(300):
        if scan == 10:
            for pin, value in (("Address", WRITABLE[kind]), ("Value", 7), ("Execute", True)):
                bench.block[f"Writer.{pin}"] = value
        if scan == 10 + apart:
            bench.put(RunForward=True)
        bench.scan()
    sent = [each for each in bench.frames[before:] if not each.read]
    mine = [each for each in sent if each.address == WRITABLE[kind]]
    return bench, mine, [each for each in sent if each not in mine]


@pytest.mark.parametrize("apart", range(2, 7))
@pytest.mark.parametrize("kind", WRITABLE)
def test_a_write_and_a_start_never_meet(kind: str, apart: int) -> None:
    bench, writes, commands = both(kind, apart)
    if writes:
        assert bench.block["Writer.Done"]
        assert not commands or writes[-1].ms < commands[0].ms, "it had arrived before the start"
        assert bench.shows("Running") == bool(commands)
    else:
        assert bench.block["Writer.ErrorID"] == code("NOT_STOPPED")
        assert bench.shows("Running")


def test_each_of_the_two_comes_first_sometimes() -> None:
    assert both("JSCC", -6)[1] == []
    written, started = both("JSCC", 4)[1:]
    assert written
    assert not started, "an edge while a write waits is lost"
    assert bool(both("JSCC", 30)[2]), "one after it is not"
