"""Dead drives are probed rarely, one at a time; they come back when they have answered several times."""

from collections import Counter
from collections.abc import Callable
from itertools import pairwise

import pytest
from tests.line.drives import counted
from tests.line.vline import PARAMETER, Bench, Config


def test_a_new_address_is_a_new_drive() -> None:
    bench = Bench().ready()
    bench.put(1, StopConfirmed=True)
    bench.run(110)  # a slot at rest is looked at each 100 ms
    bench.drives[1].unit = 20
    bench.put(1, UnitAddress=20)
    bench.scan()
    assert not bench.slot(1, "Online")
    bench.run(500)
    assert bench.slot(1, "Online")


def test_dead_drives_have_turns_of_their_own() -> None:
    """Of two whose stops wait the first was sent to again and again, as long as other dead drives were probed."""
    bench = Bench(Config(drives=6)).ready()
    for index in range(5):
        bench.drives[index].alive = False
        bench.put(index, TurnRoundMs=1000)  # so the wire rests for longer than until a stop is due again
    bench.run(500)
    for index in range(3):
        bench.stop(index)
    bench.run(10_000)
    before = len(bench.sent)
    bench.run(90_000)
    asked = Counter(each.unit for each in bench.sent[before:] if each.unit <= 5)
    for alike in ([1, 2, 3], [4, 5]):  # by stops, by probes
        numbers = [asked[unit] for unit in alike]
        assert min(numbers) >= 3, asked
        assert max(numbers) - min(numbers) <= 1, asked


def test_a_dead_drive_whose_block_is_not_called_rests_with_the_others() -> None:
    """Its stops came as soon as they were due, whatever they cost, and other dead drives were not probed any more."""
    bench = Bench(Config(drives=4)).ready()
    for index in (0, 2):
        bench.drives[index].alive = False
        bench.put(index, TurnRoundMs=500)
    bench.attended.discard(0)
    bench.run(10_000)
    before = len(bench.sent)
    bench.run(30_000)
    asked = Counter(each.unit for each in bench.sent[before:])
    assert asked[3] >= 3, asked


@pytest.mark.parametrize("others", [Bench.command, Bench.stop])
def test_others_cost_no_dead_drive_its_turn(others: Callable[[Bench, int], int]) -> None:
    """While one that lives was stopped again and again, the first of two dead ones got all attempts."""
    bench = Bench(Config(drives=4)).ready()
    for index in (1, 2):
        bench.drives[index].alive = False
        bench.put(index, TurnRoundMs=1000)
    bench.run(500)
    for index in (1, 2):
        bench.stop(index)
    bench.run(10_000)
    before = len(bench.sent)
    for _ in range(300):
        for index in (0, 3):
            others(bench, index)
        bench.run(200)
    asked = Counter(each.unit for each in bench.sent[before:] if each.unit in (2, 3))
    assert min(asked[2], asked[3]) >= 3, asked
    assert asked[2] - asked[3] in (-1, 0, 1), asked


def test_commands_of_others_cost_nobody_its_parameter() -> None:
    """While a third drive got commands, the first of two that asked for parameters all the time got all requests."""
    bench = Bench(Config(drives=4)).ready()
    for _ in range(100):
        for index in (1, 2):
            if bench.answer(index, PARAMETER):
                bench.ask(index, PARAMETER, 3, 0x0777)
        bench.command(0)
        bench.run(80)
    asked = Counter(each.unit for each in bench.sent if each.pdu[-4:-2] == b"\x07\x77")
    assert min(asked[2], asked[3]) >= 3, asked
    assert asked[2] - asked[3] in (-1, 0, 1), asked


def test_the_repeated_stop_of_a_dead_drive_waits_for_nobodys_late_reply() -> None:
    """A probe of another one took its turn, and then waited for three seconds; each seventh reply is lost."""
    bench = Bench(Config(drives=3, turn_ms=50, longest_ms=3000))
    bench.run(7000)
    bench.drives[0].alive = bench.drives[1].alive = False
    bench.stop(0)
    bench.run(17_000)
    asked = []

    def answer(request: bytes) -> bytes | None:
        asked.append(request)
        return counted(request, 1) if len(asked) % 7 else None

    bench.drives[2].answer = answer
    stops = [each.ms for each in bench.run(60_000) if each.stop and each.unit == 1]
    assert max(later - first for first, later in pairwise(stops)) < 1500


def test_a_first_read_that_is_refused_leaves_others_their_reads() -> None:
    """A drive that refused what is read before its first stop was asked three times of four, one neighbour never."""
    bench = Bench(Config(drives=3)).ready()
    bench.drives[0].answer = lambda request: request[:1] + bytes([request[1] | 0x80, 2])
    bench.put(0, PollFirst=True)
    before = len(bench.sent)
    bench.run(4000)
    asked = Counter(each.unit for each in bench.sent[before:])
    assert min(asked[unit] for unit in (1, 2, 3)) > max(asked.values()) // 2, asked
