"""Every length through sealing and opening of RTU and ASCII frames and through packing, against the reference model."""

import random
import struct
from array import array
from collections.abc import Callable, Iterator, Sequence

from tests.native.exhaustive.bench import Bench, Finding, Trial, judged
from tests.native.exhaustive.scan import Scan

from driveblocks.reference import framing, packing
from driveblocks.reference.framing import Framed
from driveblocks.render.results import code

ROOM = {"Adu": 256, "Chars": 513, "Registers": 513}
"""Elements of each type of array."""

SEAL = Scan("MB_RtuSeal", ("Length",), ("ErrorID", "AduLength", "Adu"), ("Adu",))
OPEN = Scan("MB_RtuOpen", ("AduLength", "Adu"), ("ErrorID", "Length", "Adu[:Length]"))
ENCODE = Scan("MB_AsciiEncode", ("Length",), ("ErrorID", "CharCount", "Chars"), ("Adu", "Chars"))
DECODE = Scan("MB_AsciiDecode", ("CharCount", "Chars"), ("ErrorID", "Length", "Adu[:Length]"), ("Adu",))
FORMS = [(box, bits) for box in ("Adu", "Chars") for bits in (8, 16)]


def pack(box: str, bits: int) -> Scan:
    """A block that packs characters into registers."""
    return Scan(f"MB_Pack{box}{bits}", ("CharCount",), ("RegisterCount", "Registers"), (box, "Registers"))


def unpack(box: str, bits: int) -> Scan:
    """A block that takes characters out of registers."""
    return Scan(f"MB_Unpack{box}{bits}", ("CharCount",), ("Unpacked", box), ("Registers", box))


SCANS = (SEAL, OPEN, ENCODE, DECODE, *(pack(*form) for form in FORMS), *(unpack(*form) for form in FORMS))


def lengths(short: bool) -> Sequence[int]:
    """Every length; short: every one up to 530, each 997th, and the last."""
    return [*range(530), *range(530, 0x10000, 997), 0xFFFF] if short else range(0x10000)


def noise(size: int) -> bytes:
    """Random bytes, the same on every run."""
    return random.Random(size).randbytes(size)


def _filled(data: bytes, behind: bytes) -> bytes:
    """What an array holds after its first elements were written."""
    return data + behind[len(data) :]


def _length(counts: Sequence[int]) -> Callable[[int], str]:
    return lambda at: f"of length {counts[at]}"


def sealing(benches: Sequence[Bench], short: bool) -> Iterator[Finding]:
    """Every Length of random bytes into frames."""
    counts, adu, chars = lengths(short), noise(256), noise(513)
    for scan, model, head, box in (
        (SEAL, framing.rtu_seal, adu, adu),
        (ENCODE, framing.ascii_encode, adu + chars, chars),
    ):
        yield from judged(benches, iter([_sealed(scan, model, head, box, counts)]))


def _sealed(scan: Scan, model: Callable[[bytes], Framed], head: bytes, box: bytes, counts: Sequence[int]) -> Trial:
    answers = []
    for count in counts:
        done = model(head[:count] if count <= 256 else bytes(count))
        answers.append(struct.pack("=HH", code(done.result), len(done.data)) + _filled(done.data, box))
    return Trial(scan, len(counts), array("H", counts).tobytes(), b"".join(answers), _length(counts), head)


def opening(benches: Sequence[Bench], short: bool) -> Iterator[Finding]:
    """Every length of bytes received: good frames where there are any, and the same with one byte changed."""
    counts = lengths(short)
    for damage in (False, True):
        rtu = [_rtu(count, damage) for count in counts]
        ascii_ = [_ascii(count, damage) for count in counts]
        yield from judged(benches, iter([_opened(OPEN, framing.rtu_open, rtu, "Adu")]))
        yield from judged(benches, iter([_opened(DECODE, framing.ascii_decode, ascii_, "Chars")]))


def _rtu(count: int, damage: bool) -> bytes:
    """A frame of some bytes; where there is none of this length, random bytes."""
    whole = framing.rtu_seal(noise(count - 2)) if count <= 256 and count >= 2 else Framed("LENGTH")
    data = whole.data or noise(256)[: min(count, 256)].ljust(count, b"\0")
    return _damaged(data, bytes(range(256))) if damage else data


def _ascii(count: int, damage: bool) -> bytes:
    """A frame of some characters; where there is none of this length, digits between colon, CR and LF."""
    whole = framing.ascii_encode(noise((count - 5) // 2)) if count % 2 and 5 <= count <= 513 else Framed("LENGTH")
    data = whole.data or (b":" + b"7" * max(count - 3, 0) + b"\r\n")[:count]
    return _damaged(data, b"0123456789ABCDEFabfgG:@/`\r\n\0\xff") if damage else data


def _damaged(data: bytes, others: bytes) -> bytes:
    """One byte of the first 513 is another."""
    chance = random.Random(len(data))
    if not data:
        return data
    at = chance.randrange(min(len(data), 513))
    return data[:at] + bytes([chance.choice(others)]) + data[at + 1 :]


def _opened(scan: Scan, model: Callable[[bytes], Framed], received: list[bytes], box: str) -> Trial:
    records, answers = [], []
    for data in received:
        done = model(data)
        records.append(struct.pack("=H", len(data)) + data[: ROOM[box]].ljust(ROOM[box], b"\xee"))
        answers.append(struct.pack("=HH", code(done.result), len(done.data)) + done.data.ljust(256, b"\0"))
    counts = [*map(len, received)]
    return Trial(
        scan, len(received), b"".join(records), b"".join(answers), _length(counts), noise(256) if scan.filled else b""
    )


def packs(benches: Sequence[Bench], short: bool) -> Iterator[Finding]:
    """Every CharCount of both arrays in both modes, both ways; more than the array holds counts as all of it."""
    counts = lengths(short)
    for box, bits in FORMS:
        yield from judged(benches, iter([_packed(box, bits, counts), _unpacked(box, bits, counts)]))


def _packed(box: str, bits: int, counts: Sequence[int]) -> Trial:
    data, behind = noise(ROOM[box]), noise(2 * ROOM["Registers"])
    made = {}
    for count in range(ROOM[box] + 1):
        registers = packing.pack(data[:count], bits)
        made[count] = struct.pack("=H", len(registers)) + _filled(array("H", registers).tobytes(), behind)
    wanted = b"".join(made[min(count, ROOM[box])] for count in counts)
    return Trial(pack(box, bits), len(counts), array("H", counts).tobytes(), wanted, _length(counts), data + behind)


def _unpacked(box: str, bits: int, counts: Sequence[int]) -> Trial:
    registers, behind = array("H", noise(2 * ROOM["Registers"])), noise(ROOM[box])
    made = {}
    for count in range(ROOM[box] + 1):
        data = packing.unpack(registers, count, bits)
        made[count] = struct.pack("=H", len(data)) + _filled(data, behind)
    wanted = b"".join(made[min(count, ROOM[box])] for count in counts)
    head = registers.tobytes() + behind
    return Trial(unpack(box, bits), len(counts), array("H", counts).tobytes(), wanted, _length(counts), head)
