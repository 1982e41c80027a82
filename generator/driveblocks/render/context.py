"""Map -> values ready to print: one class per template of a drive. No Jinja in here, and no drive by name."""

import re
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Literal

from driveblocks import __version__
from driveblocks.maps import names
from driveblocks.maps.form import Span, address_name, address_text, bits_text, is_bit, space_of, wire
from driveblocks.maps.model import Drive, Register, Section, Value
from driveblocks.maps.names import UNIT_NAMES, symbol
from driveblocks.maps.plan import READ_WORDS, WRITE_WORDS, Plan, Words, dialect, holding
from driveblocks.maps.revision import revision
from driveblocks.meaning.pattern import WORD, Pattern, bits_of
from driveblocks.meaning.quantity import Quantity, of_row
from driveblocks.meaning.reference import reference
from driveblocks.meaning.serial import serial
from driveblocks.meaning.status import registers, status
from driveblocks.meaning.words import STOPS, Command, words
from driveblocks.render.expression import Test, is_real

STANDARD_EXCEPTION_ADD = 0x80
"""MODBUS Application Protocol V1.1b3, 7: what an exception adds to the function code."""


@dataclass(frozen=True)
class Identity:
    """What every head comment of a drive's block needs."""

    prefix: str
    family: str
    manual: str


@dataclass(frozen=True)
class Word:
    """The word of a register: the name of its pin, and what to say of it."""

    name: str
    address: int
    address_text: str
    title: str
    number: int = 0
    """The read that brings it, from 1; 0: not said."""
    index: int = 0
    """Its place in that read."""
    mask: int = 0
    """The bits that mean faults, where there are such."""
    base: int = 0
    """The number of the fault before that of its bit 0."""
    bit: bool = False
    """It is a bit, that of its place in the one word of its read."""


ANY = Test("Value", 0, 0)


@dataclass(frozen=True)
class Part:
    """An output of a decoder; its kind says which of the rest counts, and names its template."""

    kind: Literal["flag", "field", "other_bits", "other_value"]
    name: str
    comment: str
    test: Test = ANY
    """What the word passes while a flag is TRUE."""
    low: int = 0
    """The lowest bit of a field."""
    mask: int = 0
    """Its bits, moved to bit 0."""
    others: int = 0
    """The bits that the manual does not list."""
    known: tuple[str, ...] = ()
    """The flags of all values that it lists."""


def identity(drive: Drive) -> Identity:
    """Prefix, family and manual of a drive."""
    edition = f", edition {drive.manual.edition}" if drive.manual.edition else ""
    manual = f"{title(drive)}, {drive.manual.publisher.en}{edition}".rstrip(".") + "."
    vendor = "" if drive.vendor.en in drive.family.en else f"{drive.vendor.en} "
    return Identity(drive.prefix, f"{vendor}{drive.family.en}", manual)


def version(drive: Drive) -> dict[str, object]:
    """For Version: the library's version as text and as a number, and the revision of the map."""
    major, minor, patch = (int(each) for each in re.findall("[0-9]+", __version__)[:3])
    number = 10000 * major + 100 * minor + patch
    return {"version": __version__, "number": number, "revision": revision(drive)}


def source_of(drive: Drive, source: str) -> str:
    """The place of a fact: manual and section."""
    return f"{title(drive)}: {source.rstrip('.')}."


def title(drive: Drive) -> str:
    """The title of the manual in English, and as printed where that is another language."""
    known = drive.manual.title
    return f"{known.en} ({known.own})" if known.own else known.en


# ---------------------------------------------------------------- requests and replies


FUNCTIONS = {3: "read", 4: "read", 6: "write_single", 8: "diagnostics", 16: "write_multiple"}
"""Function code -> the folder of its parts of Request."""


