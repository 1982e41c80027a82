"""Register numbers as a manual gives them, such as 40102, become the addresses that are sent, each with its table."""

import re
from collections.abc import Callable
from dataclasses import replace

from driveblocks.maps import form
from driveblocks.maps.form import Span
from driveblocks.maps.model import Drive
from driveblocks.maps.nodes import Entries, Items, Node, Scalar
from driveblocks.maps.problem import Place, Report
from driveblocks.maps.shape import EntryOf, ListOf, Shape, keys_of

_NUMBER = re.compile(r"[1-9][0-9]{0,5}|[0-9A-F]{4}H")
_SPACED = re.compile(r"((?:coil|discrete|input) )?(.*)", re.DOTALL)
Addressed = Callable[[str, Place], str]
"""Makes an address of a number at a place."""


def wired(root: Node | None, report: Report) -> Node | None:
    """The same map with addresses in the place of the manual's numbers; as it is where it has no `numbering`."""
    bases = _bases(root)
    if root is None or "first" not in bases:
        return root

    def address(text: str, at: Place) -> str:
        """An address or a range of them; what is neither stays, for the decoder to refuse."""
        match = _SPACED.fullmatch(text)
        space, rest = (match[1] or "", match[2]) if match else ("", text)
        ends = rest.split("-")
        least = bases.get(space.rstrip(), bases["first"])
        thing = space.rstrip() or "register"
        return (
            space + "-".join(one(each, at, least, thing) for each in ends)
            if all(map(_NUMBER.fullmatch, ends))
            else text
        )

    def one(text: str, at: Place, least: int, thing: str) -> str:
        number = int(text[:-1], 16) if text.endswith("H") else int(text)
        if not least <= number <= least + 0xFFFF:
            right = f"by `numbering` they are {least} to {least + 0xFFFF}"
            article = "an" if thing == "input" else "a"
            report.add(at, f"{text} is no number of {article} {thing}", right)
            return "0000H"
        return form.address_text(number - least)

    return _wired(EntryOf(Drive), root, address)


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
    return form.SPACES[space] + number - drive.numbering.base(space)


def named(drive: Drive, span: Span) -> str:
    """A span of addresses as the manual names it: by its numbers where it numbers registers, written as in the map."""
    one = drive.numbering
    if one is None:
        return form.span_text(span)
    base = one.base(form.space_of(span.first))
    numbers = dict.fromkeys(form.wire(each) + base for each in (span.first, span.last))
    written = "-".join(f"{each:04X}H" if one.hexadecimal else str(each) for each in numbers)
    return f"{form.address_text(span.first).rpartition(' ')[0]} {written}".lstrip()


def noted(drive: Drive, root: Node | None) -> Drive:
    """The same map, which knows whether this file of it, before `wired`, writes numbers in hexadecimal."""
    if drive.numbering is None or not isinstance(root, Entries):
        return drive
    node: Node = root
    for key in ("sections", "registers", "address"):
        node = node.entries[key][1] if isinstance(node, Entries) and key in node.entries else node
        node = node.items[0] if isinstance(node, Items) and node.items else node
    written = isinstance(node, Scalar) and node.text.endswith("H")
    return replace(drive, numbering=replace(drive.numbering, hexadecimal=written))


def _wired(shape: Shape, node: Node, address: Addressed) -> Node:
    if isinstance(shape, EntryOf) and isinstance(node, Entries):
        known = keys_of(shape.cls)
        made = {
            key: (name, _wired(known[key].shape, value, address) if key in known else value)
            for key, (name, value) in node.entries.items()
        }
        return Entries(made, node.at)
    if isinstance(shape, ListOf) and isinstance(node, Items):
        return Items(tuple(_wired(shape.item, each, address) for each in node.items), node.at)
    if not isinstance(node, Scalar):
        return node
    if shape in (form.ADDRESS, form.ADDRESSES):
        return node._replace(text=address(node.text, node.at))
    return node._replace(text=_reference(node, address)) if shape is form.REFERENCE else node


def _reference(node: Scalar, address: Addressed) -> str:
    """`register 40102` or `bit 40102.3`."""
    kind, _, name = node.text.partition(" ")
    number, dot, bit = name.partition(".")
    return f"{kind} {address(number, node.at)}{dot}{bit}" if kind in form.TABLES else node.text


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
