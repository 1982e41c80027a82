"""Coils, discrete inputs and input registers on the line, on every engine: reads by 01H, 02H and 04H, writes by 05H."""

import pytest
from tests.line.drives import KINDS, counted
from tests.line.vline import COMMAND, PARAMETER, POLL, Bench, Config, line_sources

from structured_text.engines.engine import Engine, Library

COILS = next(index for index, kind in enumerate(KINDS) if kind.stop_function == 5)
LINES: dict[str, Library] = {}
"""Lines by engine, built once."""
BITS = 0b1010_0110_1100_1011
"""Coils of a drive, the first as the lowest bit: no byte of them is another, none is the same in reverse."""


def coils(engine: Engine, config: Config | None = None) -> Bench:
    """A line whose drives have coils."""
    library = LINES.setdefault(engine.name, engine.build(line_sources()))
    return Bench(config or Config(kind=COILS), block=library.instance("MB_Line8"))


def hold(bench: Bench) -> Bench:
    """Drives whose coils do not change: reply `BITS`, as many as are asked for, filled up with 0."""

    def reply(request: bytes) -> bytes:
        count = request[5]
        data = (BITS & ((1 << count) - 1)).to_bytes((count + 7) // 8, "little")
        return request[:2] + bytes([len(data)]) + data if request[1] <= 2 else request[:6]

    for drive in bench.drives:
        drive.answer = reply
    return bench


@pytest.mark.parametrize("ascii_", [False, True])
def test_coils_are_bits_of_one_word_the_first_the_lowest(engine: Engine, ascii_: bool) -> None:
    bench = hold(coils(engine, Config(kind=COILS, ascii=ascii_))).ready()
    for function in (1, 2):
        for count in (1, 7, 8, 9, 16):
            bench.put(0, OtherQuantity=0, **{"PollWords[0]": 0x5A5A})
            bench.ask(0, POLL, function, 0x0011, quantity=count)
            sent = bench.run(250)
            assert bytes([1, function, 0, 0x11, 0, count]) in [each.pdu for each in sent]
            assert (bench.slot(0, "PollWords[0]"), bench.slot(0, "PollCount")) == (BITS & ((1 << count) - 1), count)
    assert bench["Timeouts"] == bench["Bad"] == bench["ForeignFrames"] == 0


def test_coils_of_a_parameter_are_a_word_too(engine: Engine) -> None:
    bench = hold(coils(engine)).ready()
    bench.ask(1, PARAMETER, 2, 0x0020, quantity=4)
    bench.run(60)
    assert bench.answer(1, PARAMETER) == "OK"
    assert bench.slot(1, "ParWords[0]") == BITS & 0xF


@pytest.mark.parametrize(("count", "data"), [(8, b"\x01\x02"), (9, b"\x01"), (9, b"\x01\x02\x03"), (16, b"\x01" * 32)])
def test_a_reply_with_the_bytes_of_another_count_is_not_believed(engine: Engine, count: int, data: bytes) -> None:
    bench = hold(coils(engine)).ready()
    bench.drives[0].answer = lambda request: request[:2] + bytes([len(data)]) + data
    bench.put(0, OtherQuantity=0)
    bench.ask(0, POLL, 1, 0x0011, quantity=count)
    bench.run(40)
    fresh = bench.slot(0, "Fresh")
    bench.run(200)
    assert bench.slot(0, "Fresh") == fresh
    assert bench["Timeouts"] + bench["Bad"] > 0


def test_a_coil_is_written_by_one_frame_whatever_quantity_was_asked_for(engine: Engine) -> None:
    bench = coils(engine).ready()
    bench.ask(1, COMMAND, 5, 0x0001, quantity=3, word=0xFF00)
    sent = [each.pdu for each in bench.run(100) if each.unit == 2 and not each.read]
    assert sent == [bytes([2, 5, 0, 1, 0xFF, 0])]
    assert bench.answer(1, COMMAND) == "OK"


@pytest.mark.parametrize("wrong", [b"\x00\x01\x00\x00", b"\x00\x02\xff\x00"])
def test_the_reply_to_a_write_repeats_coil_and_value(engine: Engine, wrong: bytes) -> None:
    bench = coils(engine).ready()
    bench.drives[1].answer = lambda request: request[:2] + wrong if request[1] == 5 else counted(request, 1)
    bench.ask(1, COMMAND, 5, 0x0001, word=0xFF00)
    bench.run(700)
    assert bench.answer(1, COMMAND) in ("SILENCE", "CHECKSUM")


def test_the_other_stop_is_a_coil_too(engine: Engine) -> None:
    bench = coils(engine).ready()
    bench.put(1, JogStopRegister=0x0005, JogStopWord=0, JogStop=1)
    bench.run(50)
    bench.set(StopAll=True)
    sent = [each.pdu for each in bench.run(2000) if each.unit == 2 and not each.read]
    assert sent == [bytes([2, 5, 0, 0, 0, 0]), bytes([2, 5, 0, 5, 0, 0])]


def test_what_no_line_sends(engine: Engine) -> None:
    bench = coils(engine).ready()
    for box, function, quantity in ((COMMAND, 15, 1), (PARAMETER, 1, 5), (PARAMETER, 15, 1)):
        bench.ask(1, box, function, 0x0001, quantity=quantity)
        bench.run(60)
        assert bench.answer(1, box) == "REQUEST"
