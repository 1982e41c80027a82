"""The short form of every check on every line of matiec, and one mistake planted for each, which it must find."""

from collections.abc import Iterable, Sequence
from dataclasses import replace
from pathlib import Path

import pytest
from tests.blocks.library import Blocks, alone
from tests.native.driver import lines
from tests.native.exhaustive import __main__ as long
from tests.native.exhaustive import program, words
from tests.native.exhaustive.bench import Bench
from tests.native.exhaustive.checks import CHECKS, run
from tests.native.exhaustive.embedded import PARTS, embedded
from tests.native.exhaustive.permissions import ALLOWED
from tests.native.exhaustive.standstills import families
from tests.shipped import drives

from structured_text.engines.embedded import EmbeddedEngine
from structured_text.engines.engine import Source

NEEDS = "needs matiec: no line of it is found, `driveblocks doctor` says where it is looked for"

PLANTED = {
    "reference-CHF-speed": ("CHF_Reference", "* 10000.0;", "* 10001.0;"),
    "reference-CHF-maximum": ("CHF_Reference", "* 10000.0;", "* 10001.0;"),
    "reference-JSCC-speed": ("JSCC_Reference", "Count := Count + 0.5;", "Count := Count + 0.49;"),
    "reference-JSCC-maximum": ("JSCC_Reference", "AskedHz > Top", "AskedHz >= Top"),
    "reference-JSCC-scale": ("JSCC_Reference", "ReferenceScale <= 1.0E6", "ReferenceScale < 1.0E6"),
    "reference-CHF-full": ("CHF_Reference", "* 10000.0;", "* 10001.0;"),
    "reference-JSCC-full": ("JSCC_Reference", "AskedHz > Top", "AskedHz >= Top"),
    "reference-SN300G5-full": ("SN300G5_Reference", "FullScaleHz <= MOST", "FullScaleHz < MOST"),
    "reference-SN300G5-speed": ("SN300G5_Reference", "Count > 65535.0", "Count > 65536.0"),
    "reference-SN300G5-maximum": ("SN300G5_Reference", "MaximumHz >= LEAST", "MaximumHz > LEAST"),
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
    "permissions": ("CHF_CanWrite", "WORD#16#8000", "WORD#16#7FFF"),
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


def altered(names: Iterable[str] = PLANTED) -> list[Source]:
    """The library with the mistakes for some checks. Raises AssertionError where a text to change is not there."""
    texts = {source.path: source for source in alone()}
    for block, old, new in dict.fromkeys(PLANTED[name] for name in names):
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


# ---------------------------------------------------------------- what is missing, or goes wrong on the way


def test_what_matiec_alone_can_do_is_named_where_it_is_missing(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """A part is done and the rest named; where nothing is done, that is no success."""
    monkeypatch.setattr(long, "lines", list)
    assert long.main(["decoders", "packing"]) == 0
    told = capsys.readouterr().out
    assert "not run without matiec: packing\n" in told
    assert "decoders " in told
    assert long.main(["packing"]) == 2
    assert "nothing ran" in capsys.readouterr().out
    assert long.main(["--line", "matiec-openplc"]) == 2


@pytest.mark.parametrize("arguments", [["packing", "nothing"], ["--line", "matiec-nothing"]])
def test_an_unknown_name_is_refused(arguments: list[str]) -> None:
    with pytest.raises(SystemExit, match="2"):
        long.main(arguments)


def test_a_check_that_cannot_be_done_is_a_failure(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Here there is no driver to run; the others go on."""
    reports = long.parallel([Bench("gone", tmp_path / "gone")], ["digits", "permissions"], short=True)
    assert long.report(reports) == 1
    assert capsys.readouterr().out.count("could not be done: ") == 2


def test_the_embedded_engine_finds_a_planted_mistake() -> None:
    right = [*embedded(["decoders"])]
    assert [report.wrong for report in right] == [0]
    wrong = Blocks(EmbeddedEngine().build(altered(["decoders"])))
    assert PARTS["decoders"](wrong).wrong > 0


def test_every_block_but_the_commands_is_in_a_check() -> None:
    """A block that is new is not left out in silence. What parameters need is tried at each side of every limit by
    tests/blocks/permissions.py, and compared on every engine."""
    by_name = {scan.name for scan in program.SCANS} | {*ALLOWED}
    by_hand = {"MB_Crc16", "MB_Crc16Compact", "MB_Lrc"}
    by_hand |= {f"{prefix}_{noun}" for prefix in families() for noun in ("Reference", "Standstill")}
    blocks = {Path(source.path).stem for source in alone() if not source.path.startswith("types/")}
    left = {f"{prefix}_{noun}" for prefix in drives() for noun in ("Command", "MayWrite", "ParameterAddress")}
    left |= {f"{prefix}_Version" for prefix in drives()}  # whose test program asks for each item
    # of pairs: tests/blocks tries each of their limits
    left |= {"MX2_Reference", "MX2_Standstill"} | words.PAIRED
    assert blocks - by_name - by_hand == left & blocks
