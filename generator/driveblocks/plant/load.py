"""Load a plant: file -> text -> nodes -> model, with every mistake of the file in one MapError."""

from collections.abc import Iterable, Iterator
from dataclasses import replace
from decimal import Decimal
from pathlib import Path
from typing import Any

from driveblocks.desk.site.kept import LABEL, PLANT, Kept, is_found
from driveblocks.desk.site.sheet import members
from driveblocks.maps import catalog, nodes, source
from driveblocks.maps.decode import build, nearest
from driveblocks.maps.load import load as load_map
from driveblocks.maps.nodes import Entries, Items, Node, Scalar
from driveblocks.maps.problem import MapError, Place, Refused, Report
from driveblocks.maps.shape import EntryOf
from driveblocks.plant import speech
from driveblocks.plant.model import SECTIONS, Gathered, HardStop, Line, Motor, Plant
from structured_text.visible import file_name

DEFAULT_HARD_STOP = "HardStop"


def load(path: Path) -> Plant:
    """The plant of a file, as far as its own form goes; `check.plant` judges it. Raises MapError with every mistake."""
    report = Report(file_name(path))
    plant = read(path, report)
    report.raise_if_any()
    assert plant is not None  # noqa: S101 - else something was noted
    return plant


def read(path: Path, report: Report) -> Plant | None:
    """The same, as far as it could be read; mistakes go to the report. Raises MapError for a file that is no text."""
    root = nodes.parse(source.read(path), report)
    if root is None:
        return None
    if not isinstance(root, Entries):
        report.add(root.at, "this is no plant", "write `plant: NAME`, `lines:` and `drives:`")
        return None
    own = {key: each for key, each in root.entries.items() if key not in SECTIONS and not _is_label(key, each[1])}
    meant = _unknown(own, report)
    plant = build(EntryOf(Plant), Entries(own, root.at), report, "the plant")
    if not isinstance(plant, Plant):
        return None
    made: dict[str, Any] = {key: dict(_section(root, key, report)) for key in SECTIONS}
    written = {key: frozenset(_names(root, meant.get(key, key))) for key in SECTIONS}
    plant = replace(plant, **made, found=dict(_found(root, report)), written=written)
    plant = replace(plant, drives=dict(_mapped(plant, path, report)))
    plant = replace(plant, lines={name: _spoken(each, plant) for name, each in plant.lines.items()})
    return plant if plant.hard_stops else replace(plant, hard_stops=_one_for_all(plant))


def _unknown(own: dict[str, tuple[Scalar, Node]], report: Report) -> dict[str, str]:
    """Note and take out the keys that a plant has not; sections that were probably meant, as they are written."""
    meant: dict[str, str] = {}
    for text in own.keys() - set(PLANT):
        key, _ = own.pop(text)
        near = nearest(text, list(PLANT))
        right = f"did you mean `{near}`?" if near else f"known keys: {', '.join(PLANT)}"
        if not key.refused:
            report.add(key.at, f"unknown key `{text[:40]}` in the plant", right)
        report.partial = True
        meant[near or ""] = text
    return meant


def _is_label(key: str, node: Node) -> bool:
    """Whether an entry is what commission found of a drive."""
    return is_found(node) and bool(LABEL.fullmatch(key))


def _section(root: Entries, section: str, report: Report) -> Iterator[tuple[str, Any]]:
    """The entries of a section by their names, those of its own form."""
    _, node = root.entries.get(section, (None, None))
    if node is None or is_found(node):
        return
    if not isinstance(node, Entries):
        report.add(
            node.at, f"`{section}` holds no names", f"write an entry per name below `{section}:`, or leave it out"
        )
        return
    for name, (key, value) in node.entries.items():
        if not LABEL.fullmatch(name) and not key.refused:
            report.add(key.at, f"`{name}` is no name", "write up to 24 letters and digits, a letter first")
        made = build(EntryOf(SECTIONS[section]), value, report, name)
        if isinstance(made, Gathered):
            made = replace(made, drives_at=_places(value))
        if not isinstance(made, SECTIONS[section]):
            report.partial = True
        else:
            yield name, replace(made, name=name, name_at=key.at)


def _names(root: Entries, section: str) -> Iterable[str]:
    """The names of a section."""
    _, node = root.entries.get(section, (None, None))
    return node.entries if isinstance(node, Entries) and not is_found(node) else ()


def _places(node: Node) -> dict[str, Place]:
    """Where each drive of a list is named first."""
    listed = node.entries["drives"][1] if isinstance(node, Entries) else None
    items = listed.items if isinstance(listed, Items) else ()
    return {each.text: each.at for each in reversed(items) if isinstance(each, Scalar)}


def _found(root: Entries, report: Report) -> Iterator[tuple[str, Kept]]:
    for label, (_, node) in root.entries.items():
        made = build(EntryOf(Kept), node, report, label) if _is_label(label, node) else None
        if isinstance(made, Kept):
            yield label, made


def _mapped(plant: Plant, path: Path, report: Report) -> Iterator[tuple[str, Motor]]:
    """The drives that have a map, with it and their settings; of a map with mistakes they are said once."""
    for name, each in plant.drives.items():
        try:
            file = catalog.resolve(each.drive)
            file = path.parent / file if catalog.is_path(each.drive) else file
            values = _values(each, plant.found.get(name))
            yield name, replace(each, map=load_map(file), path=file, values=values)
        except MapError as error:
            report.partial = True
            first = error.problems[0]
            report.add(
                each.place("drive"),
                f"the map of `{each.drive}` is bad: {first}",
                "correct it; `driveblocks check` says all",
            )
        except Refused as refused:
            report.partial = True
            report.add(each.place("drive"), *_halves(str(refused)))


def _halves(text: str) -> tuple[str, str]:
    """What is wrong, and what would be right."""
    wrong, _, right = text.partition("; ")
    return wrong, right


def _values(motor: Motor, found: Kept | None) -> dict[str, Decimal]:
    """What its `VFD_Settings` are: as found, and over that as given."""
    kept = {name: Decimal(each) for name, each in members(found).items()} if found else {}
    watchdog = {"WatchdogMs": Decimal(motor.watchdog_ms)} if motor.watchdog_ms else {}
    given = motor.settings.given if motor.settings else {}
    return {name: each for name, each in {**kept, **watchdog, **given}.items() if each}


def _spoken(line: Line, plant: Plant) -> Line:
    drives = [each.map for each in plant.on(line.name)]
    return replace(line, way=speech.way(line, drives))


def _one_for_all(plant: Plant) -> dict[str, HardStop]:
    return {DEFAULT_HARD_STOP: HardStop(at=plant.at, name=DEFAULT_HARD_STOP, drives=tuple(plant.drives))}
