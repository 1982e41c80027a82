"""`driveblocks check`: judge maps, and say everything that is wrong with them at once."""

import sys
from typing import TYPE_CHECKING

import click

from driveblocks.commands import MAPS, refuse
from structured_text.visible import file_name

if TYPE_CHECKING:
    from driveblocks.maps.collection import Source
    from driveblocks.maps.model import Drive


@click.command()
@MAPS
def run(maps: tuple[str, ...]) -> None:
    """Check maps against every rule.

    All mistakes of each map are listed, as `file:line:col: wrong; right`, and all maps are checked, whatever is wrong
    with the first. The exit status is 0 if all are good, and 2 if any is bad.

    Example: driveblocks check my_drive.yaml
    """
    from driveblocks.maps import catalog

    names = maps or [catalog.shown(path) for path in catalog.shipped()]
    if not names:
        refuse(f"{catalog.folder()}:1:1: there are no maps here; name the maps to check")
    good: list[Source] = []
    mistakes = [_check(name, good) for name in names]
    _summary(mistakes)
    if any(mistakes):
        sys.exit(2)


def _check(name: str, good: "list[Source]") -> int:
    """Check one map, alone and with the good ones before it; print what came out and return the number of mistakes."""
    from driveblocks.maps import catalog, collection, view
    from driveblocks.maps.load import load
    from driveblocks.maps.problem import MapError

    try:
        path = catalog.resolve(name)
        source = collection.Source(path, load(path))
        if wrong := collection.clashes([*good, source]):
            raise MapError(wrong)
    except catalog.UnknownDrive as unknown:
        click.echo(f"{file_name(name)}:1:1: {unknown}", err=True)
        return 1
    except MapError as error:
        click.echo(error, err=True)
        return len(error.problems)
    good.append(source)
    shown = file_name(str(path)) if catalog.is_path(name) else name
    click.echo(f"{shown}: good: {_held(source.drive)}")
    if not source.drive.frames:
        click.echo(f"{shown}: note: {view.UNPROVED}")
    return 0


def _held(drive: "Drive") -> str:
    """What a good map was checked to hold."""
    from driveblocks.maps import counts

    held = counts.of_drive(drive)
    total = held.total
    kinds = {
        "registers": total.registers, "bits": total.bits, "enum values": total.enum_values, "settings": held.settings,
        "faults": held.faults, "errors": held.errors, "frames": held.frames, "errata": held.errata,
        "absent": held.absent,
    }  # fmt: skip
    return ", ".join(f"{number} {kind.removesuffix('s') if number == 1 else kind}" for kind, number in kinds.items())


def _summary(mistakes: list[int]) -> None:
    good, bad = mistakes.count(0), len(mistakes) - mistakes.count(0)
    if bad:
        click.echo(
            f"{bad} of {_maps(len(mistakes))} bad, {sum(mistakes)} mistake{'s' * (sum(mistakes) != 1)}", err=True
        )
    else:
        click.echo(f"{_maps(good)} good")


def _maps(number: int) -> str:
    return f"{number} map{'s' * (number != 1)}"
