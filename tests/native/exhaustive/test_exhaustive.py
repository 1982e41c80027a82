"""The short form of every check on every line of matiec."""

from collections.abc import Sequence

import pytest
from tests.native.driver import lines
from tests.native.exhaustive import program
from tests.native.exhaustive.bench import Bench
from tests.native.exhaustive.checks import CHECKS, run

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
