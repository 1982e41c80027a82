"""The maps that the reference model is tried on: the example with every key, and all that are shipped."""

from pathlib import Path

import pytest

from driveblocks.maps import catalog
from driveblocks.maps.load import load
from driveblocks.maps.model import Drive

EXAMPLE = Path(__file__).parents[1] / "maps" / "example.yaml"
PATHS = (EXAMPLE, *catalog.shipped())


@pytest.fixture(scope="session")
def drives() -> dict[str, Drive]:
    """Every map by its prefix, loaded once."""
    return {drive.prefix: drive for drive in map(load, PATHS)}
