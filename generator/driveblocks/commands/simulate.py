"""`driveblocks simulate`: drives of their maps on a line, for any master."""

from pathlib import Path
from typing import Annotated

import typer

from driveblocks.commands import refuse

Drives = Annotated[
    list[str] | None,
    typer.Argument(
        metavar="DRIVE[@UNIT][:HZ]...", help="Drives, unit addresses (else the next free), their own maximum (else 50)."
    ),
]
Port = Annotated[
    str | None, typer.Option(metavar="DEVICE", help="Serve a serial port, such as COM3 or /dev/ttyUSB0: a REAL PORT.")
]
Tcp = Annotated[
    str | None, typer.Option(metavar="127.0.0.1:PORT", help="Serve serial bytes over TCP, on this computer only.")
]
Pty = Annotated[bool, typer.Option("--pty", help="Serve a pseudo-terminal (not on Windows); its name is printed.")]
Baud = Annotated[int, typer.Option("--baud", metavar="RATE", help="Bit rate, over TCP and --pty, too.")]
Form = Annotated[str, typer.Option("--format", metavar="8N1", help="Data bits, parity, stop bits.")]
Ascii = Annotated[bool, typer.Option("--ascii", help="MODBUS ASCII instead of RTU.")]
Scenario = Annotated[
    Path | None, typer.Option(metavar="FILE.yaml", help="Events and their times, such as - at 3 s: trip OC")
]
Frames = Annotated[bool, typer.Option("--frames", help="Print every frame as `driveblocks explain` does.")]
For = Annotated[str | None, typer.Option("--for", metavar="TIME", help="End after this time, such as 60s.")]
Schema = Annotated[bool, typer.Option("--schema", help="Print the JSON Schema of scenarios, and nothing else.")]


def run(  # noqa: PLR0913, PLR0917 - one parameter per option of the command line
    drives: Drives = None,
    port: Port = None,
    tcp: Tcp = None,
    pty: Pty = False,
    baud: Baud = 19200,
    form: Form = "8N1",
    ascii_mode: Ascii = False,
    scenario: Scenario = None,
    frames: Frames = False,
    for_: For = None,
    schema: Schema = False,
) -> None:
    """Simulate drives on one line, for a PLC, a program or a tool that speaks MODBUS.

    Without --port, --tcp or --pty they are at 127.0.0.1:5020. On a REAL PORT it listens for 3 seconds, then asks each
    of its addresses, and does not start if a real unit answers. The exit status is 0, or 2 for bad input.

    Example: driveblocks simulate jscc@1 chf@2 --scenario trips.yaml --frames
    """
    from driveblocks.plc import scenario as scenarios
    from driveblocks.plc.options import Refused
    from driveblocks.stand.setup import Setup, Words

    if schema:
        typer.echo(scenarios.schema(), nl=False)
        return
    if not drives:
        refuse("name a drive; for example: driveblocks simulate jscc@1")
    words = Words(
        drives=drives, port=port, tcp=tcp, pty=pty, baud=baud, form=form.upper(), ascii=ascii_mode,
        scenario=scenario, frames=frames, length=for_,
    )  # fmt: skip
    try:
        Setup(words).run()
    except Refused as refused:
        refuse(str(refused))
