"""What is believed: whole replies that fit, no echo, nothing late, nothing that a foreign master has asked for."""

import pytest
from tests.line.drives import KINDS, counted
from tests.line.vline import COMMAND, PARAMETER, POLL, STOP, Bench, Config


@pytest.mark.parametrize("ascii_", [False, True])
@pytest.mark.parametrize("kind", range(len(KINDS)))
def test_both_modes_and_every_kind_of_drive(ascii_: bool, kind: int) -> None:
    bench, form = Bench(Config(ascii=ascii_, kind=kind)).ready(), KINDS[kind]
    bench.command(1)
    bench.run(150)
    bench.stop(0)
    bench.run(150)
    assert (bench.answer(1, COMMAND), bench.answer(0, STOP)) == ("OK", "OK")
    first = 0 if form.read_function <= 2 else 5
    assert bench.slot(2, f"PollWords[{first}]") in {
        (bench.drives[2].reads - each) % (1 << (16 if first else 6)) for each in (0, 1)
    }
    assert bench["Timeouts"] == bench["Bad"] == bench["ForeignFrames"] == 0


@pytest.mark.parametrize("kind", range(len(KINDS)))
def test_a_refusal_is_a_result_and_not_repeated(kind: int) -> None:
    bench = Bench(Config(kind=kind)).ready()
    form = KINDS[kind]

    def refuse(request: bytes) -> bytes:
        if request[1] <= 4:
            return counted(request, 0)
        if form.error_function:
            return bytes([request[0], form.error_function]) + form.error_address.to_bytes(2, "big") + b"\x00\x04"
        return bytes([request[0], request[1] + form.exception_add, 4])

    bench.drives[1].answer = refuse
    bench.ask(1, PARAMETER, 6, 0x0123)
    sent = bench.run(60)
    bench.drives[1].answer = None
    assert bench.answer(1, PARAMETER) == "REFUSED"
    assert (bench.slot(1, "RefusedAddress"), bench.slot(1, "RefusedReason"), bench["Retries"]) == (0x0123, 4, 0)
    assert len([each for each in sent if each.pdu[1] == 6]) == 1


def test_a_fault_reset_is_sent_once() -> None:
    bench = Bench().ready()
    bench.put(1, ResetAsked=True)
    bench.drives[1].alive = False
    bench.command(1)
    resets = [each for each in bench.run(600) if each.unit == 2 and not each.read]
    assert (len(resets), bench.answer(1, COMMAND)) == (1, "SILENCE")


# ---------------------------------------------------------------- echo


def test_an_echo_is_found_by_reads_and_never_believed() -> None:
    bench = Bench(Config(echo=True)).ready()
    assert bench["Echo"] == 2
    bench.command(1)
    bench.run(100)
    assert bench.answer(1, COMMAND) == "OK"
    bench.drives[1].alive = False
    bench.stop(1)
    bench.run(200)
    assert bench.answer(1, STOP) == "", "only the echo has answered"
    assert bench["ForeignFrames"] == 0


def test_until_the_echo_is_known_only_reads_and_stops_are_sent_and_no_stop_is_believed() -> None:
    bench = Bench(Config(drives=1, echo=True))
    bench.drives[0].alive = False
    bench.fill(0, 3, 6, 0x2000)
    bench.stop(0)
    bench.command(0)
    assert {each.stop for each in bench.run(1000)} == {True}, "a poll that is no read decides nothing, and never leaves"
    assert bench["Echo"] == 0
    assert bench.answer(0, STOP) == ""


def test_the_same_read_of_another_master_is_no_echo() -> None:
    """The stop after it was not believed, and overdue after its retries."""
    bench = Bench(Config(drives=1)).ready()
    before = len(bench.sent)
    while not any(each.read for each in bench.sent[before:]):
        bench.scan()
    bench.foreign(bytes([bench.sent[-1].unit]) + bench.sent[-1].pdu[1:])
    bench.run(20)
    assert bench["ForeignFrames"] == 1
    bench.command(0)
    bench.run(300)
    assert (bench["Echo"], bench.answer(0, COMMAND)) == (1, "OK")


