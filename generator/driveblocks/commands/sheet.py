"""`driveblocks sheet`: what a person takes to the machine, on one page."""

import click

from driveblocks.commands import refuse


@click.command()
@click.argument("drive", metavar="DRIVE", help="Name of a shipped drive, a part of it, or the path of a map.")
@click.option("--master", is_flag=True, help="The requests of a PLC that is its own master.")
@click.option("--address", metavar="N", type=int, default=1, show_default=True, help="Unit address of the drive.")
@click.option(
    "--full-scale", metavar="HZ", type=float, default=50.0, show_default=True,
    help="What 100 % of the reference is, where it is a part of something.",
)  # fmt: skip
def run(drive: str, master: bool, address: int, full_scale: float) -> None:
    """Print a page for the machine, as Markdown.

    With --master: the requests that a PLC sends which has a Modbus instruction and takes no block, in order, with
    function, register, value and frame: the stop first, then reads, start, what keeps it running, the fault reset, and
    what must never be written.

    Examples: driveblocks sheet pf525 --master --address 3, driveblocks sheet chf --master --full-scale 60 > chf.md
    """
    from driveblocks.docs import recipe
    from driveblocks.maps import load
    from driveblocks.meaning.serial import serial

    _, known = load.named(drive)
    if not master:
        refuse("say which page: `--master` is for a PLC that is its own master")
    line = serial(known)
    if not line.lowest <= address <= line.highest:
        refuse(f"the unit addresses of this drive are {line.lowest} to {line.highest}, not {address}")
    if full_scale <= 0:
        refuse(f"`--full-scale` is more than 0 Hz, not {full_scale:g}")
    click.echo(recipe.page(known, address, full_scale))
