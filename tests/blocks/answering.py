"""Replies, right and wrong in every way, to the requests of a drive."""

import random
from dataclasses import replace

from driveblocks.reference.reply import Dialect
from driveblocks.reference.request import Asked


def good(dialect: Dialect, asked: Asked, chance: random.Random) -> bytes:
    """The body of a reply that is believed."""
    head = bytes([asked.unit, asked.function])
    if asked.function in {3, 4}:
        data = chance.randbytes(2 * asked.quantity)
        wide = dialect.two_byte_count and chance.random() < 0.3
        return head + len(data).to_bytes(2 if wide else 1, "big") + data
    pair = {
        6: (asked.address, asked.value),
        8: (asked.sub_function, asked.value),
        16: (asked.address, asked.quantity),
    }[asked.function]
    return head + b"".join(word.to_bytes(2, "big") for word in pair)


def refusal(dialect: Dialect, asked: Asked, reason: int) -> bytes:
    """The body of a refusal in the drive's form."""
    if dialect.function is not None and dialect.address is not None:
        return bytes([asked.unit, dialect.function]) + dialect.address.to_bytes(2, "big") + reason.to_bytes(2, "big")
    return bytes([asked.unit, (asked.function + (dialect.add or 0)) & 0xFF, reason & 0xFF])


def spoilt(body: bytes, other: bytes, chance: random.Random) -> bytes:
    """A body with a bit, a byte or a length changed, or the tail of another one."""
    at = chance.randrange(len(body))
    return chance.choice(
        (
            body[:at] + bytes([body[at] ^ 1 << chance.randrange(8)]) + body[at + 1 :],
            body[:at] + chance.randbytes(1) + body[at + 1 :],
            body[:at],
            body + chance.randbytes(chance.randrange(1, 9)),
            body[:at] + other[at:],
            body[: 2 + chance.randrange(2)] + chance.randbytes(chance.randrange(6)),
            body[:at] + body[at + 1 :],
        )
    )


def questions(unit: int, functions: list[int], most: int, addresses: list[int], chance: random.Random) -> Asked:
    """A random request that a drive takes."""
    base = Asked(chance.choice(functions), unit, chance.choice(addresses), chance.randrange(1, most + 1))
    return replace(base, value=chance.randrange(0x10000), sub_function=chance.choice([0, 0, 1]))
