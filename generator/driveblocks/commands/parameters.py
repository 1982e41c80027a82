"""`driveblocks parameters`: the registers of a drive saved to a file, and compared."""

import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import click

from driveblocks.commands import FILE, refuse

PLACE: tuple[Callable[[Any], Any], ...] = (
    click.option("--port", metavar="DEVICE", help="A serial port, such as COM3 or /dev/ttyUSB0: a REAL PORT."),
    click.option("--tcp", metavar="HOST:PORT", help="Serial bytes over TCP: a REAL PORT, or `driveblocks simulate`."),
    click.option("--rate", type=int, metavar="RATE", help="Bit rate of --port; else of a plant, else 9600."),
    click.option("--format", "form", metavar="8N1", help="Data bits, parity, stop bits of --port; likewise, else 8N1."),
    click.option("--ascii", is_flag=True, help="MODBUS ASCII instead of RTU."),
    click.option("--patience", default="30s", metavar="TIME", help="How long to wait for a line that was lost."),
)


def _placed(command: Callable[..., None]) -> Callable[..., None]:
    """The options of a port."""
    for option in reversed(PLACE):
        command = option(command)
    return command


@click.group()
def run() -> None:
    """Save the registers of a drive, or compare them; it only reads.

    Disconnect the PLC first: two masters on one line damage each other's frames. A drive of a plant is written as
    plant.yaml:P1; map, address, rate and format are then those of its file.
    """


def _drives(named: tuple[str, ...], words: dict[str, Any]) -> tuple[str, ...]:
    """The drives as other commands name them; rate and format of a plant are added to the words. Raises Refused."""
    from driveblocks.maps.problem import Refused
    from driveblocks.plant import word

    placed = {each: word.drive(*there) for each in named if (there := word.split(each))}
    ways = {each.way for each in placed.values()}
    if len(ways) > 1:
        raise Refused(f"{' and '.join(placed)} are on lines of other rates or formats; save one, then compare it")
    for way in ways:
        words["rate"], words["form"] = words["rate"] or way.rate, words["form"] or way.form
        words["ascii"] = words["ascii"] or way.mode == "ascii"
    words["rate"], words["form"] = words["rate"] or 9600, words["form"] or "8N1"
    return tuple(f"{placed[each].word}@{placed[each].motor.unit}" if each in placed else each for each in named)


@run.command()
@click.argument("drive", metavar="DRIVE[@UNIT]", help="The drive's map by name or path, and its unit address, else 1.")
@click.argument("file", type=FILE, metavar="FILE.csv", help="Where to; a file that is not complete is continued.")
@_placed
def save(drive: str, file: Path, **words: Any) -> None:
    """Read every register that the map lists into a file, with names and units.

    The file is whole at any moment, and says how far it came. The exit status is 0 when every register was read, 1
    when the drive refuses some or has fallen silent, replies come that nobody asked for, or a person has ended it,
    2 for bad input or a drive of another family.

    Examples: driveblocks parameters save chf@1 pump.csv --port /dev/ttyUSB0,
    driveblocks parameters save plant.yaml:P1 p1.csv --port /dev/ttyUSB0
    """
    from driveblocks.desk.site import drives
    from driveblocks.desk.site.reader import LostError

    (drive,) = _drives((drive,), words)
    try:
        told, complete = drives.save(drive, file, drives.Place(**words))
    except LostError as lost:
        click.echo(str(lost), err=True)
        sys.exit(1)
    click.echo(told)
    sys.exit(0 if complete else 1)


@run.command()
@click.argument("left", metavar="FILE.csv|DRIVE[@UNIT]", help="A file that `save` has written, or a drive.")
@click.argument("right", metavar="FILE.csv|DRIVE[@UNIT]", help="Another of the same family.")
@click.option("--all", "everything", is_flag=True, help="Compare what the drive measures, too, not only what is set.")
@click.option("--map", "own", metavar="MAP", help="The map of two files, where it is your own.")
@_placed
def compare(left: str, right: str, everything: bool, own: str | None, **words: Any) -> None:
    """Show what differs between two drives, two files, or a drive and a file, in the order of the manual.

    The exit status is 0 if all is equal, 1 if something differs or was not read, 2 for bad input or a drive that
    does not answer.

    Example: driveblocks parameters compare pump.csv chf@2 --port /dev/ttyUSB0
    """
    from driveblocks import console
    from driveblocks.desk.site import drives
    from driveblocks.desk.site.reader import LostError

    left, right = _drives((left, right), words)
    try:
        told, differs = drives.compare((left, right), drives.Place(**words), own, everything=everything)
    except LostError as lost:
        refuse(str(lost))
    console.write(*told)
    sys.exit(1 if differs else 0)
