"""Inputs that must hang together: reply frames of a Modbus slave, and a serial line with ASCII frames.

The sums are worked out here in Python, so that most frames are good and the blocks get past their first test.
"""

from collections.abc import Callable, Iterator

from tests.structured_text.engines.compare.draws import Draws

from structured_text.engines.engine import Value

Inputs = dict[str, Value]


def crc16(data: bytes) -> bytes:
    """The CRC-16 of a Modbus RTU frame (serial line standard, section 6.2.2), low byte first."""
    register = 0xFFFF
    for byte in data:
        register ^= byte
        for _ in range(8):
            register = (register >> 1) ^ (0xA001 if register & 1 else 0)
    return register.to_bytes(2, "little")


def damaged(draws: Draws, frame: bytes) -> bytes:
    """A frame with one byte changed, lost or doubled."""
    at = draws.whole(0, len(frame) - 1)
    return draws.one_of(
        [
            frame[:at] + bytes([frame[at] ^ (1 << draws.whole(0, 7))]) + frame[at + 1 :],
            frame[:at] + frame[at + 1 :],
            frame[:at] + frame[at : at + 1] + frame[at:],
        ]
    )


def reply(draws: Draws) -> Iterator[Inputs]:
    """A request and what came back: mostly the right reply; else a wrong one, a damaged one, an exception, noise."""
    while True:
        address, code = draws.whole(1, 247), draws.one_of([3, 3, 6, 16])
        register, quantity, written = draws.whole(0, 65535), draws.whole(1, 16), draws.whole(0, 65535)
        echo = register.to_bytes(2, "big") + (written if code == 6 else quantity).to_bytes(2, "big")
        frame = _summed(draws, _reply_body(draws, bytes([address, code]), echo, quantity))
        asked_address = address if draws.chance(0.9) else draws.whole(0, 255)
        asked_code = code if draws.chance(0.9) else draws.one_of([3, 6, 16, 1])
        yield {
            "Address": asked_address,
            "Code": asked_code,
            "Register": register if draws.chance(0.95) else draws.whole(0, 65535),
            "Quantity": quantity if draws.chance(0.9) else draws.one_of([0, 1, 17, 125, 32767]),
            "Written": written if draws.chance(0.9) else draws.whole(0, 65535),
            "Length": len(frame) if draws.chance(0.95) else draws.one_of([0, 4, 5, 8, 256, 257, 65535]),
            "Frame": frame,
        }


def _reply_body(draws: Draws, head: bytes, echo: bytes, quantity: int) -> bytes:
    if draws.chance(0.1):
        return bytes([head[0], head[1] | 0x80, draws.whole(1, 4)])
    if head[1] == 3:
        return head + bytes([2 * quantity]) + bytes(draws.whole(0, 255) for _ in range(2 * quantity))
    return head + echo


def _summed(draws: Draws, body: bytes) -> bytes:
    frame = body + crc16(body)
    if draws.chance(0.15):
        frame = damaged(draws, frame)
    if draws.chance(0.1):
        changed = damaged(draws, body)
        frame = changed + crc16(changed)
    return frame


def ascii_line(draws: Draws) -> Iterator[Inputs]:
    """What a serial port hands over per scan: ASCII frames in pieces of at most 16 characters, some damaged."""
    waiting = b""
    while True:
        if len(waiting) < 16 and draws.chance(0.7):
            waiting += _ascii_frame(draws)
        take = min(draws.whole(0, 16), len(waiting))
        piece, waiting = waiting[:take], waiting[take:]
        inputs: Inputs = {"Received": take if draws.chance(0.98) else 65535, "Chunk": piece}
        if draws.chance(0.01):
            inputs["State"] = 9
        yield inputs


def _ascii_frame(draws: Draws) -> bytes:
    data = bytes(draws.whole(0, 255) for _ in range(draws.one_of([0, 1, 2, 3, 5, 8, 30, 31, 32, 33])))
    lrc = bytes([-sum(data) % 256])
    frame = b":" + (data + lrc).hex().upper().encode() + b"\r\n"
    return damaged(draws, frame) if draws.chance(0.25) else frame


SCENARIOS: dict[str, Callable[[Draws], Iterator[Inputs]]] = {"reply": reply, "ascii_line": ascii_line}
