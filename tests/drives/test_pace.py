"""Whether the line is fast enough, before a start: what it bars, what it warns of; and the marks of a request."""

from collections.abc import Callable

import pytest
from tests.drives.words import sent
from tests.second.line import Bench
from tests.second.station import MADE_UP, MIXED, maps
from tests.shipped import drives

from driveblocks.render.drive import family_number
from driveblocks.render.environment import ABI

KINDS = (*MIXED, *MADE_UP)
STALE_MS = 5000
STATUS, SPEED = 0x1001, 0x3000
"""What the block of a CHF reads in each round."""


def line(bench: Bench, **figures: int) -> Bench:
    """The slot's figures of the line, as it would write them in each call."""

    def writes(one: Bench) -> None:
        for name, value in figures.items():
            one.block[f"Slots[0].{name}"] = value

    bench.watch = [writes]
    writes(bench)
    return bench


def asked(bench: Bench, box: int, field: str) -> int:
    value = bench.block[f"Slots[0].Ask[{box}].{field}"]
    assert isinstance(value, int)
    return value


def still(bench: Bench) -> Bench:
    return bench.until(lambda: bench.shows("StopConfirmed"), 12_000)


def bars(figures: dict[str, int], reason: str) -> Bench:
    """A motor at rest that these figures keep from starting."""
    bench = still(line(Bench("CHF"), **figures))
    bench.put(RunForward=False).run(100)
    assert (bench.reason(), bench.shows("Ready")) == (reason, False)
    bench.put(RunForward=True).run(1000)
    assert bench.drives[0].mode == "standstill"
    assert bench.reason() == reason
    bench.put(RunForward=False).run(100)
    return bench


def test_a_line_that_is_too_slow_bars_every_start_and_shows_both_figures() -> None:
    bench = bars({"ReadMs": STALE_MS + 1, "WorstReadMs": 9000}, "TOO_SLOW")
    shown = ("Diagnosis.ReadMs", "Diagnosis.WorstReadMs", "Diagnosis.StaleMs")
    assert [bench.out(name) for name in shown] == [STALE_MS + 1, 9000, STALE_MS]
    line(bench, ReadMs=STALE_MS, WorstReadMs=9000).running()


def test_a_status_that_is_never_fresh_is_the_line_s_fault_not_the_cable_s() -> None:
    bench = line(Bench("CHF").put(StaleMs=10), ReadMs=11)
    bench.run(5000)
    assert (bench.shows("CommOk"), bench.reason()) == (False, "TOO_SLOW")


def test_until_the_line_knows_nothing_starts() -> None:
    line(bars({"ReadMs": 0}, "LEARNING"), ReadMs=100).running()


def test_a_turn_round_is_learned_from_twenty_replies() -> None:
    bench = line(Bench("CHF").put(TurnRoundMs=0), ReadMs=100, Replies=19)
    still(bench).run(2000)
    assert (bench.reason(), bench.shows("Ready")) == ("LEARNING", False)
    line(bench, ReadMs=100, Replies=20).running()


@pytest.mark.parametrize(
    ("figures", "reason"),
    [({"WorstReadMs": STALE_MS + 1}, "MAY_BE_LATE"), ({"WorstFeedMs": 2001}, "MAY_STARVE")],
    ids=str,
)
def test_what_may_come_once_others_fail_is_said_and_bars_nothing(figures: dict[str, int], reason: str) -> None:
    bench = line(Bench("CHF").put(WatchdogMs=3000), **{"ReadMs": 100, **figures}).stopped()
    assert bench.reason() == reason
    bench.running()
    assert bench.reason() == "RUNS"


def test_a_line_that_gets_slower_ends_no_run_and_bars_no_later_start() -> None:
    bench = line(Bench("CHF"), ReadMs=100).running()
    line(bench, ReadMs=STALE_MS + 1).run(3000)
    assert (bench.drives[0].mode, bench.reason()) == ("running", "RUNS")
    bench.put(RunForward=False).stopped()
    assert bench.reason() == "MAY_BE_LATE"
    bench.running().restart().put(RunForward=False)
    still(bench).run(100)
    assert bench.reason() == "TOO_SLOW"


