"""`driveblocks sheet`: what a person takes to the machine, on one page."""

from typing import TYPE_CHECKING, Any

import click

from driveblocks.commands import refuse

if TYPE_CHECKING:
    from driveblocks.maps.model import Drive


@click.command()
@click.argument("drive", metavar="DRIVE", help="Name of a shipped drive, a part of it, or the path of a map.")
@click.option("--master", is_flag=True, help="The requests of a PLC that is its own master.")
@click.option("--address", metavar="N", type=int, default=1, show_default=True, help="Unit address of the drive.")
@click.option("--baud", metavar="RATE", type=int, help="Bit rate; if none is given, that of the drive as delivered.")
@click.option("--format", "form", metavar="8N1", help="Data bits, parity, stop bits; else as delivered.")
@click.option("--watchdog", metavar="S", type=str, help="How long the line may be silent, in seconds; else left open.")
@click.option(
    "--full-scale", metavar="HZ", type=float, default=50.0, show_default=True,
    help="What 100 % of the reference is, where it is a part of something.",
)  # fmt: skip
def run(drive: str, master: bool, address: int, full_scale: float, **words: Any) -> None:
    """Print a page for the machine, as Markdown.

    Every setting at the keypad, filled in for this address, rate and format, with boxes to tick; terminals; what to
    measure first.

    With --master: the requests that a PLC sends which has a Modbus instruction and takes no block, in order, with
    function, register, value and frame: the stop first, then reads, start, what keeps it running, the fault reset, and
    what must never be written.

    Examples: driveblocks sheet pf525 --address 3 --baud 19200 --watchdog 1,
    driveblocks sheet chf --master --full-scale 60 > chf.md
    """
    from driveblocks.docs import recipe
    from driveblocks.maps import load
    from driveblocks.meaning.serial import serial

    _, known = load.named(drive)
    if not master:
        click.echo(_settings(known, drive, address, **words), nl=False)
        return
    line = serial(known)
    if not line.lowest <= address <= line.highest:
        refuse(f"the unit addresses of this drive are {line.lowest} to {line.highest}, not {address}")
    if full_scale <= 0:
        refuse(f"`--full-scale` is more than 0 Hz, not {full_scale:g}")
    click.echo(recipe.page(known, drive, address, full_scale))


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
