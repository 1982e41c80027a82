"""The reference model shares no code with what it judges: it imports the map model and the standard library alone."""

import ast
import sys
from pathlib import Path

import driveblocks.reference

ALLOWED = {"driveblocks.maps.model", "driveblocks.maps.form", "driveblocks.maps.load"}


def imported(source: str) -> set[str]:
    """Every module that a source imports."""
    names: set[str] = set()
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.ImportFrom):
            names.add(node.module or "")
        elif isinstance(node, ast.Import):
            names.update(alias.name for alias in node.names)
    return names


def test_the_model_imports_nothing_that_it_judges() -> None:
    files = sorted(Path(driveblocks.reference.__file__).parent.glob("*.py"))
    assert len(files) > 10
    for file in files:
        foreign = {
            name
            for name in imported(file.read_text("utf-8"))
            if name.partition(".")[0] not in sys.stdlib_module_names
            and not name.startswith("driveblocks.reference")
            and name not in ALLOWED
        }
        assert not foreign, f"{file.name} imports {foreign}"
