"""Rules on conditions: a register, or a bit of it, that must have a value."""

from driveblocks.maps.form import Span, address_text, bits_text
from driveblocks.maps.model import Bit, Condition, Drive, Register
from driveblocks.maps.problem import Report
from driveblocks.maps.rules.access import known


def check(drive: Drive, report: Report) -> None:
    """Note every rule that the conditions of standstill, reference or scales break."""
    conditions = [*drive.operation.standstill.all, *drive.operation.reference.verify]
    conditions += [row.scale.when for _, row in drive.registers() if row.scale and row.scale.when]
    for condition in conditions:
        _condition(drive, condition, report)


def bit_at(row: Register, number: int) -> Bit | None:
    """The bit or field of a register that holds a bit number."""
    return next((bit for bit in row.bits if number in bit.bit), None)


def _condition(drive: Drive, condition: Condition, report: Report) -> None:
    row = known(drive, condition.register, "r", condition.place("register"), report)
    bits = condition.bit or Span(0, 15)
    if condition.bit is not None and not condition.bit:
        wrong = f"bits {bits_text(condition.bit)} run backwards"
        report.add(condition.place("bit"), wrong, "write the lower bit first")
        return
    if not 0 <= condition.equals < 1 << len(bits):
        wrong = f"{condition.equals} does not fit {len(bits)} bit{'s' * (len(bits) > 1)}"
        report.add(condition.place("equals"), wrong, f"write 0 to {(1 << len(bits)) - 1}")
    elif row is not None:
        _condition_value(condition, row, report)


def _condition_value(condition: Condition, row: Register, report: Report) -> None:
    what = address_text(condition.register)
    values = row.values
    if condition.bit is not None:
        what = f"bit {bits_text(condition.bit)} of {what}"
        bit = bit_at(row, condition.bit.first)
        if bit is None or bit.unused or bit.bit != condition.bit:
            wrong = f"{what} is not a listed bit or field"
            report.miss(condition.place("bit"), wrong, "name a bit that the register lists")
        values = bit.values if bit is not None else ()
    if values and condition.equals not in {value.value for value in values}:
        wrong = f"{condition.equals} is no value of {what}"
        report.miss(condition.place("equals"), wrong, "write one of the listed values")
