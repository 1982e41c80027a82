"""The page of a target: what to import, what must be there afterwards, a first motor, and what was verified."""

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence

from driveblocks.export.part import Part, Shelf
from driveblocks.render.environment import render
from driveblocks.render.motor import SCAN_MS
from structured_text.language.tree import Program

KINDS = {"TYPE": "types", "FUNCTION": "functions", "FUNCTION_BLOCK": "function blocks", "PROGRAM": "programs"}


def page(target: str, shelf: Shelf, files: Mapping[str, Sequence[Part]]) -> dict[str, str]:
    """The README of a target of XML files; `files` by name without ending, the libraries in front."""
    if not shelf.drives:
        return {}
    first, *_ = shelf.drives.values()
    programs = [part.name for parts in files.values() for part in parts if isinstance(part.element, Program)]
    values = {
        "files": [{"name": f"{name}.xml", "count": census(parts)} for name, parts in files.items()],
        "libraries": [f"{library.name}.xml" for library in shelf.libraries()],
        "kinds": list(KINDS.values()),
        "prefix": first.prefix,
        "prefixes": [drive.prefix for drive in shelf.drives.values()],
        "scan": SCAN_MS,
        "master": any(name == f"{first.prefix}_Master" for name in programs),
        "motor": shelf.motor(target, first).text,
        "wide": any(part.name.endswith("ZhW") for parts in files.values() for part in parts),
    }
    return {f"{target}/README.md": render(f"{target}/README.md.j2", **values)}


def census(parts: Iterable[Part]) -> dict[str, int]:
    """How many types, functions, blocks and programs there are."""
    found = Counter(KINDS[getattr(part.element, "word", "TYPE")] for part in parts)
    return {kind: found[kind] for kind in KINDS.values()}
