"""MB_Float against the IEEE numbers of the machine that runs the tests."""

from math import copysign, isfinite
from struct import pack, unpack

from tests.blocks.library import sources

from structured_text.engines.engine import Engine, Source

PROGRAM = """PROGRAM T_Float
VAR
  High : WORD;
  Low : WORD;
  Value : REAL;
END_VAR
  Value := MB_Float(High := High, Low := Low);
END_PROGRAM
"""
LOWS = (0x0000, 0x0001, 0x5555, 0xFFFF)
LEAST = 2.0**-126
"""Nothing but 0 is nearer to 0 in the format that is used everywhere."""


def texts() -> list[Source]:
    """The function, and a program that calls it."""
    return [*(each for each in sources() if each.path.endswith("/MB_Float.st")), Source("float.st", PROGRAM)]


def expected(high: int, low: int) -> float:
    """What the page promises for two words."""
    value = float(unpack(">f", pack(">HH", high, low))[0])
    if high & 0x7F80 == 0x7F80 or not isfinite(value):
        return copysign(unpack(">f", pack(">f", 3.4e38))[0], -1.0 if high & 0x8000 else 1.0)
    return value if abs(value) >= LEAST else 0.0


def test_every_exponent_and_sign_gives_the_number_of_the_standard(engine: Engine) -> None:
    program = engine.build(texts()).instance("T_Float")
    wrong = []
    for high in (
        sign + exponent * 128 + top for sign in (0, 0x8000) for exponent in range(256) for top in (0, 85, 127)
    ):
        for low in LOWS:
            program["High"], program["Low"] = high, low
            program.scan()
            if program["Value"] != expected(high, low):
                wrong.append((hex(high), hex(low), program["Value"], expected(high, low)))
    assert wrong == []
