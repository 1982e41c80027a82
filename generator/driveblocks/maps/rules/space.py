"""Rules on tables and values of 32 bits: what each may be used for, and that the drive has the functions for it."""

from collections.abc import Iterator

from driveblocks.maps.form import address_text, is_bit, space_of
from driveblocks.maps.model import Condition, Drive, State, Use
from driveblocks.maps.pair import is_first
from driveblocks.maps.plan import reads_by, used, writes_by
from driveblocks.maps.problem import Place, Report
from driveblocks.maps.rules.condition import every
from driveblocks.meaning.polls import fast_words, slow_words
from driveblocks.meaning.words import STOPS

WORD, SIGNED = 0xFFFF, 0x7FFF


def check(drive: Drive, report: Report) -> None:
    """Note every table and every pair that is used for what no block does with it."""
    for section, row in drive.registers():
        space, access = space_of(row.address.first), row.access or section.access
        if space in ("input", "discrete") and "w" in access:
            report.add(row.at, f"{address_text(row.address.first)} is written, but {space} is read only", "write r")
    before = len(report.problems)
    for condition in _conditions(drive):
        _condition(drive, condition, report)
    for what, address, place in _numbers(drive):
        if is_bit(address):
            report.add(place, f"{what} is {address_text(address)}, which is one bit", "name a register")
        elif _wide(drive, address):
            report.add(place, f"{what} is {address_text(address)}, a value of 32 bits", "name a register of 16 bits")
    _measures(drive, report)
    _written(drive, report)
    if len(report.problems) == before:
        _functions(drive, report)


def _wide(drive: Drive, address: int, use: Use = "r") -> bool:
    row = drive.register_at(address, use)
    return row is not None and row.words is not None


def _conditions(drive: Drive) -> Iterator[Condition | State]:
    yield from every(drive)
    yield from drive.operation.states


def _condition(drive: Drive, one: Condition | State, report: Report) -> None:
    """Note a condition on half a pair, and one on a pair that is not asked for whole."""
    row = drive.register_at(one.register)
    if row is None or row.words is None:
        return
    parts = [each for each in _conditions(drive) if each.at == one.at and each is not one]
    if not parts:
        half = "" if is_first(row, one.register) else "half of "
        wrong = f"{address_text(one.register)} is {half}a value of 32 bits"
        report.add(
            one.place("register"),
            wrong,
            "only a condition that must hold asks for it, by its first register and one value",
        )


def _numbers(drive: Drive) -> Iterator[tuple[str, int, Place]]:
    """What has to be a word, with its register and its place."""
    operation, faults = drive.operation, drive.faults
    if faults.present is not None:
        yield "the code of the fault", faults.present, faults.place("present")
    if drive.warnings is not None:
        yield "the code of the warning", drive.warnings.register, drive.warnings.place("register")
    if faults.bits is not None:
        yield "the first word of the faults", faults.bits.first, faults.place("bits")
    if operation.own_maximum is not None:
        yield "the drive's own maximum", operation.own_maximum.register, operation.own_maximum.place("register")
    for condition in drive.identity.all if drive.identity else ():
        yield "a word of the identity", condition.register, condition.place("register")


def _measures(drive: Drive, report: Report) -> None:
    for one in drive.operation.measures:
        row, where = drive.register_at(one.register), address_text(one.register)
        if is_bit(one.register):
            report.add(one.place("register"), f"`{one.shows}` is {where}, which is one bit", "name a register")
        elif row is not None and row.words and not is_first(row, one.register):
            report.add(one.place("register"), f"{where} is half of a value of 32 bits", "name its first register")
        elif row is not None and row.words and row.scale is None:
            report.miss(one.place("register"), f"{where} has 32 bits and no scale", "add `scale` to its row")


def _written(drive: Drive, report: Report) -> None:
    operation = drive.operation
    stop = next((one for one in operation.commands if one.does == "stop"), None)
    for command in operation.commands:
        for write in command.writes:
            where, place = address_text(write.register), write.place("register")
            if _wide(drive, write.register, "w"):
                report.add(place, f"`{command.does}` writes {where}, a value of 32 bits", "name a register of 16 bits")
            elif is_bit(write.register) and write.value is None:
                report.add(write.at, f"{where} is one bit, and has none to set or clear", "write `value: 1`, or 0")
        by = {each: writes_by(drive, each.register) for each in (command, stop) if each}
        if command.does in STOPS and stop is not None and by[command] != by[stop]:
            wrong = f"`{command.does}` is written by {by[command]:02X}H, and `stop` by {by[stop]:02X}H"
            report.add(command.place("register"), wrong, "the line sends all stops by one function")
    reference = operation.reference
    row, where = drive.register_at(reference.register, "w"), address_text(reference.register)
    if space_of(reference.register) != "holding":
        report.add(reference.place("register"), f"the reference is {where}", "name a holding register")
    elif row is not None and row.words and not is_first(row, reference.register):
        report.add(reference.place("register"), f"{where} is half of a value of 32 bits", "name its first register")
    elif row is not None and row.words and (row.range is None or row.range.max > WORD):
        wrong = f"{where} has 32 bits, and nothing says that its reference ends at {WORD} or below"
        report.miss(row.place("range"), wrong, "add `range`; blocks send no higher reference")
    elif row is not None and row.words and row.range and operation.by_sign and row.range.max > SIGNED:
        wrong = f"a negative reference reverses, and that of {where} ends at {row.range.max}"
        report.add(row.place("range"), wrong, f"write {SIGNED} or below at both ends; blocks send no higher one")


def _functions(drive: Drive, report: Report) -> None:
    """Note a function that the blocks need and the map does not list."""
    operation, place = drive.operation, drive.place("functions")
    known = used(drive)
    if not (known & {3, 4} and known & {6, 16}):
        return  # that is reported as a whole
    needed: dict[int, str] = {}
    identity = {each.register for each in drive.identity.all} if drive.identity else set()
    for address in sorted(fast_words(drive) | slow_words(drive) | identity):
        needed.setdefault(reads_by(drive, address), f"read {address_text(address)}")
    for write in (*(each for one in operation.commands for each in one.writes), operation.reference):
        needed.setdefault(writes_by(drive, write.register), f"write {address_text(write.register)}")
    for code, why in sorted(needed.items()):
        if code not in known:
            report.miss(
                place, f"to {why} takes function {code:02X}H, which is not listed", "list it, if the drive has it"
            )
