"""A restart gives up what waits, but no stop; time that stands lets only stops out."""

import pytest
from tests.line.vline import COMMAND, PARAMETER, STOP, Bench, Config


def restart(bench: Bench, how: str) -> None:
    """Restart in one of three ways."""
    if how == "pin":
        bench.set(Restart=True)
        bench.scan()
        bench.set(Restart=False)
    elif how == "late":
        bench.scan(took=1_500_000)
    else:
        bench.block["Scan.Started"] = False
        bench.scan()


@pytest.mark.parametrize("how", ["pin", "late", "first"])
def test_what_waits_is_given_up_but_no_stop(how: str) -> None:
    bench = Bench().ready()
    bench.port_takes = False
    bench.command(0)
    bench.run(30)
    bench.ask(1, PARAMETER, 6, 0x100)
    bench.stop(2)
    restart(bench, how)
    bench.port_takes = True
    assert (bench.answer(0, COMMAND), bench.answer(1, PARAMETER)) == ("RESTARTED", "RESTARTED")
    sent = bench.run(600)
    assert [each.stop for each in sent if not each.read] == [True] * len([each for each in sent if not each.read])
    assert bench.answer(2, STOP) == "OK"


@pytest.mark.parametrize(
    "name",
    [
        "Next.TurnStop",
        "Next.TurnFirst",
        "Next.TurnDead",
        "Next.TurnAgain",
        "Next.TurnFeed",
        "Next.TurnCommand",
        "Next.TurnLater",
        "Next.TurnRead",
        "Next.LastRead",
        "Next.Chosen",
        "OpenSlot",
        "Track[0].FirstSlot",
        "Own.Walk",
        "Own.WillTurn",
        "Index",
    ],
)
@pytest.mark.parametrize("how", ["pin", "late", "first"])
def test_no_slot_that_does_not_exist_outlives_a_restart(how: str, name: str) -> None:
    """Memory that was left by something else named the slot whose turn it is, which was looked at beyond the array."""
    bench = Bench().ready()
    bench.block[name] = 200
    restart(bench, how)
    assert bench.run(600)


def test_only_stops_are_sent_while_time_stays() -> None:
    bench = Bench().ready()
    for _ in range(101):
        bench.scan(elapsed=0)
    bench.command(0)
    bench.stop(1)
    before = len(bench.sent)
    for _ in range(20):
        bench.scan(elapsed=0)
    assert [each.stop for each in bench.sent[before:]] == [True]
    assert bench["ErrorID"] == 58
    bench.run(300)
    assert bench["ErrorID"] == 0


def test_nothing_but_stops_is_sent_before_time_has_moved() -> None:
    bench = Bench()
    for _ in range(50):
        bench.scan(elapsed=0)
    assert bench.sent == []
    bench.stop(1)
    bench.scan(elapsed=0)
    assert [each.stop for each in bench.sent] == [True]


@pytest.mark.parametrize("box", [COMMAND, PARAMETER])
def test_attempts_are_counted_anew_even_if_a_number_comes_again(box: int) -> None:
    """It was sent and taken back; who asks after a restart goes on from what was answered."""
    bench = Bench(Config(drives=1)).ready()
    bench.drives[0].alive = False
    bench.ask(0, box, 6, 0x2000)
    bench.run(40)
    assert bench.slot(0, f"Answer[{box}].Tries") > 0
    bench.block[f"Slots[0].Ask[{box}].Number"] = bench.slot(0, f"Answer[{box}].Number")
    bench.set(Restart=True)
    bench.scan()
    bench.set(Restart=False)
    bench.drives[0].alive = True
    bench.run(1000)
    before = bench["Retries"]
    bench.ask(0, box, 6, 0x2000)
    bench.run(200)
    assert bench.answer(0, box) == "OK"
    assert bench["Retries"] == before
