"""`driveblocks check`: judge maps and plants, and say everything that is wrong with them at once."""

import sys
from pathlib import Path
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
    """Check maps, or a plant, against every rule.

    All mistakes of each file are listed, as `file:line:col: wrong; right`, and all files are checked, whatever is wrong
    with the first. A plant that is good can be built, and its motors turn. The exit status is 0 if all are good, and 2
    if any is bad.

    Examples: driveblocks check my_drive.yaml, driveblocks check plant.yaml
    """
    from driveblocks.maps import catalog

    names = maps or [catalog.shown(path) for path in catalog.shipped()]
    if not names:
        refuse(f"{catalog.folder()}:1:1: there are no maps here; name the maps to check")
    good: list[Source] = []
    plants = [_is_plant(name) for name in names]
    mistakes = [_check_plant(name) if plant else _check(name, good) for name, plant in zip(names, plants, strict=True)]
    _summary(mistakes, "file" if any(plants) and not all(plants) else "plant" if any(plants) else "map")
    if any(mistakes):
        sys.exit(2)


def _is_plant(name: str) -> bool:
    from driveblocks.maps import catalog
    from driveblocks.plant.word import is_plant

    return catalog.is_path(name) and is_plant(Path(name))


def _check_plant(name: str) -> int:
    """Check one plant; print what came out and return the number of mistakes."""
    from driveblocks.maps.problem import MapError
    from driveblocks.plant.check import judged

    try:
        found = judged(Path(name))
    except MapError as error:
        click.echo(error, err=True)
        return len(error.problems)
    click.echo(f"{file_name(name)}: good: {found.held}")
    for each in found.warnings:
        click.echo(f"{file_name(each.file)}:{each.line}:{each.column}: warning: {each.wrong}; {each.right}")
    return 0


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


def _summary(mistakes: list[int], kind: str) -> None:
    good, bad = mistakes.count(0), len(mistakes) - mistakes.count(0)
    if bad:
        total = _counted(sum(mistakes), "mistake")
        click.echo(f"{bad} of {_counted(len(mistakes), kind)} bad, {total}", err=True)
    else:
        click.echo(f"{_counted(good, kind)} good")


def _counted(number: int, kind: str) -> str:
    return f"{number} {kind}{'s' * (number != 1)}"
