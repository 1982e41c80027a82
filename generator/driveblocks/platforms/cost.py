"""What a file costs in a PLC: bytes of data by the types that it declares, and its code as it was measured."""

from collections.abc import Iterable

from driveblocks.render.library import CHINESE, FRAMES, LINE2, LINE32, METER, PARAMETERS, PLANT
from structured_text.language.tree import Block, FunctionBlock, Program, VarKind
from structured_text.language.types import UNKNOWN, Type

CODE_KIB = {"": 111, LINE2: 15, LINE32: 15, PARAMETERS: 11, METER: 4, PLANT: 5, FRAMES: 12, CHINESE: 18}
"""By extra, KiB of code that it adds to what it needs. A test that needs matiec measures it."""
FAMILY_KIB = (20, 47)
"""The same of the smallest and the largest family, without its extras."""
MEASURED = "matiec 6bb2c33 and gcc 12.2 `-Os` for x86-64, 2026-11-29"
"""By what, and when."""


def data(block: FunctionBlock | Program) -> int:
    """Bytes of one instance and, once, of what its in-outs refer to: the sum of the widths, a BOOL counts 1."""
    return _kept(block.type or UNKNOWN) + sum(
        one.type.size for one in block.symbols.values() if one.kind is VarKind.IN_OUT
    )


def largest(blocks: Iterable[FunctionBlock]) -> tuple[str, int] | None:
    """The name of the block with most data, and its bytes; None without blocks."""
    return max(((one.name, data(one)) for one in blocks if one.type), key=lambda each: each[1], default=None)


def _kept(kind: Type) -> int:
    """Without in-outs, those of the blocks in it included: they refer to what is counted elsewhere."""
    if not isinstance(kind, Block) or kind.declaration is None:
        return kind.size
    return sum(_kept(one.type) for one in kind.declaration.symbols.values() if one.kind is not VarKind.IN_OUT)
