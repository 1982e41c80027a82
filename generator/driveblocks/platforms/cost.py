"""What a file costs in a PLC: bytes of data by the types that it declares, and its code as it was measured."""

from collections.abc import Iterable

from driveblocks.render.library import CHINESE, FRAMES, LINE2, LINE32, METER, PARAMETERS, PLANT
from structured_text.language.tree import Block, FunctionBlock, VarKind
from structured_text.language.types import UNKNOWN, Type

CODE_KIB = {"": 111, LINE2: 15, LINE32: 15, PARAMETERS: 11, METER: 4, PLANT: 5, FRAMES: 12, CHINESE: 18}
"""By extra, KiB of code that it adds to what it needs. A test that needs matiec measures it."""
FAMILY_KIB = (20, 47)
"""The same of the smallest and the largest family, without its extras."""
MEASURED = "matiec 6bb2c33 and gcc 12.2 `-Os` for x86-64, 2026-11-29"
"""By what, and when."""

CPU_KB = {"S7-1211C": 50, "S7-1212C": 75, "S7-1214C": 100, "S7-1215C": 125, "S7-1217C": 150}
"""Work memory of controllers in which all that is loaded counts, called or not; their firmware from 4.0 on."""


def data(block: FunctionBlock) -> int:
    """Bytes of one instance and, once, of what its in-outs refer to: the sum of the widths, a BOOL counts 1."""
    return kept(block.type or UNKNOWN) + sum(
        one.type.size for one in block.symbols.values() if one.kind is VarKind.IN_OUT
    )


def largest(blocks: Iterable[FunctionBlock]) -> tuple[str, int] | None:
    """The name of the block with most data, and its bytes; None without blocks."""
    return max(((one.name, data(one)) for one in blocks if one.type), key=lambda each: each[1], default=None)


def kept(kind: Type) -> int:
    """Bytes of an instance without in-outs, its own and its blocks': they refer to what is counted elsewhere."""
    if not isinstance(kind, Block) or kind.declaration is None:
        return kind.size
    return sum(kept(one.type) for one in kind.declaration.symbols.values() if one.kind is not VarKind.IN_OUT)
