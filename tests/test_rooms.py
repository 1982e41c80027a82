"""The rooms of the generator, each above what it may use: nothing imports from above, and no modules go in a circle."""

from graphlib import TopologicalSorter

from tests.rooms import GRAPH, room

ROOMS = (
    "driveblocks", "console", "modbus", "st", "maps", "simulator", "reference", "tables", "explain", "host", "render",
    "export", "docs", "testing", "prove", "building", "plc", "stand", "commands", "cli", "__main__",
)  # fmt: skip
"""From the bottom up; `driveblocks` is the package's own file."""


def test_nothing_imports_from_a_room_above() -> None:
    assert {room(name) for name in GRAPH} == set(ROOMS)
    upwards = [
        f"{name} -> {other}"
        for name, others in GRAPH.items()
        for other in others
        if other in GRAPH and ROOMS.index(room(other)) > ROOMS.index(room(name))
    ]
    assert not upwards


def test_no_modules_go_in_a_circle() -> None:
    assert GRAPH.keys() <= set(TopologicalSorter(GRAPH).static_order())
