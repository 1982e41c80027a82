"""`driveblocks import-csv`: a register table from a spreadsheet as rows of a map."""

import sys
from pathlib import Path
from typing import Literal

import click

from driveblocks.commands import FILE, refuse, write
from structured_text import files
from structured_text.visible import file_name

COLUMN = "address, id, name, unit, scale, access, table, type, size or order"


@click.command()
@click.argument(
    "file",
    metavar="FILE",
    help="A table as CSV, TSV or pasted text, or a JSON template of wb-mqtt-serial; `-` reads standard input.",
)
@click.option("--column", "columns", multiple=True, metavar="WHAT=HEAD", help=f"The head of a column that is {COLUMN}.")
@click.option("--addresses", type=click.Choice(("hex", "decimal", "4xxxx")), help="How addresses are written.")
@click.option("--factor", type=click.Choice(("multiply", "divide")), help="What a factor does to a word that is read.")
@click.option("--words", type=click.Choice(("high", "low")), help="Which word of a value of 32 bits comes first.")
@click.option("-o", "output", type=FILE, metavar="ROWS.yaml", help="A new file for the rows; else they are printed.")
def run(  # noqa: PLR0913, PLR0917 - one for each option
    file: str,
    columns: tuple[str, ...],
    addresses: str | None,
    factor: Literal["multiply", "divide"] | None,
    words: Literal["high", "low"] | None,
    output: Path | None,
) -> None:
    """Turn a register table into rows of a map.

    Check them against the manual one by one. The first line names the columns. Every line that no row could be made of
    is reported with its number; what may be meant in two ways is refused, with the option that says which. The exit
    status is 0 if all were understood, 1 if some were left out, 2 for what is refused and for bad input.

    Example: driveblocks import-csv registers.csv --addresses hex
    """
    from driveblocks.maps import table

    named = dict(each.partition("=")[::2] for each in columns)
    if strange := named.keys() - table.COLUMNS.keys():
        raise click.BadParameter(f"`{min(strange)}` is none of {COLUMN}", param_hint="--column")
    try:
        text = sys.stdin.read() if file == "-" else files.text(Path(file))
        how = table.Reading(named, addresses, factor, order=words)
        made = table.read(text, "the input" if file == "-" else file_name(file), how)
    except UnicodeDecodeError:
        refuse("the input cannot be read: it is not UTF-8; save it as such")
    rows = "".join(f"      - {each}\n" for each in made.rows)
    if output is None:
        click.echo(rows, nl=False)
    else:
        write(output, rows, new=True)
    for each in table.few([f"{each}; left out" for each in made.left]):
        click.echo(each, err=True)
    click.echo("; ".join([f"{len(made.rows)} rows, {len(made.left)} left out", *made.assumed]), err=True)
    if made.left:
        sys.exit(1)
