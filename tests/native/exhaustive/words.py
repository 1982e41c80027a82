"""Every word through the decoders, scales and fault numbers of every drive, against the reference model."""

import itertools
import random
import struct
from array import array
from collections.abc import Iterator, Sequence

from tests.blocks import meanings
from tests.native.exhaustive.bench import Bench, Finding, Trial, judged
from tests.native.exhaustive.scan import AnyScan, Call, Scan
from tests.shipped import drives

from driveblocks.maps.model import Drive, Register
from driveblocks.reference import fault, register
from driveblocks.reference.naming import name_of

DECODED = [(drive, row) for drive in drives().values() for row in meanings.decoded(drive)]
SCALED = [(drive, row) for drive in drives().values() for row in meanings.scaled(drive) if not row.words]
"""Those of two words are tried at their edges by tests/blocks."""
NUMBERED = [drive for drive in drives().values() if drive.faults.bits]
EVERY = range(0x10000)


def decoder(drive: Drive, row: Register) -> Scan:
    """A register's decoder: the word, and every output that the reference model knows."""
    return Scan(f"{drive.prefix}_{name_of(row)}", ("Value",), tuple(register.decode(row, 0)))


def scale(drive: Drive, row: Register) -> Call:
    """The function that gives a register's word in its unit."""
    return Call(meanings.scale_name(drive, row))


def fault_addresses(drive: Drive) -> list[int]:
    """The fault words, first word first."""
    relation = drive.faults.bits
    assert relation is not None
    return [*range(relation.first, relation.last + 1)]


def fault_number(drive: Drive) -> Scan:
    """The block that gives a fault number."""
    pins = tuple(meanings.word_pin(drive, address) for address in fault_addresses(drive))
    return Scan(f"{drive.prefix}_FaultNumber", pins, ("FaultNumber", "Count"))


SCANS: tuple[AnyScan, ...] = (
    *(decoder(drive, row) for drive, row in DECODED),
    *(scale(drive, row) for drive, row in SCALED),
    *(fault_number(drive) for drive in NUMBERED),
)


def packed(words: Sequence[int]) -> bytes:
    """Words as records of one word each."""
    return array("H", words).tobytes()


def some(row: Register) -> list[int]:
    """Words of the short form: those that tell bits and values apart, and each 61st."""
    return sorted({*meanings.interesting(row), *range(0, 0x10000, 61)})


def decoders(benches: Sequence[Bench], short: bool) -> Iterator[Finding]:
    """All 65536 words of every decoder."""
    yield from judged(benches, (_decoded(drive, row, some(row) if short else EVERY) for drive, row in DECODED))


def _decoded(drive: Drive, row: Register, words: Sequence[int]) -> Trial:
    form = struct.Struct(
        "=" + "".join("?" if isinstance(value, bool) else "H" for value in register.decode(row, 0).values())
    )
    wanted = b"".join(form.pack(*register.decode(row, word).values()) for word in words)
    return Trial(decoder(drive, row), len(words), packed(words), wanted, lambda at: f"of {words[at]:04X}H")


def scales(benches: Sequence[Bench], short: bool) -> Iterator[Finding]:
    """All 65536 words of every scale: the REAL that is nearest to the exact value, to the bit."""
    yield from judged(benches, (_scaled(drive, row, some(row) if short else EVERY) for drive, row in SCALED))


def _scaled(drive: Drive, row: Register, words: Sequence[int]) -> Trial:
    wanted = array("f", [register.engineering(row, word) for word in words]).tobytes()
    return Trial(scale(drive, row), len(words), packed(words), wanted, lambda at: f"of {words[at]:04X}H")


def fault_numbers(benches: Sequence[Bench], short: bool) -> Iterator[Finding]:
    """Each fault word alone, whole; every pair of bits; random words."""
    yield from judged(benches, (_numbered(drive, short) for drive in NUMBERED))


def _numbered(drive: Drive, short: bool) -> Trial:
    cases = [*_fault_words(len(fault_addresses(drive)), short)]
    found = (fault.numbered(drive, words) for words in cases)
    wanted = array("H", itertools.chain.from_iterable((one.number, one.count) for one in found)).tobytes()
    records = packed([*itertools.chain.from_iterable(cases)])
    return Trial(fault_number(drive), len(cases), records, wanted, lambda at: f"of {cases[at]}")


def _fault_words(count: int, short: bool) -> Iterator[tuple[int, ...]]:
    for place in range(count):
        for word in range(0, 0x10000, 61 if short else 1):
            yield tuple(word if at == place else 0 for at in range(count))
    for pair in itertools.combinations_with_replacement(range(16 * count), 2):
        yield tuple(sum(1 << bit % 16 for bit in set(pair) if bit // 16 == at) for at in range(count))
    chance = random.Random(count)
    for _ in range(500 if short else 100_000):
        yield tuple(chance.randrange(0x10000) for _ in range(count))
