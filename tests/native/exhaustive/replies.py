"""Every length of a reply with every function that it may have and every byte count, against the reference model."""

import struct
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

from tests.native.exhaustive.bench import Bench, Finding, Trial, judged
from tests.native.exhaustive.frames import noise
from tests.native.exhaustive.scan import Scan
from tests.shipped import drives

from driveblocks.reference.reply import Dialect, dialect, parse
from driveblocks.reference.request import COUNTED, Asked
from driveblocks.render.results import code

HEAD = tuple(f"Adu[{at}]" for at in range(6))
OPEN = ("UnitAddress", "FunctionCode", "Address", "Quantity", "SubFunction", "Value")
REQUEST = tuple(f"Request.{name}" for name in OPEN)
ANSWERED = ("ErrorID", "Reason", "WordCount", "Words[:WordCount]")
FORM = ("ExceptionAdd", "ErrorFunction", "ErrorAddress", "TwoByteCount")


def of_drive(prefix: str) -> Scan:
    """A drive's reply block."""
    return Scan(f"{prefix}_Reply", ("Length", *HEAD, *REQUEST), ANSWERED, ("Adu",))


PARSE = Scan("MB_ParseReply", ("Length", *HEAD, *REQUEST, *FORM), ANSWERED, ("Adu",))
SCANS = (PARSE, *map(of_drive, drives()))
ADU = noise(256)
LONGEST = 260
"""Up to here every length goes with every byte count."""

GENERIC = (
    Dialect(),
    Dialect(two_byte_count=True),
    Dialect(add=None, function=6, address=0x5001),
    Dialect(add=0x40, function=16, address=0x0000),
)
"""Forms of refusal for the generic block: the standard's, with a count of two bytes, CHF's, and two at once."""

REQUESTS = (
    Asked(3, 1, 0x0020, 1),
    Asked(3, 1, 0x0020, 2),
    Asked(3, 1, 0x0020, 125),
    Asked(4, 1, 0x0020, 16),
    Asked(6, 1, 0x5001, 1, value=0x0003),
    Asked(6, 1, 0x2000, 1, value=0x0003),
    Asked(8, 1, sub_function=0, value=0x12AB),
    Asked(16, 1, 0x0000, 2),
    Asked(0, 1),
    Asked(3, 0),
)


@dataclass(frozen=True)
class Reply:
    """Length and first six bytes."""

    length: int
    head: bytes

    @property
    def body(self) -> bytes:
        """All bytes; those that no array holds are 0."""
        return (self.head + ADU[6:])[: self.length].ljust(self.length, b"\0")


def replies(benches: Sequence[Bench], short: bool) -> Iterator[Finding]:
    """The generic block with several forms of refusal, then each drive's."""
    for form in GENERIC[2:] if short else GENERIC:
        yield from judged(benches, _parsed(PARSE, form, short, _form(form)))
    for prefix, drive in drives().items():
        yield from judged(benches, _parsed(of_drive(prefix), dialect(drive), short, b""))


def _form(dialect: Dialect) -> bytes:
    return struct.pack("=HHH?", dialect.add or 0, dialect.function or 0, dialect.address or 0, dialect.two_byte_count)


def _parsed(scan: Scan, dialect: Dialect, short: bool, form: bytes) -> Iterator[Trial]:
    for asked in REQUESTS:
        for function in dict.fromkeys((asked.function, asked.function | 0x80, asked.function | 0x40, 6)):
            cases = [*_replies(asked, function, short)]
            noted = struct.pack("=6H", *_open(asked)) + form
            records = b"".join(struct.pack("=H", one.length) + one.head + noted for one in cases)
            wanted = b"".join(_answer(dialect, asked, one) for one in cases)
            yield Trial(scan, len(cases), records, wanted, _teller(asked, cases), ADU)


def _open(asked: Asked) -> tuple[int, ...]:
    quantity = asked.quantity if asked.function in COUNTED else 1
    return asked.unit, asked.function, asked.address, quantity, asked.sub_function, asked.value


def _teller(asked: Asked, cases: list[Reply]) -> Callable[[int], str]:
    return lambda at: f"to {asked}: {cases[at].length} bytes, {cases[at].head.hex(' ')}"


def _replies(asked: Asked, function: int, short: bool) -> Iterator[Reply]:
    """Every length with few counts, then short lengths with every count; the echo and a refusal among the heads."""
    due = 2 * asked.quantity & 0xFF
    first = asked.sub_function if asked.function == 8 else asked.address
    second = asked.quantity if asked.function == 16 else asked.value
    echo = struct.pack(">HH", first, second)
    for length in (*range(10), *range(250, 260), 0x100, 0x8000, 0xFFFF) if short else range(0x10000):
        yield Reply(length, bytes([asked.unit, function, due]) + ADU[3:6])
        if length > LONGEST and length % 16:
            continue  # refused for its length, whatever is in it
        yield Reply(length, bytes([asked.unit, function, 0, due, *ADU[4:6]]))
        yield Reply(length, bytes([asked.unit, function]) + echo)
        yield Reply(length, bytes([asked.unit, function, 0x50, 0x01, 0, 7]))
        yield Reply(length, bytes([asked.unit + 1, function]) + echo)
    for length in (3, 5, 7, 8, 253, 254) if short else range(LONGEST):
        for count in (0, 1, 2, 3, 4, 250, 255) if short else range(256):
            yield Reply(length, bytes([asked.unit, function, count]) + ADU[3:6])


def _answer(dialect: Dialect, asked: Asked, reply: Reply) -> bytes:
    done = parse(dialect, asked, reply.body)
    words = struct.pack(f"={len(done.words)}H", *done.words).ljust(250, b"\0")
    return struct.pack("=HHH", code(done.result), done.reason, len(done.words)) + words
