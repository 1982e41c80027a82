"""Map -> values ready to print: one context per template of a drive. No Jinja in here, and no drive by name."""

import textwrap
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from decimal import Decimal
from fractions import Fraction
from typing import Any, TypeVar

from driveblocks.maps import names
from driveblocks.maps.form import Span, address_text, bits_text
from driveblocks.maps.model import Bit, Command, Condition, Drive, Register, Section, Value
from driveblocks.maps.names import UNIT_NAMES, symbol
from driveblocks.maps.plan import READ_WORDS, WRITE_WORDS, Plan, Words, plan
from driveblocks.st.writing import word

Context = dict[str, Any]
T = TypeVar("T")

TERMS = 50
"""Terms of one statement, and branches of one IF: compilers take some hundreds, and each nests what follows."""

_REAL_BITS = 24
"""Bits of a number that a REAL holds (IEC 60559, binary32)."""

STANDARD_EXCEPTION_ADD = 0x80
"""MODBUS Application Protocol V1.1b3, 7: what an exception adds to the function code."""


@dataclass(frozen=True)
class Identity:
    """What every head comment of a drive's block needs."""

    prefix: str
    family: str
    manual: str


def identity(drive: Drive) -> Identity:
    """Prefix, family and manual of a drive."""
    edition = f", edition {drive.manual.edition}" if drive.manual.edition else ""
    manual = f"{title(drive)}, {drive.manual.publisher.en}{edition}".rstrip(".") + "."
    vendor = "" if drive.vendor.en in drive.family.en else f"{drive.vendor.en} "
    return Identity(drive.prefix, f"{vendor}{drive.family.en}", manual)


def source_of(drive: Drive, source: str) -> str:
    """The place of a fact: manual and section."""
    return f"{title(drive)}: {source.rstrip('.')}."


def title(drive: Drive) -> str:
    """The title of the manual in English, and as printed where that is another language."""
    known = drive.manual.title
    return f"{known.en} ({known.own})" if known.own else known.en


# ---------------------------------------------------------------- requests and replies


def access(drive: Drive, use: str) -> Context:
    """For CanAccess: `use` is r or w."""
    allowed = plan(drive)
    spans = allowed.readable if use == "r" else allowed.writable
    name = f"{drive.prefix}_{'CanRead' if use == 'r' else 'CanWrite'}"
    return {"drive": identity(drive), "name": name, "use": use, "chains": groups(spans) or [()]}


def groups(items: Sequence[T]) -> list[Sequence[T]]:
    """The items, so many at once as one statement may have."""
    return [items[at : at + TERMS] for at in range(0, len(items), TERMS)]


def request(drive: Drive) -> Context:
    """For Request."""
    allowed: Plan = plan(drive)
    functions = sorted(allowed.functions & {3, 4, 6, 8, 16})
    modes = drive.serial.mode.modes
    most = allowed.rtu if "rtu" in modes else _without_framing(drive)
    return {
        "drive": identity(drive),
        "functions": functions,
        "reads": bool({3, 4} & set(functions)),
        "most": most,
        "longest": min(most.write, allowed.ascii.write) if modes == ("ascii",) else most.write,
        "ascii": allowed.ascii,
        "sub_functions": allowed.sub_functions,
        "sub_function_groups": groups(allowed.sub_functions),
        "modes": {"rtu": "rtu" in modes, "ascii": "ascii" in modes},
        "unit": Span(drive.serial.unit.min, drive.serial.unit.max),
        "broadcast": drive.serial.broadcast,
        "start_groups": groups(drive.serial.broadcast.start_addresses if drive.serial.broadcast else ()),
        "example_read": allowed.readable[0].first if allowed.readable else 0,
    }


def _without_framing(drive: Drive) -> Words:
    """Words per frame of a drive without RTU, before the ASCII frame sets its own limit."""
    limits = drive.limits
    read = limits.read_words.value if limits.read_words else READ_WORDS
    write = limits.write_words.value if limits.write_words else WRITE_WORDS
    return Words(read, min(write, WRITE_WORDS))


