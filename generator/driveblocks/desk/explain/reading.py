"""One reading of a body: what it says as a request or as a reply, and what a drive would not take."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass

from driveblocks.desk.explain import suspicion
from driveblocks.desk.explain.meaning import Held, held
from driveblocks.maps.form import Span, address_text, span_text, wire
from driveblocks.maps.model import Drive, ErrorCode
from driveblocks.maps.plan import READ_WORDS, start_of
from driveblocks.maps.view import error_number
from driveblocks.modbus import layout
from driveblocks.modbus.layout import Dialect, Direction, Layout, Part
from driveblocks.modbus.request import WRITES, Asked
from driveblocks.show.layout import both

_STANDARD = {
    1: "Read coils", 2: "Read discrete inputs", 3: "Read holding registers", 4: "Read input registers",
    5: "Write single coil", 6: "Write single register", 7: "Read exception status", 8: "Diagnostics",
    11: "Get comm event counter", 12: "Get comm event log", 15: "Write multiple coils",
    16: "Write multiple registers", 17: "Report server ID", 20: "Read file record", 21: "Write file record",
    22: "Mask write register", 23: "Read/write multiple registers", 24: "Read FIFO queue",
    43: "Encapsulated interface transport",
}  # fmt: skip
"""MODBUS Application Protocol V1.1b3, 6: names of functions, for drives whose map has none."""

_EXCEPTIONS = {
    1: "Illegal function", 2: "Illegal data address", 3: "Illegal data value", 4: "Server device failure",
    5: "Acknowledge", 6: "Server device busy", 8: "Memory parity error", 10: "Gateway path unavailable",
    11: "Gateway target device failed to respond",
}  # fmt: skip
"""MODBUS Application Protocol V1.1b3, 7."""


@dataclass(frozen=True)
class Field:
    """One field of the frame: name, bytes, and what they mean."""

    name: str
    data: bytes
    means: str


@dataclass(frozen=True)
class Wrong:
    """What is wrong, and what it might be instead, best first."""

    what: str
    instead: tuple[str, ...] = ()


@dataclass(frozen=True)
class Reading:
    """What a body says in one direction."""

    direction: Direction
    says: str
    fields: tuple[Field, ...]
    registers: tuple[Held, ...]
    wrongs: tuple[Wrong, ...]
    notes: tuple[str, ...] = ()


class Reader:
    """Reads bodies with what a map says, or with the standard alone."""

    def __init__(self, drive: Drive | None, dialect: Dialect, *, ascii_mode: bool) -> None:
        self.drive = drive
        self.dialect = dialect
        self.ascii_mode = ascii_mode

    def read(self, one: Layout, asked: Asked | None = None) -> Reading:
        """What a layout says; `asked` is the request that a reply answers."""
        wrongs = [*self._shape(one), *suspicion.wrongs(self.drive, one, ascii_mode=self.ascii_mode)]
        parts = [each for each in one.parts if each.name != "refused function"]
        return Reading(
            one.direction,
            self._says(one),
            tuple(Field(each.name, each.data, self._means(one, each, asked)) for each in parts),
            tuple(self._registers(one, asked)),
            tuple(Wrong(what, (instead,) if instead else ()) for what, instead in dict.fromkeys(wrongs)),
            tuple(self._notes(one, asked)),
        )

    # ------------------------------------------------------------ the sentence

    def _says(self, one: Layout) -> str:
        unit = one.body[0]
        whom = f"reply of unit {unit}" if one.direction == "reply" else f"request to unit {unit}"
        if unit == 0 and one.direction == "request":
            whom = "broadcast to all drives"
        return f"{whom}: {self._deed(one)}"

    def _deed(self, one: Layout) -> str:
        if one.refusal:
            return self._refused(one)
        if one.number("address") is not None:
            return _access(one, address_text((one.number("address") or 0) + self._start(one)))
        if one.function in (1, 2, 3, 4):
            return f"{_things(one, len(one.words))} read" if one.words else self.function(one.function)
        if one.function == 8:
            return f"diagnostics {one.number('sub-function') or 0:04X}H, data {one.number('data word') or 0:04X}H"
        return self.function(one.function)

    def _refused(self, one: Layout) -> str:
        code = one.number("reason")
        what = f"refuses function {one.function:02X}H" if one.part("refused function") else "refuses"
        return f"{what}, reason {self._reason(code, standard=self._foreign(one))}" if code is not None else what

    def _foreign(self, one: Layout) -> bool:
        """Whether a refusal has the form of the standard and the drive another; its codes are not the drive's."""
        return one.part("refused function") is not None and self.dialect.add is None

    def function(self, code: int) -> str:
        """A function by its number, as the drive's manual or the standard names it."""
        known = {one.code: both(one.name, one.own) for one in self.drive.functions} if self.drive else {}
        return known.get(code) or _STANDARD.get(code) or f"function {code:02X}H"

    def _reason(self, code: int, *, standard: bool = False) -> str:
        if self.drive is None or standard:
            return f"{code:02X}H {_EXCEPTIONS.get(code, 'unknown to the standard')}"
        found = _error(self.drive, code)
        if found is None:
            return f"{code:02X}H, which the map does not list"
        likely = ", by the standard" if found.code is None else ""
        return f"{code:02X}H {both(found.name, found.own)}{likely}"

    # ------------------------------------------------------------ the fields

    def _means(self, one: Layout, part: Part, asked: Asked | None) -> str:
        meaning: dict[str, Callable[[], str]] = {
            "unit": lambda: "broadcast: all drives" if part.number == 0 else f"unit {part.number}",
            "function": lambda: self._function(one, part.number),
            "address": lambda: self._address(part.number + self._start(one), writing=one.function in WRITES),
            "quantity": lambda: self._quantity(one, part.number),
            "byte count": lambda: self._byte_count(one, part.number),
            "reason": lambda: self._reason(part.number, standard=self._foreign(one)),
            "sub-function": lambda: self._sub_function(part.number),
            "surplus": lambda: f"{_bytes(len(part.data))} too many",
            "data": lambda: self._data(one, part, asked),
        }
        if part.name in meaning:
            return meaning[part.name]()
        return f"{part.number:04X}H = {part.number}" if len(part.data) == 2 else f"{part.number:02X}H = {part.number}"

    def _function(self, one: Layout, number: int) -> str:
        refused = one.number("refused function")
        if refused is None:
            return f"{number:02X}H {self.function(number)}"
        return f"{number - refused:02X}H + {refused:02X}H: refuses {self.function(refused)}"

    def _byte_count(self, one: Layout, number: int) -> str:
        carried = f", {_things(one, number // 2)}" if one.words else ""
        return f"{_bytes(number)}{carried}{', counted in two bytes' if one.two_byte_count else ''}"

    def _address(self, number: int, *, writing: bool) -> str:
        named = held(self.drive, number, None, writing=writing)
        known = named.note if not named.known else "  ".join(filter(None, (named.id, both(named.name, named.zh))))
        return f"{address_text(number)} {known}".rstrip()

    def _quantity(self, one: Layout, number: int) -> str:
        start = self._start(one)
        first = (one.number("address") or 0) + start
        last = min(first + max(number, 1) - 1, start + 0xFFFF)
        return f"{_things(one, number)}, {span_text(Span(first, last))}" if number else "no registers"

    def _sub_function(self, code: int) -> str:
        functions = self.drive.functions if self.drive else ()
        known = {sub.code: both(sub.name, sub.own) for one in functions for sub in one.sub_functions}
        return f"{code:04X}H {known.get(code, 'Return query data' if code == 0 else '')}".rstrip()

    def _data(self, one: Layout, part: Part, asked: Asked | None) -> str:
        if not one.words:
            return f"{_bytes(len(part.data))}, not taken apart"
        first = self._first(one, asked)
        where = f", {span_text(Span(first, first + len(one.words) - 1))}" if first is not None else ""
        return f"{_things(one, len(one.words))}{where}, see below"

    # ------------------------------------------------------------ the registers

    def _first(self, one: Layout, asked: Asked | None) -> int | None:
        own = one.number("address")
        found = own if own is not None else asked.address if asked is not None and not one.refusal else None
        return None if found is None else found + self._start(one)

    def _start(self, one: Layout) -> int:
        """Where the table of a function begins."""
        return start_of(self.drive, one.function)

    def _registers(self, one: Layout, asked: Asked | None) -> Iterator[Held]:
        first = self._first(one, asked)
        writing = one.function in WRITES
        for place, word in enumerate(one.words):
            address = first + place if first is not None and wire(first) + place <= 0xFFFF else None
            yield held(self.drive, address, word, writing=writing)
        quantity = one.number("quantity") or 0
        if not one.words and first is not None and one.function in (3, 4, 16) and quantity <= READ_WORDS:
            for address in range(first, first + min(quantity, 0x10000 - wire(first))):
                yield held(self.drive, address, None, writing=writing)

    # ------------------------------------------------------------ what is wrong, what to know

    def _shape(self, one: Layout) -> Iterator[tuple[str, str]]:
        """Length and byte count against what the function asks for."""
        kind = "an error reply" if one.refusal else f"a {one.direction} of function {one.function:02X}H"
        if one.missing > 0:
            yield f"{kind} has {one.size} bytes and the checksum, {one.missing} more than these", "truncated"
        elif one.missing < 0:
            yield f"{kind} has {one.size} bytes and the checksum; {_bytes(-one.missing)} too many", _surplus(one)
        if one.missing <= 0 and not one.agrees:
            count, quantity = one.number("byte count"), one.number("quantity")
            fits = f"a quantity of {quantity} needs {2 * quantity}" if quantity else "registers have two bytes each"
            yield f"the byte count {count} does not fit: {fits}", ""
        if one.two_byte_count and not self.dialect.two_byte_count:
            yield (
                "the byte count is a word: two-byte count",
                "the standard has one byte, and this map tolerates no other",
            )

    def _notes(self, one: Layout, asked: Asked | None) -> Iterator[str]:
        if one.words and self._first(one, asked) is None:
            yield "A read reply carries no address: give its --request, and the registers get their names."
        if one.refusal and self.drive is not None and not self._foreign(one):
            yield from _causes(self.drive, one.number("reason"))
        if one.two_byte_count and self.dialect.two_byte_count:
            yield "The byte count is a word; the map tolerates it."
        if one.function not in layout.KNOWN:
            yield f"The fields of function {one.function:02X}H are not taken apart."


