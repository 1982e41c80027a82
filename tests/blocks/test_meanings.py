"""Decoders, scales, fault numbers, standstill and texts of every drive on every engine."""

import pytest
from tests.blocks import meanings
from tests.blocks.library import built
from tests.shipped import drives

from driveblocks.maps.model import Drive, Register
from driveblocks.reference.naming import name_of
from driveblocks.render.results import RESULTS
from structured_text.engines.engine import Engine

pytestmark = pytest.mark.every_family

DRIVES = pytest.mark.parametrize("drive", drives().values(), ids=list(drives()))
DECODED = [(drive, row) for drive in drives().values() for row in meanings.decoded(drive)]
SCALED = [(drive, row) for drive in drives().values() for row in meanings.scaled(drive)]


def ids(pairs: list[tuple[Drive, Register]]) -> list[str]:
    """Drive and register as the name of a test."""
    return [f"{drive.prefix}-{name_of(row)}" for drive, row in pairs]


@pytest.mark.parametrize(("drive", "row"), DECODED, ids=ids(DECODED))
def test_decoder(engine: Engine, drive: Drive, row: Register) -> None:
    meanings.assert_decoder(built(engine), drive, row)


@pytest.mark.parametrize(("drive", "row"), SCALED, ids=ids(SCALED))
def test_scale(engine: Engine, drive: Drive, row: Register) -> None:
    meanings.assert_scale(built(engine), drive, row)


@DRIVES
def test_standstill_is_proven_by_all_conditions_at_once_and_by_nothing_less(engine: Engine, drive: Drive) -> None:
    meanings.assert_standstill(built(engine), drive)


STANDS = [
    ("SN300G5", {"DriveStatusWord": 0x0002, "OutputFrequencyWord": 0}, True),
    ("SN300G5", {"DriveStatusWord": 0x0003, "OutputFrequencyWord": 0}, False),
    ("SN300G5", {"DriveStatusWord": 0x0002, "OutputFrequencyWord": 1}, False),
    ("SN300G5", {"DriveStatusWord": 0x0000, "OutputFrequencyWord": 0}, False),
    ("JSCC", {"DriveStatusWord": 4, "OutputFrequencyWord": 0}, True),
    ("JSCC", {"DriveStatusWord": 1, "OutputFrequencyWord": 0}, False),
    ("JSCC", {"DriveStatusWord": 4, "OutputFrequencyWord": 1}, False),
    ("CHF", {"DriveStatusWord": 3, "RunningFrequencyWord": 0}, True),
    ("CHF", {"DriveStatusWord": 3, "RunningFrequencyWord": 1}, False),
    ("CHF", {"DriveStatusWord": 1, "RunningFrequencyWord": 0}, False),
]


@pytest.mark.parametrize(("prefix", "pins", "wanted"), STANDS)
def test_standstill_of_the_manuals(engine: Engine, prefix: str, pins: dict[str, int], wanted: bool) -> None:
    assert built(engine).run(f"{prefix}_Standstill", pins)["StandstillProven"] is wanted


@pytest.mark.parametrize("drive", [drive for drive in drives().values() if drive.faults.bits], ids=lambda d: d.prefix)
def test_fault_numbers(engine: Engine, drive: Drive) -> None:
    meanings.assert_fault_number(built(engine), drive)


@DRIVES
def test_texts_of_faults_and_refusals(engine: Engine, drive: Drive) -> None:
    meanings.assert_code_texts(built(engine), drive)


@DRIVES
def test_texts_of_bits_and_values(engine: Engine, drive: Drive) -> None:
    meanings.assert_bit_texts(built(engine), drive)
    meanings.assert_value_texts(built(engine), drive)


def test_texts_of_results(engine: Engine) -> None:
    blocks = built(engine)
    for result in RESULTS:
        assert blocks.call("MB_ResultTextEn", {"Code": result.code}) == result.en.encode()
        assert blocks.call("MB_ResultTextZh", {"Code": result.code}) == result.zh.encode()
    assert blocks.call("MB_ResultTextEn", {"Code": 39}) == b"unknown code"
    assert blocks.call("MB_ResultTextZh", {"Code": 65535}) == "未知代码".encode()
