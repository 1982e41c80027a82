"""Rules on conditions and states: a register, or bits of it, that must have a value."""

from collections.abc import Iterator

from driveblocks.maps.form import Span, address_text, bits_text
from driveblocks.maps.model import Bit, Condition, Drive, Register, State, Value
from driveblocks.maps.problem import Report
from driveblocks.maps.rules.access import known
from driveblocks.meaning.pattern import WORD, bits_of, of_condition


def check(drive: Drive, report: Report) -> None:
    """Note every rule that a condition of the map breaks, whatever it is for, and that states do."""
    operation = drive.operation
    conditions = [*operation.standstill.all, *operation.reference.verify]
    conditions += [each for one in (drive.identity, operation.commanded_by) if one for each in one.all]
    conditions += [each for _, row in drive.registers() if row.scale for each in row.scale.conditions]
    for condition in conditions:
        if condition.differs:
            wrong = f"{address_text(condition.register)} may have any other value here"
            report.add(condition.place("differs"), wrong, "only a status may be shown by that; ask for one value")
    conditions += [condition for status in operation.status for condition in status.any]
    for condition in conditions:
        _condition(drive, condition, condition.bit, report)
    for state in operation.states:
        _condition(drive, state, None, report)


def bit_at(row: Register, number: int) -> Bit | None:
    """The bit or field of a register that holds a bit number."""
    return next((bit for bit in row.bits if number in bit.bit), None)


def called(row: Register, condition: Condition) -> Bit | Value | None:
    """The one bit or value that a condition asks for; None where it asks for several bits, a 0, or any other value."""
    if condition.differs:
        return None
    asked = of_condition(condition)
    mask, value = asked.mask, asked.value
    for bit in row.bits:
        if mask == bits_of([bit.bit]):
            listed = (one for one in bit.values if one.value == value >> bit.bit.first)
            return next(listed, bit if value and len(bit.bit) == 1 and not bit.values else None)
    whole = mask == (value if row.masks else WORD)
    return next((one for one in row.values if whole and one.value == value), None)


def exclude(one: Condition, other: Condition) -> bool:
    """Whether two conditions never hold at once."""
    return of_condition(one).excludes(of_condition(other))


def _condition(drive: Drive, condition: Condition | State, bit: Span | None, report: Report) -> None:
    row = known(drive, condition.register, "r", condition.place("register"), report)
    bits = bit or Span(0, 15)
    if bit is not None and not bit:
        report.add(condition.place("bit"), f"bits {bits_text(bit)} run backwards", "write the lower bit first")
    elif condition.mask is not None:
        _mask(condition, condition.mask, bit, row, report)
    elif not 0 <= condition.equals < 1 << len(bits):
        wrong = f"{condition.equals} does not fit {len(bits)} bit{'s' * (len(bits) > 1)}"
        report.add(condition.place("equals"), wrong, f"write 0 to {(1 << len(bits)) - 1}")
    elif row is not None:
        _value(condition, bit, row, report)


def _value(condition: Condition | State, bit: Span | None, row: Register, report: Report) -> None:
    what = address_text(condition.register)
    values = row.values
    if bit is not None:
        what = f"bit {bits_text(bit)} of {what}"
        listed = bit_at(row, bit.first)
        if listed is None or listed.unused or listed.bit != bit:
            wrong = f"{what} is not a listed bit or field"
            report.miss(condition.place("bit"), wrong, "name a bit that the register lists")
        values = listed.values if listed is not None else ()
    if values and condition.equals not in {value.value for value in values}:
        wrong = f"{condition.equals} is no value of {what}"
        report.miss(condition.place("equals"), wrong, "write one of the listed values")


def _mask(condition: Condition | State, mask: int, bit: Span | None, row: Register | None, report: Report) -> None:
    place = condition.place("mask")
    if bit is not None:
        report.add(place, "a condition has both `bit` and `mask`", "keep one of them")
    elif not 0 < mask < WORD:
        wrong = f"mask {mask:04X}H is no part of a word"
        report.add(place, wrong, "write 0001H to FFFEH, or leave it out for the whole word")
    elif condition.equals & ~mask:
        wrong = f"{condition.equals:04X}H has bits that the mask {mask:04X}H has not"
        report.add(condition.place("equals"), wrong, "write the value in the place of its bits")
    elif row is not None:
        for what in _hidden(mask, condition.equals, row):
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
