"""One module per command of `driveblocks`; each holds the click command and the tables that it prints."""

import json
import sys
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, NoReturn

import click

from structured_text import files
from structured_text.visible import file_name

if TYPE_CHECKING:
    from driveblocks.maps.collection import Source

FILE = click.Path(path_type=Path)
MAPS = click.argument(
    "maps",
    nargs=-1,
    metavar="[MAP]...",
    help="Paths of maps, or names or model numbers of shipped ones; if none, all shipped ones.",
)


def refuse(message: str) -> NoReturn:
    """Say what is wrong with the input, and end with status 2."""
    click.echo(message, err=True)
    sys.exit(2)


def echo_json(value: object) -> None:
    click.echo(json.dumps(value, ensure_ascii=False, indent=2))


def write(path: Path, text: str, *, new: bool = False) -> None:
    """Write a file; `new`: nothing may have its name. Ends with status 2, and leaves what was there."""
    try:
        files.put(path, text, new=new)
    except FileExistsError:
        refuse(f"{file_name(path)}: is there already; name another file with -o")
    except OSError as error:
        refuse(f"{file_name(path)}: cannot be written: {error.strerror}")


def only_over(head: bytes, writer: str) -> Callable[[click.Context, click.Parameter, Path | None], Path | None]:
    """A callback of an option: before any work, status 2 for a file there that does not begin as `writer` begins it."""

    def checked(_: click.Context, __: click.Parameter, path: Path | None) -> Path | None:
        from driveblocks.desk.words import spare

        try:
            if path is not None:
                spare(path, head, f"no `driveblocks {writer}`")
        except OSError as error:
            refuse(f"{file_name(error.filename)}: {error.strerror}")
        return path

    return checked


JUNIT = click.option(
    "--junit",
    metavar="FILE",
    type=FILE,
    callback=only_over(rb'<\?xml [^>]*>\s*<testsuites name="driveblocks"', "test` or `prove"),
    help="Write all results there as JUnit XML.",
)


def sources(maps: tuple[str, ...]) -> "list[Source]":
    """Load the maps. Raises Refused with all mistakes of all of them."""
    from driveblocks.maps import catalog, collection

    return collection.read(catalog.chosen(maps))
