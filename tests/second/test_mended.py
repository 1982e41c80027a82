"""Mistakes that the matrix has found, each with the least that shows it."""

from tests.second.bench import Second

TERMINALS = {"run": 1}


def at_terminals() -> Second:
    """A CHF that its terminals run, with the reference from the bus."""
    b = Second("CHF", settings=TERMINALS, pins={"SpeedOnly": True})
    b.wait(lambda: b.models[0].reference_hz, 9000)
    b.models[0].terminal(True, b.now)
    b.run(3000)
    return b


def test_the_reference_is_taken_back_after_both_stops_of_speed_only() -> None:
    """The end of a jog follows the stop, and took back the reference of 0 that waited; none was ever sent again."""
    b = at_terminals()
    b.put(0, Enable=False).run(2000)
    assert b.models[0].reference_hz == 0.0
    b.put(0, Enable=True).run(2000)
    assert b.models[0].reference_hz == 25.0


def test_a_flickering_pin_of_speed_only_leaves_the_line_to_the_others() -> None:
    b = Second("CHF", "JSCC", "SN300G5", settings=TERMINALS, pins={"SpeedOnly": True}, ms=50)
    b.run(6000)
    b.flicker = "QuickStop"
    for _ in range(200):
        b.scan()
        assert all(b.shows("CommOk", each) for each in range(3))


def test_an_address_that_the_drive_cannot_have_can_be_corrected() -> None:
    """H5-01 of SN300G5 ends at 1FH: the line serves no other."""
    b = Second("SN300G5")
    b.wait(lambda: b.shows("StopConfirmed"), 9000)
    b.put(0, Address=77).run(9000)
    assert b.reason() == "MISSING"
    b.put(0, Address=1)
    assert b.wait(lambda: b.shows("StopConfirmed"), 9000)


def test_a_reset_waits_for_both_stops() -> None:
    """The end of a jog took back the reset that waited."""
    b = Second("CHF")
    b.wait(lambda: b.shows("Ready"), 9000)
    for ms in range(0, 700, 20):
        b.put(0, JogForward=True).run(1500)
        b.models[0].trip(3, b.now)
        b.release().run(1500 + ms)
        b.put(0, FaultReset=True).run(100)
        b.put(0, FaultReset=False).run(3000)
        assert b.models[0].fault is None, f"after {ms} ms"
        assert b.wait(lambda: b.shows("Ready"), 9000)


def test_the_reference_is_sent_again_after_another_block_was_on_the_slot() -> None:
    """It took back the reference that was on its way, which was waited for ever after."""
    b = at_terminals().put(0, RefreshMs=100)
    for ms in range(0, 200, 20):
        b.run(ms)
        b.twin(on=True)
        b.run(1000)
        b.twin(on=False)
        b.run(6000)
        for hz in (10.0, 25.0):
            b.put(0, SpeedReferenceHz=hz).run(1000)
            assert b.models[0].reference_hz == hz, f"after {ms} ms"
