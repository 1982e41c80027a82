"""`driveblocks schema`: what is made from the model of maps: the JSON Schema, and what the pages on the format hold."""

from pathlib import Path
from typing import Annotated

import typer

from driveblocks.maps import page, schema


def run(
    folder: Annotated[
        Path | None,
        typer.Argument(
            metavar="FOLDER", help="Folder with schema.json, keys.md and README.md; without it, the schema is printed."
        ),
    ] = None,
    check: Annotated[bool, typer.Option("--check", help="Write nothing; exit 1 when a file is not current.")] = False,
) -> None:
    """Write the JSON Schema and the reference of the map format, and the smallest map into its guide.

    Schema and reference are made from the model of maps.

    Example: driveblocks schema vendor_maps
    """
    if folder is None:
        typer.echo(schema.text(), nl=False)
        return
    try:
        files = _files(folder)
        stale = [path for path, text in files.items() if _read(path) != text]
        for path in stale if not check else ():
            path.write_text(files[path], encoding="utf-8")
    except (OSError, ValueError) as error:
        typer.echo(f"{folder}: cannot write the schema: {error}", err=True)
        raise typer.Exit(2) from None
    if check and stale:
        names = ", ".join(str(path) for path in stale)
        typer.echo(f"not current: {names}; run: driveblocks schema {folder}", err=True)
        raise typer.Exit(1)


def _files(folder: Path) -> dict[Path, str]:
    files = {folder / "schema.json": schema.text(), folder / "keys.md": page.reference()}
    readme = folder / "README.md"
    if page.BEGIN in _read(readme):
        files[readme] = page.update(_read(readme))
    return files


def _read(path: Path) -> str:
    return path.read_text(encoding="utf-8") if path.exists() else ""
