"""`driveblocks listen`: what others say on a line, without a byte of one's own."""

import sys
from typing import Any

import click

from driveblocks.commands import FILE, echo_json


@click.command()
@click.argument("maps", nargs=-1, metavar="[MAP[@UNIT]]...", help="Maps whose words name what is read and written.")
@click.option("--port", metavar="DEVICE", help="A serial port, such as COM3 or /dev/ttyUSB0.")
@click.option("--tcp", metavar="HOST:PORT", help="The bytes of the line over TCP.")
@click.option("--rate", type=int, metavar="RATE", help="Bit rate; else it is found.")
@click.option("--format", "form", metavar="8N1", help="Data bits, parity, stop bits; else they are found.")
@click.option("--for", "length", metavar="TIME", help="How long, such as 60s; else until Ctrl-C.")
@click.option("--log", type=FILE, metavar="FILE", help="Write each frame, as `driveblocks explain` reads it.")
@click.option("--csv", type=FILE, metavar="FILE.csv", help="Write each frame as a row.")
@click.option("--json", is_flag=True, help="Print what was heard as JSON.")
def run(json: bool, **words: Any) -> None:
    """Listen to a line that others speak on, and send nothing.

    Units, functions, registers, times and what is odd are shown. Rate and format are found by what decodes, for eight
    minutes at most. Open the port first, then clip the adapter on. The exit status is 0; 1 if nothing decodes, the port
    goes away or a file is not complete; 2 for bad input.

    Example: driveblocks listen chf@1 jscc@2 --port /dev/ttyUSB0 --log line.log
    """
    from driveblocks import console
    from driveblocks.desk.site import listen, overheard

    way, traffic, ended, wrong = listen.run(listen.Words(**words))
    if json:
        told = overheard.plain(way, traffic) | {"ended": ended, "not_complete": wrong}
        echo_json(told)
    elif way is not None:
        console.write(*overheard.tables(way, traffic))
    else:
        console.write("Nothing decoded.")
    if ended:
        click.echo(f"Ended early: {ended}", err=True)
    for each in wrong:
        click.echo(each, err=True)
    sys.exit(1 if way is None or ended or wrong else 0)