def access(drive: Drive, use: str, spans: tuple[Span, ...]) -> dict[str, object]:
    """For CanAccess: what may be read, or written; `use` is r or w."""
    return {"name": f"{drive.prefix}_{'CanRead' if use == 'r' else 'CanWrite'}", "use": use, "spans": spans}


def request(drive: Drive, allowed: Plan) -> dict[str, object]:
    """For Request: what a drive can be asked: of holding registers, since each of its functions is of one table."""
    elsewhere = any(space_of(span.first) == "input" for span in allowed.readable)
    codes = [code for code in FUNCTIONS if code in allowed.functions and not (code == 4 and elsewhere)]
    line = serial(drive)
    modes, broadcast = line.modes, line.broadcast
    most = allowed.rtu if "rtu" in modes else _without_framing(drive)
    less = allowed.ascii.read < most.read or (16 in codes and allowed.ascii.write < most.write)
    return {
        "functions": {code: FUNCTIONS[code] for code in codes},
        "uncounted": [code for code in (6, 8) if code in codes],  # those whose quantity is always 1
        "sub_functions": allowed.sub_functions,
        "modes": list(modes),
        "most": most,
        "ascii": allowed.ascii,
        "tight": "ascii" in modes and less,  # an ASCII frame holds less than an RTU frame
        "longest": most.write if "rtu" in modes else min(most.write, allowed.ascii.write),
        "serial": line,
        "beyond": line.highest > 247,  # there are addresses that the standard reserves
        "unit_pin": "Standard" if line.highest > 247 else "UnitAddress",
        "broadcast": broadcast,
        "start_addresses": broadcast.starts if broadcast else (),
        "example_read": next((span.first for span in holding(allowed.readable)), 0),
    }


def _without_framing(drive: Drive) -> Words:
    """Words per frame of a drive without RTU, before the ASCII frame sets its own limit."""
    limits = drive.limits
    read = limits.read_words.value if limits.read_words else READ_WORDS
    write = limits.write_words.value if limits.write_words else WRITE_WORDS
    return Words(read, min(write, WRITE_WORDS))


@dataclass(frozen=True)
class Refusal:
    """The form of a refusal: function code + `add`, or a reply of a function for an address; 0: not so."""

    text: str
    source: str
    add: int = 0
    function: int = 0
    address: int = 0


def reply(drive: Drive) -> dict[str, object]:
    """For Reply: what a reply looks like."""
    return {"form": refusal(drive), "two_byte_count": dialect(drive).two_byte_count}


def refusal(drive: Drive) -> Refusal:
    """What a refusal looks like."""
    form = drive.errors.form
    if form is None:
        text = "function code + 80H and one byte, as MODBUS has it; the manual does not say."
        source = "MODBUS Application Protocol V1.1b3, 7; the manual describes no refusal on the wire."
        return Refusal(text, source, add=STANDARD_EXCEPTION_ADD)
    source = source_of(drive, form.source)
    if form.kind == "exception":
        return Refusal(f"function code + {form.add:02X}H and one byte.", source, add=form.add or 0)
    text = f"a reply of function {form.function:02X}H for {address_text(form.address or 0)}, whatever was asked."
    return Refusal(text, source, function=form.function or 0, address=wire(form.address or 0))


# ---------------------------------------------------------------- decoders


@dataclass(frozen=True, kw_only=True)
class Row:
    """For Decoder and Scale: a register, with the outputs of its decoder or with its scale."""

    name: str
    address_text: str
    title: str
    own: str
    note: str
    source: str
    parts: tuple[Part, ...] = ()
    quantity: Quantity | None = None
    kind: str = ""
    """The type of its number."""
    read: bool = True
    """What is read at its address is this, and nothing else."""


def decoders(drive: Drive) -> Iterator[Row]:
    """One per register with bits or values."""
    for section, row in drive.registers():
        parts = (*_bit_parts(row), *_value_parts(row))
        if parts:
            yield replace(_register(drive, section, row, ""), parts=parts)