def _access(one: Layout, where: str) -> str:
    """What a frame with an address does there."""
    quantity, value, reply = one.number("quantity"), one.number("value"), one.direction == "reply"
    if value is not None:
        return f"{value} written to {where}" if reply else f"write {value} to {where}"
    many = _things(one, quantity or 0)
    if one.function in (1, 2, 3, 4):
        return f"read {many} from {where}"
    return f"{many} written at {where}" if reply else f"write {many} at {where}"


def _bytes(number: int) -> str:
    return f"{number} byte{'s' * (number != 1)}"


def _things(one: Layout, number: int) -> str:
    kind = {1: "coil", 5: "coil", 15: "coil", 2: "input"}.get(one.function, "register")
    return f"{number} {kind}{'s' * (number != 1)}"


def _surplus(one: Layout) -> str:
    part = one.part("surplus")
    if part is not None and not any(part.data):
        return "a 00 was received after the frame, where the line turns round; the CRC stays right with 00 there"
    return "trailing bytes, or another frame after it"


def _error(drive: Drive, code: int) -> ErrorCode | None:
    return next((one for one in drive.errors.codes if error_number(one) == code), None)


def _causes(drive: Drive, code: int | None) -> Iterator[str]:
    found = _error(drive, code) if code is not None else None
    if found is None:
        return
    if found.meaning:
        yield f"Means: {both(found.meaning.en, found.meaning.own)}"
    for cause in found.causes:
        yield f"Cause: {both(cause.en, cause.own)}"
    if found.note:
        yield found.note
