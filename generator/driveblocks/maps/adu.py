"""Example frames taken apart, by MODBUS over Serial Line V1.02 and the MODBUS Application Protocol V1.1b3.

Only for judging a map's vectors; blocks and their tests have their own.
"""

from dataclasses import dataclass, replace

from driveblocks.modbus.layout import Manners

_MOST_SHOWN = 16
_WIDTHS = {"address": "04X", "sub_function": "04X", "data": "04X", "function": "02X", "error": "02X"}


class FrameError(Exception):
    """The bytes are no frame; the text says why, and `right` what a frame looks like."""

    def __init__(self, wrong: str, right: str) -> None:
        """Keep both halves of the message."""
        self.right = right
        super().__init__(wrong)


@dataclass(frozen=True)
class Fields:
    """What a frame carries; None or () where its function has no such field."""

    unit: int
    function: int
    address: int | None = None
    words: int | None = None
    byte_count: int | None = None
    values: tuple[int, ...] = ()
    sub_function: int | None = None
    data: int | None = None
    error: int | None = None


def octets(data: bytes) -> str:
    """Bytes as a map writes them: 25 C0."""
    return data.hex(" ").upper()


def shown(key: str, value: object) -> str:
    """A field of a frame as messages print it: addresses and words as 0026H, codes as 03H, counts in decimal."""
    if isinstance(value, tuple):
        words = " ".join(f"{word:04X}H" for word in value[:_MOST_SHOWN]) or "nothing"
        return words if len(value) <= _MOST_SHOWN else f"{words} ... ({len(value)} words)"
    if not isinstance(value, int):
        return "nothing"
    return f"{value:{_WIDTHS[key]}}H" if key in _WIDTHS else str(value)


def number(word: int, signed: bool) -> int:
    """A word of 16 bits as the number that it is."""
    return word - 0x10000 if signed and word & 0x8000 else word


def refused(request: Fields, manners: Manners) -> Fields:
    """Unit and function of an exception reply to a request."""
    return Fields(request.unit, request.function + manners.added)


def split(mode: str, frame: bytes) -> tuple[bytes, bytes]:
    """Return (unit address, function and data; checksum). Raises FrameError."""
    return _split_ascii(frame) if mode == "ascii" else _split_rtu(frame)


def _split_rtu(frame: bytes) -> tuple[bytes, bytes]:
    # 3AH is also unit address 58, but no function code is the character of a digit
    if frame[:1] == b":" and frame[1:2] in b"0123456789ABCDEF":
        raise FrameError("this is an ASCII frame", "write `mode: ascii`, or the bytes in hexadecimal")
    if len(frame) < 5:
        raise FrameError(
            f"an RTU frame of {len(frame)} bytes", "the shortest has 5: address, function, data, two of CRC"
        )
    return frame[:-2], frame[-2:]


def _split_ascii(frame: bytes) -> tuple[bytes, bytes]:
    if frame[:1] != b":" or frame[-2:] != b"\r\n":
        raise FrameError("an ASCII frame without `:` before or CR LF after", "write it as :010320000001DB CR LF")
    digits = frame[1:-2]
    if len(digits) % 2:
        raise FrameError(
            f"an ASCII frame with {len(digits)} digits", "every byte is two digits, so their number is even"
        )
    body = bytes.fromhex(digits.decode("ascii"))
    if len(body) < 4:
        raise FrameError(f"an ASCII frame of {len(body)} bytes", "the shortest has 4: address, function, data, LRC")
    return body[:-1], body[-1:]


def fields(body: bytes, direction: str, manners: Manners) -> Fields:
    """Take a body (without checksum) apart. Raises FrameError when the length does not fit the function."""
    base = Fields(body[0], body[1])
    data = body[2:]
    if direction == "reply" and (base.function & 0x80 or base.function - manners.added in _FUNCTIONS):
        _need(data, 1, "an exception reply")
        return replace(base, error=data[0])
    if direction == "reply" and base.function == manners.function and _word(data, 0) == manners.address:
        _need(data, 4, "an error reply")
        return replace(base, address=_word(data, 0), error=_word(data, 2))
    reader = _READERS.get((base.function, direction))
    if reader is None:
        raise FrameError(
            f"function {base.function:02X}H is not one that a map's frame may have", "03H, 04H, 06H, 08H or 10H"
        )
    return reader(base, data)


def _word(data: bytes, at: int) -> int:
    return int.from_bytes(data[at : at + 2], "big")


def _words(data: bytes) -> tuple[int, ...]:
    return tuple(_word(data, at) for at in range(0, len(data), 2))


def _need(data: bytes, length: int, what: str) -> None:
    if len(data) != length:
        raise FrameError(f"{what} with {len(data)} data bytes", f"it has {length}")


def _read_request(base: Fields, data: bytes) -> Fields:
    _need(data, 4, "a read request")
    return replace(base, address=_word(data, 0), words=_word(data, 2))


def _read_reply(base: Fields, data: bytes) -> Fields:
    count = data[0]
    _need(data, 1 + count, f"a read reply with byte count {count}")
    if count % 2:
        raise FrameError(f"a read reply with the odd byte count {count}", "a register is two bytes")
    return replace(base, byte_count=count, words=count // 2, values=_words(data[1:]))


def _write_one(base: Fields, data: bytes) -> Fields:
    _need(data, 4, "a write of one register")
    return replace(base, address=_word(data, 0), values=(_word(data, 2),))


def _write_request(base: Fields, data: bytes) -> Fields:
    if len(data) < 5:
        raise FrameError(
            f"a write request with {len(data)} data bytes", "it has address, quantity, byte count and words"
        )
    words, count = _word(data, 2), data[4]
    _need(data, 5 + count, f"a write request with byte count {count}")
    if count != 2 * words:
        raise FrameError(f"byte count {count} for {words} words", f"it is {2 * words}")
    return replace(base, address=_word(data, 0), words=words, byte_count=count, values=_words(data[5:]))


def _write_reply(base: Fields, data: bytes) -> Fields:
    _need(data, 4, "a reply to a write")
    return replace(base, address=_word(data, 0), words=_word(data, 2))


def _diagnostics(base: Fields, data: bytes) -> Fields:
    _need(data, 4, "a diagnostics frame")
    return replace(base, sub_function=_word(data, 0), data=_word(data, 2))


_READERS = {
    (0x03, "request"): _read_request,
    (0x03, "reply"): _read_reply,
    (0x04, "request"): _read_request,
    (0x04, "reply"): _read_reply,
    (0x06, "request"): _write_one,
    (0x06, "reply"): _write_one,
    (0x08, "request"): _diagnostics,
    (0x08, "reply"): _diagnostics,
    (0x10, "request"): _write_request,
    (0x10, "reply"): _write_reply,
}
_FUNCTIONS = frozenset(function for function, _ in _READERS)
