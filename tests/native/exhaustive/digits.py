"""Every byte and every number through the hexadecimal digits."""

from array import array
from collections.abc import Iterator, Sequence

from tests.native.exhaustive.bench import Bench, Finding, Trial, judged
from tests.native.exhaustive.scan import Call

TO_DIGIT, TO_NUMBER = Call("MB_HexDigit"), Call("MB_HexValue")
SCANS = (TO_DIGIT, TO_NUMBER)
DIGITS = b"0123456789ABCDEF"
"""MODBUS over Serial Line V1.02, 2.5.2."""

NO_DIGIT = 255


def digits(benches: Sequence[Bench], _short: bool) -> Iterator[Finding]:
    """All 65536 numbers, of which the remainder by 16 counts, and all 256 characters."""
    numbers = array("H", range(0x10000)).tobytes()
    wanted = bytes(DIGITS[number % 16] for number in range(0x10000))
    yield from judged(benches, iter([Trial(TO_DIGIT, 0x10000, numbers, wanted, lambda at: f"of {at}")]))
    known = [DIGITS.find(character) for character in range(256)]
    values = array("H", [NO_DIGIT if value < 0 else value for value in known]).tobytes()
    characters = array("H", range(256)).tobytes()
    yield from judged(benches, iter([Trial(TO_NUMBER, 256, characters, values, lambda at: f"of {at:02X}H")]))
