"""Stops that the line sends by itself: its own copy, one stop after the other, again until the drive block is back."""

import pytest
from tests.line.drives import counted
from tests.line.vline import NAMES, STOP, Bench, Config, Sent

PLAIN, JOG, COAST = 0x0005, 0x0008, 0x0006
"""Words of stops; all go to the register of the drives' kind."""


def copied(slot: int = 1, jog_stop: int = 1, **fields: int | bool) -> Bench:
    """A line that has copied the stops of its drives, one of which may jog."""
    bench = Bench().ready()
    bench.put(slot, JogStopRegister=bench.kind.stop_address, JogStopWord=JOG, JogStop=jog_stop, **fields)
    bench.run(50)
    return bench


def words(sent: list[Sent], unit: int = 2) -> list[int]:
    """What was written to a unit."""
    return [int.from_bytes(each.pdu[4:6], "big") for each in sent if each.unit == unit and not each.read]


@pytest.mark.parametrize(("jog_stop", "order"), [(0, [PLAIN]), (1, [PLAIN, JOG]), (2, [JOG, PLAIN])])
@pytest.mark.parametrize("how", ["StopAll", "not called", "shared"])
def test_the_stop_of_the_last_order_is_sent_first_then_the_other(jog_stop: int, order: list[int], how: str) -> None:
    bench = copied(jog_stop=jog_stop)
    bench.put(1, StopAgain=False)
    bench.fill(1, STOP, 6, bench.kind.stop_address, word=COAST)  # whatever was posted last
    if how == "StopAll":
        bench.set(StopAll=True)
        assert words(bench.run(3000)) == order, "its block goes on"
        return
    if how == "shared":
        bench.put(1, Shared=True)
    else:
        bench.attended.discard(1)
        bench.run(990)
    found = words(bench.run(1700))
    assert len(found) >= 3 * len(order)
    assert found == (order * len(found))[: len(found)]


def test_another_block_cannot_change_the_copy() -> None:
    """It writes its stop, its words and its address in the scan in which it begins; only the next call knows of it."""
    bench = copied()
    bench.drives.append(type(bench.drives[0])(9, bench.kind))
    bench.put(1, StopWord=0x0001, JogStop=0, Alive=bench.slot(1, "Alive") + 1, UnitAddress=9)
    bench._alive[1] += 1
    bench.fill(1, STOP, 6, bench.kind.stop_address, word=0x0001)
    bench.scan()
    assert bench.slot(1, "StopOverdue"), "at once"
    bench.put(1, Shared=True)
    sent = bench.run(1200)
    assert words(sent, unit=2)[:4] == [PLAIN, JOG] * 2
    assert not [each for each in sent if each.unit == 9]
    assert bench.slot(1, "LineErrorID") == 56
    bench.put(1, Shared=False, UnitAddress=2, StopWord=PLAIN)
    bench.run(1900)
    assert bench.slot(1, "StopOverdue"), "a block in a slower task is seen rarely"
    bench.run(600)
    assert not bench.slot(1, "StopOverdue")
    assert any(each.read for each in bench.run(200) if each.unit == 2)


def test_another_block_with_the_same_address_cannot_change_the_copy_either() -> None:
    bench = copied()
    bench._alive[1] += 1  # it is called, too; its first call does not know of the other
    bench.put(1, StopWord=0x0001, JogStop=0)
    bench.scan()
    bench._alive[1] += 1
    bench.put(1, Shared=True)
    assert words(bench.run(1200))[:4] == [PLAIN, JOG] * 2


@pytest.mark.parametrize(("has_stop", "sent"), [(True, {COAST, JOG}), (False, {JOG})])
def test_a_restart_voids_the_copy_for_what_the_slot_holds(has_stop: bool, sent: set[int]) -> None:
    """The stop that a block asked for last may end a jog alone: where it is called no longer its other one counts."""
    bench = copied()
    bench.fill(1, STOP, 6, bench.kind.stop_address, word=JOG)
    bench.attended.discard(1)
    bench.put(1, StopWord=COAST, HasStop=has_stop)
    bench.set(Restart=True)
    bench.scan()
    bench.set(Restart=False)
    assert set(words(bench.run(2500))) == sent
    bench.put(1, StopWord=PLAIN, HasStop=True)
    bench.attended.add(1)
    bench.run(100)
    bench.attended.discard(1)
    assert set(words(bench.run(2500))) == {PLAIN, JOG}


