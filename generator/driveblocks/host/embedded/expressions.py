"""Every kind of expression and the function that compiles it."""

from __future__ import annotations

from driveblocks.host.embedded import operands, operators
from driveblocks.host.embedded.calls import call_term
from driveblocks.host.embedded.scope import Terms
from driveblocks.st import tree

TERMS: Terms = {
    tree.Literal: operands.literal,
    tree.Name: operands.name,
    tree.Qualified: operands.enumerated,
    tree.Member: operands.member,
    tree.Index: operands.index,
    tree.Unary: operators.unary,
    tree.Binary: operators.binary,
    tree.Call: call_term,
}
