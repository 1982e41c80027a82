"""One module per command of `driveblocks`; each holds the typer function and the tables that it prints."""

from typing import Annotated

import typer

Maps = Annotated[
    list[str] | None,
    typer.Argument(metavar="MAP", help="Maps by path, or shipped ones by name; all shipped ones without it."),
]
