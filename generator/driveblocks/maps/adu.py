"""Example frames taken apart, by MODBUS over Serial Line V1.02 and the MODBUS Application Protocol V1.1b3.

Only for judging a map's vectors; blocks and their tests have their own.
"""

from dataclasses import dataclass

from driveblocks.modbus.layout import DIRECTIONS, Dialect, Direction, Layout, take

_MOST_SHOWN = 16
_WIDTHS = {"address": "04X", "sub_function": "04X", "data": "04X", "function": "02X", "error": "02X"}


class FrameError(Exception):
    """The bytes are no frame; the text says why, and `right` what a frame looks like."""

    def __init__(self, wrong: str, right: str) -> None:
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


def refused(request: Fields, dialect: Dialect) -> Fields:
    """Unit and function of an exception reply to a request."""
    return Fields(request.unit, request.function + dialect.added)


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


def fields(body: bytes, direction: Direction, dialect: Dialect) -> Fields:
    """Take a body (without checksum) apart. Raises FrameError when the length does not fit the function."""
    one = take(body, direction, dialect)
    if direction == "reply" and not one.refusal and body[1] & 0x80:
        one = take(body, direction, Dialect())
    if not one.refusal and (body[1], direction) not in _NAMES:
        raise FrameError(f"function {body[1]:02X}H is not one that a map's frame may have", "03H, 04H, 06H, 08H or 10H")
    count = 0 if one.two_byte_count else one.number("byte count")
    quantity = one.number("quantity")
    _judge(one, count)
    return Fields(
        unit=body[0],
        function=body[1],
        address=one.number("address"),
        words=count // 2 if quantity is None and count is not None else quantity,
        byte_count=count,
        values=one.words,
        sub_function=one.number("sub-function"),
        data=one.number("data word"),
        error=one.number("reason"),
    )


def _judge(one: Layout, count: int | None) -> None:
    """Compare a body's length, byte count and quantity. Raises FrameError."""
    data, due = len(one.body) - 2, one.size - 2
    if one.refusal:
        name = "an exception reply" if one.part("address") is None else "an error reply"
    else:
        name = _NAMES[one.body[1], one.direction]
    if (one.body[1], one.direction) == (16, "request") and data < 5:
        raise FrameError(f"{name} with {data} data bytes", "it has address, quantity, byte count and words")
    if count is not None:
        name = f"{name} with byte count {count}"
        due = (5 if one.direction == "request" else 1) + count
    if data != due:
        raise FrameError(f"{name} with {data} data bytes", f"it has {due}")
    if one.direction == "reply" and count is not None and count % 2:
        raise FrameError(f"a read reply with the odd byte count {count}", "a register is two bytes")
    quantity = one.number("quantity")
    if None not in (count, quantity) and count != 2 * (quantity or 0):
        raise FrameError(f"byte count {count} for {quantity} words", f"it is {2 * (quantity or 0)}")


_NAMES: dict[tuple[int, Direction], str] = {
    **{(function, "request"): "a read request" for function in (3, 4)},
    **{(function, "reply"): "a read reply" for function in (3, 4)},
    **{(6, direction): "a write of one register" for direction in DIRECTIONS},
    **{(8, direction): "a diagnostics frame" for direction in DIRECTIONS},
    (16, "request"): "a write request",
    (16, "reply"): "a reply to a write",
}
