"""Reply blocks on every engine: each result one by one, and replies at random against the reference model."""

import random
from dataclasses import replace

import pytest
from tests.blocks import answering, wire
from tests.blocks.library import Blocks, built
from tests.shipped import drives

from driveblocks.maps.model import Drive
from driveblocks.reference.reply import Answer, Dialect, dialect, parse
from driveblocks.reference.request import Asked
from structured_text.engines.engine import Engine

DRIVES = pytest.mark.parametrize("prefix", drives())
BEHIND = (b"\x00", b"\x00\x00", b"\xff", b"0", b":", b"\r\n")
READ = Asked(3, 1, 0x2000, 2)
WRITE = Asked(6, 1, 0x1000, value=5)
SEVERAL = Asked(16, 1, 0x0100, 2)
LOOP = Asked(8, 1, value=0x1234)

RESULTS = [
    (READ, "01 03 04 01 F4 00 05", Answer("OK", (0x01F4, 5))),
    (Asked(4, 1, 0, 1), "01 04 02 01 F4", Answer("OK", (0x01F4,))),
    (replace(READ, function=0), "01 03 04 01 F4 00 05", Answer("NO_REQUEST")),
    (replace(READ, quantity=0), "01 03 00", Answer("NO_REQUEST")),
    (replace(READ, quantity=0), "01 83 02", Answer("NO_REQUEST")),
    (replace(READ, quantity=126), "01 03 FC" + 252 * " 00", Answer("NO_REQUEST")),
    (replace(WRITE, quantity=0), "01 06 10 00 00 05", Answer("NO_REQUEST")),
    (replace(LOOP, quantity=0), "01 08 00 00 12 34", Answer("NO_REQUEST")),
    (replace(SEVERAL, quantity=0), "01 10 01 00 00 00", Answer("NO_REQUEST")),
    (replace(WRITE, unit=0), "00 06 10 00 00 05", Answer("BROADCAST")),
    (READ, "", Answer("SHORT")),
    (READ, "01 03", Answer("SHORT")),
    (READ, "02 03 04 01 F4 00 05", Answer("OTHER_UNIT")),
    (READ, "01 06 04 01 F4 00 05", Answer("OTHER_FUNCTION")),
    (READ, "01 04 04 01 F4 00 05", Answer("OTHER_FUNCTION")),
    (READ, "01 86 02", Answer("OTHER_FUNCTION")),
    (READ, "01 83 02", Answer("REFUSED", reason=2)),
    (READ, "01 83 02 00", Answer("LONG")),
    (READ, "01 03 02 01 F4 00 05", Answer("BYTE_COUNT")),
    (READ, "01 03 06 01 F4 00 05", Answer("BYTE_COUNT")),
    (READ, "01 03 04 01 F4 00", Answer("SHORT")),
    (READ, "01 03 04 01 F4 00 05 00", Answer("LONG")),
    (READ, "01 03 00 04 01 F4 00 05", Answer("BYTE_COUNT")),
    (WRITE, "01 06 10 00 00 05", Answer("OK")),
    (WRITE, "01 06 10 00 00", Answer("SHORT")),
    (WRITE, "01 06 10 00 00 05 00", Answer("LONG")),
    (WRITE, "01 06 10 01 00 05", Answer("OTHER_ADDRESS")),
    (WRITE, "01 06 10 00 00 06", Answer("OTHER_VALUE")),
    (WRITE, "01 06 50 01 00 05", Answer("OTHER_ADDRESS")),
    (WRITE, "01 86 03", Answer("REFUSED", reason=3)),
    (LOOP, "01 08 00 00 12 34", Answer("OK")),
    (LOOP, "01 08 00 01 12 34", Answer("OTHER_SUB_FUNCTION")),
    (LOOP, "01 08 00 00 12 35", Answer("OTHER_VALUE")),
    (SEVERAL, "01 10 01 00 00 02", Answer("OK")),
    (SEVERAL, "01 10 01 01 00 02", Answer("OTHER_ADDRESS")),
    (SEVERAL, "01 10 01 00 00 03", Answer("OTHER_QUANTITY")),
    (SEVERAL, "01 90 FF", Answer("REFUSED", reason=255)),
]


@pytest.mark.parametrize(("asked", "body", "wanted"), RESULTS)
def test_each_result_of_the_generic_parser(engine: Engine, asked: Asked, body: str, wanted: Answer) -> None:
    data = bytes.fromhex(body)
    found = wire.parse(built(engine), "MB_ParseReply", wire.opened(asked), data, ExceptionAdd=128)
    assert found == wanted
    assert parse(Dialect(), asked, data) == wanted


def test_a_length_beyond_the_frame_is_no_reply(engine: Engine) -> None:
    body = bytes.fromhex("01 03 04") + bytes(300)
    for length in (255, 256, 65535):
        done = built(engine).run(
            "MB_ParseReply", {"Length": length, "Adu": body[:256], **{"Request.FunctionCode": 3, "Request.Quantity": 2},
                              "Request.UnitAddress": 1}
        )  # fmt: skip
        assert done["ErrorID"] == 22


