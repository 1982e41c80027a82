"""Rules on registers, their bits, values, ranges and scales."""

from driveblocks.maps.factor import doubt
from driveblocks.maps.form import Span, address_text, bits_text, is_bit, span_text
from driveblocks.maps.model import Bit, Drive, Manual, Numbering, OtherScale, Range, Register, Scale, Value
from driveblocks.maps.problem import Report, line
from driveblocks.maps.rules.name import worded
from driveblocks.maps.rules.unique import overlapping, unique
from driveblocks.meaning.pattern import of_condition


def check(drive: Drive, report: Report) -> None:
    _sections(drive, report)
    if drive.numbering:
        _numbering(drive, drive.numbering, report)
    _addresses(drive, report)
    for _, row in drive.registers():
        _spans(row, report)
        _words_of(row, report)
        _unused(drive.manual, row, report)
        _bits(drive.manual, row, report)
        _scale(row, report)


def _sections(drive: Drive, report: Report) -> None:
    unique(drive.sections, "id", "section", report)
    for section in drive.sections:
        if not section.registers:
            wrong = f"section `{section.id}` has no registers"
            report.miss(section.place("registers"), wrong, "list its rows, or remove it")


def _numbering(drive: Drive, one: Numbering, report: Report) -> None:
    """What the numbers mean is proved: one that is wrong moves every register."""
    asked = {frame.id for frame in drive.frames if frame.direction == "request" and frame.means.address is not None}
    if one.proof is None and one.says is None:
        right = "name an example request as `proof`, or give the manual's words as `says`"
        report.miss(one.at, "nothing shows which address a number is", right)
    elif one.proof is not None and one.proof not in asked:
        wrong = f"`{one.proof}` is no example request that names a register"
        report.add(one.place("proof"), wrong, "name one of `frames` whose `means` has an `address`")


def _addresses(drive: Drive, report: Report) -> None:
    """Note addresses of two rows, unless one of them is read and the other one written."""
    used = [(row.access or section.access, row) for section, row in drive.registers()]
    taken = {
        id(later): (earlier, later)
        for use in ("r", "w")
        for earlier, later in overlapping((row.address, row) for access, row in used if use in access)
    }
    for earlier, later in overlapping((row.address, row) for _, row in used):
        if earlier.address != later.address:
            taken.setdefault(id(later), (earlier, later))
    for earlier, later in taken.values():
        wrong = f"address {span_text(later.address)} is taken by {line(earlier.at)}"
        right = "one row per address, or one with `access: r` and one with `w`; if the manual misprints it, use the "
        report.add(later.place("address"), wrong, f"{right}right one and `printed:`")


def _spans(row: Register, report: Report) -> None:
    if row.address.first > row.address.last:
        wrong = f"range {span_text(row.address)} runs backwards"
        report.add(row.place("address"), wrong, "write the smaller address first")
    if len(row.address) > row.size and (row.bits or row.values or row.scale):
        wrong = "a range of registers cannot have bits, values or a scale"
        report.add(row.place("address"), wrong, "write one row per register")
    if row.words and len(row.address) % row.words:
        wrong = f"{len(row.address)} register{'s' * (len(row.address) > 1)} for values of 32 bits"
        report.add(row.place("address"), wrong, "write both registers of each value, such as 1000H-1001H")


def _words_of(row: Register, report: Report) -> None:
    bits = 1 if is_bit(row.address.first) else 16 * row.size
    low, high = (-1 << bits - 1, (1 << bits - 1) - 1) if row.signed else (0, (1 << bits) - 1)
    _kind(row, report)
    if row.range is not None:
        _range(row.range, low, high, row.signed, report)
    _values(row.values, low, high, "the word", report)
    for value in row.values:
        if row.masks and (value.value <= 0 or value.value & (value.value - 1)):
            wrong = f"{value.value} is not a single bit"
            report.add(value.place("value"), wrong, "with `masks: true` each value is 1, 2, 4, 8 ...")
        if row.range is not None and not row.range.holds(value.value):
            wrong = f"value {value.value} is outside the register's range"
            report.add(value.place("value"), wrong, f"it holds {row.range.min} to {row.range.max}")
    if row.masks and not row.values:
        report.miss(row.place("masks"), "`masks` without `values`", "list the values, or remove `masks`")
    if row.values and row.bits:
        wrong = "a register has either values or bits"
        report.add(row.place("values"), wrong, "put the values into a bit field, or drop one")


def _kind(row: Register, report: Report) -> None:
    """Note keys that a value of one bit, or of 32, cannot have."""
    if is_bit(row.address.first):
        wrong, keys = "a coil or discrete input is one bit", ["bits", "masks", "signed", "words", "scale", "never"]
    elif row.words:
        wrong, keys = "a value of 32 bits is a number", ["bits", "masks", "values", "never"]
    else:
        wrong, keys = "a value of 16 bits is one word", ["order"]
    for key in keys:
        if getattr(row, key):
            report.add(row.place(key), f"{wrong}: it has no `{key}`", "remove it, or correct `space` or `words`")


