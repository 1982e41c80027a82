"""The first program of a user: one motor on one port."""

from math import ceil

from driveblocks.maps.model import Drive
from driveblocks.render import context
from driveblocks.render.context import Context
from driveblocks.render.drive import drive_block

SCAN_MS = 10
"""Interval of its task."""
PATIENCE_MS = 500
"""How long a Modbus master of the PLC is to wait for a reply: what the line takes until it has learned better."""


def motor(drive: Drive) -> Context:
    """For motor/: the drive's name and what is sent to it, and the factory settings of its line."""
    values = drive_block(drive)
    return {
        "drive": drive,
        "name": f"{drive.prefix}_Drive",
        "family": context.identity(drive).family,
        "port": _port(drive),
        "scan": SCAN_MS,
        "has_reset": any(one.does == "fault_reset" for one in drive.operation.commands),
        "second_hand": drive.manual.second_hand,
        "unscaled": values["scaled"] is False,
        "percent": values["percent"],
        "maximum": values["maximum"],
        "checked": values["checked"],
        "ascii": "rtu" not in drive.serial.mode.modes,
        "pause": _pause(drive),
        "patience": PATIENCE_MS,
    }


def _pause(drive: Drive) -> int:
    """Silence that a Modbus master of the PLC has to be set to, ms: by itself it keeps 3.5 characters."""
    silence = drive.serial.silence and drive.serial.silence.milliseconds
    return ceil(silence) + 1 if silence else 0


def _port(drive: Drive) -> dict[str, int]:
    """Bit rate, parity and bits of a character: the drive's factory settings where the manual has them."""
    rates, formats = drive.serial.baud, drive.serial.format
    rate = next((each.baud for each in rates.codes if each.code == rates.default), 9600) if rates else 9600
    parity = next((each.parity for each in formats.codes if each.code == formats.default), "") if formats else ""
    number = {"odd": 1, "even": 2}.get(parity, 0)
    return {"rate": rate, "bits": 11 if number else 10, "parity": number, "known": int(rates is not None)}


def master(drive: Drive) -> Context:
    """For a Master: the words that it reads in turn, which of them prove standstill, and what a run waits for."""
    proof = context.standstill(drive)["words"]
    verify = drive.operation.reference.verify
    registers = dict.fromkeys((*(word.address for word in proof), *(one.register for one in verify)))
    names = {register: context.word_input(drive, register) for register in registers}
    return {
        **motor(drive),
        "words": list(names.values()),
        "proof": [word.name for word in proof],
        "verify": [
            {"number": list(names).index(one.register) + 1, "test": context.tested(names[one.register].name, one)}
            for one in verify
        ],
        "mode": 1 if drive_block(drive)["write"] == 6 else 2,
    }
