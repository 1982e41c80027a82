"""Register numbers as a manual gives them, such as 40102, become the addresses that are sent, each with its table."""

import re
from collections.abc import Callable

from driveblocks.maps import form
from driveblocks.maps.form import Numbered, Wired
from driveblocks.maps.model import Drive, Short
from driveblocks.maps.nodes import Entries, Items, Node, Scalar, told
from driveblocks.maps.problem import Place, Report
from driveblocks.maps.shape import EntryOf, ListOf, Shape, keys_of

_NUMBER = re.compile(r"[1-9][0-9]{0,5}|[0-9A-F]{4}H")
_SPACED = re.compile(r"((?:coil|discrete|input) )?(.*)", re.DOTALL)
_WRITTEN = r"(?:[1-9][0-9]{0,5}|[0-9A-F]{4}H)"
_COUNTS = re.compile(rf"\b{_WRITTEN}\b")
_RUN = re.compile(
    r"\b(?:(?P<table>register|coil|discrete|input)s? )?"
    rf"(?P<run>{_WRITTEN}\b(?:(?:, | and | or | to |-){_WRITTEN}\b)*)"
)
"""Numbers in a sentence, and the table that it names."""
_LIKELY = re.compile(r"[0-9A-F]{4}H|[1-9][0-9]{4,5}")
"""What is a register's number, and hardly anything else."""


def wired(root: Node | None, report: Report) -> Node | None:
    """The same map with addresses in the place of the manual's numbers; as it is where it has no `numbering`.

    In its sentences the addresses stand beside the numbers.
    """
    bases = _bases(root)
    return root if root is None or "first" not in bases else _Wiring(bases, report).map(root)


def _bases(root: Node | None) -> dict[str, int]:
    """The number of address 0: `first`, and by table where a table has its own."""
    said = root.entries["numbering"][1] if isinstance(root, Entries) and "numbering" in root.entries else None
    rows = said.entries if isinstance(said, Entries) else {}
    told = {key: rows[key][1] for key in ("first", "coil", "discrete", "input") if key in rows}
    return {
        key: int(each.text)
        for key, each in told.items()
        if isinstance(each, Scalar) and form.COUNT.pattern.fullmatch(each.text)
    }


def numbered(drive: Drive, space: str, number: int) -> int | None:
    """The address of a number of a table, where the manual numbers registers."""
    if drive.numbering is None or not 0 <= number - drive.numbering.base(space) <= 0xFFFF:
        return None
    return at(drive, form.SPACES[space] + number - drive.numbering.base(space))


def in_hex(drive: Drive) -> bool:
    """Whether the manual numbers registers, and in hexadecimal."""
    known = next((row.address.first for _, row in drive.registers()), None)
    return isinstance(known, Numbered) and known.hexadecimal


def at(drive: Drive, address: int) -> int:
    """An address that was sent as one of this map, which has the manual's number where it numbers registers."""
    if drive.numbering is None:
        return address
    return Numbered(address, drive.numbering.base(form.space_of(address)), hexadecimal=in_hex(drive))


