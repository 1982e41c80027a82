"""`driveblocks simulate`: drives of their maps on a line, for any master."""

from typing import Any

import click

from driveblocks.commands import FILE, refuse


@click.command()
@click.argument(
    "drives",
    nargs=-1,
    metavar="DRIVE[@UNIT][:HZ]...",
    help="Shipped drives or paths of maps, with unit address (else the next free one) and own maximum (else 50 Hz).",
)
@click.option("--port", metavar="DEVICE", help="Serve a serial port, such as COM3 or /dev/ttyUSB0: a REAL PORT.")
@click.option("--tcp", metavar="127.0.0.1:PORT", help="Serve serial bytes over TCP, on this computer only.")
@click.option("--pty", is_flag=True, help="Serve a pseudo-terminal (not on Windows); its name is printed.")
@click.option("--baud", metavar="RATE", type=int, help="Bit rate, over TCP, too; else as the drives are delivered.")
@click.option("--format", "form", metavar="8N1", help="Data bits, parity, stop bits; else as the drives are delivered.")
@click.option("--ascii", is_flag=True, help="MODBUS ASCII instead of RTU.")
@click.option("--scenario", type=FILE, metavar="FILE.yaml", help="Events and their times, such as - at 3 s: trip OC")
@click.option("--frames", is_flag=True, help="Print every frame as `driveblocks explain` does.")
@click.option("--for", "length", metavar="TIME", help="End after this time, such as 60s.")
@click.option("--schema", is_flag=True, help="Print the JSON Schema of scenarios, and nothing else.")
def run(drives: tuple[str, ...], schema: bool, **words: Any) -> None:
    """Simulate drives on a line, for a PLC or any MODBUS tool.

    Without --port, --tcp or --pty they are at 127.0.0.1:5020. On a REAL PORT it listens for 3 seconds, then asks each
    of its addresses, and does not start if a real unit answers. The exit status is 0, or 2 for bad input.

    Example: driveblocks simulate jscc@1 chf@2 --scenario trips.yaml --frames
    """
    from driveblocks.desk import scenario as scenarios
    from driveblocks.desk.simulate.setup import Setup, Words

    if schema:
        click.echo(scenarios.schema(), nl=False)
        return
    if not drives:
        refuse("name a drive; for example: driveblocks simulate jscc@1")
    made = Words(drives=drives, **words)
    Setup(made).run()
