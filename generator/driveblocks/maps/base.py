"""A map that says only what is different from the map of a sister model: both become one tree, as if it were one map.

What a map takes over keeps its source, and names its document: the sister's manual. A source that the map gives itself
holds for all that it takes over in that place.
"""

from pathlib import Path
from typing import NamedTuple

from driveblocks.maps import catalog
from driveblocks.maps.form import NUMBER
from driveblocks.maps.model import Drive, ErrorCode, Manual, Pin, State, Text, Twin
from driveblocks.maps.nodes import Entries, Items, Node, Scalar, told
from driveblocks.maps.problem import Place, Report, Taken
from driveblocks.maps.shape import EntryOf, ListOf, Shape, keys_of, required_of, told_last

DEEPER = " > "
"""Between the names of a path in `without`."""
_NAMES = ("address", "bit", "code", "value", "does", "shows", "id", "what")
"""Keys that name a row in its list."""
_NAMED_BY: dict[type, str] = {State: "name", ErrorCode: "code", Twin: "stored", Pin: "pin"}
"""What names the rows of other lists."""
_ADDRESS = len("0026H")
_WHOLE = (Manual, Text)
"""What is never made of both: half a sister's words would be nobody's."""


def find(name: str, beside: Path) -> Path | None:
    """The file of a base: beside the map, or among those that come with the program."""
    files = (folder / f"{name}.yaml" for folder in (beside.parent, catalog.folder()))
    return next((file for file in files if file.is_file()), None)


def asked(root: Node | None) -> Node | None:
    """What a map says of its base; None where it has none."""
    return root.entries["base"][1] if isinstance(root, Entries) and "base" in root.entries else None


def whole(root: Entries, file: Path, taken: Node, sister: Drive, report: Report) -> Entries:
    """A map together with what it takes over from its base: from what is in `file`, the checked map `sister`."""
    at, left = root.entries["base"][1].at, root.entries.get("without")
    base = _moved(taken, at, file.name, left[1].at if left else None)
    for path in _paths(root):
        base = _cut(base, path.text.split(DEEPER), EntryOf(Drive)) or _missed(base, path, file, report)
    assert isinstance(base, Entries)  # noqa: S101  (a checked map is a mapping)
    own = _Own(_word("document", file.stem, at), sister.family.en)
    entries = base.entries | {"documents": _documents(base, file, sister)}
    entries.pop("models", None)  # the nameplate of a sister is that of another drive
    made = _entries(EntryOf(Drive), Entries(entries, base.at), root, own)
    return Entries(made.entries | {"documents": _named(made, _rows(root))}, made.at)


class _Own(NamedTuple):
    """What the base's own manual is called where facts are taken from it: as a document, and by its model."""

    document: tuple[Scalar, Node]
    family: str


def _word(key: str, text: str, at: Place) -> tuple[Scalar, Node]:
    return Scalar(key, plain=True, at=at), Scalar(text, plain=False, at=at)


def _documents(base: Entries, file: Path, sister: Drive) -> tuple[Scalar, Node]:
    at = base.at
    said = {"id": file.stem, "title": sister.manual.title.en, "publisher": sister.manual.publisher.en}
    said |= {"edition": sister.manual.edition} if sister.manual.edition else {}
    said |= {"trust": "transcribed" if sister.manual.second_hand else "sister"}
    row = Entries({key: _word(key, text, at) for key, text in said.items()}, at)
    return Scalar("documents", plain=True, at=at), Items((*(_of_a_sister(one) for one in _rows(base)), row), at)


def _of_a_sister(document: Node) -> Node:
    """What was read of the base's drive was read of a sister's, unless the map itself says so of the document."""
    if not isinstance(document, Entries) or "read" not in told("trust", document):
        return document
    key, old = document.entries["trust"]
    return Entries(document.entries | {"trust": (key, Scalar("sister", plain=True, at=old.at))}, document.at)


def _rows(node: Entries) -> tuple[Node, ...]:
    listed = node.entries["documents"][1] if "documents" in node.entries else None
    return listed.items if isinstance(listed, Items) else ()


def _named(made: Entries, mine: tuple[Node, ...]) -> tuple[Scalar, Node]:
    """Documents of both maps; of the base's only those that something which was taken over still names."""
    key, old = made.entries["documents"]
    named = {*told("document", made), *(name for row in mine for name in told("id", row))}
    kept = tuple(row for row in _rows(made) if {*told("id", row)} <= named)
    return key, Items(kept, old.at) if isinstance(old, Items) else old


def _moved(node: Node, base: Place, file: str, without: Place | None) -> Node:
    """The same, at one place: mistakes in what is taken over are shown where it is asked for."""
    at = Taken(base, file, node.at, without)
    if isinstance(node, Scalar):
        return node._replace(at=at)
    if isinstance(node, Items):
        return Items(tuple(_moved(each, base, file, without) for each in node.items), at)
    made = {
        key: (name._replace(at=Taken(base, file, name.at, without)), _moved(each, base, file, without))
        for key, (name, each) in node.entries.items()
    }
    return Entries(made, at)


# ---------------------------------------------------------------- what is left out


def _paths(root: Entries) -> list[Scalar]:
    listed = root.entries["without"][1] if "without" in root.entries else None
    return [each for each in listed.items if isinstance(each, Scalar)] if isinstance(listed, Items) else []


