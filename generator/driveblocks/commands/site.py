"""`driveblocks site`: what commissioning has found, as settings for the PLC, a page to be signed, a field report."""

from pathlib import Path

import click

from driveblocks.commands import FILE, only_over, refuse, write
from driveblocks.platforms import EXPORTS

PAGE = only_over(rb"<!doctype html><html lang='en'><head><meta charset='utf-8'><title>Commissioning<", "site --html")


@click.command()
@click.argument(
    "file", type=FILE, default=Path("site.yaml"), metavar="[FILE]", help="What `commission` has kept, else site.yaml."
)
@click.option("--to", "target", type=click.Choice(EXPORTS), default="beremiz", help="The platform of the PLC.")
@click.option("--html", type=FILE, callback=PAGE, metavar="FILE.html", help="Write a page to be printed and signed.")
@click.option("--report", metavar="LABEL", help="Print what was found of one drive, to be sent as an issue.")
@click.option("--map", "maps", multiple=True, metavar="MAP", help="A map of your own that a drive is of, for --html.")
def run(file: Path, target: str, html: Path | None, report: str | None, maps: tuple[str, ...]) -> None:
    """Print the settings of each drive of site.yaml, or a report.

    Each is an initialised VFD_Settings. What was measured on one drive is for that drive alone: maps and blocks do not
    change. The exit status is 0, or 2 for bad input.

    Example: driveblocks site --to siemens --html pump.html
    """
    from driveblocks.desk.site import kept, sheet
    from driveblocks.maps import catalog
    from driveblocks.maps.load import load

    entries = kept.read(file)
    own = {path.stem: path for path in map(catalog.resolve, maps)}
    names = {each.map for each in entries.values() if html}
    drives = {each: load(own.get(each) or catalog.resolve(each)) for each in names}
    if report is not None and report not in entries:
        refuse(f"{file} has no {report}; it has {', '.join(entries)}")
    if html is not None:
        write(html, sheet.page(entries, drives))
    lines = sheet.report(report, entries[report]) if report else sheet.initialisation(entries, target)
    for line in lines:
        click.echo(line)