def scales(drive: Drive) -> Iterator[Row]:
    """One per register with a scale."""
    for section, row in drive.registers():
        if row.scale is not None:
            named = _register(drive, section, row, UNIT_NAMES.get(row.unit or "", ""))
            kind = "DINT" if row.signed else "UDINT" if row.words else "UINT"
            yield replace(named, quantity=of_row(row, row.address.first), kind=kind)


def _register(drive: Drive, section: Section, row: Register, suffix: str) -> Row:
    return Row(
        name=names.block(drive.prefix, symbol(row) + suffix),
        address_text=address_text(row.address.first),
        title=inside_a_sentence(row.name or ""),
        own=row.own,
        note=_elsewhere(row.note or ""),
        source=source_of(drive, row.source or section.source),
        read=drive.is_read(row),
    )


def _elsewhere(text: str) -> str:
    """A text of the map, whose other parts a reader of the block has not before him."""
    return text.replace("`absent`", "`absent` in the map of the drive")


def inside_a_sentence(name: str) -> str:
    """A name as it is inside a sentence; an abbreviation such as CPF stays as it is."""
    return name if name[1:2].isupper() else name[:1].lower() + name[1:]


def _bit_parts(row: Register) -> Iterator[Part]:
    for bit in row.bits:
        if bit.unused or not bit.name:
            continue
        where = f"bit{'s' * (len(bit.bit) > 1)} {bits_text(bit.bit)}{': ' * bool(bit.own)}{bit.own}"
        mask = bits_of([bit.bit])
        if len(bit.bit) == 1:
            yield _flag(symbol(bit), Test("Value", mask, mask), f"{bit.name}; {where}")
            continue
        low = bit.bit.first
        yield Part("field", symbol(bit), f"{bit.name}; {where}", low=low, mask=mask >> low)
        for value in bit.values:
            yield _flag(symbol(value), Test("Value", mask, value.value << low), _said(value))


def _flag(name: str, test: Test, comment: str) -> Part:
    """An output that is TRUE when the word passes a test."""
    return Part("flag", name, comment, test)


def _said(value: Value) -> str:
    return f"{value.value}: {value.name}{'; ' * bool(value.own)}{value.own}"


def _value_parts(row: Register) -> Iterator[Part]:
    for value in row.values:
        yield _flag(symbol(value), Test("Value", value.value if row.masks else 0, value.value), _said(value))
    if row.values and row.masks:
        others = ~sum({value.value for value in row.values})
        comment = "TRUE: no bit is set, or one that the manual does not list"
        yield Part("other_bits", "Unknown", comment, others=others)
    elif row.values:
        comment = "TRUE: a value that the manual does not list"
        yield Part("other_value", "Unknown", comment, known=tuple(map(symbol, row.values)))


# ---------------------------------------------------------------- commands, reference, standstill, faults


MOTIONS = {
    "RunForward": "run_forward", "RunReverse": "run_reverse", "JogForward": "jog_forward", "JogReverse": "jog_reverse"
}  # fmt: skip
"""Pin -> the command that it asks for."""


@dataclass(frozen=True)
class Keep:
    """The pin of a command register for the bits, by their mask, that are in use and belong to no command."""

    name: str
    register: int
    mask: int


@dataclass(frozen=True)
class Told:
    """The register of a command, its bits, and the pin whose other bits pass through."""

    register: int
    bits: int
    keep: Keep | None


def command(drive: Drive) -> dict[str, object]:
    """For Command: what commands write.

    The branches are in the order in which they count: the template of each, the pin that asks, its word.
    """
    stop = words(drive).stop
    keeps = _keeps(drive, stop.last.register)
    told: dict[str, Told] = {one.does: _told(one, keeps) for one in words(drive).commands if not one.negative}
    stops = {each.register for does, each in told.items() if does in STOPS}
    return {
        "source": source_of(drive, stop.source),
        "elsewhere": len({each.register for each in told.values()}) > 1,  # commands have several registers
        "stops_elsewhere": len(stops) > 1,
        "stop": told["stop"],
        "has": told,
        "keeps": list(keeps.values()),
        "branches": list(_branches(told)),
    }


