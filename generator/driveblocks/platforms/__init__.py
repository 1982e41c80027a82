"""The platforms that a PLC is programmed on: a folder each, with its record, port, templates, writer and page.

A new platform is a folder here. `RECORD` in its `__init__` says what it is; one with files of its own has a `writer`.
"""

from importlib import import_module
from pkgutil import iter_modules

from driveblocks.platforms.record import Platform

CANONICAL = "iec61131"
"""The platform that all others are made from: the text of every block."""


def _found() -> dict[str, Platform]:
    """All of them by name, in the order of their records."""
    folders = [each.name for each in iter_modules(__path__) if each.ispkg]
    records: list[Platform] = [import_module(f"{__name__}.{name}").RECORD for name in folders]
    return {one.name: one for one in sorted(records, key=lambda one: one.order)}


PLATFORMS = _found()
TARGETS = tuple(one.name for one in PLATFORMS.values() if one.title)
"""Those that files are built for."""
EXPORTS = tuple(name for name in TARGETS if name != CANONICAL)
"""Those that have a form of their own, and a page."""


def is_yours(path: str) -> bool:
    """Whether a file, by its path below the output folder, is the user's once it is there."""
    platform, _, inner = path.partition("/")
    return platform in PLATFORMS and inner.startswith(PLATFORMS[platform].yours)