def _missed(base: Node, path: Scalar, file: Path, report: Report) -> Node:
    wrong = f"`{path.text}` is nothing that {file.name} has"
    right = "write keys and names of rows, such as `faults > codes > 48` or `settings`; "
    right += "a row without a name by what one of its keys says, and no other row's"
    report.add(path.at, wrong, right)
    return base


def _cut(node: Node, path: list[str], shape: Shape) -> Node | None:
    """A tree without what a path leads to; None where it leads nowhere."""
    if isinstance(node, Entries) and isinstance(shape, EntryOf) and path[0] in node.entries:
        key, value = node.entries[path[0]]
        inner = (
            _cut(value, path[1:], keys_of(shape.cls)[path[0]].shape)
            if path[1:] and path[0] in keys_of(shape.cls)
            else None
        )
        if path[1:] and inner is None:
            return None
        rest = {name: each for name, each in node.entries.items() if inner is not None or name != path[0]}
        return Entries(rest if inner is None else rest | {path[0]: (key, inner)}, node.at)
    if isinstance(node, Items) and isinstance(shape, ListOf):
        return _without(node, path, shape)
    return None


def _without(node: Items, path: list[str], shape: ListOf) -> Node | None:
    """A list without a row, or without what the path leads to in it."""
    named = [index for index, row in enumerate(node.items) if _is_named(row, path[0], shape)]
    if len(named) != 1:
        return None
    index = named[0]
    inner = _cut(node.items[index], path[1:], shape.item) if path[1:] else None
    if path[1:] and inner is None:
        return None
    kept = () if inner is None else (inner,)
    return _Rest((*node.items[:index], *kept, *node.items[index + 1 :]), node.at)


def _is_named(row: Node, word: str, shape: ListOf) -> bool:
    """Whether a row has a name; that of one without is what any of its keys says."""
    if isinstance(row, Scalar):
        return row.text == word
    if _key(shape) is None and isinstance(row, Entries):
        return any(_is_named(each, word, shape) for _, each in row.entries.values() if not isinstance(each, Items))
    return _name(row, shape) == _spelled(word)


class _Rest(Items):
    """A list of which single rows were left out: the others stay, whatever the map adds."""


# ---------------------------------------------------------------- what is taken over


def _both(shape: Shape, base: Node, mine: Node | None, own: _Own) -> Node:
    """What a map says, and what it takes over beside that: all, where it says nothing."""
    if isinstance(shape, EntryOf) and isinstance(base, Entries) and isinstance(mine, Entries | None):
        return mine if mine and shape.cls in _WHOLE else _entries(shape, base, mine, own)
    if isinstance(shape, ListOf) and isinstance(base, Items) and isinstance(mine, Items | None):
        alone = mine is not None and not (mine.items and (_key(shape) or isinstance(base, _Rest)))
        return mine if alone and mine else _items(shape, base, mine, own)
    return base if mine is None else mine


def _entries(shape: EntryOf, base: Entries, mine: Entries | None, own: _Own) -> Entries:
    """Key by key; its document is the sister's manual; a source that the map gives replaces all that goes with one."""
    known, said = keys_of(shape.cls), mine.entries if mine else {}
    entries = {}
    for key, (name, value) in base.entries.items():
        if key not in {"document", *told_last(shape.cls)} or "source" not in said or key in said:
            entries[key] = (name, _both(known[key].shape, value, said[key][1] if key in said else None, own))
    entries |= {key: each for key, each in said.items() if key not in base.entries}
    return Entries(entries if "source" in said else _sourced(shape, entries, own), mine.at if mine else base.at)


def _items(shape: ListOf, base: Items, mine: Items | None, own: _Own) -> Items:
    """Row by row: those of one name are one, at their old place; new ones follow, and one that is there twice."""
    said = mine.items if mine else ()
    last = {name: row for row in said if (name := _name(row, shape)) is not None}
    rows = [_both(shape.item, row, last.get(_name(row, shape) or ""), own) for row in base.items]
    old = {_name(row, shape) for row in base.items}
    new = [row for row in said if (name := _name(row, shape)) is None or name not in old or last[name] is not row]
    return Items((*rows, *new), mine.at if mine else base.at)


def _sourced(shape: EntryOf, entries: dict[str, tuple[Scalar, Node]], own: _Own) -> dict[str, tuple[Scalar, Node]]:
    """Keys of an entry whose source is a page of the base: the document is named, or, where no key can, the model."""
    if "source" not in entries or "document" in entries:
        return entries
    if "document" in keys_of(shape.cls):
        return entries | {"document": own.document}
    key, said = entries["source"]
    if isinstance(said, Scalar):
        said = said._replace(text=f"{own.family}: {said.text}")
    return entries | {"source": (key, said)}


def _key(shape: ListOf) -> str | None:
    """What names the rows of a list; None where they have no names, so that the list is replaced as one."""
    if not isinstance(shape.item, EntryOf):
        return None
    if shape.item.cls in _NAMED_BY:
        return _NAMED_BY[shape.item.cls]
    must = {key.name for key in required_of(shape.item.cls)}
    return next((name for name in _NAMES if name in must), None)


def _name(row: Node, shape: ListOf) -> str | None:
    key = _key(shape)
    if key is None or not isinstance(row, Entries) or key not in row.entries:
        return None
    name = row.entries[key][1]
    return _spelled(name.text) if isinstance(name, Scalar) else None


def _spelled(name: str) -> str:
    """A number in one spelling: 48 is 30H."""
    return str(NUMBER.parse(name)) if NUMBER.pattern.fullmatch(name) and len(name) < _ADDRESS else name
