"""`driveblocks listen`: who speaks on a line, what is asked how often, and what is wrong; nothing is ever sent."""

import sys
from typing import Any

import click

from driveblocks.commands import FILE, refuse


@click.command()
@click.argument("maps", nargs=-1, metavar="MAP[@UNIT]...", help="Maps of units; one without UNIT is for all others.")
@click.option("--port", metavar="DEVICE", help="A serial port, such as COM3 or /dev/ttyUSB0.")
@click.option("--tcp", metavar="HOST:PORT", help="Serial bytes over TCP, as a serial device server gives them.")
@click.option("--rate", type=int, metavar="RATE", help="Listen at this bit rate only; else it is found out.")
@click.option("--format", "form", metavar="8N1", help="Listen with these data bits, parity, stop bits only.")
@click.option("--mode", type=click.Choice(["rtu", "ascii"]), help="Listen for this framing only.")
@click.option("--for", "length", metavar="TIME", help="End after this time, such as 60s; else with Ctrl-C.")
@click.option("--log", type=FILE, metavar="FILE", help="Write every frame there, as `driveblocks explain` reads it.")
@click.option("--csv", type=FILE, metavar="FILE", help="Write the registers there as a table.")
@click.option("--json", is_flag=True, help="Print everything as JSON at the end.")
def run(**options: Any) -> None:
    """Listen to a line with a master at work: units, registers, times, damaged frames; nothing is ever sent.

    Rate and format are found by what decodes. Open the port first, then clip the adapter on. The exit status is 0 if
    frames were heard, 1 if not or if the port or a file failed, 2 for bad input.

    Example: driveblocks listen chf@1 jscc@2 --port /dev/ttyUSB0 --for 60s --log line.log
    """
    from json import dumps

    from driveblocks import console
    from driveblocks.plc.options import Refused
    from driveblocks.site import listen, spoken

    try:
        heard = listen.run(listen.Words(**options))
    except Refused as refused:
        refuse(str(refused))
    if heard.findings is not None and heard.way is not None:
        if options["json"]:
            click.echo(dumps(spoken.plain(heard.findings, heard.way), ensure_ascii=False, indent=2))
        else:
            console.write(*spoken.tables(heard.findings, heard.way))
    for each in heard.failed:
        click.echo(each, err=True)
    sys.exit(1 if heard.failed or heard.findings is None or not heard.findings.good else 0)
