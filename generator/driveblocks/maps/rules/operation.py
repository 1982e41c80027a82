"""Rules on commands, reference, standstill, faults and error replies."""

from driveblocks.maps.form import address_text, bits_text
from driveblocks.maps.model import Bit, Command, Condition, Drive, Fault, Register
from driveblocks.maps.problem import Place, Report

_ERROR_KEYS = {"exception": ("add",), "write_reply": ("function", "address")}


def check(drive: Drive, report: Report) -> None:
    """Note every rule that commands, conditions, faults or errors break."""
    _commands(drive, report)
    _reference(drive, report)
    for condition in drive.operation.standstill.all:
        _condition(drive, condition, report)
    for _, row in drive.registers():
        if row.scale is not None and row.scale.when is not None:
            _condition(drive, row.scale.when, report)
    _faults(drive, report)
    _errors(drive, report)


def _access(drive: Drive, row: Register) -> str:
    section = next(section for section, other in drive.registers() if other is row)
    return row.access or section.access


def _known(drive: Drive, address: int, use: str, place: Place, report: Report) -> Register | None:
    """The row of an address that is to be read (`r`) or written (`w`); notes what stands against it."""
    row = drive.register_at(address)
    if row is None:
        report.add(place, f"{address_text(address)} is in no register table", "name a listed register")
    elif row.unused:
        report.add(place, f"{address_text(address)} is unused", "name a register in use")
    elif use not in _access(drive, row):
        verb = "read" if use == "r" else "written"
        report.add(place, f"{address_text(address)} cannot be {verb}", "name another register, or correct its `access`")
    else:
        return row
    return None


def _commands(drive: Drive, report: Report) -> None:
    seen: dict[str, Command] = {}
    words: dict[tuple[int, int], Command] = {}
    for command in drive.operation.commands:
        if command.does in seen:
            report.add(command.place("does"), f"command `{command.does}` stands twice", "one entry per command")
        seen[command.does] = command
        _command(drive, command, report)
        if command.value is not None:
            other = words.setdefault((command.register, command.value), command)
            if other is not command:
                wrong = f"`{command.does}` and `{other.does}` write the same value {command.value}"
                report.add(command.place("value"), wrong, "each command has its own value")
    for does in ("run_forward", "stop"):
        if does not in seen:
            report.add(
                drive.operation.place("commands"),
                f"there is no command `{does}`",
                "a drive that cannot run or stop is of no use",
            )


def _command(drive: Drive, command: Command, report: Report) -> None:
    if (command.value is None) == (not command.set and not command.clear):
        report.add(
            command.at, f"command `{command.does}` needs a value, or bits to set and clear", "give one of the two"
        )
    row = _known(drive, command.register, "w", command.place("register"), report)
    if row is None:
        return
    if command.value is not None and row.values and command.value not in {value.value for value in row.values}:
        wrong = f"{command.value} is no value of {address_text(command.register)}"
        report.add(command.place("value"), wrong, "write one of the listed values")
    _command_bits(command, row, report)


def _command_bits(command: Command, row: Register, report: Report) -> None:
    both = {n for span in command.set for n in span} & {n for span in command.clear for n in span}
    if both:
        bits = ", ".join(f"{n:X}" for n in sorted(both))
        report.add(command.at, f"`{command.does}` sets and clears bit {bits}", "decide for one")
    for key in ("set", "clear"):
        for span in getattr(command, key):
            for number in span:
                bit = _bit_at(row, number)
                if bit is None or bit.unused:
                    wrong = f"bit {number:X} of {address_text(row.address.first)} is not in use"
                    report.add(command.place(key), wrong, "name a bit that the register lists")


def _bit_at(row: Register, number: int) -> Bit | None:
    return next((bit for bit in row.bits if number in bit.bit), None)


def _reference(drive: Drive, report: Report) -> None:
    reference = drive.operation.reference
    row = _known(drive, reference.register, "w", reference.place("register"), report)
    if row is not None and reference.negative_reverses and not row.signed:
        wrong = f"a negative reference, but {address_text(reference.register)} is not signed"
        report.add(reference.place("negative_reverses"), wrong, "add `signed: true` to the register")
    for condition in reference.verify:
        _condition(drive, condition, report)


def _condition(drive: Drive, condition: Condition, report: Report) -> None:
    row = _known(drive, condition.register, "r", condition.place("register"), report)
    width = len(condition.bit) if condition.bit is not None else 16
    if not 0 <= condition.equals < 1 << max(width, 0):
        report.add(
            condition.place("equals"), f"{condition.equals} does not fit {width} bits", f"write 0 to {(1 << width) - 1}"
        )
    if row is None:
        return
    if condition.bit is not None:
        bit = _bit_at(row, condition.bit.first)
        if bit is None or bit.unused or bit.bit != condition.bit:
            wrong = f"bit {bits_text(condition.bit)} of {address_text(condition.register)} is not a listed bit or field"
            report.add(condition.place("bit"), wrong, "name a bit that the register lists")
    elif row.values and condition.equals not in {value.value for value in row.values}:
        wrong = f"{condition.equals} is no value of {address_text(condition.register)}"
        report.add(condition.place("equals"), wrong, "write one of the listed values")


