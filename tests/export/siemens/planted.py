"""Mistakes that somebody could make in the writer, each as an edit of its text, and the check that has to find it."""

import importlib
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType
from unittest.mock import patch

from tests.export.siemens import checks
from tests.export.siemens.checks import Read, opened
from tests.export.siemens.scl import SclError

from driveblocks.export import siemens
from driveblocks.export.part import Part, Shelf

PACKAGE = "driveblocks.export.siemens"
FOLDER = Path(siemens.__file__).parent
READER = "the reader"
NEEDED = (
    "MB_Plus",
    "MB_WireMs",
    "MB_Crc16",
    "MB_RtuSeal",
    "MB_HexDigit",
    "MB_Lrc",
    "MB_AsciiEncode",
    "CHF_Reference",
    "CHF_FaultTextZh",
    "JSCC_ErrorTextEn",
)
"""Parts that hold whatever a mistake could touch."""


class Few(Shelf):
    """A shelf of some parts, with the port alone."""

    def adapter(self, platform: str) -> tuple[Part, ...]:
        """Only the port."""
        return super().adapter(platform)[:1]


def few() -> Few:
    """All types, and the parts that are needed."""
    stock = checks.shelf()
    parts = [part for part in stock.parts if part.folder == "types" or part.name in NEEDED]
    return Few(tuple(parts), {}, stock.languages)


def edited(module: str, old: str, new: str) -> Callable[[Shelf], checks.Files]:
    """The writer with one text of one of its modules replaced."""
    with patch.dict(sys.modules):
        for name in [name for name in sys.modules if name.startswith(f"{PACKAGE}.")]:
            del sys.modules[name]
        text = (FOLDER / f"{module}.py").read_text("utf-8")
        assert old in text, old
        made = sys.modules[f"{PACKAGE}.{module}"] = ModuleType(f"{PACKAGE}.{module}")
        exec(text.replace(old, new), made.__dict__)  # noqa: S102  (the writer's own text, edited)
        writer: Callable[[Shelf], checks.Files] = importlib.import_module(f"{PACKAGE}.library").files
        return writer


@dataclass(frozen=True)
class Planted:
    """A mistake: its name, the module, what is there, what instead, and the check that tells."""

    name: str
    module: str
    old: str
    new: str
    check: Callable[[Read], None] | None = None

    @property
    def by(self) -> str:
        """The name of the check."""
        return self.check.__name__ if self.check else READER

    def found(self) -> str:
        """Who finds it: the reader, the first check that fails, or nobody."""
        stock = few()
        files = edited(self.module, self.old, self.new)(stock)
        try:
            read = opened(stock, files)
        except SclError:
            return READER
        for check in checks.CHECKS:
            try:
                check(read)
            except AssertionError:
                return check.__name__
        return "nobody"


PLANTED = (
    Planted(
        "a line of the head is lost",
        "declaration",
        "part.head.splitlines()",
        "part.head.splitlines()[1:]",
        checks.heads_are_equal,
    ),
    Planted(
        "comments of declarations are lost",
        "declaration",
        'made[-1] += f"   // {said}"',
        'made[-1] += ""',
        checks.declarations_are_equal,
    ),
    Planted(
        "a comment above a declaration is lost",
        "declaration",
        "else one.leading",
        "else ()",
        checks.declarations_are_equal,
    ),
    Planted("initial values are lost", "declaration", 'return [f" := {value.text}"]', 'return [""]'),
    Planted(
        "a row of an array is lost",
        "declaration",
        "for row in rows[:-1]",
        "for row in rows[1:-1]",
        checks.declarations_are_equal,
    ),
    Planted(
        "variables come in another order",
        "declaration",
        'found["VAR"].sort(key=lambda one: one.constant)',
        'found["VAR"].reverse()',
        checks.declarations_are_equal,
    ),
    Planted("constants are left out", "declaration", "in found.items():", "in [*found.items()][:-1]:"),
    Planted("a type has no quotes", "declaration", "return f'\"{found.name}\"'", "return found.name"),
    Planted(
        "a UINT becomes an INT",
        "declaration",
        "return ELEMENTARY[upper]",
        'return ELEMENTARY[upper].replace("UInt", "Int")',
        checks.declarations_are_equal,
    ),
    Planted(
        "an array begins at 1",
        "declaration",
        "{_number(part, low, names)}..",
        "{_number(part, low, names) + 1}..",
        checks.arrays_are_told,
    ),
    Planted(
        "an array type stays a name",
        "declaration",
        "if array := names.array(spec.name):",
        'if array := names.array(""):',
    ),
    Planted("an array stays a constant", "declaration", "if one.constant and _is_array", "if one.retain and _is_array"),
    Planted("a function has static variables", "declaration", 'name = "VAR_TEMP" if', 'name = "VAR" if'),
    Planted("a function has no result", "declaration", "if pou.returns else", "if not pou.returns else"),
    Planted(
        "VERSION is missing",
        "declaration",
        '    yield "VERSION : 0.1"\n    yield from head(part)\n    yield from sections',
        "    yield from head(part)\n    yield from sections",
    ),
    Planted("access is not optimized", "declaration", "else 'TRUE'", "else 'FALSE'"),
    Planted("BEGIN is missing", "declaration", 'yield "BEGIN"', 'yield ""'),
    Planted("a local has no #", "body", 'self.put(value.at, "#")', 'self.put(value.at, "")'),
    Planted(
        "a function has no quotes",
        "body",
        "self.put(callee.at, '\"')\n            self.put(callee.at + len(callee.name), '\"')",
        "pass",
    ),
    Planted("SHR is called by position", "body", 'f"{formal} := "', '""'),
    Planted("SHR has its parameters the other way round", "words", '"SHR": ("IN", "N")', '"SHR": ("N", "IN")'),
    Planted(
        "a literal is changed",
        "body",
        "return made + whole[here:end]",
        'return (made + whole[here:end]).replace("256", "255")',
        checks.bodies_are_equal,
    ),
    Planted(
        "comments of bodies are lost",
        "body",
        "return made + whole[here:end]",
        'return "\\n".join(each.partition("(*")[0] for each in (made + whole[here:end]).split("\\n"))',
        checks.comments_are_equal,
    ),
    Planted(
        "the last line of a body is lost",
        "body",
        "return made + whole[here:end]",
        "return made + whole[here:end].rpartition('\\n')[0]",
    ),
    Planted(
        "non-ASCII is dropped", "library", "{line}", "{line.encode('ascii', 'ignore').decode()}", checks.heads_are_equal
    ),
    Planted("the byte order mark is missing", "library", '"\\ufeff" + ', ""),
    Planted("lines end with LF", "library", "\\r\\n", "\\n"),
    Planted("a function ends as a block", "library", '"END_FUNCTION", False', '"END_FUNCTION_BLOCK", False'),
    Planted(
        "types come in another order",
        "library",
        "made += type_lines(part, names)",
        "made[:0] = type_lines(part, names)",
    ),
    Planted(
        "what an array means is not told",
        "library",
        "made += [*head(part), f",
        "made += [f",
        checks.arrays_are_told,
    ),
    Planted(
        "the last block is left out",
        "library",
        "    for part in parts:\n        made += [*opening",
        "    for part in [*parts][:-1]:\n        made += [*opening",
        checks.all_are_there,
    ),
)
