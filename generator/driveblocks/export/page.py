"""The page of a target: what to import, what must be there afterwards, a first motor, and what was verified."""

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence

from driveblocks.export.part import Part, Shelf
from driveblocks.render.environment import render
from driveblocks.render.motor import SCAN_MS

KINDS = {"TYPE": "types", "FUNCTION": "functions", "FUNCTION_BLOCK": "function blocks", "PROGRAM": "programs"}


def page(
    target: str, shelf: Shelf, programs: Mapping[str, Sequence[Part]], port: Iterable[Part] = ()
) -> dict[str, str]:
    """The README of a target whose libraries are one XML file each; `programs` by prefix, the first motor in front."""
    if not shelf.drives:
        return {}
    files = [
        {
            "name": f"{library.name}.xml",
            "drives": len(library.drives),
            "count": census(
                (*library.parts, *port, *(one for drive in library.drives for one in programs[drive.prefix]))
            ),
        }
        for library in shelf.libraries()
    ]
    prefix, first = next(iter(programs.items()))
    values = {
        "files": files,
        "kinds": list(KINDS.values()),
        "prefix": prefix,
        "prefixes": list(programs),
        "scan": SCAN_MS,
    }
    text = render(f"{target}/README.md.j2", motor=first[0].text, master=len(first) > 1, **values)
    return {f"{target}/README.md": text}


def census(parts: Iterable[Part]) -> dict[str, int]:
    """How many types, functions, blocks and programs there are."""
    found = Counter(KINDS[getattr(part.element, "word", "TYPE")] for part in parts)
    return {kind: found[kind] for kind in KINDS.values()}
