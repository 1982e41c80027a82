"""Every kind of expression and the function that compiles it."""

from structured_text.engines.embedded import operands, operators
from structured_text.engines.embedded.calls import call_term
from structured_text.engines.embedded.scope import Terms
from structured_text.language import tree

TERMS: Terms = {
    tree.Literal: operands.literal, tree.Name: operands.name, tree.Qualified: operands.enumerated,
    tree.Member: operands.member, tree.Index: operands.index, tree.Unary: operators.unary,
    tree.Binary: operators.binary, tree.Call: call_term,
}  # fmt: skip
