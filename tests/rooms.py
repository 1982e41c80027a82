"""What each module of the two packages imports."""

import ast
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import driveblocks
import structured_text

ROOT = Path(driveblocks.__file__).parent
TOOLCHAIN = Path(structured_text.__file__).parent


def modules() -> dict[str, Path]:
    """Every module by its dotted name."""
    paths = [path for root in (ROOT, TOOLCHAIN) for path in root.rglob("*.py")]
    names = {path: path.relative_to(ROOT.parent).with_suffix("").parts for path in paths}
    return {".".join(parts).removesuffix(".__init__"): path for path, parts in names.items()}


def imports(path: Path, known: dict[str, Path]) -> Iterator[str]:
    """What a module imports, wherever it does; what is imported for types alone counts, too."""
    for node in ast.walk(ast.parse(path.read_text("utf-8"))):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.module:
            named = (f"{node.module}.{alias.name}" for alias in node.names)
            yield from (name if name in known else node.module for name in named)


CHECKED = ("check", "collection", "load", "rivals", "rules")
"""What of `maps` stands above `meaning`: the rules of a map ask it, and what is loaded is checked by them."""


def room(module: str) -> str:
    """The folder or file of `driveblocks` that a module is in; `driveblocks` itself, `structured_text` as a whole."""
    package, *rest = module.split(".")
    if package == "driveblocks" and rest[:1] == ["maps"] and rest[1:2] and rest[1] in CHECKED:
        return "checked maps"
    return rest[0] if package == "driveblocks" and rest else package


MODULES = modules()


@cache
def graph() -> dict[str, set[str]]:
    """Every module, with what it imports."""
    return {name: set(imports(path, MODULES)) for name, path in MODULES.items()}


def reached(start: str) -> set[str]:
    """Modules that a room imports, and those that they import."""
    found: set[str] = set()
    waiting = [name for name in graph() if room(name) == start]
    while waiting:
        name = waiting.pop()
        if name not in found:
            found.add(name)
            waiting += graph().get(name, ())
    return found
