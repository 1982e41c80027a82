"""`driveblocks list`: the drives that DriveBlocks ships maps for."""

import sys
from pathlib import Path
from typing import TYPE_CHECKING

import click

from driveblocks.commands import MAPS, echo_json

if TYPE_CHECKING:
    from driveblocks.maps.model import Drive


@click.command()
@MAPS
@click.option("--json", is_flag=True, help="Print everything that the maps hold as one JSON array.")
def run(maps: tuple[str, ...], json: bool) -> None:
    """List drives: those of the maps named, or all shipped ones.

    A map with mistakes is left out, its mistakes are printed to standard error, and the exit status is 2.

    Example: driveblocks list --json | jq '.[].drive'
    """
    from driveblocks.maps import catalog

    paths = catalog.chosen(maps)
    loaded = {path: drive for path in paths if (drive := _load(path)) is not None}
    if json:
        _print_json(loaded)
    else:
        _print_table(loaded)
    if len(loaded) < max(1, len(set(paths))):
        sys.exit(2)


def _load(path: Path) -> "Drive | None":
    from driveblocks.maps.load import load
    from driveblocks.maps.problem import MapError

    try:
        return load(path)
    except MapError as error:
        click.echo(error, err=True)
        return None


def _print_json(loaded: "dict[Path, Drive]") -> None:
    from driveblocks.maps import counts, trust, view

    drives = [
        {
            **view.of_drive(drive, path.stem),
            "file": str(path),
            "counts": counts.plain(counts.of_drive(drive)),
            "trust": trust.counted(drive),
        }
        for path, drive in loaded.items()
    ]
    echo_json(drives)


def _print_table(loaded: "dict[Path, Drive]") -> None:
    from driveblocks import console
    from driveblocks.maps import counts, trust, view
    from driveblocks.show.layout import both, table

    kinds = ("registers", "faults", "frames")  # what finds room at 80 columns beside a maker's whole name
    made = table("drive", "blocks", "family", *kinds, wide=("family",), numbers=kinds)
    for path, drive in loaded.items():
        held = counts.of_drive(drive)
        family = both(view.title(drive), drive.family.own)
        numbers = (held.total.registers, held.faults, held.frames)
        made.add_row(path.stem, f"{drive.prefix}_*", family, *map(str, numbers))
    console.write(made)
    for path, drive in loaded.items():
        if not drive.frames:
            console.write(f"\n{path.stem}: {view.UNPROVED}")
        for line in trust.heard(drive):
            console.write(f"\n{path.stem}: {line}")
    console.write("\n`driveblocks show DRIVE` prints everything about one of them.")
