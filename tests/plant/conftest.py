"""Figures of lines that are the same from plant to plant are computed once."""

from collections.abc import Iterator, Sequence
from functools import lru_cache

import pytest

from driveblocks.desk.site import asked
from driveblocks.desk.site.line import Line
from driveblocks.maps.collection import Source


@pytest.fixture(scope="package", autouse=True)
def _figures_once() -> Iterator[None]:
    plain = asked.of_text

    @lru_cache(64)
    def kept(name: str, text: str, scan: int) -> dict[str, Line]:
        return plain(name, text, maps, scan)

    maps: list[Source] = []

    def of_text(name: str, text: str, own: Sequence[Source], scan: int) -> dict[str, Line]:
        maps[:] = own  # a text names the blocks of its maps
        return kept(name, text, scan)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(asked, "of_text", of_text)
        yield