def reply(drive: Drive) -> Context:
    """For Reply."""
    form = drive.errors.form
    if form is None:
        text = "function code + 80H and one byte, as MODBUS has it; the manual does not say."
        source = "MODBUS Application Protocol V1.1b3, 7; the manual describes no refusal on the wire."
        values: Context = {"add": STANDARD_EXCEPTION_ADD, "function": 0, "address": 0}
    elif form.kind == "exception":
        text = f"function code + {form.add:02X}H and one byte."
        source = source_of(drive, form.source)
        values = {"add": form.add, "function": 0, "address": 0}
    else:
        text = f"a reply of function {form.function:02X}H for {address_text(form.address or 0)}, whatever was asked."
        source = source_of(drive, form.source)
        values = {"add": 0, "function": form.function, "address": form.address}
    tolerant = any(tolerance.kind == "two_byte_count" for tolerance in drive.tolerances)
    return {"drive": identity(drive), "form": {"text": text, "source": source, **values}, "two_byte_count": tolerant}


# ---------------------------------------------------------------- decoders


def decoders(drive: Drive) -> Iterator[Context]:
    """For Decoder: one context per register with bits or values."""
    for section, row in drive.registers():
        parts = [*_bit_parts(row), *_value_parts(row)]
        if parts:
            yield {**_register(drive, section, row, ""), "parts": parts}


def scales(drive: Drive) -> Iterator[Context]:
    """For Scale: one context per register with a scale."""
    for section, row in drive.registers():
        if row.scale is not None and row.unit is not None:
            operation, constant = times(row.scale.factor)
            yield {
                **_register(drive, section, row, UNIT_NAMES[row.unit]),
                "unit": row.unit,
                "factor": f"{row.scale.factor.normalize():f}",
                "signed": row.signed,
                "operation": operation,
                "constant": constant,
                "condition": condition_text(row.scale.when) if row.scale.when else "",
            }


def times(factor: Decimal) -> tuple[str, str]:
    """What turns a count into engineering units, and the REAL constant that it needs, if any.

    `/ 100.0` for 0.01, `* 2.5` for 2.5, `* 3.0 / 1000.0` for 0.003: numbers that a REAL holds, so that a C compiler,
    for which a literal is a double, gets the same. What no literals give exactly is a constant of type REAL.
    """
    ratio = Fraction(factor)
    if _is_real(ratio):
        return f"* {real(factor)}", ""
    if ratio.numerator == 1:
        return f"/ {ratio.denominator}.0", ""
    if 0xFFFF * ratio.numerator < 1 << _REAL_BITS:
        return f"* {ratio.numerator}.0 / {ratio.denominator}.0", ""
    return "* FACTOR", real(factor)


