"""The page of a platform: what to take, what must be there afterwards, a first motor, and what was verified."""

import re
from collections import Counter
from collections.abc import Sequence
from pathlib import Path

from driveblocks.platforms import cost
from driveblocks.platforms.part import SHARED, Shelf, Volume
from driveblocks.render.environment import ABI, render
from driveblocks.render.library import CHINESE, FRAMES, LINE2, LINE32, METER, PARAMETERS, PLANT
from driveblocks.render.motor import SCAN_MS
from structured_text.language.tree import ArraySpec, FunctionBlock, TypeDecl

_FAMILY = re.compile(r"\bX(?=_|\b)")
"""What stands for the name of a family on a page of several."""
KINDS = {"TYPE": "types", "FUNCTION": "functions", "FUNCTION_BLOCK": "function blocks", "PROGRAM": "programs"}
WHAT = {
    "": "what every drive needs",
    LINE2: "a line of up to 2 drives, with less data",
    LINE32: "a line of up to 32 drives",
    PARAMETERS: "reads, writes and stores parameters of a drive",
    METER: "a meter or a sensor on the line; needs `Parameters`",
    PLANT: "groups, standby, analog inputs, hours",
    FRAMES: "frames without a line, in RTU and ASCII",
    CHINESE: "texts in Chinese",
}
"""What an extra is for."""


PORT = {
    "": "the serial port, with a line of 8 drives",
    LINE2: "2 drives at it; needs `DriveBlocks_Line2`",
    LINE32: "32 drives at it; needs `DriveBlocks_Line32`",
}
"""What the files of a port are for."""


def page(platform: str, shelf: Shelf, volumes: Sequence[Volume], masters: bool = False) -> dict[str, str]:
    """The pages, README.md first of all; none without a family. `masters`: the PLC itself may be a master."""
    if not shelf.drives:
        return {}
    first, *_ = shelf.drives.values()
    values = {
        "rows": [_row(one) for one in volumes if not one.drive],
        "places": None,
        "frames": any(one.extra == FRAMES for one in volumes),
        "kinds": list(KINDS.values())[:3],
        "one": first.prefix,
        "scan": SCAN_MS,
        "master": masters,
        "wide": any(language.suffix != "En" for language in shelf.languages),
        "abi": ABI,
        "cost": cost,
    }
    folder = Path(__file__).parent / platform
    texts = {each.name[:-3]: render(f"{platform}/{each.name}", **values) for each in sorted(folder.glob("*.md.j2"))}
    return texts if len(shelf.drives) > 1 else {name: _FAMILY.sub(first.prefix, text) for name, text in texts.items()}


def _row(one: Volume) -> dict[str, object]:
    """A volume of what is shared, for a table; of a port, which is not typed, nobody knows the data and the code."""
    blocks = [part.element for part in one.blocks if isinstance(part.element, FunctionBlock)]
    specs = [part.element.spec for part in one.types if isinstance(part.element, TypeDecl)]
    counted = Counter(KINDS[getattr(part.element, "word", "TYPE")] for part in one.parts)
    return {
        "name": one.name,
        "what": WHAT[one.extra] if one.base == SHARED else PORT[one.extra],
        "needed": not one.extra,
        "count": {kind: counted[kind] for kind in KINDS.values()},
        "structures": sum(not isinstance(spec, ArraySpec) for spec in specs),  # those that TIA Portal shows
        "largest": cost.largest(blocks),
        "code": cost.CODE_KIB[one.extra] if one.base == SHARED else None,
    }
