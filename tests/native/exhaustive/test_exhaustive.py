"""The short form of every check on every line of matiec, and one mistake planted for each, which it must find."""

from collections.abc import Sequence
from dataclasses import replace

import pytest
from tests.blocks.library import sources
from tests.native.driver import lines
from tests.native.exhaustive import program
from tests.native.exhaustive.bench import Bench
from tests.native.exhaustive.checks import CHECKS, run

from driveblocks.host.engine import Source

NEEDS = "needs matiec: no line of it is found, `driveblocks doctor` says where it is looked for"

PLANTED = {
    "reference-CHF-speed": ("CHF_Reference", "* 10000.0;", "* 10001.0;"),
    "reference-CHF-maximum": ("CHF_Reference", "* 10000.0;", "* 10001.0;"),
    "reference-JSCC-speed": ("JSCC_Reference", "Count := Count + 0.5;", "Count := Count + 0.49;"),
    "reference-JSCC-maximum": ("JSCC_Reference", "Asked > MaximumHz", "Asked >= MaximumHz"),
    "reference-JSCC-scale": ("JSCC_Reference", "ReferenceScale <= 1.0E6", "ReferenceScale < 1.0E6"),
    "reference-SN300G5-speed": ("SN300G5_Reference", "Count > 65535.0", "Count > 65536.0"),
    "reference-SN300G5-maximum": ("SN300G5_Reference", "MaximumHz >= 0.0", "MaximumHz > 0.0"),
    "reference-words": ("CHF_Reference", "* 10000.0;", "* 10001.0;"),
    "replies": ("MB_ParseReply", "Length > 254", "Length > 255"),
    "request-blocks": ("SN300G5_Request", "UnitAddress > 32", "UnitAddress > 33"),
    "request-builders": ("MB_BuildWriteMultiple", "Quantity > 123", "Quantity > 124"),
    "decoders": ("SN300G5_FaultContents2", "WORD#16#0800", "WORD#16#0808"),
    "standstill": ("CHF_Standstill", "WORD#16#0003", "WORD#16#0002"),
    "place-texts": ("SN300G5_BitTextZh", "4:", "3:"),
    "opening": ("MB_AsciiDecode", "CharCount > 513", "CharCount > 514"),
    "sealing": ("MB_RtuSeal", "Length > 254", "Length > 255"),
    "packing": ("MB_UnpackChars8", "WORD#16#00FF", "WORD#16#007F"),
    "scales": ("JSCC_OutputFrequencyHz", "/ 10.0;", "/ 10.00001;"),
    "fault-numbers": ("SN300G5_FaultNumber", "WORD#16#0031", "WORD#16#0033"),
    "code-texts": ("JSCC_FaultTextEn", "unknown code", "unknown"),
    "permissions": ("CHF_CanWrite", "First >= 32768", "First >= 32767"),
    "checksums": ("MB_Crc16", "WORD#16#8081", "WORD#16#8082"),
    "digits": ("MB_HexDigit", "Number MOD 16", "Number MOD 15"),
}
"""For each check the change of a block that it must find. The rule of the references is in no block."""


@pytest.fixture(scope="module")
def benches() -> list[Bench]:
    """The driver of every line that is found."""
    found = [program.bench(engine) for engine in lines()]
    return found or pytest.skip(NEEDS)


@pytest.mark.parametrize("name", CHECKS)
def test_every_case_is_as_the_reference_says(benches: Sequence[Bench], name: str) -> None:
    report = run(name, benches, short=True)
    assert all(line.cases for line in report.lines)
    assert report.wrong == 0, str(report)


@pytest.fixture(scope="module")
def mistaken() -> list[Bench]:
    """One line, with the library in which each of these mistakes is planted."""
    engine = next(lines(), None)
    return [program.bench(engine, altered())] if engine else pytest.skip(NEEDS)


def altered() -> list[Source]:
    """The library with all mistakes. Raises AssertionError where a text to change is not there."""
    texts = {source.path: source for source in sources()}
    for block, old, new in dict.fromkeys(PLANTED.values()):
        path = next(path for path in texts if path.endswith(f"/{block}.st"))
        assert old in texts[path].text, (block, old)
        texts[path] = replace(texts[path], text=new.join(texts[path].text.rsplit(old, 1)))
    return [*texts.values()]


@pytest.mark.parametrize("name", PLANTED)
def test_planted_mistake_is_found(mistaken: Sequence[Bench], name: str) -> None:
    report = run(name, mistaken, short=True)
    assert report.wrong > 0
    assert any(line.examples for line in report.lines)


def test_every_check_of_blocks_has_a_planted_mistake() -> None:
    assert {*CHECKS} - {*PLANTED} == {"reference-rule"}
