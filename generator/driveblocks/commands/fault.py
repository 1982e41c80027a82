"""`driveblocks fault`: what a fault of a drive means, and what to do about it."""

from collections.abc import Iterator
from typing import TYPE_CHECKING

import click

from driveblocks.commands import refuse

if TYPE_CHECKING:
    from driveblocks.maps.model import Drive
    from driveblocks.meaning.advice import Advice


@click.command()
@click.argument("drive", metavar="DRIVE", help="Name or model number of a shipped drive, or the path of a map.")
@click.argument("code", metavar="CODE", help="As the keypad shows it, or as the bus gives it: 30, 1EH or 0x1E.")
def run(drive: str, code: str) -> None:
    """Say what a fault means, what helps, and what clears it.

    Causes and remedies are from the maker's table, in other words, where it was read. The exit
    status is 2 for a code that the drive does not have, with the nearest.

    Examples: driveblocks fault pf525 13, driveblocks fault pf525 F081, driveblocks fault gd200a OL1
    """
    from driveblocks.maps import load
    from driveblocks.meaning import advice

    _, known = load.named(drive)
    if not known.faults.codes:
        refuse(f"the manual of {known.prefix} lists no fault codes: see the drive's own")
    found = advice.asked(known, code)
    if not found:
        near = "\n".join(f"  {_title(one)}" for one in advice.nearest(known, code))
        refuse(f"{known.prefix} has no fault `{code}`; nearest are\n{near}")
    click.echo("\n\n".join("\n".join(_page(known, one)) for one in found))


def _title(one: "Advice") -> str:
    return "  ".join(filter(None, (one.keypad, f"{one.code} ({one.code:02X}H)", one.name)))


def _page(drive: "Drive", one: "Advice") -> Iterator[str]:
    yield f"{drive.prefix} {_title(one)}"
    for head, some in (("causes", one.causes), ("what to do", one.remedies)):
        yield from (f"{head}:", *(f"  - {each}" for each in some)) if some else ()
    if not one.causes and not one.remedies:
        yield "causes and remedies: none in the map; see the drive's own manual"
    yield from [f"note: {one.note}"] if one.note else []
    yield f"clears it, once the cause is gone: {one.clears}"
    yield f"the block shows: Fault, FaultCode {one.code}, Reason 40"
    from_ = drive.faults.help if one.causes or one.remedies else None
    if from_:
        document = next((each.title for each in drive.documents if each.id == from_.document), "the manual")
        yield f"source: {document}: {from_.source}"
