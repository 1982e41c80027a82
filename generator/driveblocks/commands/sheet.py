"""`driveblocks sheet`: what a person takes to the machine, on one page."""

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from driveblocks.commands import refuse

if TYPE_CHECKING:
    from driveblocks.maps.model import Drive
    from driveblocks.plant.model import Motor, Plant


@click.command()
@click.argument(
    "drive",
    metavar="DRIVE|PLANT.yaml[:P1]",
    help="Name or model number of a shipped drive, or the path of a map; or a plant, or a drive of it.",
)
@click.option("--master", is_flag=True, help="The requests of a PLC that is its own master.")
@click.option("--address", metavar="N", type=int, help="Unit address of the drive, else 1.")
@click.option("--baud", metavar="RATE", type=int, help="Bit rate; if none is given, that of the drive as delivered.")
@click.option("--format", "form", metavar="8N1", help="Data bits, parity, stop bits; else as delivered.")
@click.option("--watchdog", metavar="S", type=str, help="How long the line may be silent, in seconds; else left open.")
@click.option(
    "--full-scale", metavar="HZ", type=float, default=50.0, show_default=True,
    help="What 100 % of the reference is, where it is a part of something.",
)  # fmt: skip
def run(drive: str, master: bool, address: int | None, full_scale: float, **words: Any) -> None:
    """Print a page for the machine, as Markdown.

    Every setting at the keypad, filled in for this address, rate and format, with boxes to tick; terminals; what to
    measure first.

    With --master: the requests that a PLC sends which has a Modbus instruction and takes no block, in order, with
    function, register, value and frame: the stop first, then reads, start, what keeps it running, the fault reset, and
    what must never be written.

    Of a plant, a page for each drive with its own address, rate, format and watchdog.

    Examples: driveblocks sheet pf525 --address 3 --baud 19200 --watchdog 1,
    driveblocks sheet plant.yaml:P1, driveblocks sheet chf --master --full-scale 60 > chf.md
    """
    from driveblocks.docs import recipe
    from driveblocks.maps import load
    from driveblocks.meaning.serial import serial

    if pages := _of_plant(drive, given=master or address is not None or any(words.values())):
        click.echo("\n".join(pages), nl=False)
        return
    _, known = load.named(drive)
    address = 1 if address is None else address
    if not master:
        click.echo(_settings(known, drive, address, **words), nl=False)
        return
    line = serial(known)
    if not line.lowest <= address <= line.highest:
        refuse(f"the unit addresses of this drive are {line.lowest} to {line.highest}, not {address}")
    if full_scale <= 0:
        refuse(f"`--full-scale` is more than 0 Hz, not {full_scale:g}")
    click.echo(recipe.page(known, drive, address, full_scale))


def _of_plant(word: str, *, given: bool) -> list[str]:
    """The pages of a plant, or of one drive of it; none where the word names no plant."""
    from driveblocks.plant import check
    from driveblocks.plant.word import is_plant, split

    path, name = split(word) or (Path(word), "")
    if not is_plant(path):
        return []
    if given:
        refuse("a plant says address, rate, format and watchdog of its drives itself; leave the options out")
    plant = check.good(path)
    if name and name not in plant.drives:
        refuse(f"{path} has no drive {name}; it has {', '.join(plant.drives)}")
    return [_of_drive(plant, each) for each in plant.drives.values() if name in ("", each.name)]


def _of_drive(plant: "Plant", motor: "Motor") -> str:
    """The page of a drive of a plant, with its tag."""
    from decimal import Decimal

    from driveblocks.docs import keypad
    from driveblocks.plant.word import Found

    way = plant.lines[motor.line].way
    silence = Decimal(motor.watchdog_ms) / 1000 if motor.watchdog_ms else None
    try:
        line = keypad.wanted(motor.map, motor.unit, way.rate, way.form, silence, way.mode)
    except ValueError as error:
        refuse(f"{motor.name}: {error}")
    page = keypad.page(motor.map, Found(motor, way).word, line)
    return page.replace("\n", f"\n\n**{motor.name}**, {motor.title}, line {motor.line}\n", 1)


def _settings(known: "Drive", word: str, unit: int, **words: Any) -> str:
    from decimal import Decimal, InvalidOperation

    from driveblocks.docs import keypad

    silence = words["watchdog"]
    try:
        line = keypad.wanted(known, unit, words["baud"], words["form"], Decimal(silence) if silence else None)
    except InvalidOperation:
        refuse(f"`--watchdog` is a number of seconds, such as 1 or 0.5, not `{silence}`")
    except ValueError as error:
        refuse(str(error))
    return keypad.page(known, word, line)
