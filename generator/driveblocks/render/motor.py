"""The first program of a user: one motor on one port."""

from dataclasses import dataclass
from math import ceil

from driveblocks.maps.model import Drive
from driveblocks.meaning.reference import Reference, reference
from driveblocks.meaning.serial import Serial, serial
from driveblocks.meaning.status import registers, status
from driveblocks.render import context
from driveblocks.render.context import Word
from driveblocks.render.drive import drive_block
from driveblocks.render.expression import Test

SCAN_MS = 10
"""Interval of its task."""
PATIENCE_MS = 500
"""How long a Modbus master of the PLC is to wait for a reply: what the line takes until it has learned better."""


@dataclass(frozen=True)
class Motor:
    """For motor/: the drive's name and what is sent to it, and the factory settings of its line."""

    drive: Drive
    name: str
    family: str
    port: Serial
    scan: int
    has_reset: bool
    second_hand: bool
    reference: Reference
    checked: int
    ascii: bool
    pause: int
    patience: int


def motor(drive: Drive) -> Motor:
    """The first motor of a family."""
    ordering, own = drive_block(drive).ordering, drive_block(drive).own
    return Motor(
        drive=drive,
        name=f"{drive.prefix}_Drive",
        family=context.identity(drive).family,
        port=serial(drive),
        scan=SCAN_MS,
        has_reset="fault_reset" in ordering.can,
        second_hand=own.second_hand,
        reference=reference(drive),
        checked=own.checked,
        ascii=serial(drive).ascii,
        pause=_pause(drive),
        patience=PATIENCE_MS,
    )


def _pause(drive: Drive) -> int:
    """Silence that a Modbus master of the PLC has to be set to, ms: by itself it keeps 3.5 characters."""
    silence = serial(drive).silence_ms
    return ceil(silence) + 1 if silence else 0


@dataclass(frozen=True)
class Verified:
    """A test that a run waits for, and the number of the word that it is about."""

    number: int
    test: Test


@dataclass(frozen=True)
class Master:
    """For a Master: the words that it reads in turn, which of them prove standstill, and what a run waits for."""

    words: list[Word]
    proof: list[str]
    verify: list[Verified]
    mode: int
    """1: writes by function 06, 2: by 10H."""


def master(drive: Drive) -> dict[str, object]:
    """What a program prints that has the PLC's own master for its line."""
    proof = context.standstill(drive).words
    verify = status(drive).verify
    names = {word.address: word for word in (*proof, *(context.word_input(drive, each) for each in registers(verify)))}
    found = Master(
        words=list(names.values()),
        proof=[word.name for word in proof],
        verify=[
            Verified(list(names).index(one.register) + 1, context.tested(names[one.register].name, one))
            for one in verify
        ],
        mode=1 if drive_block(drive).ordering.write == 6 else 2,
    )
    return vars(motor(drive)) | vars(found)