@pytest.mark.parametrize("kind", KINDS)
def test_every_request_says_whose_it_is_and_a_stop_is_whole(kind: str) -> None:
    bench = Bench(kind)
    own = family_number(maps()[kind].prefix)
    checks = set()
    for run in (True, False):
        _ = bench.running() if run else bench.put(RunForward=False).stopped()
        for box in (0, 1, 3):
            assert (asked(bench, box, "Unit"), asked(bench, box, "FamilyCode")) == (1, own)
        checks.add((asked(bench, 0, "Number"), asked(bench, 0, "Check")))
    assert (bench.block["Slots[0].FamilyCode"], bench.block["Slots[0].Abi"]) == (own, 256 * ABI)
    assert len({check for _, check in checks}) == len({number for number, _ in checks})


def test_no_two_families_have_one_number() -> None:
    numbers = [family_number(drive.prefix) for drive in (*drives().values(), *maps().values())]
    assert 0 not in numbers
    assert len(set(numbers)) == len({drive.prefix for drive in (*drives().values(), *maps().values())})


def test_a_line_of_another_version_stops_the_motor_and_starts_none() -> None:
    bench = line(Bench("CHF").running(), Abi=256 * (ABI + 1))
    bench.run(60)
    assert bench.reason() == "OTHER_VERSION"
    assert bench.out("Control.PostStop") or bench.out("State") == 0
    bench.put(RunForward=False).run(5000)
    bench.put(RunForward=True).run(1000)
    assert bench.drives[0].mode == "standstill"
    line(bench, Abi=256 * ABI).put(RunForward=False).stopped().running()


def marks(bench: Bench, wanted: Callable[[], bool]) -> set[tuple[bool, bool]]:
    """AskLater and AskFeeds of each reference that is posted while the motor runs."""
    found: set[tuple[bool, bool]] = set()

    def looks(one: Bench) -> None:
        if one.out("Control.PostCommand") and one.out("Control.Sent") == 10:
            found.add((bool(one.block["Slots[0].AskLater"]), bool(one.block["Slots[0].AskFeeds"])))

    bench.watch.append(looks)
    bench.until(wanted)
    bench.watch.remove(looks)
    return found


def test_a_reference_is_marked_as_new_as_a_refresh_or_as_what_feeds_a_watchdog() -> None:
    bench = Bench("CHF").put(RefreshMs=300).running()
    assert marks(bench, lambda: len(sent(bench, bench.run(1000), "reference")) > 1) == {(True, False)}
    bench.put(SpeedReferenceHz=30.0)
    assert marks(bench, lambda: bool(sent(bench, bench.run(100), "reference"))) == {(False, False)}
    bench.put(WatchdogMs=900, RefreshMs=0).run(500)
    found = marks(bench, lambda: len(sent(bench, bench.run(1000), "reference")) > 1)
    assert {feeds for _, feeds in found} == {True}
    assert bench.block["Slots[0].FeedMs"] == 900


def test_what_the_line_leaves_waiting_makes_room_for_the_status() -> None:
    """The line has no time for the code of the fault, which the block of a CHF reads in each third poll."""
    bench = line(Bench("CHF").running(), ReadMs=1000)
    bench.spoil = lambda frame, reply: reply if not frame.read or frame.address in (STATUS, SPEED) else None
    bench.until(lambda: bool(bench.block["Slots[0].PollLater"]))
    ages = []
    for _ in range(400):
        bench.scan()
        ages.append(bench.number("StatusAgeMs"))
    assert max(ages) < 1000
    assert bench.drives[0].mode == "running"
    assert bench.block["Slots[0].StatusPolls"] == 3
