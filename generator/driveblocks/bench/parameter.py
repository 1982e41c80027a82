"""The programs for what a ladder user may write, and for the registers of the manual's numbers."""

from collections.abc import Iterator

from driveblocks.bench import kit
from driveblocks.bench.code import NUMBERS, WORDS
from driveblocks.bench.script import Probe, Script
from driveblocks.maps.form import address_text
from driveblocks.maps.model import Drive
from driveblocks.maps.numbering import at
from driveblocks.reference.permission import Judge, Numbered, Write, parameters
from structured_text.language.writing import flag, word

END = 0xFFFF
"""The last address, and the last word."""


def scripts(drive: Drive, stem: str) -> Iterator[Script]:
    """One program for what may be written, and one for the manual's numbers where they prove a register."""
    yield _writes(drive, stem)
    known = parameters(drive)
    if known:
        yield _numbers(drive, stem, known)


def _writes(drive: Drive, stem: str) -> Script:
    program = kit.script(drive, stem, "MayWrite", "what a ladder user may write, each side of every limit")
    judge = Judge(drive)
    for address in _turns(drive, judge):
        wishes = [Write(address, unknown=how & 1 > 0, stopped=how & 2 > 0) for how in range(4)]
        program.stage(address_text(at(drive, address)), *(_wish(drive, judge, wish) for wish in wishes))
    for _, row in drive.registers():
        if row.range is not None:
            ends = (row.range.min - 1, row.range.min, row.range.max, row.range.max + 1)
            wishes = [Write(row.address.first, value & END) for value in ends]
            program.stage(f"{address_text(row.address.first)}, values", *(_wish(drive, judge, wish) for wish in wishes))
    return program


def _turns(drive: Drive, judge: Judge) -> list[int]:
    """The addresses beside which another has another result."""
    spans = [*(row.address for _, row in drive.registers()), *(area.addresses for area in drive.areas)]
    bit = drive.storage.add or 0
    ends = {end | more for span in spans for end in (span.first, span.last) for more in (0, bit)}
    near = {0, END} | {end + step for end in ends for step in (-1, 0, 1)}
    return [one for one in sorted(near) if 0 <= one <= END and _turns_at(judge, one)]


def _turns_at(judge: Judge, address: int) -> bool:
    beside = {judge.result(Write(address + step)) for step in (-1, 1) if 0 <= address + step <= END}
    return address in (0, END) or beside != {judge.result(Write(address))}


def _wish(drive: Drive, judge: Judge, wish: Write) -> Probe:
    result = judge.result(wish)
    pins = f"Address := {word(wish.address)}, Value := {word(wish.value)}, AllowUnknown := {flag(wish.unknown)}"
    call = f"{drive.prefix}_MayWrite({pins}, Stopped := {flag(wish.stopped)})"
    how = f"{wish.value}, {'stopped' if wish.stopped else 'not stopped'}{', AllowUnknown' if wish.unknown else ''}"
    return kit.is_number(call, NUMBERS[result], f"{how}: {WORDS[result]}")


def _numbers(drive: Drive, stem: str, known: dict[Numbered, int]) -> Script:
    title = "the registers of the manual's numbers, each side of every gap"
    program = kit.script(drive, stem, "ParameterAddress", title)
    for letter, group in dict.fromkeys((letter, group) for letter, group, _ in known):
        own = {number for *beside, number in known if beside == [letter, group]}
        sides = {0} | {number + step for number in own for step in (-1, 0, 1)}
        asked = [(letter, group, number) for number in sorted(sides) if number >= 0]
        probes = (_number(drive, known, each) for each in asked if _turn(known, each))
        program.stage(f"{letter}{group}", *probes)
    if _grouped(known):
        letters = dict.fromkeys(letter for letter, _, _ in known)
        behind = ((one, 1 + max(group for letter, group, _ in known if letter == one), 1) for one in letters)
        program.stage("no such group", *(_number(drive, known, each) for each in [("?", 1, 1), *behind]))
    return program


def _grouped(known: dict[Numbered, int]) -> bool:
    """Whether the function has pins for letter and group."""
    return any(letter or group for letter, group, _ in known)


def _turn(known: dict[Numbered, int], asked: Numbered) -> bool:
    """Whether the register of a number does not lie between those of the numbers beside it."""
    letter, group, number = asked
    before, own, behind = (known.get((letter, group, number + step)) for step in (-1, 0, 1))
    return own is None or before != own - 1 or behind != own + 1


def _number(drive: Drive, known: dict[Numbered, int], asked: Numbered) -> Probe:
    letter, group, number = asked
    register = known.get(asked)
    pins = f"Letter := {ord(letter or chr(0))}, Group := {group}, " if _grouped(known) else ""
    call = f"{drive.prefix}_ParameterAddress({pins}Number := {number})"
    says = "none" if register is None else address_text(register)
    return kit.is_flag(f"{call} = {-1 if register is None else register}", True, f"{letter}{group}, {number}: {says}")
