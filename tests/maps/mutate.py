"""Random changes of a map's text, one fact at a time."""

import random
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from decimal import Decimal
from functools import cached_property
from typing import Any

from driveblocks.maps import form, nodes
from driveblocks.maps.form import Form
from driveblocks.maps.model import Drive
from driveblocks.maps.nodes import Entries, Items, Node, Scalar
from driveblocks.maps.problem import Report
from driveblocks.maps.shape import EntryOf, ListOf, OneOf, Shape, keys_of

HEX = "0123456789ABCDEF"
Path = tuple[str | int, ...]
"""Keys and indices from the root of the document to a value."""


@dataclass(frozen=True)
class Leaf:
    """One value of a map: where it stands, as what, and what the model takes there."""

    path: Path
    scalar: Scalar
    shape: Form | OneOf

    @property
    def kind(self) -> str:
        """What it is, whichever of its list."""
        return "".join("[]" if isinstance(part, int) else f".{part}" for part in self.path).lstrip(".")


@dataclass(frozen=True)
class Change:
    """A mutated text, and in words what was done to it."""

    data: bytes
    said: str
    kind: str
    path: Path | None = None
    """The fact that was changed; None where bytes or lines were."""
    new: str = ""


class Text:
    """The text of a good map with its values, ready to be changed."""

    def __init__(self, name: str, text: str) -> None:
        """Read the values of a map; it must be good YAML."""
        self.name = name
        self.text = text
        self.report = Report(name)
        root = nodes.parse(text, self.report)
        assert root is not None
        assert not self.report.problems
        self.root: Node = root

    @cached_property
    def leaves(self) -> list[Leaf]:
        """Every value that holds a fact and not prose, and that is in one piece in the text."""
        found = _leaves(self.root, EntryOf(Drive), ())
        return [leaf for leaf in found if _is_fact(leaf) and self._stands(leaf.scalar)]

    @cached_property
    def by_kind(self) -> dict[str, list[Leaf]]:
        """The same by kind."""
        kinds: dict[str, list[Leaf]] = {}
        for leaf in self.leaves:
            kinds.setdefault(leaf.kind, []).append(leaf)
        return kinds

    @cached_property
    def starts(self) -> list[int]:
        """Where each line starts in the text."""
        starts = [0]
        for line in self.text.split("\n"):
            starts.append(starts[-1] + len(line) + 1)
        return starts

    def offset(self, scalar: Scalar) -> int:
        """Where the characters of a value start in the text, after its quote."""
        return self.starts[scalar.at[0] - 1] + scalar.at[1] - 1 + (not scalar.plain)

    def _stands(self, scalar: Scalar) -> bool:
        return bool(scalar.text) and self.text.startswith(scalar.text, self.offset(scalar))


def _leaves(node: Node, shape: Shape, path: Path) -> Iterator[Leaf]:
    if isinstance(node, Entries) and isinstance(shape, EntryOf):
        keys = keys_of(shape.cls)
        for name, (_, value) in node.entries.items():
            yield from _leaves(value, keys[name].shape, (*path, name))
    elif isinstance(node, Items) and isinstance(shape, ListOf):
        for index, item in enumerate(node.items):
            yield from _leaves(item, shape.item, (*path, index))
    elif isinstance(node, Scalar) and isinstance(shape, (Form, OneOf)):
        yield Leaf(path, node, shape)


def _is_fact(leaf: Leaf) -> bool:
    if leaf.shape is form.TEXT:
        return leaf.path[-1] == "id" or (leaf.path[-1] == "default" and leaf.scalar.text.isdecimal())
    if leaf.shape is form.WORD:
        return leaf.path[-1] in ("answers", "proof")
    return isinstance(leaf.shape, OneOf) or leaf.shape.name in _ALTER


def plain(node: Node) -> Any:
    """A node tree as dict, list and str."""
    if isinstance(node, Entries):
        return {name: plain(value) for name, (_, value) in node.entries.items()}
    return [plain(item) for item in node.items] if isinstance(node, Items) else node.text


