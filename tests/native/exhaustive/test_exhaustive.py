"""The short form of every check on every line of matiec."""

from collections.abc import Sequence
from pathlib import Path

import pytest
from tests.blocks.library import alone
from tests.native.driver import lines
from tests.native.exhaustive import program, words
from tests.native.exhaustive.bench import Bench
from tests.native.exhaustive.checks import CHECKS, run
from tests.native.exhaustive.permissions import ALLOWED
from tests.native.exhaustive.standstills import families
from tests.shipped import drives

NEEDS = "needs matiec: no line of it is found, `driveblocks doctor` says where it is looked for"


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


def test_every_block_but_the_commands_is_in_a_check() -> None:
    """A block that is new is not left out in silence. What parameters need is tried at each side of every limit by
    the test programs of each drive."""
    by_name = {scan.name for scan in program.SCANS} | {*ALLOWED}
    by_hand = {"MB_Crc16", "MB_Crc16Compact", "MB_Lrc"}
    by_hand |= {f"{prefix}_{noun}" for prefix in families() for noun in ("Reference", "Standstill")}
    blocks = {Path(source.path).stem for source in alone() if not source.path.startswith("types/")}
    left = {f"{prefix}_{noun}" for prefix in drives() for noun in ("Command", "MayWrite", "ParameterAddress")}
    left |= {f"{prefix}_Version" for prefix in drives()}  # whose test program asks for each item
    # of pairs: tests/blocks tries each of their limits
    left |= {"MX2_Reference", "MX2_Standstill"} | words.PAIRED
    assert blocks - by_name - by_hand == left & blocks