def test_a_read_whose_reply_can_equal_its_request_decides_nothing() -> None:
    bench = Bench(Config(words=1))
    for slot in range(3):
        bench.put(slot, TwoByteCount=True, OtherQuantity=0)
        bench.fill(slot, 3, 3, 0x0002)
        bench.drives[slot].answer = lambda request: request[:2] + b"\x00\x02\x00\x01"
    bench.run(1000)
    assert bench["Echo"] == 0


# ---------------------------------------------------------------- late replies


def test_a_late_reply_is_waited_out_dropped_and_followed_by_another_quantity() -> None:
    bench = Bench(Config(drives=1, longest_ms=100)).ready()
    bench.drives[0].turn_us = 60_000
    while bench["Timeouts"] == 0:
        bench.scan()
    bench.drives[0].turn_us = None
    fresh = bench.slot(0, "Fresh")
    assert bench.run(80) == []
    assert bench.slot(0, "Fresh") == fresh
    assert bench.slot(0, "Late") == 1
    bench.run(30)
    assert bench.sent[-1].pdu[5] == 7
    bench.run(30)
    assert bench.slot(0, "PollWords[0]") >= bench.drives[0].reads - 1


def test_a_wait_for_a_late_reply_is_never_shortened_and_keeps_nobody_else() -> None:
    bench = Bench(Config(drives=2, longest_ms=500)).ready()
    bench.drives[0].turn_us = 60_000
    while bench["Timeouts"] == 0:
        bench.scan()
    bench.drives[0].turn_us = None
    others = bench.run(480)
    assert {each.unit for each in others} == {2}
    assert len(others) > 20
    assert 1 in {each.unit for each in bench.run(60)}


# ---------------------------------------------------------------- strangers


@pytest.mark.parametrize(
    ("frame", "counted"),
    [
        (bytes([9, 6, 0x20, 0, 0, 2]), 1),
        (bytes([9, 3, 4, 1, 2, 3, 4]), 1),
        (bytes([9, 16, 0x20, 0, 0, 2, 4, 1, 2, 3, 4]), 1),
        (bytes([9, 0x83, 2]), 1),
        (bytes([9, 0x41, 2, 1]), 0),
    ],
)
@pytest.mark.parametrize("ascii_", [False, True])
def test_frames_that_nobody_asked_for_are_counted(frame: bytes, counted: int, ascii_: bool) -> None:
    bench = Bench(Config(drives=1, ascii=ascii_))
    bench.put(0, PollEveryMs=500)
    bench.ready().run(300)
    before = bench["ForeignFrames"]
    while bench["Exchange.Phase"] or bench["Exchange.QuietMs"] < 100 or bench["Track[0].Life.PauseMs"] < 200:
        bench.scan()
    bench.now += bench.chance.randrange(9000)  # so that it may be split between two scans
    bench.foreign(frame)
    bench.run(100)
    assert bench["ForeignFrames"] == before + counted


def test_the_inside_of_a_good_reply_is_no_foreign_frame() -> None:
    """Six bytes of a reply and the two after them that happen to be their checksum."""
    bench = Bench(Config(drives=1))
    head = bytes([1, 3, 12, 1, 2, 3])
    from driveblocks.reference.checksum import crc16

    inner = head + crc16(head).to_bytes(2, "little")
    bench.drives[0].answer = lambda request: inner + bytes(15 - len(inner)) if request[5] == 6 else None
    bench.run(2000)
    assert bench.slot(0, "Fresh") > 50
    assert bench["ForeignFrames"] == 0


class Turning(Bench):
    """A port that hears a character before each frame."""

    def transmit(self, text: bytes, start: int, whole: bool = True) -> int:
        return super().transmit(b"\x00" + text, start - self._us(1), whole)


