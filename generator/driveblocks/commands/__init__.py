"""One module per command of `driveblocks`; each holds the typer function and the tables that it prints."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, NoReturn

import typer

if TYPE_CHECKING:
    from driveblocks.maps.model import Drive

Maps = Annotated[
    list[str] | None,
    typer.Argument(metavar="MAP", help="Maps by path, or shipped ones by name; all shipped ones without it."),
]


def refuse(message: str) -> NoReturn:
    """Say what is wrong with the input, and end with status 2."""
    typer.echo(message, err=True)
    raise typer.Exit(2)


def loaded(name: str) -> "tuple[Path, Drive]":
    """The map that a word of the command line names. Ends with status 2 if it is none, or bad."""
    from driveblocks.maps import catalog
    from driveblocks.maps.load import load
    from driveblocks.maps.problem import MapError

    try:
        path = catalog.resolve(name)
        return path, load(path)
    except (catalog.UnknownDrive, MapError) as error:
        refuse(str(error))
