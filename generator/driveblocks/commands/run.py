"""`driveblocks run`: a soft PLC for a program in ST, on simulated drives or a real line."""

import sys
from typing import TYPE_CHECKING, Any

import click

from driveblocks.commands import FILE, refuse

if TYPE_CHECKING:
    from driveblocks.desk.run.setup import Given

USUAL_SCAN = "10ms"


@click.command()
@click.argument(
    "program",
    type=FILE,
    required=False,
    metavar="[PROGRAM.st|PLANT.yaml]",
    help="The program; the library is added to it.",
)
@click.option("--program", "name", metavar="NAME", help="Which PROGRAM, where the file has several.")
@click.option("--map", "maps", multiple=True, metavar="MAP", help="A map of your own that the program uses.")
@click.option(
    "--simulate",
    multiple=True,
    metavar="DRIVE[@UNIT][:HZ]",
    help="Simulate a shipped drive or that of a map; HZ is its maximum (50). Without it or a port: the program's.",
)
@click.option("--tcp", metavar="HOST:PORT", help="Serial bytes over TCP: a REAL PORT, whatever its address.")
@click.option("--simulated", is_flag=True, help="There are only simulated drives behind --tcp, on this computer.")
@click.option("--port", metavar="DEVICE", help="A serial port, such as COM3 or /dev/ttyUSB0: a REAL PORT.")
@click.option("--format", "form", metavar="8E1", help="Data bits, parity, stop bits of --port; else by CharacterBits.")
@click.option("--scan", metavar="TIME", help="Time between two scans, 10ms unless given; of a plant as it says.")
@click.option(
    "--watchdog",
    metavar="TIME",
    help="A scan that takes longer ends the run; 500ms unless given. The first scan may take 3s.",
)
@click.option("--for", "length", metavar="TIME", help="End after this time, such as 60s.")
@click.option(
    "--show",
    multiple=True,
    metavar="NAME",
    help="Show this variable, too; may be repeated. It is traced and drawn, too.",
)
@click.option("--script", type=FILE, metavar="FILE", help="Set inputs by lines such as: at 2.5s: Start := TRUE")
@click.option(
    "--scenario", type=FILE, metavar="FILE.yaml", help="What happens to simulated drives, such as - at 3 s: trip OC 2"
)
@click.option("--trace", type=FILE, metavar="FILE.csv", help="Write what the shown variables did.")
@click.option("--picture", type=FILE, metavar="FILE.svg", help="Draw what the drives did, and the shown variables.")
@click.option("--allow-run", is_flag=True, help="Send more than reads and stops on a real port; asks first.")
@click.option("--demo", is_flag=True, help="Two pumps and a fan of three makes, simulated, fifteen seconds.")
@click.option("--fast", is_flag=True, help="With simulated drives: do not wait between scans.")
def run(show: tuple[str, ...], **words: Any) -> None:
    """Run a program as a soft PLC, at simulated drives or a line.

    On a REAL PORT only reads and the maps' stops are sent, unless --allow-run. Whatever ends the run, every drive is
    stopped first, and those that could not be confirmed are named: at Ctrl-C and every signal that can be caught,
    and by a watchdog if a scan does not end. No program can do so after kill -9, while the computer sleeps, or over
    an unplugged cable: wire a hard stop. The exit status is 0 if all drives came to standstill, 1 if one could not
    be confirmed or the program failed, and 2 for bad input or a file that cannot be written.

    Of a plant, its program runs at simulated drives of its addresses; its hard stops close with their contacts.

    Examples: driveblocks run my_line.st --simulate jscc@1 --for 60s, driveblocks run plant.yaml
    """
    from driveblocks.desk.keyboard import Keyboard
    from driveblocks.desk.run import permission
    from driveblocks.desk.run.options import Options
    from driveblocks.desk.run.setup import Setup

    given, scan = _given(words)
    words["scan"] = words["scan"] or scan
    options = Options(show=tuple(",".join(show).replace(",", " ").split()), **words)
    keyboard = Keyboard(0)
    made = Setup(options, keyboard, given)
    sys.exit(made.run(permission.ask(made.probe, keyboard) if options.allow_run else frozenset()))


def _given(words: dict[str, Any]) -> "tuple[Given | None, str]":
    """What a plant gives, and its scan. Ends with status 2 for a word that is not for a plant."""
    from driveblocks.plant.word import is_plant

    if words["program"] is None or not is_plant(words["program"]):
        return None, USUAL_SCAN
    from driveblocks.plant import check, play

    if named := [each for each in ("name", "maps", "simulate") if words[each]]:
        option = {"name": "--program", "maps": "--map", "simulate": "--simulate"}[named[0]]
        refuse(f"{option} is for a program; a plant says itself what there is")
    plant = check.good(words["program"])
    return play.given(plant), f"{plant.scan_ms}ms"
