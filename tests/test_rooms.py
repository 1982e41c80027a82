"""The rooms of the generator, each above what it may use: nothing imports from above, and no modules go in a circle."""

import re
import sys
from graphlib import TopologicalSorter

from tests.rooms import ROOT, graph, room

from driveblocks.maps import catalog

ROOMS = (
    "structured_text", "driveblocks", "console", "modbus", "maps", "meaning", "checked maps", "reference",
    "show", "render", "diff", "platforms", "docs", "bench", "prove", "output", "desk", "plant", "commands", "cli",
    "__main__",
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


def test_nothing_decides_by_the_name_of_a_drive() -> None:
    """Differences between drives are data of their maps."""
    names = {word for path in catalog.shipped() for word in path.stem.split("_") if len(word) > 2}
    named = re.compile(rf"['\"]({'|'.join(sorted(names))})['\"]", re.IGNORECASE)
    for path in (*ROOT.parent.rglob("*.py"), *ROOT.parent.rglob("*.j2")):
        shape = r"\{%.*?%\}" if path.suffix == ".j2" else r"(?m)^\s*(?:if|elif|while|match|case|assert)\b.*$"
        found = [each for each in re.findall(shape, path.read_text("utf-8")) if named.search(each)]
        assert not found, f"{path}: {found}"
