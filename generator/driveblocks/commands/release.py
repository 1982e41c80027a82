"""`driveblocks release`: one archive per platform, and per platform and family, to be downloaded."""

from pathlib import Path

import click

from driveblocks.commands import FILE, MAPS, refuse, sources
from driveblocks.platforms import TARGETS


@click.command()
@MAPS
@click.option("-o", "--output", type=FILE, metavar="FOLDER", default=Path("dist"), help="Folder to write to.")
@click.option(
    "--to", "targets", multiple=True, type=click.Choice(TARGETS), metavar="PLATFORM", help="A platform; else all."
)
def run(maps: tuple[str, ...], output: Path, targets: tuple[str, ...]) -> None:
    """Write the archives that users download.

    Each platform has one of all families, and one of each family with a page of its own. Run it in a checkout, whose
    pages and licence go with them. The same maps give the same bytes each time. The exit
    status is 0, or 2 for bad input.

    Example: driveblocks release chf pf525 --to codesys
    """
    from driveblocks.output.release import LICENCE, release
    from driveblocks.platforms.problem import ExportError

    root = Path()
    if not (root / LICENCE).is_file():
        refuse(f"there is no {LICENCE} here; run it in a checkout of DriveBlocks")
    try:
        made = release(root, output, sources(maps), targets or TARGETS)
    except ExportError as error:
        refuse(str(error))
    except OSError as error:
        refuse(f"{error.filename or output}: cannot be written: {error.strerror}")
    for path in made:
        click.echo(f"{path}: {path.stat().st_size // 1024} KiB")
