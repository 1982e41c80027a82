"""Programs for the comparison of a reply with the open request: replies that are right, and wrong in each way."""

from collections.abc import Iterator
from dataclasses import dataclass, replace

from driveblocks.bench import kit
from driveblocks.bench.code import NUMBERS, WORDS
from driveblocks.bench.script import Script
from driveblocks.bench.table import Table
from driveblocks.maps.model import Drive
from driveblocks.meaning.serial import serial
from driveblocks.reference.reply import Dialect, dialect, parse
from driveblocks.reference.request import BUILDABLE, READS, Asked, Requests, body
from structured_text.language.writing import word

STALE = (0xDEAD, 0xBEEF, 0xF00D)
"""What is in the words before each reply: one that is not believed must keep it."""

STANDARD_ADD = 0x80
ELSEWHERE = 0x5001
"""An address for refusals that are write replies, where the drive has none of its own."""

_REQUEST = {
    "unit": ("RequestUnit", "UnitAddress", "UINT"),
    "function": ("RequestFunction", "FunctionCode", "UINT"),
    "address": ("RequestAddress", "Address", "WORD"),
    "quantity": ("RequestQuantity", "Quantity", "UINT"),
    "sub_function": ("RequestSub", "SubFunction", "WORD"),
    "value": ("RequestValue", "Value", "WORD"),
}


@dataclass(frozen=True)
class Case:
    """A reply (body without checksum) to an open request; `length` where the block is given another."""

    about: str
    asked: Asked
    data: bytes


@dataclass(frozen=True)
class Subject:
    """What is tested: the statement that calls it, and how it must take refusals."""

    call: str
    dialect: Dialect
    codes: tuple[int, ...]


def scripts(drive: Drive, stem: str) -> Iterator[Script]:
    call = "Parse(Length := Length, Adu := Adu, Request := Request, Words := Words);"
    codes = tuple(dict.fromkeys(code.code for code in drive.errors.codes if code.code is not None))
    subject = Subject(call, dialect(drive), codes)
    source = drive.errors.form.source if drive.errors.form else drive.errors.source
    model = Requests(drive)
    for function in sorted(set(model.functions) & BUILDABLE):
        title = f"replies to function {function:02X}H, right and wrong in each way"
        program = kit.script(drive, stem, f"Reply{function:02X}H", title, f"refusals: {source}")
        kit.declare(program, "Adu", "Words", "Request", Parse=f"{drive.prefix}_Reply")
        fill(program, subject, question(model, function))
        yield program


def question(model: Requests, function: int) -> Asked:
    """A request of two registers, if the drive takes two; its limits do not matter to replies."""
    most = model.rtu if "rtu" in serial(model.drive).modes else model.ascii
    counts = {3: most.read, 4: most.read, 16: most.write}
    known = model.functions[8].sub_functions if 8 in model.functions else ()
    sub = known[0].code if function == 8 and known else 0
    spans = model.readable if function in READS else model.writable
    unit = max(serial(model.drive).lowest, 1)
    return asked(function, min(spans, default=0x2100), sub, min(2, counts.get(function, 1)), unit)


def asked(function: int, address: int = 0x2100, sub_function: int = 0, quantity: int = 2, unit: int = 1) -> Asked:
    """A request whose fields differ from each other."""
    quantity = quantity if function in (3, 4, 16) else 1
    value = 0x1234 if function in (6, 8) else 0
    return Asked(function, unit, 0 if function == 8 else address, quantity, value, sub_function)


def fill(program: Script, subject: Subject, base: Asked) -> None:
    table = _table(program, subject, base)
    seen: set[tuple[Asked, bytes]] = set()
    for case in _cases(subject, base):
        if (case.asked, case.data) not in seen:
            seen.add((case.asked, case.data))
            _row(table, subject, base, case)


# ---------------------------------------------------------------- the table


