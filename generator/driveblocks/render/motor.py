"""The first program of a user: one motor on one port."""

from driveblocks.maps.model import Drive
from driveblocks.render import context
from driveblocks.render.context import Context
from driveblocks.render.drive import drive_block

SCAN_MS = 10
"""Interval of its task."""


def motor(drive: Drive) -> Context:
    """For motor/: the drive's name and what it is to be told, and the factory settings of its line."""
    return {
        "drive": drive,
        "name": f"{drive.prefix}_Drive",
        "family": context.identity(drive).family,
        "port": _port(drive),
        "scan": SCAN_MS,
        "has_reset": any(one.does == "fault_reset" for one in drive.operation.commands),
        "second_hand": drive.manual.second_hand,
        "unscaled": drive_block(drive)["scaled"] is False,
        "ascii": "rtu" not in drive.serial.mode.modes,
    }


def _port(drive: Drive) -> dict[str, int]:
    """Bit rate, parity and bits of a character: the drive's factory settings where the manual has them."""
    rates, formats = drive.serial.baud, drive.serial.format
    rate = next((each.baud for each in rates.codes if each.code == rates.default), 9600) if rates else 9600
    parity = next((each.parity for each in formats.codes if each.code == formats.default), "") if formats else ""
    number = {"odd": 1, "even": 2}.get(parity, 0)
    return {"rate": rate, "bits": 11 if number else 10, "parity": number, "known": int(rates is not None)}
