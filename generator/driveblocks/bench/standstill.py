"""Programs for what proves standstill, and for the fault number: each condition violated, each bit set."""

import random
from collections.abc import Iterator

from driveblocks.bench import kit
from driveblocks.bench.script import Script
from driveblocks.bench.table import Table
from driveblocks.maps.form import address_text
from driveblocks.maps.model import Drive
from driveblocks.meaning.status import registers, status
from driveblocks.reference.fault import numbered
from driveblocks.reference.naming import word_pin
from driveblocks.reference.standstill import proven

RANDOM = 8
"""Random sets of words, the same in every run."""


def scripts(drive: Drive, stem: str) -> Iterator[Script]:
    """One program for standstill; one for the fault number where the map relates faults to bits."""
    yield _standstill(drive, stem)
    if drive.faults.bits is not None:
        yield _fault_number(drive, stem)


def _pins(drive: Drive, table: Table, addresses: list[int]) -> dict[int, str]:
    """Declare one input per register; address -> pin."""
    pins = {}
    for address in addresses:
        row = drive.register_at(address)
        assert row is not None  # noqa: S101  (a checked map lists them)
        pins[address] = word_pin(row, address)
        table.column(pins[address], "WORD", 0, f"register {address_text(address)}")
    return pins


def _call(block: str, pins: dict[int, str]) -> str:
    return f"{block}({', '.join(f'{pin} := {pin}' for pin in pins.values())});"


def _said(words: dict[int, int]) -> str:
    return ", ".join(f"{address_text(address)} = {word:04X}H" for address, word in words.items())


# ---------------------------------------------------------------- standstill


def _standstill(drive: Drive, stem: str) -> Script:
    proof = status(drive).standstill
    program = kit.script(drive, stem, "Standstill", "what proves standstill", proof.said.source)
    kit.declare(program, Proof=f"{drive.prefix}_Standstill")
    table = Table(program)
    addresses = list(registers(proof.patterns))
    pins = _pins(drive, table, addresses)
    table.column("Wanted", "BOOL", False, "whether the words prove it")
    table.do(_call("Proof", pins), kit.is_flag("Proof.StandstillProven", "Wanted", "StandstillProven"))
    for about, words in _proofs(drive, addresses):
        wanted = proven(drive, words)
        says = f"{about}: {_said(words)}: {'proven' if wanted else 'not proven'}"
        table.row(says, {pins[address]: word for address, word in words.items()} | {"Wanted": wanted})
    return program


def _proofs(drive: Drive, addresses: list[int]) -> Iterator[tuple[str, dict[int, int]]]:
    still = dict.fromkeys(addresses, 0)
    for pattern in status(drive).standstill.patterns:
        still[pattern.register] |= pattern.word
    yield "all conditions hold", still
    for pattern in (each for each in status(drive).standstill.patterns if each.is_ != "="):
        for word in (pattern.value - pattern.unit, pattern.value, pattern.value + pattern.unit):
            yield f"{pattern}, at its limit", {**still, pattern.register: word & 0xFFFF}
    for address in addresses:
        for bit in range(16):
            yield f"bit {bit:X} of {address_text(address)} changed", {**still, address: still[address] ^ 1 << bit}
        for word in (0, 0xFFFF):
            yield f"{address_text(address)} alone", {**still, address: word}
    yield "nothing", dict.fromkeys(addresses, 0)
    yield "everything", dict.fromkeys(addresses, 0xFFFF)
    source = random.Random(1)  # noqa: S311  (test words, no secrets)
    for _ in range(RANDOM):
        yield "random", {address: source.getrandbits(16) for address in addresses}


# ---------------------------------------------------------------- fault number


def _fault_number(drive: Drive, stem: str) -> Script:
    relation = drive.faults.bits
    assert relation is not None  # noqa: S101  (asked before)
    program = kit.script(drive, stem, "FaultNumber", "the fault words as a fault number", relation.source)
    kit.declare(program, Number=f"{drive.prefix}_FaultNumber")
    table = Table(program)
    addresses = list(range(relation.first, relation.last + 1))
    pins = _pins(drive, table, addresses)
    table.column("WantedNumber", "UINT", 0, "FaultNumber that must come out")
    table.column("WantedCount", "UINT", 0, "Count that must come out")
    table.do(
        _call("Number", pins),
        kit.is_number("Number.FaultNumber", "WantedNumber", "FaultNumber"),
        kit.is_number("Number.Count", "WantedCount", "Count"),
    )
    for about, words in _faults(addresses):
        found = numbered(drive, [words[address] for address in addresses])
        wanted = {"WantedNumber": found.number, "WantedCount": found.count}
        says = f"{about}: {_said(words)}: fault {found.number}, {found.count} in all"
        table.row(says, {pins[address]: word for address, word in words.items()} | wanted)
    return program


def _faults(addresses: list[int]) -> Iterator[tuple[str, dict[int, int]]]:
    none = dict.fromkeys(addresses, 0)
    yield "no fault", none
    for address in addresses:
        for bit in range(16):
            yield f"bit {bit:X} of {address_text(address)}", {**none, address: 1 << bit}
        yield f"all bits of {address_text(address)}", {**none, address: 0xFFFF}
    yield "all bits", dict.fromkeys(addresses, 0xFFFF)
    yield "the highest bits", dict.fromkeys(addresses, 0x8000)
    source = random.Random(2)  # noqa: S311  (test words, no secrets)
    for _ in range(RANDOM):
        yield "random", {address: source.getrandbits(16) for address in addresses}
