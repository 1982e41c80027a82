"""`driveblocks line`: how fast a line is and how late its stops are, before anything is bought."""

from pathlib import Path
from typing import Any

import click

from driveblocks.commands import FILE, echo_json, only_over, write

PICTURE = only_over(rb"<svg [^>]*>\s*<title>One round of polls: ", "line --picture")


@click.command()
@click.argument(
    "line",
    nargs=-1,
    metavar="DRIVE[@UNIT]...|PROGRAM.st",
    help="Drives and unit addresses (else the next free), or a program.",
)
@click.option("--program", "name", metavar="NAME", help="Which PROGRAM, where the file has several.")
@click.option("--map", "maps", multiple=True, metavar="MAP", help="A map of your own that the program uses.")
@click.option(
    "--device",
    multiple=True,
    type=int,
    metavar="REGISTERS",
    help="A meter or a sensor beside the drives, of which as many registers are read; may be repeated.",
)
@click.option("--rate", type=int, metavar="RATE", help="Bit rate; else of the program, or of the drives as delivered.")
@click.option("--format", "form", metavar="8N1", help="Data bits, parity, stop bits; else likewise.")
@click.option("--ascii", is_flag=True, help="MODBUS ASCII instead of RTU.")
@click.option("--scan", metavar="TIME", default="10ms", help="Time between two scans.")
@click.option("--max-scan", metavar="TIME", help="The longest; else MaxScanMs of the program, or two scans.")
@click.option("--keeps-silence", is_flag=True, help="The port itself keeps the silence between frames.")
@click.option("--port-late", metavar="TIME", help="How long the port or its adapter delays request and reply.")
@click.option(
    "--reply", metavar="TIME", help="How long a drive takes until its reply begins; else 20 ms, or its setting."
)
@click.option("--watchdog", metavar="TIME", help="Time of the drives' own watchdogs; a program has it itself.")
@click.option("--stop-within", metavar="TIME", help="The stops of all drives have to be sent within this time.")
@click.option("--picture", type=FILE, callback=PICTURE, metavar="FILE.svg", help="Draw one round of the line.")
@click.option("--json", is_flag=True, help="Print all figures of all rates as JSON.")
def run(picture: Path | None, json: bool, **words: Any) -> None:
    """Compute how often drives are read and how late stops can be.

    It does so before anything is bought. The figures of stops and of how old a status gets are those of the line block
    itself, run at each bit rate; nothing is sent. It names the families whose stop would move a drive of another one of
    the line. The exit status is 0; 1 if at the line's own rate --stop-within does not hold, a status can get older than
    its StaleMs, or what feeds a watchdog can wait for more than two thirds of its time, or if no block could see such
    a mix-up; 2 for bad input.

    Example: driveblocks line chf@1 chf@2 jscc@3 --rate 19200 --stop-within 500ms --picture round.svg
    """
    import sys

    from driveblocks import console
    from driveblocks.desk.site import asked, report
    from driveblocks.desk.site import picture as pictures
    from driveblocks.desk.site.line import figures

    line = asked.line(asked.Words(**words))
    tried = [figures(line, rate) for rate in line.rates()]
    own = next(each for each in tried if each.rate == line.rate)
    if picture is not None:
        write(picture, pictures.drawn(own))
    if json:
        echo_json(report.plain(tried))
    else:
        console.write(*report.tables(tried))
    untold = [each for each in report.mistaken(line) if not each.told]
    sys.exit(1 if own.broken or untold else 0)
