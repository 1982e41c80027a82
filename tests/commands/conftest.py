"""Commands read each map once only, however many tests run them on it: the loader has tests of its own."""

import functools
from pathlib import Path

import pytest

from driveblocks.maps import load
from driveblocks.maps.model import Drive

read = load.load


@functools.cache
def known(path: Path, _folder: Path, _content: bytes) -> Drive:
    """A map as it was when it was first read."""
    return read(path)


def once(path: Path) -> Drive:
    """What `load` returns and raises."""
    return known(path, Path.cwd(), path.read_bytes()) if path.is_file() else read(path)


@pytest.fixture(autouse=True)
def _maps_read_once(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(load, "load", once)
