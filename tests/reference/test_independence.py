"""The reference model and what it judges share nothing but the map as data, and the standard library."""

import sys

from tests.rooms import graph, reached, room

MAP = {"driveblocks.maps.model", "driveblocks.maps.form", "driveblocks.maps.problem", "structured_text.visible"}
"""The map as data; the last one prints the name of a file."""
JUDGED = {"modbus", "structured_text", "show", "desk", "render"}


def test_the_model_reaches_nothing_that_it_judges() -> None:
    found = {name for name in reached("reference") if name.partition(".")[0] not in sys.stdlib_module_names}
    assert {name for name in found if room(name) != "reference"} == MAP


def test_nothing_that_is_judged_reaches_the_model() -> None:
    assert {room(name) for name in graph()} > JUDGED
    assert not [name for start in JUDGED for name in reached(start) if room(name) == "reference"]
