"""Frames that nobody here asked for are a rate: what counts, when starts pass no more, and when again."""

import pytest
from tests.line.vline import COMMAND, Bench, Config, line_sources

from structured_text.engines.embedded.engine import EmbeddedEngine
from structured_text.engines.engine import Source

REQUEST = bytes([9, 3, 0x20, 0, 0, 2])
TWO_LINES = """PROGRAM TwoLines
VAR
  One : MB_Line8; Two : MB_Line8; OnePort : MB_Port; TwoPort : MB_Port; Slots : MB_Slots8; Others : MB_Slots8;
END_VAR
  One(ElapsedMs := 10, Port := OnePort, Slots := Slots);
  Two(ElapsedMs := 10, Port := TwoPort, Slots := {slots});
END_PROGRAM
"""


def quiet(longest_ms: int = 30) -> Bench:
    """A line with much room between its polls."""
    bench = Bench(Config(drives=1, longest_ms=longest_ms))
    bench.put(0, PollEveryMs=200)
    return bench.ready()


def idle(bench: Bench) -> Bench:
    """Wait until nothing is open or near."""
    while bench["Exchange.Phase"] or bench["Exchange.QuietMs"] < 30 or bench["Track[0].Life.PauseMs"] < 100:
        bench.scan()
    return bench


def strange(bench: Bench, frame: bytes = REQUEST) -> None:
    """Somebody speaks, while nothing is open or near."""
    idle(bench).foreign(frame)
    bench.run(50)


def passes(bench: Bench) -> bool:
    """Whether a start passes."""
    bench.put(0, Begins=True)
    bench.command(0)
    bench.run(100)
    assert (bench.answer(0, COMMAND) == "FOREIGN") is (bench["ErrorID"] == 54)
    return bench.answer(0, COMMAND) == "OK"


@pytest.mark.parametrize(("most", "limit"), [(0, 5), (2, 2)])
def test_more_than_the_most_in_ten_seconds(most: int, limit: int) -> None:
    bench = quiet()
    bench.set(ForeignMost=most)
    for _ in range(limit):
        strange(bench)
    assert passes(bench)
    strange(bench)
    assert bench["ForeignFrames"] == limit + 1
    assert not passes(bench)
    bench.run(28_000)
    assert not passes(bench)
    bench.run(2500)
    assert passes(bench)
    assert bench["ForeignFrames"] == 0


@pytest.mark.parametrize("ascii_", [False, True])
def test_a_request_counts_though_one_of_ours_is_handed_to_the_port_meanwhile(ascii_: bool) -> None:
    """It had begun, and its first characters were forgotten."""
    bench = Bench(Config(drives=1, ascii=ascii_, rate=4800))
    bench.put(0, PollEveryMs=500)
    bench.ready()
    idle(bench).foreign(REQUEST)
    bench.drives[0].alive = False
    bench.stop(0)
    bench.run(60)
    assert bench["ForeignFrames"] == 1


def test_a_read_waits_until_the_unit_has_answered_another_master() -> None:
    """Both replies were mixed up for many reads: none proved anything. It waits for a turn-round at most."""
    bench = Bench(Config(drives=1, turn_ms=50, longest_ms=50))
    bench.put(0, PollEveryMs=500)
    idle(bench.ready())
    while not bench.run(10):
        pass
    bench.run(490)
    bench.foreign(bytes([1, *REQUEST[1:]]))
    assert not bench.run(40)
    assert bench.run(100)


@pytest.mark.parametrize("kind", ["Begins", "a reference"])
def test_only_what_starts_a_motor_or_resets_its_fault_is_kept_back(kind: str) -> None:
    """The reference of a running motor passes."""
    bench = quiet()
    for _ in range(6):
        strange(bench)
    bench.put(0, Begins=kind == "Begins")
    bench.command(0)
    bench.run(100)
    assert bench.answer(0, COMMAND) == ("OK" if kind == "a reference" else "FOREIGN")


def test_each_request_accounts_for_one_late_reply() -> None:
    """Two stops stay unanswered, since a stop waits for nobody; both replies come late."""
    bench = Bench(Config(drives=2, longest_ms=400)).ready()
    bench.put(0, PollEveryMs=5000)
    bench.put(1, PollEveryMs=5000)
    bench.run(300)
    for drive in bench.drives:
        drive.turn_us = 200_000
    bench.stop(0)
    bench.stop(1)
    bench.run(75)
    for drive in bench.drives:
        drive.alive = False
    bench.run(500)
    heard = [len([each for each in drive.heard if each[1] == 6]) for drive in bench.drives]
    assert min(heard) >= 2
    assert bench["ForeignFrames"] == 0
    assert bench["LateReplies"] >= 1


@pytest.mark.parametrize(("slots", "error"), [("Slots", 56), ("Others", 0)])
def test_two_lines_cannot_have_the_same_slots(slots: str, error: int) -> None:
    """A copy of the line for a second port: its drive 1 got what was meant for the other one, and ran."""
    sources = [*line_sources(), Source("two.st", TWO_LINES.format(slots=slots))]
    library = EmbeddedEngine().build(sources)
    for used in ((1, 4), (1,)):
        program = library.instance("TwoLines")
        for each in ("Slots", "Others"):
            for slot in used:
                program[f"{each}[{slot}].UnitAddress"] = slot
        for _ in range(30):
            program.scan()
        assert [program[name] for name in ("One.ErrorID", "Two.ErrorID")] == [error, error]
        assert program[f"Slots[{used[-1]}].LineErrorID"] == error
