"""`driveblocks commission`: find a drive on its line, check its keypad, measure it, ask for what its manual lacks."""

import sys
from pathlib import Path
from typing import Any

import click

from driveblocks.commands import FILE, refuse


@click.command()
@click.argument("map", metavar="[MAP]", required=False, help="The drive's map, by name or path; else of a plant.")
@click.option("--port", metavar="DEVICE", help="A serial port, such as COM3 or /dev/ttyUSB0: a REAL PORT.")
@click.option("--tcp", metavar="HOST:PORT", help="Serial bytes over TCP: a REAL PORT, or `driveblocks simulate`.")
@click.option("--rate", type=int, metavar="RATE", help="Try this bit rate only; else those of the map.")
@click.option("--format", "form", metavar="8N1", help="Try these data bits, parity, stop bits only.")
@click.option("--mode", type=click.Choice(["rtu", "ascii"]), help="Try this framing only.")
@click.option("--unit", type=int, metavar="UNIT", help="Try this unit address only.")
@click.option("--label", default="Drive1", metavar="NAME", help="What the drive is called in the machine, and in FILE.")
@click.option("--who", default="", metavar="NAME", help="Who is there, for FILE and its report.")
@click.option("--skip", multiple=True, metavar="STEP", help="Skip plate, keypad, measure or gaps; may be repeated.")
@click.option(
    "--file",
    type=FILE,
    default=Path("site.yaml"),
    metavar="FILE",
    help="Where what was found is kept; of a plant, map, rate, format and unit of the label are taken, too.",
)
@click.option("--replace", is_flag=True, help="Replace what FILE has of this label.")
def run(**words: Any) -> None:
    """Find and check a new drive; nothing is written to it.

    Disconnect the PLC first, and leave one drive on the line. Nothing is sent before 60 s of silence and a typed word.
    Enter skips a question. The exit status is 0 if all steps came to their end, 1 if not, 2 for bad input.

    Examples: driveblocks commission chf --port /dev/ttyUSB0 --label Pump,
    driveblocks commission --file plant.yaml --label P1 --port /dev/ttyUSB0
    """
    from driveblocks.desk.site import hour

    words |= _of_plant(words)
    if words["map"] is None:
        refuse(f"name the map, or a drive of a plant: --file plant.yaml --label P1; {words['file']} is no plant")
    sys.exit(1 if hour.run(hour.Words(**words), input).ended else 0)


def _of_plant(words: dict[str, Any]) -> dict[str, Any]:
    """What a plant says of the drive, where the words do not. Raises Refused."""
    from driveblocks.plant import word

    if not word.is_plant(words["file"]):
        return {}
    found = word.drive(words["file"], words["label"])
    way = found.way
    said = {"map": found.word, "rate": way.rate, "form": way.form, "mode": way.mode, "unit": found.motor.unit}
    return {key: value for key, value in said.items() if words[key] is None}
