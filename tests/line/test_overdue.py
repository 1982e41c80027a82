"""When a stop is overdue: silence that is beyond doubt, and no other; from a cut cable to the contact."""

from dataclasses import replace

import pytest
from tests.line.drives import counted
from tests.line.vline import NAMES, STOP, Bench, Config

LEARNED = Config(drives=1, turn_ms=50, longest_ms=500, turn_high=20_000)
EIGHT = Config(drives=8, turn_ms=50, longest_ms=500, turn_high=20_000)
"""Reply times as drive blocks learn them."""


def cut(config: Config, held: bool, after: int = 0) -> tuple[int, int]:
    """Cut the cable; ms until StopOverdue of every slot, and what the line says of it."""
    bench = Bench(config).ready()
    bench.run(500 + after)
    for drive in bench.drives:
        drive.alive = False
    began = bench.now
    if not held:
        for slot in range(config.drives):
            bench.stop(slot)
    posted = not held
    while not all(bench.slot(slot, "StopOverdue") for slot in range(config.drives)):
        bench.scan()
        if not posted and not bench.slot(0, "Online"):
            posted = True  # as its drive block does
            for slot in range(config.drives):
                bench.stop(slot)
        assert bench.now - began < 20_000_000
    return (bench.now - began) // 1000, bench["CutToContactMs"]


@pytest.mark.parametrize("held", [False, True])
@pytest.mark.parametrize("config", [LEARNED, EIGHT])
@pytest.mark.parametrize("echo", [False, True])
@pytest.mark.parametrize("after", [0, 7, 23, 61])
def test_from_a_cut_cable_to_the_contact(config: Config, held: bool, echo: bool, after: int) -> None:
    took, stated = cut(replace(config, echo=echo), held, after)
    assert config.longest_ms < took <= stated
    assert stated <= (2500 if config.drives == 1 else 4000)


def test_before_reply_times_are_learned_it_takes_longer() -> None:
    took, stated = cut(Config(drives=8, turn_ms=500, longest_ms=500, turn_high=20_000), held=True)
    assert 2500 < took <= stated


@pytest.mark.parametrize("echo", [False, True])
def test_one_of_eight_that_is_cut_off_is_overdue_in_four_seconds(echo: bool) -> None:
    """A port that echoes answers for nobody."""
    bench = Bench(replace(EIGHT, echo=echo)).ready()
    bench.drives[3].alive = False
    began = bench.now
    while bench.slot(3, "Online"):
        bench.scan()
    bench.stop(3)
    while not bench.slot(3, "StopOverdue"):
        bench.scan()
    assert bench.now - began < 4_000_000
    assert not any(bench.slot(slot, "StopOverdue") for slot in range(8) if slot != 3)


def test_the_stop_of_a_drive_that_has_just_died_rests_for_no_other() -> None:
    """One that never answered takes half a second for each attempt, and the others three times as long after it."""
    bench = Bench(replace(LEARNED, drives=3))
    bench.drives[0].alive = False
    bench.put(0, TurnRoundMs=500)
    bench.ready().run(6000)
    bench.drives[1].alive = False
    while bench.slot(1, "Online"):
        bench.scan()
    bench.stop(0)
    bench.stop(1)
    began = bench.now
    while not bench.slot(1, "StopOverdue"):
        bench.scan()
    assert bench.now - began < 1_500_000


def test_three_unanswered_requests_to_a_drive_that_is_read_rarely_come_at_once() -> None:
    """At the first of them its silence is long enough already."""
    bench = Bench(replace(LEARNED, drives=3))
    bench.put(1, PollEveryMs=1500)
    bench.ready().run(6000)
    asked = len(bench.drives[1].heard)
    while len(bench.drives[1].heard) == asked:
        bench.scan()
    bench.drives[1].alive = False
    began = bench.now
    while bench.slot(1, "Online"):
        bench.scan()
    assert bench.now - began < 1_500_000 + 3 * 500_000
    assert [sent.unit for sent in bench.sent].count(2) == asked + 4


@pytest.mark.parametrize("cut_off", [3, 5, 7])
def test_who_still_answers_stays_online(cut_off: int) -> None:
    bench = Bench(EIGHT).ready()
    bench.run(500)
    for drive in bench.drives[:cut_off]:
        drive.alive = False
    for _ in range(1500):
        bench.scan()
        assert all(bench.slot(slot, "Online") for slot in range(cut_off, 8)), "nobody else is dead"
    assert bench["OnlineCount"] == 8 - cut_off


