"""Types of ST as sorts of the solver, and the scalars that a variable is made of.

A variable is known by the path of each of its scalars, in upper case as the engines spell it: `SLOT.ASK[0].NUMBER`.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product

import z3

from structured_text.language.tree import Array, Block, Expression, Literal, Name, Struct, Unary, VarDecl, VarKind
from structured_text.language.types import Elementary, Kind, Type, plain

SINGLE = z3.Float32()
"""The sort of REAL."""


class UnsupportedError(Exception):
    """Something of ST that cannot be said to the solver."""


@dataclass(frozen=True)
class Leaf:
    """A scalar of a variable: its name below it, its type, its initial value (None: that of the type)."""

    name: str
    type: Elementary
    initial: Expression | None

    @property
    def path(self) -> str:
        return self.name.upper()


def leaves(each: Type, initial: Expression | None = None) -> Iterator[Leaf]:
    """The scalars of a type, in the order of declaration; an in-out of a block belongs to who hands it over."""
    each = plain(each)
    if isinstance(each, Elementary):
        yield Leaf("", each, initial)
    elif isinstance(each, Struct):
        for field in each.fields.values():
            yield from _below(f".{field.name}", field.type, field.initial)
    elif isinstance(each, Array):
        for indices in product(*(range(low, high + 1) for low, high in each.bounds)):
            yield from _below(f"[{','.join(map(str, indices))}]", each.element, each.start)
    elif isinstance(each, Block) and each.declaration is not None:
        for symbol in variables(each):
            yield from _below(f".{symbol.name}", symbol.type, symbol.start)
    else:
        raise UnsupportedError(f"a variable of type {each}")


def _below(name: str, each: Type, initial: Expression | None) -> Iterator[Leaf]:
    return (Leaf(name + leaf.name, leaf.type, leaf.initial) for leaf in leaves(each, initial))


def variables(block: Block) -> Iterator[VarDecl]:
    """The variables that an instance of a block keeps."""
    symbols = block.declaration.symbols if block.declaration else {}
    return (each for each in symbols.values() if not each.constant and each.kind is not VarKind.IN_OUT)


def sort(each: Type) -> z3.SortRef:
    """The sort of a scalar. UnsupportedError."""
    each = plain(each)
    if isinstance(each, Elementary):
        if each.kind is Kind.BOOL:
            return z3.BoolSort()
        if each.kind in (Kind.BITS, Kind.INTEGER):
            return z3.BitVecSort(each.width)
        if each.kind is Kind.REAL and each.width == 32:
            return SINGLE
    raise UnsupportedError(f"a value of type {each}")


def number(value: bool | int | float, each: Type) -> z3.ExprRef:
    """A value of Python as a term."""
    of = sort(each)
    if of == SINGLE:
        return z3.FPVal(float(value), SINGLE)
    return z3.BoolVal(bool(value)) if z3.is_bool(of) or of == z3.BoolSort() else z3.BitVecVal(int(value), of.size())


def initial(leaf: Leaf) -> z3.ExprRef:
    """The value that a scalar has at power-up. UnsupportedError."""
    return number(0 if leaf.initial is None else _constant(leaf.initial), leaf.type)


def _constant(value: Expression) -> bool | int | float:
    if isinstance(value, Literal) and isinstance(value.value, bool | int | float):
        return value.value
    if isinstance(value, Name) and isinstance(value.symbol, VarDecl) and value.symbol.start is not None:
        return _constant(value.symbol.start)
    if isinstance(value, Unary) and value.op == "-":
        return -_constant(value.operand)
    raise UnsupportedError("an initial value that is no literal")
