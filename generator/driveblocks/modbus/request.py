"""What was asked: the request that a reply is compared with."""

from dataclasses import dataclass

from driveblocks.modbus.layout import Layout

READS = frozenset({3, 4})
"""Functions that read registers."""
WRITES = frozenset({5, 6, 15, 16})
"""Functions that write registers or coils."""


@dataclass(frozen=True)
class Asked:
    """A request by its fields; those that its function lacks are neutral."""

    function: int
    unit: int
    address: int
    quantity: int
    value: int
    sub_function: int
    words: tuple[int, ...]
    ascii: bool


def asked_by(one: Layout, *, ascii_mode: bool = False) -> Asked:
    """The request that a layout is, or that its reply answers as far as the reply repeats it."""
    value = one.number("data word") if one.function == 8 else one.number("value")
    quantity = one.number("quantity")
    return Asked(
        function=one.function,
        unit=one.body[0],
        address=one.number("address") or 0,
        quantity=1 if quantity is None else quantity,
        value=value or 0,
        sub_function=one.number("sub-function") or 0,
        words=one.words,
        ascii=ascii_mode,
    )
