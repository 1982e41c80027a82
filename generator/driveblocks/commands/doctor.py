"""`driveblocks doctor`: what runs on this machine, what is missing, what that costs, and where to get it."""

import sys
from typing import TYPE_CHECKING

import click

from driveblocks.commands import echo_json

if TYPE_CHECKING:
    from driveblocks.output.health import Health

_COLOURS = {"ok": "green", "missing": "yellow", "broken": "red"}


@click.command()
@click.option("--json", is_flag=True, help="Print the findings as JSON.")
def run(json: bool) -> None:
    """Say which ST engines this machine has, and what is missing.

    For each part that is missing it says what cannot be done without it, and where to get it.

    The exit status is 0 if the embedded engine works: then everything can be done, and only matiec may be missing.
    It is 1 if not.

    Example: driveblocks doctor --json | jq .missing
    """
    from driveblocks.output.health import examine
    from structured_text.engines.discovery import survey

    health = examine(survey())
    if json:
        echo_json(health.plain())
    elif sys.stdout.isatty():
        _print_tables(health)
    else:
        _print_lines(health)
    sys.exit(0 if health.works else 1)


def _print_lines(health: "Health") -> None:
    for part in health.parts:
        click.echo(f"{part.name:<15} {part.state:<8} {part.detail}")
    for each in health.missing:
        click.echo(f"\n{each.missing} is missing: {each.cost}.\n  {each.remedy}")


def _print_tables(health: "Health") -> None:
    from rich.text import Text

    from driveblocks import console
    from driveblocks.show.layout import table

    found = table("part", "state", "what and where", wide=("what and where",))
    for part in health.parts:
        found.add_row(part.name, Text(part.state, _COLOURS[part.state]), part.detail)
    console.write(found)
    if health.missing:
        missing = table("missing", "what that costs", "where to get it", wide=("what that costs", "where to get it"))
        for each in health.missing:
            missing.add_row(each.missing, each.cost, each.remedy)
        console.write("", missing)
