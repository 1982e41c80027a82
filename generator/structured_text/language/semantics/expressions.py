"""Every kind of expression and the function that finds its type (clause 3.3.1)."""

from structured_text.language.semantics import operands, operators
from structured_text.language.semantics.calls import call_type
from structured_text.language.semantics.scope import Inference
from structured_text.language.tree import (
    ArrayInitial,
    Binary,
    BitAccess,
    Call,
    Dereference,
    Direct,
    Index,
    Literal,
    Member,
    Name,
    Qualified,
    Repeat,
    StructInitial,
    Unary,
)

INFERENCE: Inference = {
    Literal: operands.literal, Name: operands.name, Qualified: operands.qualified, Member: operands.member,
    Index: operands.index, BitAccess: operands.bit_access, Dereference: operands.dereference, Direct: operands.direct,
    Unary: operators.unary, Binary: operators.binary, Call: call_type, Repeat: operands.misplaced,
    ArrayInitial: operands.misplaced, StructInitial: operands.misplaced,
}  # fmt: skip