@pytest.mark.parametrize("echo", [False, True])
def test_a_character_before_each_reply_hides_no_echo_and_is_none(echo: bool) -> None:
    """Commands waited for ever for what the echo is, and no stop was believed."""
    bench = Turning(Config(drives=2, echo=echo)).ready()
    assert bench["Echo"] == (2 if echo else 1)
    bench.command(0)
    bench.stop(1)
    bench.run(300)
    assert (bench.answer(0, COMMAND), bench.answer(1, STOP)) == ("OK", "OK")
    bench.drives[0].answer = lambda request: counted(request, 1) if request[1] <= 4 else None
    bench.command(0)
    bench.run(600)
    assert bench.answer(0, COMMAND) == "SILENCE", "no echo is believed"
    bench.stop(0)
    bench.run(200)
    assert bench.answer(0, STOP) == ""


def late_reader(config: Config) -> Bench:
    """The registers of the first drive hold their address, and all its reads have one length."""
    bench = Bench(config)
    bench.put(0, OtherQuantity=config.words)
    bench.drives[0].answer = lambda each: counted(each, int.from_bytes(each[2:4], "big")) if each[1] <= 4 else each[:6]
    bench.run(5000)
    return bench


def asked_late(bench: Bench, turn_ms: int) -> None:
    """One read of the first drive is answered late, and the next after nearly all the time that it has."""
    bench.drives[0].turn_us, before = 1000 * turn_ms, len(bench.sent)
    while not any(each.unit == 1 for each in bench.sent[before:]):
        bench.scan()
    bench.drives[0].turn_us = 900 * bench.config.turn_ms


def taken(bench: Bench) -> set[int]:
    """What is taken for the reply to the first drive's next read, which is one of other registers."""
    bench.ask(0, POLL, 3, 0x3000, quantity=bench.config.words)
    words: set[int] = set()
    for _ in range(200):
        bench.scan()
        if bench.answer(0, POLL) == "OK":
            words.add(bench.slot(0, "PollWords[0]"))
    return words


def test_after_a_restart_the_open_request_has_its_time_on_the_wire_too() -> None:
    """At 4800 bit/s that is 17 ms; a reply of 60 ms came after a wait of 60."""
    bench = late_reader(Config(drives=1, rate=4800, longest_ms=60))
    asked_late(bench, 60)
    bench.set(Restart=True)
    bench.scan()
    bench.set(Restart=False)
    assert taken(bench) == {0x3000}


def test_the_late_reply_of_a_dead_drive_ends_no_wait_for_anothers() -> None:
    bench = late_reader(Config(drives=2, turn_ms=50, longest_ms=500))
    bench.drives[1].alive = False
    bench.stop(1)
    bench.run(6000)
    assert not bench.slot(1, "Online")
    while not 0 < bench["Track[1].Stop.AgainMs"] <= 40:
        bench.scan()
    bench.drives[1].alive, bench.drives[1].turn_us = True, 100_000
    asked_late(bench, 320)
    while bench.sent[-1].unit != 2:
        bench.scan()
    bench.run(60)
    assert taken(bench) == {0x3000}


def test_a_new_address_ends_no_wait_for_anothers_late_reply() -> None:
    """One whose replies take 100 ms at most set the wait of 950 ms to 100."""
    bench = late_reader(Config(drives=2, turn_ms=50, longest_ms=100))
    bench.put(0, LongestMs=1000)
    bench.put(1, StopConfirmed=True)
    asked_late(bench, 255)
    while not bench["Track[0].Life.WaitMs"]:
        bench.scan()
    bench.stop(1)
    while (bench["OpenSlot"], bench["Exchange.Phase"]) != (1, 2):
        bench.scan()
    bench.put(1, UnitAddress=9)
    bench.scan()
    assert taken(bench) == {0x3000}
