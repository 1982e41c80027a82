"""The rooms of the generator, each above what it may use: nothing imports from above, and no modules go in a circle."""

import sys
from graphlib import TopologicalSorter

from tests.rooms import graph, room

ROOMS = (
    "structured_text", "driveblocks", "console", "modbus", "maps", "simulator", "desk", "reference", "show",
    "explain", "render", "diff", "export", "docs", "testing", "prove", "output", "plc", "site", "stand", "commands",
    "cli", "__main__",
)  # fmt: skip
"""From the bottom up; `driveblocks` is the package's own file, `structured_text` a package of its own."""
FLOORS = ("structured_text", "visible", "files", "language", "findings", "engines", "cli", "__main__")
"""Those of `structured_text`."""


def test_nothing_imports_from_a_room_above() -> None:
    assert {room(name) for name in graph()} == set(ROOMS)
    upwards = [
        f"{name} -> {other}"
        for name, others in graph().items()
        for other in others
        if other in graph() and ROOMS.index(room(other)) > ROOMS.index(room(name))
    ]
    assert not upwards


def test_simulated_drives_need_nothing_that_explains_frames_or_runs_programs() -> None:
    stand = {other for name, others in graph().items() if room(name) == "stand" for other in others}
    assert not [name for name in stand if name in graph() and room(name) == "explain"]
    # a word such as chf@1:60:CurrentScale=0.1 means the same to `simulate` as to `run --simulate`
    assert {name for name in stand if name in graph() and room(name) == "plc"} == {"driveblocks.plc.drives"}


def test_no_modules_go_in_a_circle() -> None:
    assert graph().keys() <= set(TopologicalSorter(graph()).static_order())


def test_the_toolchain_knows_no_drive() -> None:
    own = {name: others for name, others in graph().items() if room(name) == "structured_text"}
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
