"""Every kind of expression and the function that finds its type (clause 3.3.1)."""

from structured_text.language import tree
from structured_text.language.semantics import operands, operators
from structured_text.language.semantics.calls import call_type
from structured_text.language.semantics.scope import Inference

INFERENCE: Inference = {
    tree.Literal: operands.literal, tree.Name: operands.name, tree.Qualified: operands.qualified,
    tree.Member: operands.member, tree.Index: operands.index, tree.BitAccess: operands.bit_access,
    tree.Dereference: operands.dereference, tree.Direct: operands.direct, tree.Unary: operators.unary,
    tree.Binary: operators.binary, tree.Call: call_type, tree.Repeat: operands.misplaced,
    tree.ArrayInitial: operands.misplaced, tree.StructInitial: operands.misplaced,
}  # fmt: skip
