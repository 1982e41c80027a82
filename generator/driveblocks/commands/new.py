"""`driveblocks new`: a first map to go on from."""

from pathlib import Path

import click

from driveblocks.commands import FILE, refuse, write


@click.command()
@click.argument("prefix", metavar="PREFIX", help="What the names of the blocks start with, such as SN300G5.")
@click.option("-o", "--output", type=FILE, metavar="FILE", help="File to write; without it, PREFIX in small letters.")
def run(prefix: str, output: Path | None) -> None:
    """Write a first map, with comments that say what to replace.

    It is valid as it is, so every mistake that `driveblocks check` reports later is yours. A file that exists
    is never touched: the exit status is 2.

    Example: driveblocks new ACME -o acme_100.yaml
    """
    path = output or Path(f"{prefix.lower()}.yaml")
    text = _named(prefix)
    write(path, text, new=True)
    click.echo(f"{path}: the map of a drive that does not exist; replace every fact by your manual's, then run")
    click.echo(f"driveblocks check {path}")


def _named(prefix: str) -> str:
    """The skeleton with another prefix. Ends with status 2 where no map may have it."""
    from driveblocks.maps import form, load, page
    from driveblocks.maps.problem import MapError

    if not form.PREFIX.pattern.fullmatch(prefix):
        refuse(f"this cannot be a prefix; {form.PREFIX.right}")
    text = page.skeleton().replace(page.PREFIX, prefix)
    try:
        load.loads(text, "the map")
    except MapError as error:
        refuse(f"{prefix} cannot be a prefix: {error.problems[0].wrong}; {error.problems[0].right}")
    return text