def test_one_lost_reply_beside_a_drive_that_has_just_died_is_no_silent_line() -> None:
    """Two polls to it fill OfflineMs, since its reply time is not learned; then another drive loses one reply."""
    bench = Bench(replace(LEARNED, drives=2))
    bench.put(0, TurnRoundMs=500)
    bench.ready().run(500)
    bench.drives[0].alive = False
    while bench["Times.LineSilentMs"] < 1000:
        bench.scan()
    bench.drives[1].alive = False
    bench.scan()
    while bench["Phase"] == 2:
        bench.scan()
    bench.drives[1].alive = True
    for _ in range(1500):
        bench.scan()
        assert bench.slot(1, "Online")
    assert not bench.slot(0, "Online")


def test_never_before_the_longest_reply() -> None:
    bench = Bench(Config(drives=1, longest_ms=5000)).ready()
    bench.drives[0].alive = False
    bench.stop(0)
    bench.run(4900)
    assert not bench["StopOverdue"]
    bench.run(300)
    assert bench["StopOverdue"]


@pytest.mark.parametrize("stops", [60, pytest.param(1000, marks=pytest.mark.long)])
def test_a_port_that_stalls_opens_no_contact(stops: int) -> None:
    """It says that it has taken frames, and sends none for 300 ms."""
    bench = Bench(Config(drives=2)).ready()
    for _ in range(stops):
        bench.stop(1)
        for drive in bench.drives:
            drive.alive = False
        for _ in range(30):
            bench.scan()
            assert not bench["StopOverdue"]
        for drive in bench.drives:
            drive.alive = True
        while not bench.answer(1, STOP):
            bench.scan()
            assert not bench["StopOverdue"]


def test_a_busy_drive_has_time_and_what_is_lost_meanwhile_does_not_count() -> None:
    """It refuses its stop for 2.2 s, and each fifth refusal is lost; then it obeys."""
    bench = Bench(EIGHT).ready()
    bench.put(2, BusyReason=6, StopWithinMs=0)
    refused, said = [], set[str]()

    def answer(request: bytes) -> bytes | None:
        if request[1] != 6:
            return counted(request, 1)
        refused.append(bench.now)
        return None if len(refused) % 5 == 0 else bytes([request[0], request[1] + 0x80, 6])

    bench.drives[2].answer = answer
    bench.stop(2)
    began = bench.now
    while bench.now - began < 2_200_000:
        bench.scan()
        said.add(NAMES[bench.slot(2, "Answer[0].ErrorID")])
        assert not bench.slot(2, "StopOverdue"), f"after {(bench.now - began) // 1000} ms"
    assert len(refused) > 7
    assert said == {"OK", "BUSY", "SILENCE"}  # it has refused no stop for good: the end of a jog is sent again
    bench.drives[2].answer = None
    bench.run(400)
    assert bench.answer(2, STOP) == "OK"
    assert not bench.slot(2, "StopOverdue")


def test_a_repetition_that_a_busy_drive_refuses_in_a_long_ramp_is_no_alarm() -> None:
    """Its first stop was acknowledged four seconds ago; time counts from the first attempt of the repetition."""
    bench = Bench(EIGHT).ready()
    bench.put(2, BusyReason=6, StopWithinMs=9000)
    bench.stop(2)
    bench.run(4000)
    assert bench.answer(2, STOP) == "OK"
    began = bench.now
    bench.drives[2].answer = lambda each: counted(each, 1) if each[1] != 6 else bytes([each[0], each[1] + 0x80, 6])
    bench.put(2, StopAgain=True)
    bench.stop(2)
    while bench.now - began < 2_200_000:
        bench.scan()
        assert not bench.slot(2, "StopOverdue"), f"after {(bench.now - began) // 1000} ms"


def test_a_drive_that_stays_busy_opens_the_contact() -> None:
    bench = Bench(EIGHT).ready()
    bench.put(2, BusyReason=6, StopWithinMs=0)
    bench.drives[2].answer = lambda each: counted(each, 1) if each[1] != 6 else bytes([each[0], each[1] + 0x80, 6])
    bench.stop(2)
    began = bench.now
    while not bench.slot(2, "StopOverdue"):
        bench.scan()
        assert bench.now - began < 3_000_000
    assert bench.now - began > 2_500_000


def test_silent_units_get_one_attempt_each_before_retries() -> None:
    bench = Bench(Config(drives=4)).ready()
    for drive in bench.drives[:3]:
        drive.alive = False
    bench.run(6000)
    assert bench["OnlineCount"] == 1
    for slot in range(3):
        bench.stop(slot)
    sent = [each.unit for each in bench.run(1000) if each.stop]
    assert sorted(sent[:3]) == sorted(sent[3:6]) == [1, 2, 3]
    bench.stop(3)
    assert next(each for each in bench.run(60) if each.stop).unit == 4, "a new stop passes between"


