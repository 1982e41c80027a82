"""`driveblocks counts`: how much the shipped maps hold, as the table of drives in the READMEs."""

import sys
from pathlib import Path
from typing import TYPE_CHECKING

import click

from driveblocks.commands import FILE, refuse, write
from structured_text import files

if TYPE_CHECKING:
    from driveblocks.maps.model import Drive


@click.command()
@click.argument(
    "pages", nargs=-1, type=FILE, metavar="[PAGE]...", help="Pages to write the table into; else it is printed."
)
@click.option("--check", is_flag=True, help="Write nothing; exit 1 when a page is not current.")
def run(pages: tuple[Path, ...], check: bool) -> None:
    """Count what the shipped maps hold, per drive and table.

    Registers, bits, enum values, settings, faults, errors, frames, errata and gaps are counted.

    Example: driveblocks counts README.md vendor_maps/README.md
    """
    from driveblocks.maps import inventory

    try:
        maps = _maps()
        if not pages:
            click.echo(inventory.table(maps, Path.cwd()), nl=False)
            return
        old = {page: files.text(page) for page in pages}
        current = {page: inventory.update(text, maps, page.parent) for page, text in old.items()}
    except (OSError, ValueError) as error:
        refuse(f"cannot write the table: {error}")
    stale = [page for page in old if old[page] != current[page]]
    if check and stale:
        names = " ".join(map(str, pages))
        click.echo(f"not current: {', '.join(map(str, stale))}; run: driveblocks counts {names}", err=True)
        sys.exit(1)
    for page in stale:
        write(page, current[page])


def _maps() -> "dict[Path, Drive]":
    from driveblocks.maps import catalog
    from driveblocks.maps.load import load

    return {path: load(path) for path in catalog.shipped()}
