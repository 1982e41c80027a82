"""Rules on faults, the registers and bits that report them, and on error replies."""

from driveblocks.maps.form import Span, address_text, bits_text
from driveblocks.maps.model import Bit, BitRelation, Drive, ErrorCode, ErrorForm, Fault, Faults, Value, Warnings
from driveblocks.maps.problem import Place, Report
from driveblocks.maps.rules.access import known
from driveblocks.maps.rules.unique import unique

_ERROR_KEYS = {"exception": ("add",), "write_reply": ("function", "address")}
WORD_BITS = 16
_MOST_WORDS = 64
"""Fault words of one drive; more is a slip in an address."""
_ADDED = (0x40, 0x80)
"""Bits that no function code of the MODBUS Application Protocol V1.1b3, 5.1, has: the highest is 2BH."""


def check(drive: Drive, report: Report) -> None:
    codes = unique(drive.faults.codes, "code", "fault code", report, "{:02X}H".format)
    for code, fault in codes.items():
        if not 1 <= code <= 0xFFFF:
            report.add(fault.place("code"), f"fault code {code}", "0 means no fault; codes are 1 to FFFFH")
    _helped(drive, report)
    _fault_registers(drive, codes, report)
    _present(drive, report)
    if drive.faults.bits is not None:
        _fault_bits(drive, drive.faults.bits, unique(drive.faults.codes, "id", "fault", report), report)
    if drive.warnings is not None:
        _warnings(drive, drive.warnings, report)
    _errors(drive, report)


def _helped(drive: Drive, report: Report) -> None:
    """Note causes and remedies of which nothing says where they are from, and a place without any."""
    faults, codes = drive.faults, (*drive.faults.codes, *drive.warning_codes)
    helped = [one for one in codes if one.causes or one.remedies or one.power_cycle]
    if helped and faults.help is None:
        wrong = f"nothing says where what helps against {drive.kind_of(helped[0])} {helped[0].code:02X}H is from"
        report.miss(helped[0].at, wrong, "add `help: {source: ...}` to `faults`")
    if faults.help is not None and not helped:
        report.add(faults.place("help"), "no code has causes or remedies", "add them, or remove `help`")


def _warnings(drive: Drive, warnings: Warnings, report: Report) -> None:
    """Note what hides the code of a warning, or makes it another one."""
    codes = unique(warnings.codes, "code", "warning code", report, "{:02X}H".format)
    count, faults = len(warnings.span), drive.faults
    if not count:
        report.add(
            warnings.place("bits"), f"bits {bits_text(warnings.span)} run backwards", "write the lower bit first"
        )
    for code, warning in codes.items():
        if count and not 1 <= code < 1 << count:
            wrong = f"warning code {code}"
            report.add(
                warning.place("code"), wrong, f"0 means no warning; codes of {count} bits are 1 to {(1 << count) - 1}"
            )
    if warnings.register == faults.present and (faults.present_bits or Span(0, 15)).overlaps(warnings.span):
        wrong = f"{address_text(warnings.register)} holds the code of a fault in the same bits"
        report.add(warnings.place("register"), wrong, "name the bits of each: `bits`, and `present_bits` of `faults`")
    row = known(drive, warnings.register, "r", warnings.place("register"), report)
    if row is not None and row.values:
        _code_values(row.values, warnings.register, codes, "warning", report)


def _fault_registers(drive: Drive, codes: dict[int, Fault], report: Report) -> None:
    place = drive.faults.place("registers")
    if not drive.faults.registers:
        report.miss(place, "no register reports a fault", "name the register that holds the fault code")
    for span in drive.faults.registers:
        if not span or len(span) > _MOST_WORDS:
            wrong = f"fault registers from {address_text(span.first)} to {address_text(span.last)}"
            report.add(place, wrong, f"write the smaller first, and at most {_MOST_WORDS} in a range")
            continue
        for address in span:
            row = known(drive, address, "r", place, report)
            if row is not None and row.values and codes:
                _code_values(row.values, address, codes, "fault", report)


def _present(drive: Drive, report: Report) -> None:
    """Note what hides the code of the fault that is present, or gives it twice."""
    faults = drive.faults
    if faults.present is None:
        if faults.bits is None and not any("faults" in one.about for one in drive.absent):
            wrong = "nothing gives the code of the fault that is present"
            right = "add `present` with its register, or say under `absent`, about `faults`, that there is none"
            report.miss(faults.at, wrong, right)
    elif faults.bits is not None:
        wrong = "`bits` give the number of the present fault, and so does `present`"
        report.add(faults.place("present"), wrong, "keep the one that the manual says more of")
    elif not any(faults.present in span for span in faults.registers):
        wrong = f"{address_text(faults.present)} is not among `registers`"
        report.miss(faults.place("present"), wrong, "name one of them")
    if faults.present_bits is not None:
        _present_bits(faults, len(faults.present_bits), report)


def _present_bits(faults: Faults, count: int, report: Report) -> None:
    if not 1 <= count < WORD_BITS:
        wrong = f"`present_bits` are {count} bits"
        report.add(faults.place("present_bits"), wrong, "write the smaller first, and leave all 16 out")
    elif faults.present is None:
        report.miss(faults.place("present_bits"), "no register has these bits", "add `present`")
    for fault in faults.codes:
        if fault.code >= 1 << count > 1:
            wrong = f"fault {fault.code} does not fit into {count} bits"
            report.add(fault.place("code"), wrong, "correct it, or `present_bits`")


