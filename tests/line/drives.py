"""The drives of the virtual line: one table for the line in Python and the line in C."""

from dataclasses import astuple, dataclass, fields

from driveblocks.render.environment import ABI

ABI_WORD = 256 * ABI
"""What a block and a line of one version write into a slot."""


@dataclass(frozen=True)
class Kind:
    """How drives of a kind are asked: where they read, write and stop, and how they refuse."""

    read_function: int
    read_address: int
    write_function: int
    write_address: int
    stop_function: int
    stop_address: int
    stop_words: int
    stop_word: int
    exception_add: int
    error_function: int
    error_address: int


KINDS = (
    Kind(3, 0x2000, 6, 0x1001, 6, 0x1000, 1, 5, 0x80, 0, 0),
    Kind(3, 0x0020, 16, 0x0002, 16, 0x0001, 2, 0, 0x80, 0, 0),
    Kind(3, 0x3000, 6, 0x2001, 6, 0x2000, 1, 3, 0, 6, 0x5001),
    Kind(1, 0x0010, 5, 0x0001, 5, 0x0000, 1, 0, 0x80, 0, 0),
)
"""Stop by function 06, by two words of function 10H, or by a coil; refusals as function + 80H or as a write reply."""


def counted(request: bytes, number: int) -> bytes:
    """The reply to a read, whose registers hold a number; of coils, its lowest bits."""
    quantity = request[5]
    if request[1] in (1, 2):
        data = (number % (1 << quantity)).to_bytes((quantity + 7) // 8, "little")
    else:
        data = (number % 65536).to_bytes(2, "big") * quantity
    return request[:2] + bytes([len(data)]) + data


def check(*values: int) -> int:
    """Of a stop: Number, Address, FunctionCode, Quantity, Unit, Family and its word, as a polynomial by a prime."""
    total = 1
    for value in values:
        total = (total * 251 + value) % 65521
    return total


def header() -> str:
    """The same table in C."""
    names = "".join(f"int {field.name}; " for field in fields(Kind))
    rows = ",\n".join("  {" + ", ".join(map(str, astuple(kind))) + "}" for kind in KINDS)
    table = f"enum {{ ABI_WORD = {ABI_WORD} }};\nstatic const Kind KINDS[] = {{\n{rows}}};\n"
    return f"typedef struct {{ {names}}} Kind;\n#define KIND_COUNT {len(KINDS)}\n{table}"
