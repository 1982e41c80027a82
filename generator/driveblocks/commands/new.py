"""`driveblocks new`: a first map, or a first plant, to go on from."""

import sys
from pathlib import Path

import click

from driveblocks.commands import FILE, refuse, write
from structured_text.visible import file_name


@click.command()
@click.argument(
    "name",
    metavar="PREFIX|NAME",
    help="What the names of the blocks start with, such as SN300G5; or what a plant is called.",
)
@click.option("--plant", is_flag=True, help="Write a plant instead of a map.")
@click.option(
    "-o", "--output", type=FILE, metavar="FILE", help="File to write; else PREFIX in small letters, or plant.yaml."
)
def run(name: str, plant: bool, output: Path | None) -> None:
    """Write a first map, or a first plant, to go on from.

    Its comments say what to replace. It is valid as it is, so every mistake that `driveblocks check` reports later is
    yours. On a terminal a plant is asked for line by line. A file that exists is never touched: the exit status is 2.

    Examples: driveblocks new ACME -o acme_100.yaml, driveblocks new --plant "Pumping station"
    """
    path = output or Path("plant.yaml" if plant else f"{name.lower()}.yaml")
    if plant:
        _plant(name, path)
        return
    text = _named(name)
    write(path, text, new=True)
    click.echo(f"{path}: the map of a drive that does not exist; replace every fact by your manual's, then run")
    click.echo(f"driveblocks check {path}")


def _plant(name: str, path: Path) -> None:
    """Write a plant. Ends with status 2 for a name that no program can have."""
    from driveblocks.plant import draft
    from driveblocks.plant.model import identifier

    if not identifier(name)[:1].isalpha():
        refuse("this cannot be the name of a plant; begin it with a letter A to Z")
    if path.exists():
        refuse(f"{file_name(path)}: is there already; name another file with -o")
    alone = not (sys.stdin and sys.stdin.isatty() and sys.stdout.isatty())
    write(path, draft.skeleton(name) if alone else draft.asked(name, _ask, click.echo), new=True)
    click.echo(
        f"{path}: {'a plant with two pumps; replace it by yours' if alone else 'what you have answered'}, then run"
    )
    click.echo(f"driveblocks check {path}")


def _ask(question: str, usual: str) -> str:
    """The answer of a person; Enter means the usual one."""
    answer: str = click.prompt(question, default=usual, show_default=bool(usual))
    return answer.strip()


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
