"""Rules on conditions and states: a register, or bits of it, that must have a value, or a number within limits."""

from collections.abc import Iterator

from driveblocks.maps.form import Span, address_text, bits_text
from driveblocks.maps.model import Bit, Condition, Drive, Register, State
from driveblocks.maps.problem import Report
from driveblocks.maps.rules.access import known
from driveblocks.meaning.pattern import WORD, Pattern, asked, bits_of, of_condition


def check(drive: Drive, report: Report) -> None:
    """Note every rule that a condition of the map breaks, whatever it is for, and that states do."""
    for condition in (*exact(drive), *drive.operation.standstill.all):
        if condition.differs:
            wrong = f"{address_text(condition.register)} may have any other value here"
            report.add(condition.place("differs"), wrong, "only a status may be shown by that; ask for one value")
    for condition in exact(drive):
        for key in ("below", "above"):
            if getattr(condition, key) is not None:
                wrong = f"{address_text(condition.register)} may have many values here"
                right = "only a status or standstill may be shown by that; ask for one value"
                report.add(condition.place(key), wrong, right)
    for condition in every(drive):
        _condition(drive, condition, condition.bit, report)
    for state in drive.operation.states:
        _condition(drive, state, None, report)


def exact(drive: Drive) -> Iterator[Condition]:
    """Conditions that ask for one value."""
    yield from drive.operation.reference.verify
    yield from (each for one in (drive.identity, drive.operation.commanded_by) if one for each in one.all)
    yield from (each for _, row in drive.registers() if row.scale for each in row.scale.conditions)


def every(drive: Drive) -> Iterator[Condition]:
    """Every condition of a map."""
    yield from drive.operation.standstill.all
    yield from exact(drive)
    yield from (each for one in drive.operation.status for each in one.any)
    yield from (each for one in drive.operation.forbids for each in one.any)


def bit_at(row: Register, number: int) -> Bit | None:
    """The bit or field of a register that holds a bit number."""
    return next((bit for bit in row.bits if number in bit.bit), None)


def pattern(drive: Drive, condition: Condition) -> Pattern:
    """What a condition asks."""
    return of_condition(condition, drive.register_at(condition.register))


def _condition(drive: Drive, condition: Condition | State, bit: Span | None, report: Report) -> None:
    row = known(drive, condition.register, "r", condition.place("register"), report)
    bits, keys = bit or Span(0, 15), ("equals", "below", "above")
    given = [key for key in keys if getattr(condition, key, None) is not None]
    is_, number = asked(condition)
    if len(given) != 1:
        wrong = f"a condition has both `{given[0]}` and `{given[1]}`" if given else "a condition asks for nothing"
        if given or condition.keys.keys().isdisjoint(keys):
            report.add(condition.at, wrong, "write one of `equals`, `below` and `above`")
    elif bit is not None and not bit:
        report.add(condition.place("bit"), f"bits {bits_text(bit)} run backwards", "write the lower bit first")
    elif condition.mask is not None:
        _mask(condition, condition.mask, bit, row, report)
    elif is_ in ("<", ">"):
        _number(condition, given[0], row, report)
    elif not 0 <= number < 1 << len(bits):
        wrong = f"{number} does not fit {len(bits)} bit{'s' * (len(bits) > 1)}"
        report.add(condition.place("equals"), wrong, f"write 0 to {(1 << len(bits)) - 1}")
    elif row is not None:
        _value(condition, bit, row, report)


def _number(condition: Condition | State, key: str, row: Register | None, report: Report) -> None:
    """Note a limit that no number of the register is beyond, or that all are."""
    bit = condition.bit if isinstance(condition, Condition) else None
    low, high = (-0x8000, 0x7FFF) if row and row.signed and bit is None else (0, (1 << len(bit or Span(0, 15))) - 1)
    is_, number = asked(condition)
    low, high = (low + 1, high) if is_ == "<" else (low, high - 1)
    if getattr(condition, "differs", None):
        report.add(condition.place("differs"), f"`differs` beside `{key}`", "it belongs to `equals`")
    elif row is not None and not low <= number <= high:
        wrong = f"no number of {address_text(condition.register)}, or every one, is {key} {number}"
        hint = "; a number below 0 needs `signed: true` in its row" * (number <= 0 and not row.signed)
        report.add(condition.place(key), wrong, f"write {low} to {high}{hint}")
    elif row is not None and bit is not None:
        _listed(condition, bit, row, report)


def _value(condition: Condition | State, bit: Span | None, row: Register, report: Report) -> None:
    what, values = address_text(condition.register), row.values
    if bit is not None:
        what, listed = f"bit {bits_text(bit)} of {what}", _listed(condition, bit, row, report)
        values = listed.values if listed is not None else ()
    number = asked(condition)[1]
    if values and number not in {value.value for value in values}:
        wrong = f"{number} is no value of {what}"
        report.miss(condition.place("equals"), wrong, "write one of the listed values")


def _listed(condition: Condition | State, bit: Span, row: Register, report: Report) -> Bit | None:
    """The entry of a bit or field; notes one that is not listed."""
    listed = bit_at(row, bit.first)
    if listed is None or listed.unused or listed.bit != bit:
        wrong = f"bit {bits_text(bit)} of {address_text(condition.register)} is not a listed bit or field"
        report.miss(condition.place("bit"), wrong, "name a bit that the register lists")
    return listed


def _mask(condition: Condition | State, mask: int, bit: Span | None, row: Register | None, report: Report) -> None:
    place, (is_, number) = condition.place("mask"), asked(condition)
    if bit is not None:
        report.add(place, "a condition has both `bit` and `mask`", "keep one of them")
    elif is_ in ("<", ">"):
        report.add(place, "the bits of a mask are no number", "name bits that are side by side, as `bit`")
    elif not 0 < mask < WORD:
        wrong = f"mask {mask:04X}H is no part of a word"
        report.add(place, wrong, "write 0001H to FFFEH, or leave it out for the whole word")
    elif number & ~mask:
        wrong = f"{number:04X}H has bits that the mask {mask:04X}H has not"
        report.add(condition.place("equals"), wrong, "write the value in the place of its bits")
    elif row is not None:
        for what in _hidden(mask, number, row):
            wrong = f"{address_text(condition.register)} lists no {what}"
            report.miss(place, wrong, "ask for bits, fields and values that the register lists")


def _hidden(mask: int, value: int, row: Register) -> Iterator[str]:
    """What a mask asks for and the register does not list; of a field all bits are asked for, or none."""
    if row.values and not row.masks:
        yield "single bits, but values of the whole word"
        return
    listed = {one.value.bit_length() - 1 for one in row.values}
    listed |= {number for bit in row.bits if not bit.unused for number in bit.bit}
    for number in range(16):
        if mask >> number & 1 and number not in listed:
            yield f"bit {number:X}"
    for bit in row.bits:
        ours = bits_of([bit.bit])
        found = (value & ours) >> bit.bit.first
        if bit.values and mask & ours == ours and found not in {one.value for one in bit.values}:
            yield f"value {found} of bits {bits_text(bit.bit)}"
        elif bit.values and 0 < mask & ours < ours:
            yield f"part of bits {bits_text(bit.bit)}"