def _faults(drive: Drive, report: Report) -> None:
    codes: dict[int, Fault] = {}
    ids: dict[str, Fault] = {}
    for fault in drive.faults.codes:
        if not 1 <= fault.code <= 0xFFFF:
            report.add(fault.place("code"), f"fault code {fault.code}", "0 means no fault; codes lie within 1 to FFFFH")
        if fault.code in codes:
            report.add(
                fault.place("code"),
                f"fault code {fault.code:02X}H is taken by line {codes[fault.code].at[0]}",
                "one entry per code",
            )
        if fault.id in ids:
            report.add(
                fault.place("id"),
                f"fault id `{fault.id}` is taken by line {ids[fault.id or ''].at[0]}",
                "one entry per id",
            )
        codes[fault.code] = fault
        if fault.id is not None:
            ids[fault.id] = fault
    for span in drive.faults.registers:
        for address in span:
            _fault_register(drive, address, codes, report)
    _fault_bits(drive, ids, report)


def _fault_register(drive: Drive, address: int, codes: dict[int, Fault], report: Report) -> None:
    row = _known(drive, address, "r", drive.faults.place("registers"), report)
    if row is None or not row.values or not codes:
        return
    for value in row.values:
        fault = codes.get(value.value)
        if value.value and (fault is None or fault.name != value.name or fault.zh != value.zh):
            wrong = f"value {value.value} `{value.name}` of {address_text(address)} is not in the table of faults"
            report.add(value.at, wrong, "a fault register's values and `faults.codes` say the same")
    for code, fault in codes.items():
        if code not in {value.value for value in row.values}:
            report.add(
                fault.place("code"),
                f"fault {code} is not among the values of {address_text(address)}",
                "list it there too",
            )


def _fault_bits(drive: Drive, ids: dict[str, Fault], report: Report) -> None:
    relation = drive.faults.bits
    if relation is None:
        return
    due: dict[str, int] = {}
    for address in range(relation.first, relation.last + 1):
        row = _known(drive, address, "r", relation.at, report)
        for bit in row.bits if row else ():
            if bit.id is not None:
                due[bit.id] = 16 * (address - relation.first) + bit.bit.first + 1
                _fault_bit(bit, due[bit.id], ids, report)
    for id_, fault in ids.items():
        if id_ not in due:
            report.add(
                fault.place("id"), f"fault {id_} is no bit of the fault words", "correct the id, or the bits' ids"
            )


def _fault_bit(bit: Bit, due: int, ids: dict[str, Fault], report: Report) -> None:
    fault = ids.get(bit.id or "")
    if fault is None:
        report.add(bit.place("id"), f"fault bit {bit.id} has no fault code", f"by 16 x word + bit + 1 it is {due:02X}H")
    elif fault.code != due:
        wrong = f"fault {bit.id} has code {fault.code:02X}H, but its bit makes it {due:02X}H"
        report.add(fault.place("code"), wrong, "code = 16 x (word - first) + bit + 1")


def _errors(drive: Drive, report: Report) -> None:
    codes = [error.code for error in drive.errors.codes if error.code is not None]
    for error in drive.errors.codes:
        if error.code is not None and (codes.count(error.code) > 1 or not 1 <= error.code <= 0xFFFF):
            report.add(
                error.place("code"), f"error code {error.code:02X}H stands twice or is 0", "one entry per code, from 1"
            )
    form = drive.errors.form
    if form is None:
        return
    needed = _ERROR_KEYS[form.kind]
    for key in ("add", "function", "address"):
        if (getattr(form, key) is None) == (key in needed):
            said = "has no" if key in needed else "must not have"
            report.add(form.at, f"`kind: {form.kind}` {said} `{key}`", f"it needs {' and '.join(needed)}")
    if form.address is not None:
        _error_register(drive, form.address, form.place("address"), set(codes), report)


def _error_register(drive: Drive, address: int, place: Place, codes: set[int], report: Report) -> None:
    row = _known(drive, address, "r", place, report)
    listed = {value.value for value in row.values if value.value} if row else set()
    if listed and listed != codes:
        odd = ", ".join(map(str, sorted(listed ^ codes)))
        report.add(
            place, f"the values of {address_text(address)} and `errors.codes` differ in {odd}", "they say the same"
        )
