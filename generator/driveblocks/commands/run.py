"""`driveblocks run`: a soft PLC for a program in ST, on simulated drives or a real line."""

from pathlib import Path
from typing import Annotated

import typer

from driveblocks.commands import refuse

Program = Annotated[Path | None, typer.Argument(metavar="PROGRAM.st", help="The program; the library is added to it.")]
Name = Annotated[
    str | None, typer.Option("--program", metavar="NAME", help="Which PROGRAM, where the file has several.")
]
Maps = Annotated[
    list[str] | None, typer.Option("--map", metavar="MAP", help="A map of your own that the program uses.")
]
Simulate = Annotated[
    list[str] | None,
    typer.Option(
        "--simulate",
        metavar="DRIVE[@UNIT][:HZ]",
        help="Simulate this drive, with its own maximum (50); may be repeated. Without any port: those of the program.",
    ),
]
Tcp = Annotated[
    str | None,
    typer.Option(metavar="HOST:PORT", help="Serial bytes over TCP: a REAL PORT, whatever its address."),
]
Simulated = Annotated[
    bool, typer.Option("--simulated", help="There are only simulated drives behind --tcp, on this computer.")
]
Port = Annotated[
    str | None, typer.Option(metavar="DEVICE", help="A serial port, such as COM3 or /dev/ttyUSB0: a REAL PORT.")
]
Form = Annotated[
    str | None,
    typer.Option("--format", metavar="8E1", help="Data bits, parity, stop bits of --port; else by CharacterBits."),
]
Scan = Annotated[str, typer.Option(metavar="TIME", help="Time between two scans.")]
Watchdog = Annotated[
    str | None,
    typer.Option(
        metavar="TIME",
        help="A scan that takes longer ends the run; 500ms unless given. The first scan may take 3s.",
    ),
]
For = Annotated[str | None, typer.Option("--for", metavar="TIME", help="End after this time, such as 60s.")]
Show = Annotated[
    list[str] | None,
    typer.Option(
        "--show", metavar="NAME", help="Show this variable, too; may be repeated. It is traced and drawn, too."
    ),
]
Script = Annotated[
    Path | None, typer.Option(metavar="FILE", help="Set inputs by lines such as: at 2.5s: Start := TRUE")
]
Scenario = Annotated[
    Path | None,
    typer.Option(metavar="FILE.yaml", help="What happens to simulated drives, such as - at 3 s: trip OC 2"),
]
Trace = Annotated[Path | None, typer.Option(metavar="FILE.csv", help="Write what the shown variables did.")]
Picture = Annotated[Path | None, typer.Option(metavar="FILE.svg", help="Draw a timing diagram of the shown variables.")]
Allow = Annotated[bool, typer.Option("--allow-run", help="Send more than reads and stops on a real port; asks first.")]
Demo = Annotated[bool, typer.Option("--demo", help="Two pumps and a fan of three makes, simulated, fifteen seconds.")]
Fast = Annotated[bool, typer.Option("--fast", help="With simulated drives: do not wait between scans.")]


def run(  # noqa: PLR0913, PLR0917 - one parameter per option of the command line
    program: Program = None,
    name: Name = None,
    maps: Maps = None,
    simulate: Simulate = None,
    tcp: Tcp = None,
    simulated: Simulated = False,
    port: Port = None,
    form: Form = None,
    scan: Scan = "10ms",
    watchdog: Watchdog = None,
    for_: For = None,
    show: Show = None,
    script: Script = None,
    scenario: Scenario = None,
    trace: Trace = None,
    picture: Picture = None,
    allow_run: Allow = False,
    demo: Demo = False,
    fast: Fast = False,
) -> None:
    """Run a program: a soft PLC on this computer, at simulated drives or at a real line.

    On a REAL PORT only reads and the maps' stops are sent, unless --allow-run. Whatever ends the run, every drive is
    stopped first, and those that could not be confirmed are named: at Ctrl-C and every signal that can be caught,
    and by a watchdog if a scan does not end. No program can do so after kill -9, while the computer sleeps, or over
    an unplugged cable: wire a hard stop. The exit status is 0 if all drives came to standstill, 1 if one could not
    be confirmed or the program failed, and 2 for bad input or a file that cannot be written.

    Example: driveblocks run my_line.st --simulate jscc@1 --for 60s
    """
    from driveblocks.plc.keyboard import Keyboard
    from driveblocks.plc.options import Options, Refused
    from driveblocks.plc.setup import Setup

    options = Options(
        program=program, name=name, maps=tuple(maps or ()), simulate=tuple(simulate or ()), tcp=tcp, port=port,
        simulated=simulated, form=form, scan=scan, watchdog=watchdog, length=for_,
        show=tuple(",".join(show or ()).replace(",", " ").split()),
        script=script, scenario=scenario, trace=trace, picture=picture, allow_run=allow_run, demo=demo, fast=fast,
    )  # fmt: skip
    try:
        status = Setup(options, Keyboard(0)).run()
    except Refused as refused:
        refuse(str(refused))
    if status:
        raise typer.Exit(status)