class _Wiring:
    """Takes the manual's numbers out of a map."""

    def __init__(self, bases: dict[str, int], report: Report) -> None:
        self._bases, self._report = bases, report
        self._listed: frozenset[int] = frozenset()
        """The addresses of the rows."""
        self._hexadecimal = False

    def map(self, root: Node) -> Node:
        """First the tables, so that sentences know what is an address."""
        made = self._of(EntryOf(Drive), root)
        rows = [each for each in told("address", made) if isinstance(each, Wired)]
        self._hexadecimal = any(each.said.endswith("H") for each in rows)
        self._listed = frozenset(
            at for each in rows if form.ADDRESSES.pattern.fullmatch(each) for at in form.ADDRESSES.parse(each)
        )
        return self._told(EntryOf(Drive), made)

    def _of(self, shape: Shape, node: Node) -> Node:
        if isinstance(node, Scalar) and shape in (form.ADDRESS, form.ADDRESSES):
            return node._replace(text=self._address(node.text, node.at))
        if isinstance(node, Scalar) and shape is form.REFERENCE:
            return node._replace(text=self._reference(node))
        return _each(shape, node, self._of)

    def _told(self, shape: Shape, node: Node) -> Node:
        if isinstance(node, Scalar) and shape is form.ENGLISH:
            return node._replace(text=_RUN.sub(self._beside, node.text))
        return _each(shape, node, self._told)

    def _address(self, text: str, at: Place) -> str:
        """An address or a range of them; what is neither stays, for the decoder to refuse."""
        match = _SPACED.fullmatch(text)
        space, rest = (match[1] or "", match[2]) if match else ("", text)
        ends = rest.split("-")
        if not all(map(_NUMBER.fullmatch, ends)):
            return text
        thing = space.rstrip() or "register"
        made = "-".join(self._one(each, at, thing) for each in ends)
        return Wired(space + made, text, self._base(thing))

    def _base(self, thing: str) -> int:
        return self._bases.get(thing, self._bases["first"])

    def _one(self, text: str, at: Place, thing: str) -> str:
        least = self._base(thing)
        number = _count(text)
        if not least <= number <= least + 0xFFFF:
            right = f"by `numbering` they are {least} to {least + 0xFFFF}"
            article = "an" if thing == "input" else "a"
            self._report.add(at, f"{text} is no number of {article} {thing}", right)
            return "0000H"
        return form.wire_text(number - least)

    def _reference(self, node: Scalar) -> str:
        """`register 40102` or `bit 40102.3`."""
        kind, _, name = node.text.partition(" ")
        number, dot, bit = name.partition(".")
        if kind not in form.TABLES:
            return node.text
        made = self._address(form.TABLES[kind] + number, node.at).rpartition(" ")[2]
        return Wired(f"{kind} {made}{dot}{bit}", node.text)

    def _beside(self, run: re.Match[str]) -> str:
        """Numbers in a sentence, with what is sent beside them: `coil 0003H (wire 0002H)`."""
        counts = _COUNTS.findall(run["run"])
        likely = all(_LIKELY.fullmatch(each) and each.endswith("H") == self._hexadecimal for each in counts)
        for table in (run["table"],) if run["table"] else ("register", "input", "coil", "discrete"):
            sent = [_count(each) - self._base(table) for each in counts]
            listed = form.SPACES["holding" if table == "register" else table] + sent[0] in self._listed
            fits = all(0 <= each <= 0xFFFF for each in sent)
            if fits and (likely + listed + bool(run["table"])) > 1:
                texts = iter([form.wire_text(each) for each in sent])
                return f"{run[0]} (wire {_COUNTS.sub(lambda _, texts=texts: next(texts), run['run'])})"
        return run[0]


def _count(text: str) -> int:
    return int(text[:-1], 16) if text.endswith("H") else int(text)


def _each(shape: Shape, node: Node, work: Callable[[Shape, Node], Node]) -> Node:
    """The same with what a node holds worked over; names stay, of which identifiers are made."""
    if isinstance(shape, EntryOf) and isinstance(node, Entries) and shape.cls is not Short:
        known = keys_of(shape.cls)
        made = {
            key: (name, work(known[key].shape, value) if key in known and key != "name" else value)
            for key, (name, value) in node.entries.items()
        }
        return Entries(made, node.at)
    if isinstance(shape, ListOf) and isinstance(node, Items):
        return Items(tuple(work(shape.item, each) for each in node.items), node.at)
    return node


def spaced(root: Node | None) -> Node | None:
    """The same map with the table of its section, or its own, before the address of each row."""
    sections = root.entries["sections"][1] if isinstance(root, Entries) and "sections" in root.entries else None
    if not isinstance(root, Entries) or not isinstance(sections, Items):
        return root
    made = Items(tuple(map(_section, sections.items)), sections.at)
    return Entries(root.entries | {"sections": (root.entries["sections"][0], made)}, root.at)


def _section(section: Node) -> Node:
    rows = section.entries["registers"][1] if isinstance(section, Entries) and "registers" in section.entries else None
    if not isinstance(section, Entries) or not isinstance(rows, Items):
        return section
    made = Items(tuple(_row(row, _space(section)) for row in rows.items), rows.at)
    return Entries(section.entries | {"registers": (section.entries["registers"][0], made)}, section.at)


def _row(row: Node, space: str) -> Node:
    said = row.entries["address"][1] if isinstance(row, Entries) and "address" in row.entries else None
    own = _space(row) or space
    if not isinstance(row, Entries) or not isinstance(said, Scalar) or own in ("", "holding") or " " in said.text:
        return row
    made = said._replace(text=f"{own} {said.text}")
    return Entries(row.entries | {"address": (row.entries["address"][0], made)}, row.at)


def _space(entry: Node) -> str:
    said = entry.entries["space"][1] if isinstance(entry, Entries) and "space" in entry.entries else None
    return said.text if isinstance(said, Scalar) else ""
