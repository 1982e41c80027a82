"""The rooms of the generator, each above what it may use: nothing imports from above, and no modules go in a circle."""

import sys
from collections import Counter
from graphlib import TopologicalSorter

from tests.rooms import GRAPH, modules, room

ROOMS = (
    "structured_text", "driveblocks", "console", "modbus", "maps", "simulator", "reference", "tables", "explain",
    "render", "export", "docs", "testing", "prove", "building", "plc", "stand", "commands", "cli", "__main__",
)  # fmt: skip
"""From the bottom up; `driveblocks` is the package's own file, `structured_text` a package of its own."""
FLOORS = ("structured_text", "visible", "files", "language", "findings", "engines", "cli", "__main__")
"""Those of `structured_text`."""

# building: what is tested together is a module of its own, so that `test` need not import what builds a folder;
# testing: a read and a store that are not answered, a reference that is refused
MOST = {
    "building": 830, "commands": 1375, "docs": 1120, "explain": 2110, "export": 2060, "maps": 6600, "modbus": 325,
    "plc": 4050, "prove": 1880, "reference": 1050, "render": 2110, "simulator": 1320, "stand": 560,
    "structured_text": 16_100, "tables": 1060, "testing": 7570,
}  # fmt: skip
"""Lines of each room at most. Lower it without a word; who raises it says why, in a line above it."""


def test_no_room_outgrows_its_ceiling() -> None:
    lines = Counter[str]()
    for name, path in modules().items():
        lines[room(name)] += len(path.read_text("utf-8").splitlines())
    assert {each: count for each, count in lines.items() if count > MOST.get(each, 200)} == {}


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


def test_the_toolchain_knows_no_drive() -> None:
    own = {name: others for name, others in GRAPH.items() if room(name) == "structured_text"}
    foreign = {
        other.partition(".")[0]
        for others in own.values()
        for other in others
        if other.partition(".")[0] not in sys.stdlib_module_names
    }
    assert foreign == {"structured_text"}
    floors = {name: FLOORS.index([*name.split("."), "structured_text"][1]) for name in own}
    upwards = [f"{name} -> {other}" for name in own for other in own[name] if floors.get(other, 0) > floors[name]]
    assert not upwards