CHANGED = {
    "StopWord": (COAST, [(6, 0x1000, COAST), (6, 0x1000, JOG)]),
    "StopRegister": (0x1007, [(6, 0x1007, PLAIN), (6, 0x1000, JOG)]),
    "JogStopWord": (COAST, [(6, 0x1000, PLAIN), (6, 0x1000, COAST)]),
    "JogStopRegister": (0x1007, [(6, 0x1000, PLAIN), (6, 0x1007, JOG)]),
    "JogStop": (2, [(6, 0x1000, JOG), (6, 0x1000, PLAIN)]),
    "FunctionCode": (5, [(5, 0x1000, PLAIN), (5, 0x1000, JOG)]),
}
"""A field of a slot, what it becomes, and the stops of the line's own from then on."""


@pytest.mark.parametrize("field", CHANGED)
@pytest.mark.parametrize("jogged", [0, 1])
def test_each_field_that_changes_alone_is_copied(field: str, jogged: int) -> None:
    """Also where no jog had to be stopped before, and its words were of no use."""
    bench = copied(jog_stop=jogged)
    new, stops = CHANGED[field]
    if field == "FunctionCode":
        bench.fill(1, STOP, new, bench.kind.stop_address)
    else:
        bench.put(1, **{field: new})
    if not jogged and field != "JogStop":
        stops = stops[:1]
    bench.run(50)
    bench.attended.discard(1)
    sent = [each.pdu for each in bench.run(3000) if each.unit == 2 and not each.read]
    found = [(pdu[1], *(int.from_bytes(pdu[at : at + 2], "big") for at in (2, 4))) for pdu in sent]
    assert found[: len(stops)] == stops


def test_how_one_stop_has_failed_says_nothing_about_the_next() -> None:
    """Else a drive block takes the end of a jog for refused, when the stop before it was."""
    bench = copied()
    stops = bench.kind.stop_address.to_bytes(2, "big")
    bench.drives[1].answer = lambda frame: bytes([2, 0x86, 3]) if frame[2:4] == stops else counted(frame, 0)
    bench.stop(1)
    bench.run(100)
    assert NAMES[bench.slot(1, "Answer[0].ErrorID")] == "REFUSED"
    number = bench.post(1, STOP)
    for _ in range(10):
        if bench.slot(1, "Answer[0].Tried") != number:
            bench.scan()
    assert bench.slot(1, "Answer[0].Tried") == number
    assert bench.slot(1, "Answer[0].ErrorID") == 0
    bench.run(100)
    assert NAMES[bench.slot(1, "Answer[0].ErrorID")] == "REFUSED"


def test_a_unit_that_nobody_attends_is_stopped_when_its_supply_returns() -> None:
    """It is read every ten seconds, as one without supply is; it may go on by itself."""
    bench = copied()
    bench.put(1, SupplyOff=True)
    bench.drives[1].alive = False
    bench.run(5000)
    bench.attended.discard(1)
    assert words(bench.run(15_000)) == []
    assert not bench["StopOverdue"]
    bench.drives[1].alive = True
    assert words(bench.run(11_000))[:2] == [PLAIN, JOG]


def test_a_port_that_sends_a_call_later_gets_a_repeated_stop_no_sooner() -> None:
    """Its answer came while the stop still counted as unsent, so the pause after it was left out."""
    bench = Bench(Config(drives=2, scan=40_000, max_scan=45, tx_late=1)).ready()
    bench.attended.discard(0)
    bench.run(4000)
    before = len(bench.sent)
    bench.run(3000)
    assert sum(each.unit == 1 and each.stop for each in bench.sent[before:]) <= 6
