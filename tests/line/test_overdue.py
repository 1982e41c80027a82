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
    while bench["Silence.SilentMs"] < 1000:
        bench.scan()
    bench.drives[1].alive = False
    bench.scan()
    while bench["Exchange.Phase"] == 2:
        bench.scan()
    bench.drives[1].alive = True
    for _ in range(1500):
        bench.scan()
        assert bench.slot(1, "Online")
    assert not bench.slot(0, "Online")


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