def _table(program: Script, subject: Subject, base: Asked) -> Table:
    table = Table(program)
    right = answer(base)
    table.column("Length", "UINT", len(right), "bytes of the reply, without checksum")
    for name, (variable, _, type_) in _REQUEST.items():
        table.column(variable, type_, getattr(base, name), "what was asked")
    table.column("WantedError", "UINT", 0, "ErrorID that Parse must give")
    table.column("WantedReason", "UINT", 0, "Reason that it must give")
    table.column("WantedCount", "UINT", 0, "WordCount that it must give")
    table.column("WantedFirst", "WORD", STALE[0], "first word; as before with an error")
    table.column("WantedSecond", "WORD", STALE[1], "second word; as before with an error")
    table.always(*kit.fill_words("Words", STALE), *kit.fill("Adu", _padded(right)))
    table.do(
        *(f"Request.{pin} := {variable};" for variable, pin, _ in _REQUEST.values()),
        subject.call,
        kit.is_number("Parse.ErrorID", "WantedError", "ErrorID"),
        kit.is_number("Parse.Reason", "WantedReason", "Reason"),
        kit.is_number("Parse.WordCount", "WantedCount", "WordCount"),
        kit.is_word("Words[0]", "WantedFirst", "first word"),
        kit.is_word("Words[1]", "WantedSecond", "second word"),
        kit.is_word("Words[2]", word(STALE[2]), "third word, which was not asked for"),
    )
    return table


def _padded(right: bytes) -> bytes:
    """A reply with two more bytes after it, which are there but not received."""
    return right + b"\x00\x00"


def _row(table: Table, subject: Subject, base: Asked, case: Case) -> None:
    found = parse(subject.dialect, case.asked, case.data)
    usual = _padded(answer(base))
    assert not any(case.data[len(usual) :])  # noqa: S101  (nothing but zeros follows, in any case)
    changed = kit.changed("Adu", usual, case.data[: len(usual)])
    words = (*found.words, *STALE[len(found.words) :])
    asked_ = {variable: getattr(case.asked, name) for name, (variable, _, _) in _REQUEST.items()}
    wanted = {
        "WantedError": NUMBERS[found.result],
        "WantedReason": found.reason,
        "WantedCount": len(found.words),
        "WantedFirst": words[0],
        "WantedSecond": words[1],
    }
    says = f"{case.about}: {'believed' if found.result == 'OK' else WORDS[found.result]}"
    table.row(says, {"Length": len(case.data)} | asked_ | wanted, *changed)


# ---------------------------------------------------------------- the cases


def answer(base: Asked) -> bytes:
    """The reply that a request asks for; registers read hold 1111H, 2222H and so on."""
    if base.function in READS:
        words = b"".join((0x1111 * (index % 15 + 1)).to_bytes(2, "big") for index in range(base.quantity))
        return bytes([base.unit, base.function, len(words)]) + words
    return body(replace(base, words=(0,) * base.quantity))[:6]


def _cases(subject: Subject, base: Asked) -> Iterator[Case]:
    right = answer(base)
    yield Case("as asked", base, right)
    yield from _bits(base, right)
    yield from _lengths(base, right)
    yield from _counts(base, right)
    yield from _exceptions(subject, base)
    yield from _write_replies(subject, base)
    yield from _others(base)
    yield from _requests(base, right)


def _bits(base: Asked, right: bytes) -> Iterator[Case]:
    """Each byte with its lowest and with its highest bit changed."""
    for index, octet in enumerate(right):
        for mask in (0x01, 0x80):
            changed = right[:index] + bytes([octet ^ mask]) + right[index + 1 :]
            yield Case(f"byte {index} is {changed[index]:02X}H instead of {octet:02X}H", base, changed)


def _lengths(base: Asked, right: bytes) -> Iterator[Case]:
    whole = _padded(right)
    for length in range(len(whole) + 1):
        yield Case(f"{length} bytes instead of {len(right)}", base, whole[:length])
    for length in (254, 255, 256, 65535):
        yield Case(f"{length} bytes instead of {len(right)}", base, whole.ljust(length, b"\x00"))
    for length in (254, 255):
        other = bytes([base.unit + 1]) + whole[1:]
        yield Case(f"{length} bytes of another unit", base, other.ljust(length, b"\x00"))


def _counts(base: Asked, right: bytes) -> Iterator[Case]:
    """Replies to reads that are whole in themselves, with more or fewer registers, or with a byte count of two."""
    if base.function not in READS:
        return
    for quantity in (base.quantity - 1, base.quantity + 1):
        yield Case(f"{quantity} registers instead of {base.quantity}", base, answer(replace(base, quantity=quantity)))
    yield Case("no register was asked, and none came", replace(base, quantity=0), answer(replace(base, quantity=0)))
    head, data = right[:2], right[3:]
    yield Case("a byte count of two bytes", base, head + bytes([0, len(data)]) + data)
    yield Case("a byte count of two bytes, the high one 01H", base, head + bytes([1, len(data)]) + data)
    yield Case("a byte count of two bytes, the low one too small", base, head + bytes([0, len(data) - 2]) + data)


