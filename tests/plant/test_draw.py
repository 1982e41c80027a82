"""Plants drawn at random are good: what builds and runs them draws them, too."""

from pathlib import Path

import pytest
from tests.plant.draw import draw

from driveblocks.plant.check import judged

FEW, MORE = range(2), range(2, 20)


@pytest.mark.parametrize("seed", [*FEW, *(pytest.param(each, marks=pytest.mark.thorough) for each in MORE)])
def test_a_drawn_plant_is_good(tmp_path: Path, seed: int) -> None:
    path = tmp_path / "drawn.yaml"
    path.write_text(draw(seed), encoding="utf-8")
    plant = judged(path).plant
    assert 2 <= len(plant.drives) <= 12
    assert len({each.map.vendor.en for each in plant.drives.values()}) > 1
