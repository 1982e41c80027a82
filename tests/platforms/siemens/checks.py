"""What must be true of the files of a shelf, as the reader of SCL finds them; a check has the name of what it sees."""

import functools
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

from tests.platforms.siemens.scl import Block, read
from tests.platforms.stock import volumes
from tests.shipped import BOTH, sources

from driveblocks.maps.model import Drive
from driveblocks.platforms.part import Part, Shelf
from driveblocks.platforms.part import shelf as made_shelf
from driveblocks.render import library, text
from driveblocks.render.motor import master
from structured_text.language.fingerprint import fingerprint, stream
from structured_text.language.tree import ArraySpec, Function, NamedSpec, Pou, Spec, TypeDecl, VarDecl, VarKind

Files = dict[str, str]
SECTIONS = {
    VarKind.INPUT: "VAR_INPUT",
    VarKind.OUTPUT: "VAR_OUTPUT",
    VarKind.IN_OUT: "VAR_IN_OUT",
    VarKind.LOCAL: "VAR",
    VarKind.FIELD: "STRUCT",
}
ORDER = ("STRUCT", "VAR_INPUT", "VAR_OUTPUT", "VAR_IN_OUT", "VAR", "VAR_TEMP", "VAR CONSTANT")


@dataclass(frozen=True)
class Read:
    """Parts and the blocks that were read, in the order of the files; `above` is the comment above all of them."""

    parts: dict[str, Part]
    blocks: dict[str, Block]
    above: list[str]
    files: dict[str, list[str]]

    def pairs(self) -> Iterator[tuple[Part, Block]]:
        """Each block with its part."""
        for name, block in self.blocks.items():
            yield self.parts[name], block


@functools.cache
def shelf() -> Shelf:
    """The shipped library."""
    return stocked({source.path.stem: text.told(source.drive, BOTH) for source in sources()}, BOTH)


def stocked(drives: dict[str, Drive], languages: list[text.Language]) -> Shelf:
    """The library of some drives."""
    files = [*library.generic(languages)]
    for stem, drive in drives.items():
        files.extend(library.drive(stem, drive, languages))
    return made_shelf(files, drives, languages)


def opened(stock: Shelf, files: Files) -> Read:
    """Read all files as they are imported: what is shared, each family, programs."""
    parts = [*stock.parts, *(part for one in stock.port("siemens") for part in one.parts), *programs(stock)]
    named = {part.name.upper(): part for part in parts}
    known: dict[str, Block] = {}
    found = {name: [block.name for block in read(files[name], known)] for name in importing(stock)}
    above = [line for names in found.values() for line in known[names[0].upper()].above]
    return Read(named, known, above, found)


def programs(stock: Shelf) -> list[Part]:
    motors = [stock.motor("siemens", drive) for drive in stock.drives.values()]
    return [*motors, *stock.masters("siemens", master).values()]


def importing(stock: Shelf) -> list[str]:
    """The files in the order of their import, as the page has it: types in front of the blocks of their file."""
    rows = [(part.folder, part.name, part.text) for part in stock.parts]
    port = [(part.folder, part.name, part.text) for one in stock.port("siemens") for part in one.parts]
    made = volumes(stock, rows) | volumes(replace(stock, drives={}), port, "SI_Port")
    typed = {"shared/DriveBlocks", "shared/DriveBlocks_Plant", "shared/DriveBlocks_Frames"}
    names = [f"{name}.{end}" for name in made for end in (("udt", "scl") if name in typed else ("scl",))]
    order = sorted(names, key=lambda name: name.startswith("families"))
    return [*order, *(f"yours/{each.name}.scl" for each in programs(stock))]


def structure(part: Part) -> bool:
    """Whether a part is an array type, which has no name in SCL."""
    return not (isinstance(part.element, TypeDecl) and isinstance(part.element.spec, ArraySpec))


def all_are_there(found: Read) -> None:
    """Every part but the array types is in the files, once; that none is used above it, the reader has seen."""
    assert {name for name, part in found.parts.items() if structure(part)} == found.blocks.keys()


