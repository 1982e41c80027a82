"""`driveblocks schema`: what is made from the model of maps: the JSON Schema, and what the pages on the format hold."""

import sys
from pathlib import Path

import click

from driveblocks.commands import FILE, refuse
from driveblocks.maps import page, schema
from structured_text import files

_HEADS = {"schema.json": rb'\{\s*"\$schema": "[^"]*",\s*"title": "DriveBlocks', "keys.md": rb"# Every key of a map\s"}
"""How the files begin that this command writes."""


@click.command()
@click.argument(
    "folder",
    type=FILE,
    required=False,
    metavar="[FOLDER]",
    help="Folder with schema.json, keys.md and README.md; if none is given, the schema is printed.",
)
@click.option("--check", is_flag=True, help="Write nothing; exit 1 when a file is not current.")
def run(folder: Path | None, check: bool) -> None:
    """Write the JSON Schema and the reference of the map format.

    Both are made from the model of maps. The smallest map is written into the guide.

    Example: driveblocks schema vendor_maps
    """
    if folder is None:
        click.echo(schema.text(), nl=False)
        return
    from driveblocks.desk.words import spare

    try:
        made = _files(folder)
        for name, head in _HEADS.items():
            spare(folder / name, head, "no `driveblocks schema`")
        stale = [path for path, text in made.items() if _read(path) != text]
        for path in stale if not check else ():
            files.put(path, made[path])
    except OSError as error:
        refuse(f"{error.filename or folder}: {error.strerror}")
    except ValueError as error:
        refuse(f"{folder}: cannot write the schema: {error}")
    if check and stale:
        names = ", ".join(str(path) for path in stale)
        click.echo(f"not current: {names}; run: driveblocks schema {folder}", err=True)
        sys.exit(1)


def _files(folder: Path) -> dict[Path, str]:
    made = {folder / "schema.json": schema.text(), folder / "keys.md": page.reference()}
    readme = folder / "README.md"
    if page.BEGIN in _read(readme):
        made[readme] = page.update(_read(readme))
    return made


def _read(path: Path) -> str:
    return files.text(path) if path.exists() else ""
