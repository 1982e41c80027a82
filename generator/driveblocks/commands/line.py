"""`driveblocks line`: how fast a line is and how late its stops are, before anything is bought."""

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from driveblocks.commands import FILE, echo_json, only_over, refuse, write

if TYPE_CHECKING:
    from driveblocks.desk.site.line import Line

PICTURE = only_over(rb"<svg [^>]*>\s*<title>One round of polls: ", "line --picture")


@click.command()
@click.argument(
    "line",
    nargs=-1,
    metavar="DRIVE[@UNIT]...|PROGRAM.st|PLANT.yaml",
    help="Drives and unit addresses (else the next free), a program, or a plant.",
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

    Of a plant it computes each line, as the file says it.

    Example: driveblocks line chf@1 chf@2 jscc@3 --rate 19200 --stop-within 500ms --picture round.svg
    """
    import sys

    from driveblocks import console
    from driveblocks.desk.site import asked, report
    from driveblocks.desk.site import picture as pictures
    from driveblocks.desk.site.line import figures

    plant = _plant(words, pictured=picture is not None)
    lines = plant or {"": asked.line(asked.Words(**words))}
    tried = {name: [figures(line, rate) for rate in line.rates()] for name, line in lines.items()}
    own = [next(each for each in some if each.rate == each.line.rate) for some in tried.values()]
    if picture is not None:
        write(picture, pictures.drawn(own[0]))
    if json:
        plain = {name: report.plain(some) for name, some in tried.items()}
        echo_json(plain if plant else plain[""])
    else:
        for at, (name, some) in enumerate(tried.items()):
            console.write(*[*[""] * bool(at), f"Line {name}"] * bool(plant), *report.tables(some))
    untold = [each for line in lines.values() for each in report.mistaken(line) if not each.told]
    sys.exit(1 if untold or any(each.broken for each in own) else 0)


def _plant(words: dict[str, Any], *, pictured: bool) -> "dict[str, Line]":
    """The lines of a plant; none where the words name no plant. Ends with status 2."""
    from driveblocks.plant.check import spoken
    from driveblocks.plant.word import is_plant

    named, usual = words["line"], {"scan": "10ms", "maps": (), "device": (), "ascii": False, "keeps_silence": False}
    if not any(each.lower().endswith((".yaml", ".yml")) and is_plant(Path(each)) for each in named):
        return {}
    if len(named) > 1:
        refuse("name one plant, one program, or drives")
    if given := [key for key, value in words.items() if key != "line" and value != usual.get(key)]:
        refuse(f"--{given[0].replace('_', '-')} is for a program or named drives, not for a plant")
    _, lines = spoken(Path(named[0]))
    if pictured and len(lines) > 1:
        refuse(f"{len(lines)} lines ({', '.join(lines)}); --picture draws one: name its drives")
    return lines
