"""Replies against a request: the field that does not match, echoes, and requests that are none."""

from contextlib import suppress

import pytest
from tests.desk.explain.explaining import Explain, rtu

from driveblocks.maps.problem import Refused

READ = "01 03 20 00 00 01 8F CA"
RUN = "01 06 10 00 00 01 4C CA"


@pytest.mark.parametrize(
    ("frame", "request_frame", "wrong", "perhaps"),
    [
        (rtu("02 03 02 01 F4"), READ, "unit: 2 answers, and unit 1 was asked", "two have the same address"),
        (RUN, READ, "function: 06H answers, and 03H was asked", "a late reply"),
        (rtu("01 83 02"), rtu("01 03 20 00 00 01"), "", ""),
        (rtu("01 03 04 01 F4 00 00"), READ, "byte count: 4; the request asks for 1 register", "a late reply"),
        (rtu("01 03 00 02 01 F4"), READ, "byte count: 2; the request asks for 1 register, so", "two-byte count"),
        (rtu("01 03 02 01"), READ, "length: 4 bytes before the checksum", "truncated: 1 byte missing"),
        (rtu("01 06 10 00 00"), RUN, "length: 5 bytes before the checksum", "truncated: 1 byte missing"),
        (rtu("01 06 10 00 00 01 02"), RUN, "length: 7 bytes before the checksum", "1 byte too many"),
        (rtu("01 06 10 01 00 01"), RUN, "address: 1001H answers, and 1000H was asked", "a late reply"),
        (rtu("01 06 00 10 00 01"), RUN, "address: 0010H answers, and 1000H was asked", "its bytes are swapped"),
        (rtu("01 06 10 00 00 02"), RUN, "value: 0002H answers, and 0001H was asked", "a late reply"),
        (rtu("01 10 10 00 00 01"), rtu("01 10 10 00 00 02 04 00 01 00 00"), "quantity: 0001H answers", "a late reply"),
        (READ, READ, "this is the request itself", "half-duplex echo"),
        (rtu("01 03 30 00 00 01"), READ, "byte count: 48; the request asks", "this is a request, not a reply"),
        (":01030201F405", READ, "this is ASCII, and the request was sent in RTU", ""),
        (":01030201F405", ":010320000001DB", "", ""),
    ],
)
def test_jscc(explain: Explain, frame: str, request_frame: str, wrong: str, perhaps: str) -> None:
    made = explain("JSCC", frame, request_frame)
    assert made.good is not bool(wrong)
    told = " | ".join(one.what for one in made.all_wrongs)
    assert wrong in told
    assert perhaps in " | ".join(each for one in made.all_wrongs for each in one.instead)


@pytest.mark.parametrize(
    ("prefix", "frame", "request_frame", "wrong"),
    [
        ("SN300G5", rtu("01 08 00 00 12 AA"), rtu("01 08 00 00 12 AB"), "value: 12AAH answers, and 12ABH was asked"),
        ("SN300G5", rtu("01 08 00 01 12 AB"), rtu("01 08 00 00 12 AB"), "sub-function: 0001H answers, and 0000H"),
        ("CHF", rtu("00 06 10 00 00 05"), rtu("00 06 10 00 00 05"), "the request was a broadcast, and nobody answers"),
        ("CHF", rtu("01 83 02"), rtu("01 03 00 04 00 02"), "function: 83H answers, and 03H was asked"),
    ],
)
def test_other_drives(explain: Explain, prefix: str, frame: str, request_frame: str, wrong: str) -> None:
    made = explain(prefix, frame, request_frame)
    assert not made.good
    assert wrong in made.all_wrongs[0].what


@pytest.mark.parametrize(
    ("body", "asked", "wrong"),
    [
        ("01 01 02 FF 03", "01 01 00 00 00 0A", ""),
        ("01 01 01 FF", "01 01 00 00 00 0A", "byte count: 1; the request asks for 10 coils, so it is 2"),
        ("01 0F 00 13 00 0A", "01 0F 00 13 00 0A 02 CD 01", ""),
        ("01 07 6D", "01 07", ""),
    ],
)
def test_what_the_standard_alone_knows(explain: Explain, body: str, asked: str, wrong: str) -> None:
    made = explain("", rtu(body), rtu(asked))
    assert [one.what for one in made.all_wrongs] == ([wrong] if wrong else [])


def test_a_refusal_whatever_was_asked(explain: Explain) -> None:
    made = explain("CHF", "01 06 50 01 00 05 09 09", "01 03 00 04 00 02 85 CA")
    assert made.good
    assert made.readings[0].says == "reply of unit 1: refuses, reason 05H Illegal data  非法数据"


def test_an_echo_before_the_reply(explain: Explain) -> None:
    made = explain("JSCC", READ + " 01 03 02 01 F4 B8 53", READ)
    assert not made.good
    assert [one.good for one in made.inside] == [True, True]
    (held,) = made.inside[1].readings[0].registers
    assert (held.address, str(held.value)) == (0x2000, "50.0")


def test_the_echo_of_a_single_write_looks_like_its_reply(explain: Explain) -> None:
    made = explain("JSCC", RUN, RUN)
    assert made.good
    assert "an adapter that hears itself would show the same" in made.notes[0]


def test_a_good_reply_to_what_the_map_does_not_list(explain: Explain) -> None:
    made = explain("JSCC", rtu("01 06 40 00 00 01"), rtu("01 06 40 00 00 01"))
    assert made.good
    assert "The map speaks against this: 4000H may not be written" in made.readings[0].notes[0]


def test_a_wrong_reply_is_repaired_and_read_with_the_names_of_the_request(explain: Explain) -> None:
    made = explain("JSCC", "01 03 02 01 F4 53 B8", READ)
    assert not made.good
    assert made.readings[0].registers[0].name == "Output frequency"


@pytest.mark.parametrize(
    ("request_frame", "message"),
    [
        ("01 03 02 01 F4 B8 53", "request:1:1: this is no good request: it reads as a reply"),
        ("01 03 20 00 00 01 CA 8F", "request:1:1: this is no good request: the CRC does not fit"),
        ("01 03 2G", "request:1:8: `G` is no hexadecimal digit"),
        (rtu("01 10 20 00 00 80"), "request:1:1: this is no good request: "),
        (rtu("01 10 20 00 00 80 00"), "request:1:1: this is no good request: "),
        (rtu("01 10 20 00 00 80 00" + " 00" * 256), "request:1:1: this is no good request: "),
        (rtu("01 03 20 00 00"), "request:1:1: this is no good request: "),
    ],
)
def test_requests_that_are_none(explain: Explain, request_frame: str, message: str) -> None:
    with pytest.raises(Refused) as caught:
        explain("JSCC", "01 03 02 01 F4 B8 53", request_frame)
    assert str(caught.value).startswith(message)


@pytest.mark.parametrize("quantity", [0, 1, 127, 128, 200, 0x7FFF, 0x8000, 0xFFFF])
@pytest.mark.parametrize("function", [1, 3, 4, 15])
def test_a_request_of_any_quantity_is_compared(explain: Explain, function: int, quantity: int) -> None:
    request = rtu(f"01 {function:02X} 20 00 {quantity:04X}" + (" 02 00 00" if function == 15 else ""))
    for reply in (rtu("01 03 02 01 F4"), rtu(f"01 {function:02X} 20 00 {quantity:04X}"), rtu("01 04 00 01")):
        with suppress(Refused):
            assert explain("", reply, request).asked
