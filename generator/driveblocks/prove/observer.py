"""The conditions of the rules as ST: a block that sees the variables of another one, before and after a call.

A condition names what the block itself names. `Was.X` is X as the call found it (of an input: as the last call had
it). Constants of all blocks may be used where all blocks that have one of that name mean the same number.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence

from structured_text.language.tree import Block, Checked, Function, Literal, Pou, VarDecl, VarKind
from structured_text.language.types import Type

NAME = "Rules_of_"
"""How the observer of a block is called."""


def name(pou: Pou) -> str:
    return NAME + pou.name


def text(pou: Pou, checked: Checked, conditions: Mapping[str, str]) -> str:
    """The observer as ST: its memory types, then one assignment for each condition."""
    declared = dict.fromkeys(_memories(pou))
    lines = [line for block in declared for line in _memory(block, pou)]
    lines += [*_memory_of(pou, pou.name, pou), f"FUNCTION_BLOCK {name(pou)}", "VAR"]
    lines += [f"  {_name(each, pou)} : {_type(each.type, pou)};" for each in kept(pou)]
    lines += [f"  Was : {pou.name}_in_{pou.name};", *(f"  {each} : BOOL;" for each in conditions)]
    lines += ["END_VAR", "VAR CONSTANT", *_constants(pou, checked, conditions), "END_VAR"]
    lines += [f"  {_assigned(each, condition)}" for each, condition in conditions.items()]
    return "\n".join([*lines, "END_FUNCTION_BLOCK", ""])


def _assigned(name: str, condition: str) -> str:
    """What a rule claims is checked only where it applies: there a divisor is known not to be 0."""
    if "Then" not in name:
        return f"{name} := {condition};"
    return f"{name} := FALSE; IF {name.replace('Then', 'When')} THEN {name} := {condition}; END_IF;"


def kept(pou: Pou) -> Iterator[VarDecl]:
    """All variables of a block, its in-outs too; of a function also its result."""
    return (each for each in pou.symbols.values() if not each.constant)


def _name(each: VarDecl, pou: Pou) -> str:
    """A function's result is called Result here."""
    return "Result" if isinstance(pou, Function) and each.kind is VarKind.RESULT else each.name


def _memories(pou: Pou) -> Iterator[Block]:
    """The blocks inside a block, innermost first."""
    for each in kept(pou):
        if isinstance(each.type, Block) and each.type.declaration is not None:
            yield from _memories(each.type.declaration)
            yield each.type


def _memory(block: Block, outer: Pou) -> list[str]:
    assert block.declaration is not None  # noqa: S101 - standard blocks have no memory here
    return _memory_of(block.declaration, block.name, outer, in_outs=False)


def _memory_of(pou: Pou, of: str, outer: Pou, *, in_outs: bool = True) -> list[str]:
    """The memory of a block as a structure."""
    fields = [each for each in kept(pou) if in_outs or each.kind is not VarKind.IN_OUT]
    made = [f"    {_name(each, pou)} : {_type(each.type, outer)};" for each in fields]
    return ["TYPE", f"  {of}_in_{outer.name} : STRUCT", *made, "  END_STRUCT;", "END_TYPE"]


def _type(each: Type, outer: Pou) -> str:
    return f"{each.name}_in_{outer.name}" if isinstance(each, Block) else str(each)


def _constants(pou: Pou, checked: Checked, conditions: Iterable[str]) -> Iterator[str]:
    """The block's own constants, and those of others that all mean the same number, in the narrowest of their types."""
    found: dict[str, list[VarDecl]] = {}
    for other in (*checked.functions.values(), *checked.blocks.values()):
        for each in _numbers(other):
            found.setdefault(each.name.upper(), []).append(each)
    own = {each.name.upper(): [each] for each in _numbers(pou)}
    taken = {each.name.upper() for each in kept(pou)} | {each.upper() for each in conditions}
    for name, those in (found | own).items():
        if name not in taken and len({_value(each) for each in those}) == 1:
            least = min(those, key=lambda each: each.type.size)
            yield f"  {least.name} : {least.type} := {_literal(least)};"


def _numbers(pou: Pou) -> Sequence[VarDecl]:
    return [each for each in pou.symbols.values() if each.constant and isinstance(each.initial, Literal)]


def _value(each: VarDecl) -> object:
    return each.initial.value if isinstance(each.initial, Literal) else None


def _literal(each: VarDecl) -> str:
    return each.initial.text if isinstance(each.initial, Literal) else ""
