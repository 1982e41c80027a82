"""Request blocks on every engine: each limit of each drive, against the reference model and named one by one."""

from dataclasses import replace

import pytest
from tests.blocks import wire
from tests.blocks.asking import Asking, assert_request
from tests.blocks.library import built, result
from tests.shipped import drives

from driveblocks.reference.request import Asked
from structured_text.engines.engine import Engine

DRIVES = pytest.mark.parametrize("prefix", drives())

READ = Asked(3, 1, 0x2000, 1)
LIMITS = [
    # the manuals' limits: 16 words (SN300G5, CHF), 25 data bytes (JSCC), ASCII at most 16 words (CHF)
    ("SN300G5", Asked(3, 1, 0x0020, 16), "OK"),
    ("SN300G5", Asked(3, 1, 0x0020, 17), "QUANTITY"),
    ("SN300G5", Asked(3, 1, 0x0020, 1, ascii=True), "MODE"),
    ("SN300G5", Asked(4, 1, 0x0020, 1), "FUNCTION"),
    ("SN300G5", Asked(3, 1, 0x0020, 0), "QUANTITY"),
    ("SN300G5", Asked(16, 1, 0x0100, 17, words=(0,) * 17), "QUANTITY"),
    ("SN300G5", Asked(6, 1, 0x0001), "FUNCTION"),
    ("SN300G5", Asked(8, 1, value=0x1234, sub_function=1), "SUB_FUNCTION"),
    ("SN300G5", Asked(8, 1, value=0x1234), "OK"),
    ("SN300G5", Asked(16, 1, 0x0020, 1, words=(1,)), "NOT_WRITABLE"),
    ("SN300G5", Asked(3, 0x20, 0x0026, 1), "OK"),
    ("SN300G5", Asked(3, 0x21, 0x0026, 1), "UNIT"),
    ("SN300G5", Asked(3, 0, 0x0026, 1), "NO_BROADCAST"),
    ("SN300G5", Asked(16, 0, 0x0000, 1, words=(1,)), "OK"),
    ("SN300G5", Asked(16, 0, 0x0006, 1, words=(1,)), "NO_BROADCAST"),
    ("SN300G5", Asked(3, 1, 0x0036, 2), "NOT_READABLE"),
    ("SN300G5", Asked(16, 1, 0xFFFD, 1, words=(0,)), "OK"),
    ("JSCC", Asked(3, 1, 0x0000, 12), "OK"),
    ("JSCC", Asked(3, 1, 0x0000, 13), "QUANTITY"),
    ("JSCC", Asked(16, 1, 0x0000, 10, words=(0,) * 10), "OK"),
    ("JSCC", Asked(16, 1, 0x0000, 11, words=(0,) * 11), "QUANTITY"),
    ("JSCC", Asked(3, 1, 0x2000, 1, ascii=True), "OK"),
    ("JSCC", Asked(3, 1, 0x1000, 1), "NOT_READABLE"),
    ("JSCC", Asked(6, 1, 0x2000), "NOT_WRITABLE"),
    ("JSCC", Asked(6, 0, 0x1000), "NO_BROADCAST"),
    ("JSCC", Asked(3, 248, 0x2000, 1), "UNIT"),
    ("JSCC", Asked(8, 1), "FUNCTION"),
    ("JSCC", Asked(3, 1, 0xFFFF, 2), "WRAP"),
    ("CHF", Asked(3, 1, 0x3000, 8), "OK"),
    ("CHF", Asked(3, 1, 0x3000, 17), "QUANTITY"),
    ("CHF", Asked(3, 1, 0x3000, 7, ascii=True), "OK"),
    ("CHF", Asked(3, 1, 0x3000, 8, ascii=True), "ASCII_LIMIT"),
    ("CHF", Asked(3, 1, 0x8007, 1), "NOT_READABLE"),
    ("CHF", Asked(6, 1, 0x81FF), "OK"),
    ("CHF", Asked(6, 1, 0x8200), "NOT_WRITABLE"),
    ("CHF", Asked(6, 1, 0x3000), "NOT_WRITABLE"),
    ("CHF", Asked(6, 0, 0x1000, value=5), "OK"),
    ("CHF", Asked(3, 0, 0x3000), "NO_BROADCAST"),
    ("CHF", Asked(16, 1, 0x1000, 1), "FUNCTION"),
]