def _exceptions(subject: Subject, base: Asked) -> Iterator[Case]:
    """Refusals by an exception: with this drive's number and with the standard's."""
    head = bytes([base.unit])
    for add in sorted({STANDARD_ADD, subject.dialect.add or STANDARD_ADD}):
        function = (base.function + add) & 0xFF
        for code in sorted({0, 1, 2, 3, 4, 255, *(code & 0xFF for code in subject.codes)}):
            yield Case(f"exception {function:02X}H with code {code}", base, head + bytes([function, code]))
        for size in (0, 2, 4):
            data = head + bytes([function]) + bytes(range(1, size + 1))
            yield Case(f"exception {function:02X}H with {size} bytes", base, data)
        for other in sorted(BUILDABLE - {base.function}):
            changed = bytes([(other + add) & 0xFF, 2])
            yield Case(f"exception {changed[0]:02X}H to another function", base, head + changed)
        yield Case("exception of another unit", base, bytes([base.unit + 1, function, 2]))


def _write_replies(subject: Subject, base: Asked) -> Iterator[Case]:
    """Refusals by a reply to a write that nobody asked for."""
    function = subject.dialect.function or 6
    address = subject.dialect.address if subject.dialect.address is not None else ELSEWHERE
    head = bytes([base.unit, function])
    for code in sorted({0, 1, 5, 0x0100, 0xFFFF, *subject.codes}):
        data = head + address.to_bytes(2, "big") + (code & 0xFFFF).to_bytes(2, "big")
        yield Case(f"a write reply of {address:04X}H with {code}", base, data)
    data = head + address.to_bytes(2, "big") + b"\x00\x05"
    for step in (-1, 1, 0x100):
        near = head + ((address + step) & 0xFFFF).to_bytes(2, "big") + b"\x00\x05"
        yield Case(f"a write reply of {(address + step) & 0xFFFF:04X}H with 5", base, near)
    yield Case(f"a write reply of {address:04X}H, one byte too short", base, data[:5])
    yield Case(f"a write reply of {address:04X}H, one byte too long", base, data + b"\x00")
    yield Case(f"a write reply of {address:04X}H by another function", base, data[:1] + b"\x10" + data[2:])
    yield Case(f"a write reply of {address:04X}H by another unit", base, bytes([base.unit + 1]) + data[1:])
    yield Case("a reply of function 00H for 0000H", base, bytes([base.unit, 0, 0, 0, 0, 5]))
    if base.function == function:
        own = replace(base, address=address, value=5, quantity=1)
        yield Case(f"a write reply of {address:04X}H that was asked for", own, data)
        yield Case(f"a write reply of {address:04X}H that was asked for with 6", replace(own, value=6), data)


def _others(base: Asked) -> Iterator[Case]:
    for function in sorted(BUILDABLE - {base.function}):
        data = answer(replace(asked(function), unit=base.unit))
        yield Case(f"a reply to function {function:02X}H", base, data)


def _requests(base: Asked, right: bytes) -> Iterator[Case]:
    """The same reply, and other requests."""
    yield Case("nothing was asked", replace(base, function=0), right)
    yield Case("a broadcast was asked", replace(base, unit=0), right)
    yield Case("another unit was asked", replace(base, unit=base.unit + 1), right)
    yield Case("another address was asked", replace(base, address=base.address ^ 1), right)
    yield Case("an address that differs in its high byte was asked", replace(base, address=base.address ^ 0x100), right)
    yield Case("another number of registers was asked", replace(base, quantity=base.quantity + 1), right)
    for quantity in (0, 125, 126):
        yield Case(f"{quantity} registers were asked", replace(base, quantity=quantity), right)
    odd = bytes([base.unit, 5]) + right[2:6].ljust(4, b"\x00")
    yield Case("a function that no block asks for was asked", replace(base, function=5), odd)
    yield Case("another word was asked", replace(base, value=base.value ^ 0x8000), right)
    yield Case("another sub-function was asked", replace(base, sub_function=base.sub_function ^ 1), right)