def _is_real(number: Fraction) -> bool:
    """Whether a REAL holds a number exactly: 24 bits, and no exponent that a scale could have is too large."""
    lowest = number.numerator & -number.numerator
    whole = number.denominator & (number.denominator - 1) == 0
    return whole and (number.numerator // max(lowest, 1)).bit_length() <= _REAL_BITS


def real(value: Decimal) -> str:
    """A REAL literal."""
    text = f"{value.normalize():f}"
    return text if "." in text else f"{text}.0"


def _register(drive: Drive, section: Section, row: Register, suffix: str) -> Context:
    return {
        "drive": identity(drive),
        "name": names.block(drive.prefix, symbol(row) + suffix),
        "address_text": address_text(row.address.first),
        "title": _inside_a_sentence(row.name or ""),
        "own": row.own,
        "note": _elsewhere(row.note or ""),
        "source": source_of(drive, row.source or section.source),
    }


def _elsewhere(text: str) -> str:
    """A text of the map, whose other parts a reader of the block has not before him."""
    return text.replace("`absent`", "`absent` in the map of the drive")


def _inside_a_sentence(name: str) -> str:
    """A name as it stands inside a sentence; an abbreviation such as CPF stays as it is."""
    return name if name[1:2].isupper() else name[:1].lower() + name[1:]


def _bit_parts(row: Register) -> Iterator[Context]:
    for bit in row.bits:
        if bit.unused or not bit.name:
            continue
        where = f"bit{'s' * (len(bit.bit) > 1)} {bits_text(bit.bit)}{': ' * bool(bit.own)}{bit.own}"
        if len(bit.bit) == 1:
            yield part(symbol(bit), "BOOL", bit_test("Value", bit.bit.first), f"{bit.name}; {where}")
        else:
            yield from _field_parts(bit, where)


def _field_parts(bit: Bit, where: str) -> Iterator[Context]:
    low, mask = bit.bit.first, (1 << len(bit.bit)) - 1
    shifted = f"SHR(Value, {low})" if low else "Value"
    yield part(symbol(bit), "UINT", f"WORD_TO_UINT({shifted} AND {word(mask)})", f"{bit.name}; {where}")
    for value in bit.values:
        test = f"(Value AND {word(mask << low)}) = {word(value.value << low)}"
        yield part(symbol(value), "BOOL", test, _said(value))


def _said(value: Value) -> str:
    return f"{value.value}: {value.name}{'; ' * bool(value.own)}{value.own}"


def _value_parts(row: Register) -> Iterator[Context]:
    known: list[str] = []
    for value in row.values:
        test = bit_test("Value", value.value.bit_length() - 1) if row.masks else f"Value = {word(value.value)}"
        known.append(symbol(value))
        yield part(known[-1], "BOOL", test, _said(value))
    if known and row.masks:
        yield part("Unknown", "BOOL", _unlisted_bits(row), "TRUE: no bit is set, or one that the manual does not list")
    elif known:
        first, *more = _none_of(known)
        yield {**part("Unknown", "BOOL", first, "TRUE: a value that the manual does not list"), "more": more}


def _unlisted_bits(row: Register) -> str:
    others = word(~sum({value.value for value in row.values}))
    return f"(Value = {word(0)}) OR ((Value AND {others}) <> {word(0)})"


def _none_of(names_: list[str]) -> list[str]:
    """Expressions of which all must be TRUE."""
    return ["NOT (" + "\n    ".join(textwrap.wrap(" OR ".join(group), 90)) + ")" for group in groups(names_)]


def part(name: str, type_: str, expression: str, comment: str) -> Context:
    """One output of a decoder."""
    return {"name": name, "type": type_, "expression": expression, "comment": comment, "more": []}


def bit_test(variable: str, bit: int) -> str:
    """An expression that is TRUE when a bit of a WORD is set."""
    return f"({variable} AND {word(1 << bit)}) = {word(1 << bit)}"


# ---------------------------------------------------------------- commands, reference, standstill, faults


def condition_text(condition: Condition) -> str:
    """`000FH bit 0 = 0`."""
    bits = f" bit{'s' * (len(condition.bit) > 1)} {bits_text(condition.bit)}" if condition.bit else ""
    return f"{address_text(condition.register)}{bits} = {condition.equals}"


def command(drive: Drive) -> Context:
    """For Command."""
    commands = {one.does: one for one in drive.operation.commands}
    stop = commands["stop"]
    keeps = _keeps(drive, stop.register)
    printed: dict[str, Context] = {
        does: {"text": _command_text(one, stop, keeps), "register": one.register} for does, one in commands.items()
    }
    asked = [
        ("RunForward", printed.get("run_forward")),
        ("RunReverse", printed.get("run_reverse")),
        ("JogForward", printed.get("jog_forward")),
        ("JogReverse", printed.get("jog_reverse")),
    ]
    optional = ("run_reverse", "jog_forward", "jog_reverse", "jog_stop", "quick_stop", "coast_stop", "fault_reset")
    stops = {one.register for one in commands.values() if one.does in ("coast_stop", "quick_stop", "jog_stop")}
    return {
        "drive": identity(drive),
        "source": source_of(drive, stop.source),
        "register": stop.register,
        "elsewhere_too": len({one.register for one in commands.values()}) > 1,
        "stops_elsewhere": bool(stops - {stop.register}),
        "stop": {**printed["stop"], "word": stop.value if stop.value is not None else _bits(stop.set)},
        "keeps": keeps.values(),
        "asked": asked,
        **{does: printed.get(does) for does in optional},
    }


def _keeps(drive: Drive, first: int) -> dict[int, Context]:
    """The pin and the mask of each command register with bits that are in use and belong to no command."""
    by_bits = [one for one in drive.operation.commands if one.value is None]
    found = {}
    for register in sorted({one.register for one in by_bits}, key=lambda register: (register != first, register)):
        row = drive.register_at(register)
        used = _bits(bit.bit for bit in (row.bits if row else ()) if not bit.unused)
        mask = used & ~_bits(span for one in by_bits if one.register == register for span in (*one.set, *one.clear))
        if mask:
            name = "KeepWord" if register == first else f"KeepWord{address_text(register)}"
            found[register] = {"name": name, "address": register, "mask": mask}
    return found


def _bits(spans: Iterable[Span]) -> int:
    """The word in which the bits of some spans are set."""
    return sum(1 << bit for bit in {bit for span in spans for bit in span})


def _command_text(one: Command, stop: Command, keeps: dict[int, Context]) -> str:
    """The word of a command; a reset beside the run bits is a stop with the bits of the reset."""
    if one.value is not None:
        return word(one.value)
    bits = _bits(one.set)
    if one.does == "fault_reset" and one.register == stop.register:
        bits |= _bits(stop.set) & ~_bits(one.clear)
    keep = keeps.get(one.register)
    if keep is None:
        return word(bits)
    kept = f"{keep['name']} AND {word(keep['mask'])}"
    return f"({kept}) OR {word(bits)}" if bits else kept


def reference(drive: Drive) -> Context:
    """For Reference."""
    spec = drive.operation.reference
    row = drive.register_at(spec.register)
    assert row is not None  # noqa: S101  (a checked map lists its reference register)
    percent = spec.means == "percent_of_maximum"
    highest, why = (
        (row.range.max, "the range of the register") if row.range else (32767 if row.signed else 65535, "the word")
    )
    return {
        "drive": identity(drive),
        "source": source_of(drive, spec.source),
        "register": spec.register,
        "percent": percent,
        "maximum": spec.maximum or "the maximum frequency",
        "scale": row.scale,
        "counts": _counts(row, percent),
        "verify": _verify(spec.verify),
        "highest": highest,
        "highest_why": f"{why} ends here",
    }


def _verify(conditions: tuple[Condition, ...]) -> str:
    """What a program must read back before the word means what it says."""
    if not conditions:
        return ""
    return f" The word means this only while {' and '.join(map(condition_text, conditions))}: read that back first."


def _counts(row: Register, percent: bool) -> Context:
    """Counts of a frequency: the expression, and the REAL constants of the ratio where no literal holds it."""
    if row.scale is None:
        return {"text": "Asked * ReferenceScale", "ratio": None}
    asked = "Asked / MaximumHz" if percent else "Asked"
    ratio = (100 if percent else 1) / Fraction(row.scale.factor)
    if _is_real(ratio):
        return {"text": f"{asked} * {real(Decimal(ratio.numerator) / ratio.denominator)}", "ratio": None}
    return {"text": f"{asked} / DIVISOR * COUNTS", "ratio": ratio}


def standstill(drive: Drive) -> Context:
    """For Standstill."""
    proof = drive.operation.standstill
    addresses = list(dict.fromkeys(condition.register for condition in proof.all))
    words = [_input(drive, address) for address in addresses]
    named = {one["address"]: one["name"] for one in words}
    conditions = [{"expression": _test(named[one.register], one), "comment": condition_text(one)} for one in proof.all]
    return {
        "drive": identity(drive),
        "why": _elsewhere(proof.why[:1].upper() + proof.why[1:].rstrip(".") + "."),
        "source": source_of(drive, proof.source),
        "words": words,
        "conditions": conditions,
        "groups": groups(conditions),
    }


def _input(drive: Drive, address: int) -> Context:
    row = drive.register_at(address)
    assert row is not None  # noqa: S101  (a checked map lists the registers of its conditions)
    return {
        "name": names.word_pin(row),
        "address": address,
        "address_text": address_text(address),
        "title": row.name or "",
    }


def _test(name: str, condition: Condition) -> str:
    if condition.bit is None:
        return f"{name} = {word(condition.equals)}"
    mask = ((1 << len(condition.bit)) - 1) << condition.bit.first
    return f"({name} AND {word(mask)}) = {word(condition.equals << condition.bit.first)}"


def fault_number(drive: Drive) -> Context | None:
    """For FaultNumber; None where faults have no relation to bits."""
    relation = drive.faults.bits
    if relation is None:
        return None
    words = []
    for index, address in enumerate(range(relation.first, relation.last + 1)):
        row = drive.register_at(address)
        mask = sum(1 << bit.bit.first for bit in (row.bits if row else ()) if bit.id is not None)
        words.append({**_input(drive, address), "mask": mask, "base": 16 * index})
    return {"drive": identity(drive), "source": source_of(drive, relation.source), "words": words}