def _branches(told: dict[str, Told]) -> Iterator[tuple[str, str, Told]]:
    stop = told["stop"]
    chain = [
        ("fault_reset", "", told.get("fault_reset")),
        ("stop", "CoastStop", told.get("coast_stop")),
        ("stop", "QuickStop", told.get("quick_stop")),
        ("stop", "Halted", stop),
        ("contradiction", "", stop),
        *(("motion" if does in told else "not_able", pin, told.get(does, stop)) for pin, does in MOTIONS.items()),
        ("stop", "Jogging", told.get("jog_stop")),
    ]
    return ((branch, pin, word) for branch, pin, word in chain if word)


def _keeps(drive: Drive, first: int) -> dict[int, Keep]:
    """Those of each command register that has such bits."""
    found = {}
    for register, mask in sorted(kept(drive).items(), key=lambda each: (each[0] != first, each[0])):
        name = "KeepWord" if register == first else f"KeepWord{address_name(register)}"
        found[register] = Keep(name, register, mask)
    return found


def kept(drive: Drive) -> dict[int, int]:
    """The bits of each command register that are in use and belong to no command, where there are such."""
    found = {each.register: each.keeps for one in words(drive).commands for each in one.writes if each.keeps}
    return dict(sorted(found.items()))


def _told(one: Command, keeps: dict[int, Keep]) -> Told:
    last = one.last
    return Told(last.register, last.word, keeps.get(last.register) if last.keeps else None)


def referred(drive: Drive) -> dict[str, object]:
    """For Reference."""
    has = reference(drive)
    return vars(has) | {
        "source": source_of(drive, has.said.source),
        "exact": is_real(has.ratio),
        "highest_why": f"{'the range of the register' if has.ranged else 'the word'} ends here",
        "verify": status(drive).verify,
    }


@dataclass(frozen=True)
class Standstill:
    """For Standstill."""

    why: str
    source: str
    words: list[Word]
    conditions: tuple[Pattern, ...]
    tests: list[Test]


def standstill(drive: Drive) -> Standstill:
    """What proves that the motor is at standstill."""
    proof = status(drive).standstill
    words = [word_input(drive, address) for address in registers(proof.patterns)]
    pins = {word.address: word.name for word in words}
    return Standstill(
        why=_elsewhere(proof.why[:1].upper() + proof.why[1:].rstrip(".") + "."),
        source=source_of(drive, proof.said.source),
        words=words,
        conditions=proof.patterns,
        tests=[tested(pins[one.register], one) for one in proof.patterns],
    )


def word_input(drive: Drive, address: int) -> Word:
    """The word of a register."""
    row = drive.register_at(address)
    assert row is not None  # noqa: S101  (a checked map lists the registers of its conditions)
    return Word(names.word_pin(row, address), address, address_text(address), row.name or "", bit=is_bit(address))


def tested(pin: str, one: Pattern) -> Test:
    """A pattern as a test of the word at a pin."""
    return Test(pin, one.mask if one.mask != WORD else 0, one.value, one.is_, one.signed)


@dataclass(frozen=True)
class FaultNumber:
    """For FaultNumber: the words whose bits are faults."""

    source: str
    words: list[Word]


def fault_number(drive: Drive) -> FaultNumber | None:
    """None where faults have no relation to bits."""
    relation = drive.faults.bits
    if relation is None:
        return None
    words = []
    for index, address in enumerate(range(relation.first, relation.last + 1)):
        row = drive.register_at(address)
        mask = sum(1 << bit.bit.first for bit in (row.bits if row else ()) if bit.id is not None)
        words.append(replace(word_input(drive, address), mask=mask, base=16 * index))
    return FaultNumber(source_of(drive, relation.source), words)
