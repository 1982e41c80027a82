"""`driveblocks import-csv`: a register table from a spreadsheet as rows of a map."""

import sys
from pathlib import Path

import click

from driveblocks.commands import FILE, refuse, write

COLUMN = "address, id, name, unit, scale or access"


@click.command()
@click.argument("file", metavar="FILE", help="A table as CSV, TSV or pasted text; `-` reads standard input.")
@click.option("--column", "columns", multiple=True, metavar="WHAT=HEAD", help=f"The head of a column that is {COLUMN}.")
@click.option("--addresses", type=click.Choice(("hex", "decimal", "4xxxx")), help="How addresses are written.")
@click.option("-o", "output", type=FILE, metavar="ROWS.yaml", help="A new file for the rows; else they are printed.")
def run(file: str, columns: tuple[str, ...], addresses: str | None, output: Path | None) -> None:
    """Turn a register table into rows of a map.

    Check them against the manual one by one. The first line names the columns. Every line that no row could be made of
    is reported with its number. The exit status is 0 if all were understood, 1 if some were left out, 2 for bad input.

    Example: driveblocks import-csv registers.csv --addresses hex
    """
    from driveblocks.maps import table
    from driveblocks.maps.problem import printable

    named = dict(each.partition("=")[::2] for each in columns)
    if strange := named.keys() - table.COLUMNS.keys():
        raise click.BadParameter(f"`{min(strange)}` is none of {COLUMN}", param_hint="--column")
    if output is not None and output.exists():
        refuse(f"{printable(str(output))}: is there already; name a new file")
    try:
        text = sys.stdin.read() if file == "-" else Path(file).read_text(encoding="utf-8-sig")
        made = table.read(text, "the input" if file == "-" else printable(file), named, addresses)
    except table.TableError as error:
        refuse(str(error))
    except UnicodeDecodeError:
        refuse(f"{printable(file)}:1:1: cannot be read: it is not UTF-8; save it as such")
    except OSError as error:
        refuse(f"{printable(file)}:1:1: cannot be read: {error.strerror}")
    rows = "".join(f"      - {each}\n" for each in made.rows)
    if output is None:
        click.echo(rows, nl=False)
    else:
        write(output, rows, "x")
    for each in made.left:
        click.echo(f"{each}; left out", err=True)
    click.echo(f"{len(made.rows)} rows, {len(made.left)} left out", err=True)
    if made.left:
        sys.exit(1)