def arrays_are_told(found: Read) -> None:
    """What an array type says stands at the top of its file."""
    arrays = [part for part in found.parts.values() if not structure(part)]
    wanted = [line for part in arrays for line in (*part.head.splitlines(), _array(found, part))]
    assert sorted(line.removeprefix("//").strip() for line in found.above) == sorted(line.strip() for line in wanted)


def _array(found: Read, part: Part) -> str:
    bare = _type(found, NamedSpec(0, part.name))
    plain = re.sub(r"\b(?:BYTE|WORD)\b", lambda name: name[0].capitalize(), bare)
    plain = re.sub(r"(?:MB|VFD)_\w+", lambda name: f'"{found.parts[name[0]].name}"', plain)
    return f"{part.name} is {plain.replace('ARRAY', 'Array').replace('OF', 'of')} wherever it is used"


def heads_are_equal(found: Read) -> None:
    """The comment at the top is the comment of the block."""
    for part, block in found.pairs():
        assert block.head == part.head.splitlines(), part.name


def declarations_are_equal(found: Read) -> None:
    """Kind, result, and each variable with section, type, initial value and comment."""
    for part, block in found.pairs():
        element = part.element
        if isinstance(element, Function):
            assert (block.kind, block.returns) == ("FUNCTION", _type(found, element.returns)), part.name
        else:
            assert block.kind == ("TYPE" if isinstance(element, TypeDecl) else "FUNCTION_BLOCK"), part.name
        wanted = sorted(_variables(found, part), key=lambda one: ORDER.index(one[0]))
        assert [(one.section, one.name, one.type, one.initial, one.comment) for one in block.variables] == wanted


def _variables(found: Read, part: Part) -> Iterator[tuple[str, str, str, tuple[str, ...], str]]:
    """What is declared: an array of constants is a variable after the others, a function's variable is temporary."""
    element = part.element
    declared = element.spec.fields if isinstance(element, TypeDecl) else _all(element)  # type: ignore[attr-defined]  # a structure
    for one in sorted(declared, key=lambda each: each.constant):
        kind, section = _type(found, one.spec), SECTIONS[one.kind]
        if one.constant and not kind.startswith("ARRAY"):
            section = "VAR CONSTANT"
        elif isinstance(element, Function) and section == "VAR":
            section = "VAR_TEMP"
        initial = stream(part.text[one.initial.at : one.end].rstrip(";")) if one.initial else ()
        said = [*one.leading, *([one.trailing] if one.trailing else [])]
        yield section, one.name, kind, initial, " ".join(" ".join(each.text for each in said).split())


def _all(pou: Pou) -> list[VarDecl]:
    return [one for block in pou.blocks for one in block.variables]


def _type(found: Read, spec: Spec | None) -> str:
    """A type in upper case, the name of an array replaced by what it means."""
    if isinstance(spec, NamedSpec):
        part = found.parts.get(spec.name.upper())
        if spec.name == "TON":
            return "TON_TIME"
        return spec.name.upper() if part is None or structure(part) else _type(found, part.element.spec)  # type: ignore[union-attr]  # a type
    if isinstance(spec, ArraySpec):
        bounds = [(each.low.text, each.high.text) for each in spec.ranges if each]  # type: ignore[attr-defined]  # literals
        return f"ARRAY[{bounds[0][0]}..{bounds[0][1]}] OF {_type(found, spec.element)}"
    return "STRING"


def bodies_are_equal(found: Read) -> None:
    """Token by token; and the hash in the head is that of these tokens."""
    for part, block in found.pairs():
        assert tuple(block.tokens) == part.tokens, part.name
        if part.tokens and (hashed := re.search(r"Body +(\w{8}),", " ".join(block.head))):
            assert hashed[1] == fingerprint(block.tokens), part.name


def comments_are_equal(found: Read) -> None:
    """Comments between statements, in their order."""
    for part, block in found.pairs():
        start = part.text.index(part.body) if part.body else len(part.text)
        wanted = [" ".join(each.text.split()) for each in part.unit.comments if each.at >= start]
        assert block.comments == wanted, part.name


CHECKS: tuple[Callable[[Read], None], ...] = (
    all_are_there, heads_are_equal, arrays_are_told, declarations_are_equal, bodies_are_equal, comments_are_equal,
)  # fmt: skip
