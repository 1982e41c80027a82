"""`driveblocks schema`: write the JSON Schema of maps, or check that the one in a folder is current."""

from pathlib import Path
from typing import Annotated

import typer

from driveblocks.maps import schema


def run(
    file: Annotated[Path | None, typer.Argument(help="Where to write it; without, it is printed.")] = None,
    check: Annotated[bool, typer.Option("--check", help="Write nothing; exit 1 when FILE is not current.")] = False,
) -> None:
    """Print or write the JSON Schema of maps, made from the model, for editors."""
    text = schema.text()
    if file is None:
        typer.echo(text, nl=False)
    elif check:
        if not file.exists() or file.read_text(encoding="utf-8") != text:
            typer.echo(f"{file} is not current; run: driveblocks schema {file}", err=True)
            raise typer.Exit(1)
    else:
        file.write_text(text, encoding="utf-8")
