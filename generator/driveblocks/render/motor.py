"""The first program of a user: one motor on one port."""

from dataclasses import dataclass
from math import ceil

from driveblocks.maps.model import Drive
from driveblocks.render import context
from driveblocks.render.context import Word
from driveblocks.render.drive import drive_block
from driveblocks.render.expression import Test

SCAN_MS = 10
"""Interval of its task."""
PATIENCE_MS = 500
"""How long a Modbus master of the PLC is to wait for a reply: what the line takes until it has learned better."""


@dataclass(frozen=True)
class Port:
    """Bit rate, parity (1 odd, 2 even) and bits of a character; whether the manual has them."""

    rate: int
    bits: int
    parity: int
    known: bool


@dataclass(frozen=True)
class Motor:
    """For motor/: the drive's name and what is sent to it, and the factory settings of its line."""

    drive: Drive
    name: str
    family: str
    port: Port
    scan: int
    has_reset: bool
    second_hand: bool
    unscaled: bool
    in_rpm: bool
    percent: bool
    maximum: str
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
        port=_port(drive),
        scan=SCAN_MS,
        has_reset="fault_reset" in ordering.can,
        second_hand=own.second_hand,
        unscaled=not ordering.scaled,
        in_rpm=ordering.in_rpm,
        percent=ordering.percent,
        maximum=ordering.maximum,
        checked=own.checked,
        ascii="rtu" not in drive.serial.mode.modes,
        pause=_pause(drive),
        patience=PATIENCE_MS,
    )


def _pause(drive: Drive) -> int:
    """Silence that a Modbus master of the PLC has to be set to, ms: by itself it keeps 3.5 characters."""
    silence = drive.serial.silence and drive.serial.silence.milliseconds
    return ceil(silence) + 1 if silence else 0


def _port(drive: Drive) -> Port:
    """The drive's factory settings where the manual has them."""
    rates, formats = drive.serial.baud, drive.serial.format
    rate = next((each.baud for each in rates.codes if each.code == rates.default), 9600) if rates else 9600
    parity = next((each.parity for each in formats.codes if each.code == formats.default), "") if formats else ""
    number = {"odd": 1, "even": 2}.get(parity, 0)
    return Port(rate, 11 if number else 10, number, rates is not None)


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
    verify = drive.operation.reference.verify
    registers = dict.fromkeys((*(word.address for word in proof), *(one.register for one in verify)))
    names = {register: context.word_input(drive, register) for register in registers}
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