def change_a_fact(text: Text, rng: random.Random) -> Change:
    """Change one fact; kinds that a map has often are drawn more often, but not as often as they stand there."""
    kinds = list(text.by_kind)
    weights = [len(text.by_kind[kind]) ** 0.5 for kind in kinds]
    while True:
        leaf = rng.choice(text.by_kind[rng.choices(kinds, weights)[0]])
        new = altered(leaf, rng, text)
        if new is not None:
            return replaced(text, leaf, new)


def replaced(text: Text, leaf: Leaf, new: str) -> Change:
    """The text with one value replaced."""
    old, start = leaf.scalar.text, text.offset(leaf.scalar)
    data = text.text[:start] + new + text.text[start + len(old) :]
    where = f"{text.name}:{leaf.scalar.at[0]}:{leaf.scalar.at[1]}"
    return Change(data.encode(), f"{where}: {leaf.kind}: {old} -> {new}", leaf.kind, leaf.path, new)


def altered(leaf: Leaf, rng: random.Random, text: Text) -> str | None:
    """Another value of the same form that means something else, or None where the draw gave none."""
    old, shape = leaf.scalar.text, leaf.shape
    if isinstance(shape, OneOf):
        return rng.choice([word for word in shape.words if word != old] or [None])
    if shape is form.WORD:
        return rng.choice([frame for frame in _frame_ids(text) if frame != old] or [None])
    if shape is form.TEXT:
        return str(int(old) + rng.choice((1, -1, 10))) if old.isdecimal() else old[:-1] + rng.choice("QXYZ")
    new = _ALTER[shape.name](old, rng)
    return None if shape.pattern.fullmatch(new) is None or meaning(leaf, new) == meaning(leaf, old) else new


def meaning(leaf: Leaf, text: str) -> object:
    """What a text means in a place: 0000H and 00H are one number."""
    fits = isinstance(leaf.shape, Form) and leaf.shape.pattern.fullmatch(text)
    return leaf.shape.parse(text) if isinstance(leaf.shape, Form) and fits else text


def _frame_ids(text: Text) -> list[str]:
    return [frame["id"] for frame in plain(text.root)["frames"]]


def _digit(old: str, rng: random.Random, digits: str = HEX) -> str:
    """One of the digits of a text changed."""
    places = [index for index, char in enumerate(old) if char in digits]
    if not places:
        return old
    place = rng.choice(places)
    return old[:place] + rng.choice(digits) + old[place + 1 :]


def _number(old: str, rng: random.Random) -> str:
    if old.endswith("H"):
        return _digit(old[:-1], rng) + "H" if rng.random() < 0.5 else _step_hex(old, rng)
    return rng.choice((str(int(old) + 1), str(int(old) - 1), str(int(old) * 10), _digit(old, rng, HEX[:10])))


def _step_hex(old: str, rng: random.Random) -> str:
    moved = int(old[:-1], 16) + rng.choice((1, -1, 16, -16))
    return f"{max(moved, 0):0{len(old) - 1}X}H"


def _range(old: str, rng: random.Random, end: Callable[[str, random.Random], str]) -> str:
    first, dash, last = old.partition("-")
    if dash and rng.random() < 0.5:
        return first + dash + end(last, rng)
    return end(first, rng) + dash + last


def _decimal(old: str, rng: random.Random) -> str:
    number = Decimal(old)
    choices = (number * 10, number / 10, number + 1, -number, Decimal(_digit(old, rng, HEX[:10])))
    return f"{rng.choice(choices):f}"


_ALTER: dict[str, Callable[[str, random.Random], str]] = {
    form.NUMBER.name: _number,
    form.COUNT.name: _number,
    form.ADDRESS.name: _number,
    form.ADDRESSES.name: lambda old, rng: _range(old, rng, _number),
    form.BITS.name: lambda old, rng: _range(old, rng, _digit),
    form.DECIMAL.name: _decimal,
    form.BYTES.name: _digit,
    form.ADU.name: _digit,
    form.REGISTER_WORD.name: _digit,
    form.ID.name: lambda old, rng: _digit(old, rng, HEX[:10]),
}