def test_new_numbers_do_not_hide_that_nobody_answers() -> None:
    """A pin that flickers posts a stop in every scan."""
    bench = Bench(Config(drives=2)).ready()
    bench.drives[0].alive = False
    for _ in range(400):
        bench.stop(0)
        bench.scan()
    assert bench.slot(0, "StopOverdue")


@pytest.mark.parametrize("still", [False, True])
def test_proof_outlives_silence(still: bool) -> None:
    """The isolator of a fan that stands is opened."""
    bench = Bench().ready()
    bench.put(1, StopConfirmed=True, ProvedStill=still, StopWithinMs=700)
    bench.run(100)
    bench.drives[1].alive = False
    bench.put(1, StopConfirmed=False)
    bench.stop(1)
    seen = []
    for _ in range(1000):
        bench.scan()
        seen.append(bench["StopOverdue"])
    assert any(seen) is not still
    bench.drives[1].alive = True
    bench.put(1, StopConfirmed=True)
    bench.run(1500)
    assert not bench["StopOverdue"]
    read = bytes.fromhex("0203 0C") + bytes(12)
    bench.put(1, OtherQuantity=0)
    bench.drives[1].answer = lambda request: None if request[1] == 6 else read
    bench.stop(1)
    while not bench["StopOverdue"]:
        bench.scan()
        assert bench.slot(1, "Online"), "it answers, but not its stop"


def test_a_tripped_drive_owes_no_standstill_while_that_is_fresh() -> None:
    bench = Bench().ready()
    bench.put(1, StopWithinMs=800)
    bench.stop(1)
    bench.run(400)
    bench.put(1, Tripped=True)
    bench.run(10_000)
    assert not bench["StopOverdue"]
    bench.put(1, Tripped=False)
    bench.run(700)
    assert not bench["StopOverdue"], "it counts anew"
    bench.run(200)
    assert bench["StopOverdue"]


def test_what_stays_unanswered_while_it_boots_counts_anew_then() -> None:
    bench = Bench(Config(drives=1))
    bench.put(0, BootMs=3000)
    bench.drives[0].alive = False
    bench.stop(0)
    bench.run(2500)
    bench.drives[0].alive = True
    for _ in range(100):
        bench.scan()
        assert not bench["StopOverdue"], "the first reply ends it, and says no evil"


def test_without_supply_an_answering_drive_that_falls_silent_is_no_alarm() -> None:
    bench = Bench().ready()
    bench.put(1, SupplyOff=True, StopWithinMs=300)
    bench.drives[1].alive = False
    bench.run(60)
    bench.stop(1)
    for _ in range(500):
        bench.scan()
        assert not bench["StopOverdue"]


@pytest.mark.parametrize("how", ["dark", "boots"])
def test_one_without_supply_or_that_boots_keeps_no_cut_cable_from_the_contact(how: str) -> None:
    """Its silence proves nothing, but that of the others does."""
    bench = Bench(replace(EIGHT, turn_ms=200))
    for slot in range(8):
        bench.put(slot, BootMs=10_000)
    bench.drives[7].alive = how != "dark"
    bench.put(7, SupplyOff=how == "dark", StopConfirmed=True)
    bench.run(16_000)
    if how == "boots":
        bench.put(7, UnitAddress=99)
        bench.scan()
    for slot, drive in enumerate(bench.drives[:7]):
        drive.alive = False
        bench.stop(slot)
    bench.drives[7].alive = False
    began = bench.now
    while not all(bench.slot(slot, "StopOverdue") for slot in range(7)):
        bench.scan()
        assert bench.now - began <= 1000 * bench["CutToContactMs"]
    assert not bench.slot(7, "StopOverdue")


@pytest.mark.parametrize("off", [False, True])
def test_the_stop_of_one_that_has_fallen_silent_lets_others_be_read(off: bool) -> None:
    """For OfflineMs no late reply was waited out, and nothing but that stop was sent; without supply, too."""
    bench = Bench(replace(LEARNED, drives=2), OfflineMs=10_000).ready()
    bench.run(3000)
    bench.drives[0].alive = False
    bench.put(0, SupplyOff=off)
    bench.stop(0)
    for _ in range(9):
        fresh = bench.slot(1, "Fresh")
        bench.run(1000)
        assert bench.slot(1, "Fresh") != fresh
    bench.run(3000)
    assert bool(bench.slot(0, "StopOverdue")) is not off
