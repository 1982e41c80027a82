"""Short walks; `make drives` goes on."""

import pytest
from tests.drives.walk import walk


@pytest.mark.parametrize("seed", [*range(10), 18, 20605, 3196, 17709, 44932, 67794, 68212, 69152, 2098, 544379, 559157])
def test_every_rule_holds(seed: int) -> None:
    walk(seed)