def _code_values(values: tuple[Value, ...], address: int, codes: dict[int, Fault], kind: str, report: Report) -> None:
    for value in values:
        known_as = codes.get(value.value)
        if value.value and (known_as is None or known_as.name != value.name or known_as.zh != value.zh):
            wrong = f"value {value.value} `{value.name}` of {address_text(address)} is not in the table of {kind}s"
            report.miss(value.at, wrong, f"a {kind} register's values and `{kind}s.codes` say the same")
    listed = {value.value for value in values}
    for code, one in codes.items():
        if code not in listed:
            wrong = f"{kind} {code} is not among the values of {address_text(address)}"
            report.miss(one.place("code"), wrong, "list it there too")


def _fault_bits(drive: Drive, relation: BitRelation, ids: dict[str, Fault], report: Report) -> None:
    if not relation.first <= relation.last < relation.first + _MOST_WORDS:
        wrong = f"fault words from {address_text(relation.first)} to {address_text(relation.last)}"
        report.add(relation.at, wrong, f"write the first and the last, at most {_MOST_WORDS} words")
        return
    due: dict[str, int] = {}
    for address in range(relation.first, relation.last + 1):
        row = known(drive, address, "r", relation.at, report)
        for bit in row.bits if row else ():
            if bit.id is not None:
                number = 16 * (address - relation.first) + bit.bit.first + 1
                _fault_bit(bit, number, due, ids, report)
                due.setdefault(bit.id, number)
    for id_, fault in ids.items():
        if id_ not in due:
            right = "correct the id, or the bits' ids"
            report.miss(fault.place("id"), f"fault {id_} is no bit of the fault words", right)


def _fault_bit(bit: Bit, number: int, due: dict[str, int], ids: dict[str, Fault], report: Report) -> None:
    fault = ids.get(bit.id or "")
    if bit.id in due:
        wrong = f"fault bit {bit.id} is twice in the fault words"
        report.add(
            bit.place("id"), wrong, f"as bit of the words it has the numbers {due[bit.id]:02X}H and {number:02X}H"
        )
    elif fault is None:
        right = f"by 16 x word + bit + 1 it is {number:02X}H"
        report.miss(bit.place("id"), f"fault bit {bit.id} has no fault code", right)
    elif fault.code != number:
        wrong = f"fault {bit.id} has code {fault.code:02X}H, but its bit makes it {number:02X}H"
        report.add(fault.place("code"), wrong, "code = 16 x (word - first) + bit + 1")


def _errors(drive: Drive, report: Report) -> None:
    codes = unique(drive.errors.codes, "code", "error code", report, "{:02X}H".format)
    form = drive.errors.form
    most = 0xFF if form is not None and form.kind == "exception" else 0xFFFF
    for code, error in codes.items():
        if not 1 <= code <= most:
            report.add(error.place("code"), f"error code {code}", f"codes are 1 to {most}")
    for error in drive.errors.codes:
        _corroborated(error, report)
    if form is not None:
        _error_form(drive, form, report)
        if form.address is not None:
            names = {code: error.name for code, error in codes.items()}
            _error_register(drive, form.address, form.place("address"), names, report)


def _corroborated(error: ErrorCode, report: Report) -> None:
    """Note documents that give one error different numbers: they cannot speak of the same."""
    numbers = [item for item in error.corroborated if item.value is not None]
    for item in numbers[1:]:
        if item.value != numbers[0].value:
            wrong = f"`{item.document}` has {item.value} for this error, `{numbers[0].document}` has {numbers[0].value}"
            report.add(item.place("value"), wrong, "correct one of them, or leave out what is not about it")


def _error_form(drive: Drive, form: ErrorForm, report: Report) -> None:
    needed = _ERROR_KEYS[form.kind]
    for key in ("add", "function", "address"):
        if getattr(form, key) is None and key in needed:
            report.miss(form.at, f"`kind: {form.kind}` has no `{key}`", f"it needs {' and '.join(needed)}")
        if getattr(form, key) is not None and key not in needed:
            report.add(
                form.place(key), f"`kind: {form.kind}` must not have `{key}`", f"it needs {' and '.join(needed)}"
            )
    if form.add is not None:
        _added(drive, form, form.add, report)
    if form.function is not None and form.function not in (0x05, 0x06):
        wrong = f"function {form.function:02X}H has no reply with one address and one word"
        report.add(form.place("function"), wrong, "write 06H")


def _added(drive: Drive, form: ErrorForm, add: int, report: Report) -> None:
    """Note an exception whose function code is, or could be, that of another request's reply."""
    codes = {function.code for function in drive.functions}
    taken = sorted(code for code in codes if code + add in codes)
    if add not in _ADDED:
        wrong = f"{add:02X}H added to a function code marks no refusal"
        report.add(form.place("add"), wrong, "write 80H, as Modbus does, or 40H: no function code has these bits")
    elif taken:
        wrong = f"the refusal of function {taken[0]:02X}H is function {taken[0] + add:02X}H, which the drive has"
        report.add(form.place("add"), wrong, "correct `add`, or the list of functions")


def _error_register(drive: Drive, address: int, place: Place, codes: dict[int, str], report: Report) -> None:
    row = known(drive, address, "r", place, report)
    values = {value.value: value.name for value in row.values if value.value} if row else {}
    odd = sorted(code for code in values.keys() | codes.keys() if values.get(code) != codes.get(code))
    if values and odd:
        wrong = f"the values of {address_text(address)} and `errors.codes` differ in {', '.join(map(str, odd))}"
        report.miss(place, wrong, "they have the same codes and names")