@pytest.mark.parametrize(("prefix", "asked", "wanted"), LIMITS)
@pytest.mark.every_family
def test_limits_of_the_manuals(engine: Engine, prefix: str, asked: Asked, wanted: str) -> None:
    assert wire.build(built(engine), prefix, asked).built.result == wanted


@DRIVES
def test_every_limit_and_every_border_of_addresses(engine: Engine, prefix: str) -> None:
    asking, blocks = Asking(drives()[prefix]), built(engine)
    several = list(asking.limits())
    some = several if len(several) < 1500 else several[:: len(several) // 1500]
    seen = {assert_request(blocks, asking, asked) for asked in some}
    assert {"OK", "QUANTITY", "NOT_READABLE"} <= seen


@DRIVES
def test_random_requests_give_the_reference_bytes_or_its_result(engine: Engine, prefix: str) -> None:
    asking, blocks = Asking(drives()[prefix], engine.name), built(engine)
    seen = {assert_request(blocks, asking, asking.any()) for _ in range(800)}
    assert {"OK", "UNIT", "FUNCTION", "QUANTITY"} <= seen


BAD = [
    ("MB_BuildRead", {"UnitAddress": 0, "FunctionCode": 3, "Quantity": 1, "MaxWords": 125}, "UNIT"),
    ("MB_BuildRead", {"UnitAddress": 248, "FunctionCode": 3, "Quantity": 1, "MaxWords": 125}, "UNIT"),
    ("MB_BuildRead", {"UnitAddress": 1, "FunctionCode": 6, "Quantity": 1, "MaxWords": 125}, "FUNCTION"),
    ("MB_BuildRead", {"UnitAddress": 1, "FunctionCode": 3, "Quantity": 0, "MaxWords": 125}, "QUANTITY"),
    ("MB_BuildRead", {"UnitAddress": 1, "FunctionCode": 3, "Quantity": 126, "MaxWords": 65535}, "QUANTITY"),
    ("MB_BuildRead", {"UnitAddress": 1, "FunctionCode": 3, "Quantity": 17, "MaxWords": 16}, "QUANTITY"),
    (
        "MB_BuildRead",
        {"UnitAddress": 1, "FunctionCode": 4, "Quantity": 2, "Address": 0xFFFF, "MaxWords": 125},
        "WRAP",
    ),
    ("MB_BuildWriteSingle", {"UnitAddress": 248}, "UNIT"),
    ("MB_BuildWriteMultiple", {"UnitAddress": 248, "Quantity": 1, "MaxWords": 123}, "UNIT"),
    ("MB_BuildWriteMultiple", {"UnitAddress": 1, "Quantity": 0, "MaxWords": 123}, "QUANTITY"),
    ("MB_BuildWriteMultiple", {"UnitAddress": 1, "Quantity": 124, "MaxWords": 65535}, "QUANTITY"),
    ("MB_BuildWriteMultiple", {"UnitAddress": 1, "Quantity": 2, "Address": 0xFFFF, "MaxWords": 123}, "WRAP"),
    ("MB_BuildDiagnostics", {"UnitAddress": 0}, "UNIT"),
    ("MB_BuildDiagnostics", {"UnitAddress": 248}, "UNIT"),
]


@pytest.mark.parametrize(("block", "pins", "wanted"), BAD)
def test_generic_builders_alone_refuse_too(engine: Engine, block: str, pins: dict[str, int], wanted: str) -> None:
    done = built(engine).run(block, {**pins, "Request.FunctionCode": 3})
    assert (result(done), done["Length"], done["Request.FunctionCode"]) == (wanted, 0, 0)


def test_no_request_is_open_after_a_refused_one(engine: Engine) -> None:
    blocks = built(engine)
    sent = wire.build(blocks, "JSCC", replace(READ, quantity=13))
    assert wire.parse(blocks, "JSCC_Reply", sent.request, bytes.fromhex("010302 01F4")).result == "NO_REQUEST"