CHF_RESULTS = [
    # CHF refuses by a reply of function 06H for 5001H, whatever was asked
    (Asked(3, 1, 0x3000, 1), "01 06 50 01 00 04", Answer("REFUSED", reason=4)),
    (Asked(6, 1, 0x1000, value=1), "01 06 50 01 00 08", Answer("REFUSED", reason=8)),
    (Asked(8, 1), "01 06 50 01 12 34", Answer("REFUSED", reason=0x1234)),
    (Asked(6, 1, 0x5001, value=4), "01 06 50 01 00 04", Answer("OK")),
    (Asked(6, 1, 0x5001, value=4), "01 06 50 01 00 05", Answer("OTHER_VALUE")),
    (Asked(3, 1, 0x3000, 1), "01 06 50 02 00 04", Answer("OTHER_FUNCTION")),
    (Asked(3, 1, 0x3000, 1), "01 06 50 01 00", Answer("OTHER_FUNCTION")),
    (Asked(3, 1, 0x3000, 1), "01 06 50 01 00 05 00", Answer("OTHER_FUNCTION")),
    (Asked(6, 1, 0x1000, value=3), "01 06 50 01 00 05 00", Answer("LONG")),
    (Asked(3, 1, 0x3000, 1), "02 06 50 01 00 04", Answer("OTHER_UNIT")),
    (Asked(3, 1, 0x3000, 1), "01 83 02", Answer("OTHER_FUNCTION")),
]


@pytest.mark.parametrize(("asked", "body", "wanted"), CHF_RESULTS)
def test_refusals_by_a_write_reply(engine: Engine, asked: Asked, body: str, wanted: Answer) -> None:
    data = bytes.fromhex(body)
    assert wire.parse(built(engine), "CHF_Reply", wire.opened(asked), data) == wanted
    assert parse(dialect(drives()["CHF"]), asked, data) == wanted


def test_a_two_byte_count_is_taken_only_where_the_map_says_so(engine: Engine) -> None:
    body = bytes.fromhex("01 03 00 04 01 F4 00 05")
    for prefix, drive in drives().items():
        tolerant = any(one.kind == "two_byte_count" for one in drive.tolerances)
        found = wire.parse(built(engine), f"{prefix}_Reply", wire.opened(READ), body)
        assert found == (Answer("OK", (0x01F4, 5)) if tolerant else Answer("BYTE_COUNT"))


def check(blocks: Blocks, prefix: str, dialect: Dialect, asked: Asked, body: bytes) -> str:
    """One reply against the reference; answers the result's name."""
    found = wire.parse(blocks, f"{prefix}_Reply", wire.opened(asked), body)
    assert found == parse(dialect, asked, body), (asked, body.hex(" "), found)
    return found.result


def assert_by_chance(blocks: Blocks, drive: Drive, count: int) -> set[str]:
    """Right and wrong replies at random; answers the names of all results seen."""
    spoken, chance, seen = dialect(drive), random.Random(drive.prefix), set()
    unit, places = drive.serial.unit.min, [0, 0x1000, spoken.address or 0]
    for _ in range(count):
        asked = answering.questions(chance.choice([unit, unit, unit + 6]), [3, 4, 6, 8, 16], 16, places, chance)
        body = answering.good(spoken, asked, chance)
        other = answering.good(spoken, replace(asked, function=chance.choice([3, 6, 16])), chance)
        if chance.random() < 0.2:
            body = answering.refusal(spoken, asked, chance.randrange(256))
        if chance.random() < 0.7:
            body = answering.spoilt(body, other, chance)
        seen.add(check(blocks, drive.prefix, spoken, asked, body))
    return seen


@DRIVES
def test_random_replies_are_judged_as_by_the_reference(engine: Engine, prefix: str) -> None:
    seen = assert_by_chance(built(engine), drives()[prefix], 1200)
    assert {"OK", "REFUSED", "SHORT", "LONG", "BYTE_COUNT", "OTHER_FUNCTION", "OTHER_VALUE", "OTHER_ADDRESS"} <= seen


@DRIVES
@pytest.mark.parametrize("ascii_mode", [False, True], ids=["rtu", "ascii"])
def test_any_single_changed_bit_of_a_frame_is_noticed(engine: Engine, prefix: str, ascii_mode: bool) -> None:
    spoken, chance, blocks = dialect(drives()[prefix]), random.Random(prefix), built(engine)
    for asked in (READ, WRITE, SEVERAL, LOOP, Asked(3, 1, 0, 16)):
        frame = wire.frame(blocks, answering.good(spoken, asked, chance), ascii_mode=ascii_mode)
        request = wire.opened(asked)
        assert wire.receive(blocks, prefix, request, frame, ascii_mode=ascii_mode).result == "OK"
        for at in range(len(frame)):
            for bit in range(8):
                changed = frame[:at] + bytes([frame[at] ^ 1 << bit]) + frame[at + 1 :]
                assert wire.unframe(blocks, changed, ascii_mode=ascii_mode).result != "OK", (at, bit)
        # a CRC does not notice bytes 00H after a frame; the length that the request asks for does
        changed_lengths = [*(frame[:n] for n in range(len(frame))), *(frame + more for more in BEHIND)]
        for changed in changed_lengths:
            answer = wire.receive(blocks, prefix, request, changed, ascii_mode=ascii_mode)
            assert answer.result != "OK", changed
