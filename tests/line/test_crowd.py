"""Real drive blocks of all families on a virtual line, in short; each module judges a failure again by its name."""

from itertools import product

import pytest
from tests.line import budget, owners, panel
from tests.line.crowd import FAMILIES, WHY_NOT

pytestmark = pytest.mark.skipif(bool(WHY_NOT), reason=WHY_NOT)


@pytest.mark.parametrize("name", [str(each) for each in range(8)])
def test_a_random_line(name: str) -> None:
    assert budget.judge(name).told == []


@pytest.mark.parametrize(("scan", "dead"), [(10, 4), (20, 3), (50, 0), (50, 1), (50, 7)])
def test_eight_drives_of_a_family(scan: int, dead: int) -> None:
    """Dead neighbours stop no healthy motor, and full lines stop nobody."""
    names = [f"{family},{scan},{dead},line" for family in ("CHF", "MX2", "PF525", "SN300G5")]
    assert [each.told for each in map(budget.judge, names) if each.told] == []


@pytest.mark.thorough
@pytest.mark.parametrize("dead", [0, 1, 3])
def test_a_start_by_states_comes_in_time_on_a_slow_line(dead: int) -> None:
    """Each of its writes waits for two reads of the status."""
    assert budget.judge(f"ATV312,50,{dead},line").told == []


@pytest.mark.parametrize("name", ["27", "42", "53", "58", "125", "141", "148", "18", "8", "29"])
def test_beside_a_panel(name: str) -> None:
    assert panel.judge(name).told == []


PAIRS = (("JSCC", "CHF"), ("PF525", "GD200A"), ("GD200A", "PF525"), ("MX2", "ATV312"))
CASES = [
    *(f"{what},{a},{b},{how}" for what in owners.SHARED for (a, b), how in product(PAIRS, ("1 1", "1 2"))),
    *(f"{what},{a},{b}" for what in owners.PAIRS for a, b in PAIRS),
    *(f"{what},{family}" for what in owners.ALONE for family in ("PF525", "SN300G5")),
    *(f"refused,{family},{mode},restart" for family in FAMILIES[:3] for mode in owners.MODES),
    "terminals,GD200A,SpeedOnly,restart",
]


@pytest.mark.parametrize("name", CASES)
def test_whose_a_request_is(name: str) -> None:
    assert owners.judge(name).told == []
