"""What other code sees of Structured Text: blocks and functions with their pins, types with their fields."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from driveblocks.diff.change import Change, Kind
from structured_text.language.parser import parse
from structured_text.language.tree import Function, FunctionBlock, Pou, StructSpec, TypeDecl, VarDecl, VarKind

WIRED = {VarKind.INPUT: "input", VarKind.OUTPUT: "output", VarKind.IN_OUT: "in-out"}


@dataclass(frozen=True)
class Pin:
    kind: str
    type: str
    default: str


@dataclass(frozen=True)
class Face:
    """A block, a function or a type; `type` is what a function returns, or what a type without fields is made of."""

    kind: str
    name: str
    type: str
    pins: dict[str, tuple[str, Pin]]
    """By the name in upper case: the name as it is written, and the pin."""


def faces(texts: Iterable[tuple[str, str]]) -> dict[str, Face]:
    """What these files (path, text) declare, by the name in upper case."""
    found = {}
    for path, text in texts:
        for each in parse(text, path).elements:
            if isinstance(each, (FunctionBlock, Function)):
                found[each.name.upper()] = _of_pou(each, text)
            elif isinstance(each, TypeDecl):
                found[each.name.upper()] = _of_type(each, text)
    return found


def _of_pou(pou: Pou, text: str) -> Face:
    pins = {
        one.name.upper(): (one.name, _pin(WIRED[group.kind], one, text))
        for group in pou.blocks
        if group.kind in WIRED
        for one in group.variables
    }
    returns = pou.returns if isinstance(pou, Function) else None
    type_ = text[returns.at :].split("VAR", 1)[0].strip() if returns else ""
    return Face("function" if isinstance(pou, Function) else "block", pou.name, type_, pins)


def _of_type(one: TypeDecl, text: str) -> Face:
    if not isinstance(one.spec, StructSpec):
        return Face("type", one.name, " ".join(text[one.spec.at : one.end].split()).removesuffix(";"), {})
    return Face(
        "type", one.name, "", {each.name.upper(): (each.name, _pin("field", each, text)) for each in one.spec.fields}
    )


def _pin(kind: str, one: VarDecl, text: str) -> Pin:
    type_, _, default = text[one.spec.at : one.end].rstrip("; \n").partition(":=")
    return Pin(kind, " ".join(type_.split()), " ".join(default.split()))


def compared(old: dict[str, Face], new: dict[str, Face]) -> Iterator[Change]:
    """What differs, in the order of the old names, and then what is new."""
    for name, before in old.items():
        after = new.get(name)
        where = f"{before.kind} {before.name}"
        if after is None:
            yield Change(Kind.BREAKS, where, "is gone")
        elif (before.kind, before.type) != (after.kind, after.type):
            yield Change(Kind.BREAKS, where, f"{_said(before)}, now {_said(after)}")
        else:
            yield from _pins(where, before.pins, after.pins)
    yield from (
        Change(Kind.NEW, f"{each.kind} {each.name}", _said(each)) for name, each in new.items() if name not in old
    )


def _said(face: Face) -> str:
    pins = f"{len(face.pins)} {'fields' if face.kind == 'type' else 'pins'}"
    return f"a {face.kind} of {face.type}" if face.type else f"a {face.kind} with {pins}"


def _pins(where: str, old: dict[str, tuple[str, Pin]], new: dict[str, tuple[str, Pin]]) -> Iterator[Change]:
    for name, (written, before) in old.items():
        which = f"{where}, {before.kind} {written}"
        if name not in new:
            yield Change(Kind.BREAKS, which, "is gone")
            continue
        after = new[name][1]
        if (before.kind, before.type) != (after.kind, after.type):
            yield Change(Kind.BREAKS, which, f"{before.type}, now {after.kind} {after.type}")
        elif before.default != after.default:
            yield Change(Kind.ACTS, which, f"default {before.default or 'none'}, now {after.default or 'none'}")
    for name, (written, pin) in new.items():
        if name not in old:
            # an in-out without a variable does not compile; any other pin may stay open
            kind = Kind.BREAKS if pin.kind == "in-out" else Kind.NEW
            yield Change(kind, f"{where}, {pin.kind} {written}", pin.type)