def _range(allowed: Range, low: int, high: int, signed: bool, report: Report) -> None:
    if allowed.min > allowed.max:
        wrong = f"range {allowed.min} to {allowed.max} runs backwards"
        report.add(allowed.at, wrong, "write the smaller number as `min`")
    if allowed.min < low or allowed.max > high:
        hint = "" if signed or allowed.min >= 0 else "; a negative number needs `signed: true`"
        what = {1: "bit", 65535: "word"}.get(high - low, "two words")
        wrong = f"range {allowed.min} to {allowed.max} does not fit the {what}"
        report.add(
            allowed.at,
            wrong,
            f"a word holds {low} to {high}{hint}" if what == "word" else f"it holds {low} to {high}{hint}",
        )


def _values(values: tuple[Value, ...], low: int, high: int, holder: str, report: Report) -> None:
    unique(values, "value", "value", report, str)
    unique(values, "name", "name", report)
    for value in values:
        if not low <= value.value <= high:
            report.add(value.place("value"), f"value {value.value} does not fit {holder}", f"it holds {low} to {high}")


def _unused(manual: Manual, row: Register, report: Report) -> None:
    facts = [key for key in ("scale", "unit", "values", "bits", "range", "id") if getattr(row, key)]
    if row.unused and facts:
        report.add(row.place(facts[0]), f"an unused register has `{facts[0]}`", "remove it, or remove `unused`")
    _named(manual, row, f"register {span_text(row.address)}", row.unused, report)


def _named(manual: Manual, entry: Register | Bit, what: str, unused: bool, report: Report) -> None:
    if entry.name:
        worded(manual, entry, what, report)
    if (entry.zh or entry.wording) and not entry.name and not unused:
        report.miss(entry.at, f"{what} has no `name`: the translation is missing", "add the English `name`")


def _bits(manual: Manual, row: Register, report: Report) -> None:
    for earlier, later in overlapping((bit.bit, bit) for bit in row.bits):
        wrong = f"bit {bits_text(later.bit)} of {address_text(row.address.first)} is taken by {line(earlier.at)}"
        report.add(later.place("bit"), wrong, "one entry per bit")
    for bit in row.bits:
        _one_bit(manual, row, bit, report)


def _one_bit(manual: Manual, row: Register, bit: Bit, report: Report) -> None:
    if bit.bit.first > bit.bit.last:
        report.add(bit.place("bit"), f"bits {bits_text(bit.bit)} run backwards", "write the lower bit first")
        return
    if bit.unused and (bit.values or bit.id):
        report.add(bit.at, "an unused bit has values or an id", "remove them, or remove `unused`")
    if not bit.unused and not bit.name and not bit.own:
        wrong = f"bit {bits_text(bit.bit)} has neither a name nor `unused: true`"
        report.miss(bit.at, wrong, "name it, or write `unused: true`")
    _named(manual, bit, f"bit {bits_text(bit.bit)} of {address_text(row.address.first)}", bit.unused, report)
    _values(bit.values, 0, (1 << len(bit.bit)) - 1, _width(bit.bit), report)


def _width(bits: Span) -> str:
    return "1 bit" if len(bits) == 1 else f"{len(bits)} bits"


def _scale(row: Register, report: Report) -> None:
    if row.scale is None:
        return
    factors: list[Scale | OtherScale] = [row.scale, *row.scale.otherwise]
    for one in factors:
        if one.factor <= 0:
            report.add(
                one.place("factor"), f"factor {one.factor} is not positive", "write units per count, such as 0.01"
            )
        elif row.unit and (doubted := doubt(one.factor, row.unit, 16 * row.size)):
            report.add(one.place("factor"), *doubted)
    if row.scale.otherwise:
        _otherwise(row, row.scale, report)
    if row.values or row.bits:
        wrong = f"a register of listed {'values' if row.values else 'bits'} has a scale"
        report.add(row.place("scale"), wrong, "remove one of them")


def _otherwise(row: Register, scale: Scale, report: Report) -> None:
    """Note factors of which nothing says which one holds."""
    if row.words:
        report.add(scale.place("otherwise"), "a value of 32 bits has one factor", "leave `otherwise` out")
    if scale.when is None:
        report.miss(scale.at, "a factor that always holds has others beside it", "add `when` to it, too")
    for one in scale.otherwise[:-1]:
        if one.when is None:
            report.miss(one.at, "a factor that holds while no other does is not the last", "add `when`, or move it")
    for number, later in enumerate(scale.conditions):
        if not all(of_condition(later).excludes(of_condition(earlier)) for earlier in scale.conditions[:number]):
            wrong = "this may hold together with the condition of another factor"
            report.add(later.at, wrong, "ask the same bits for another value")
