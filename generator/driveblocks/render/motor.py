"""The first program of a user: one motor on one port."""

from dataclasses import dataclass
from math import ceil

from driveblocks.maps.model import Drive
from driveblocks.maps.revision import checked
from driveblocks.maps.trust import second_hand
from driveblocks.meaning.reference import reference
from driveblocks.meaning.serial import serial
from driveblocks.meaning.status import registers, status
from driveblocks.render import context
from driveblocks.render.drive import drive_block
from driveblocks.render.expression import Test

SCAN_MS = 10
"""Interval of its task."""
PATIENCE_MS = 500
"""How long a Modbus master of the PLC is to wait for a reply: what the line takes until it has learned better."""


def motor(drive: Drive) -> dict[str, object]:
    """For motor/: the first motor of a family, what is sent to it, and the factory settings of its line."""
    return {
        "drive": drive, "name": f"{drive.prefix}_Drive", "family": context.identity(drive).family,
        "port": serial(drive), "reference": reference(drive), "scan": SCAN_MS, "ascii": serial(drive).ascii,
        "has_reset": "fault_reset" in drive_block(drive).ordering.can, "second_hand": second_hand(drive),
        "checked": checked(drive), "pause": _pause(drive), "patience": PATIENCE_MS,
    }  # fmt: skip


def _pause(drive: Drive) -> int:
    """Silence that a Modbus master of the PLC has to be set to, ms: by itself it keeps 3.5 characters."""
    silence = serial(drive).silence_ms
    return ceil(silence) + 1 if silence else 0


@dataclass(frozen=True)
class Verified:
    """A test that a run waits for, and the number of the word that it is about."""

    number: int
    test: Test


def master(drive: Drive) -> dict[str, object]:
    """What a program prints that has the PLC's own master for its line.

    The words that it reads in turn, which of them prove standstill, what a run waits for; mode 1 writes by function
    06, 2 by 10H.
    """
    proof = context.standstill(drive).words
    verify = status(drive).verify
    names = {word.address: word for word in (*proof, *(context.word_input(drive, each) for each in registers(verify)))}
    at = {word.address: number for number, word in enumerate(names.values(), 1)}
    return motor(drive) | {
        "words": list(names.values()),
        "proof": [word.name for word in proof],
        "verify": [Verified(at[one.register], context.tested(names[one.register].name, one)) for one in verify],
        "mode": 1 if drive_block(drive).ordering.write == 6 else 2,
    }
