"""Mistakes that somebody could make in the writers of TC6, each as an edit of their text, and the check that tells."""

import importlib
import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType
from unittest.mock import patch

from lxml import etree
from tests.export.tc6_checks import (
    Made,
    assert_bodies,
    assert_comments,
    assert_declarations,
    assert_folders,
    assert_ladders,
    assert_libraries,
    assert_marks,
    assert_names,
    assert_plain,
    assert_room,
    assert_schema,
    assert_tasks,
    made,
)

from driveblocks.export.part import Shelf

BOTH = ("plcopen", "codesys")
MODULES = ("element", "tc6", "ladder", "rungs", *BOTH)
"""What writes, each after what it imports."""


@dataclass(frozen=True)
class Planted:
    """A mistake: its name, the module, what is in its text, what instead, the check that tells, and where.

    What both dialects share is tried in one.
    """

    name: str
    module: str
    old: str
    new: str
    check: Callable[[Made], None]
    targets: Sequence[str] = ("plcopen",)

    def found(self, shelf: Shelf, target: str) -> bool:
        """Whether its check turns red."""
        modules = self.modules()
        try:
            for one in made(modules[target].write, shelf, target):
                self.check(one)
        except (AssertionError, etree.XMLSyntaxError, etree.DocumentInvalid):
            return True
        return False

    def modules(self) -> dict[str, ModuleType]:
        """The writers with the mistake, made anew."""
        fresh: dict[str, ModuleType] = {}
        with patch.dict(sys.modules):
            for name in MODULES:
                whole = f"driveblocks.export.{name}"
                path = Path(importlib.import_module(whole).__file__ or "")
                text = path.read_text("utf-8")
                if name == self.module:
                    assert text.count(self.old) == 1, f"{self.name}: the writer has changed"
                    text = text.replace(self.old, self.new)
                fresh[name] = sys.modules[whole] = ModuleType(whole)
                exec(compile(text, str(path), "exec"), fresh[name].__dict__)  # noqa: S102  (our own writer, edited)
        return fresh


PLANTED = (
    Planted(
        "every comment is lost",
        "tc6",
        "self.text(text)) if text else",
        "self.text(text)) if 0 else",
        assert_comments,
    ),
    Planted("a comment ends early", "tc6", "one.text.split()) for", "one.text.split()[:3]) for", assert_comments),
    Planted("a head is lost", "tc6", "self.dialect.documentation(below)", "None", assert_comments),
    Planted(
        "an initial value is lost",
        "tc6",
        "self.initial(one.initial),\n            self.dialect.documentation(self.d",
        "None,\n            self.dialect.documentation(self.d",
        assert_declarations,
    ),
    Planted(
        "a table ends early",
        "tc6",
        "map(self.item, value.items)",
        "map(self.item, value.items[:2])",
        assert_declarations,
    ),
    Planted("a repetition is lost", "tc6", '{"repetitionValue": self.said(value.count)}', "{}", assert_declarations),
    Planted(
        "sections change places",
        "tc6",
        "for block in one.blocks",
        "for block in one.blocks[::-1]",
        assert_declarations,
    ),
    Planted(
        "fields change places",
        "tc6",
        "*map(self.variable, spec.fields)",
        "*map(self.variable, spec.fields[::-1])",
        assert_declarations,
    ),
    Planted(
        "a constant is a variable",
        "tc6",
        "if word in block.qualifiers}",
        'if word in block.qualifiers and word == "RETAIN"}',
        assert_declarations,
    ),
    Planted(
        "what is kept is not",
        "tc6",
        "if word in block.qualifiers}",
        'if word in block.qualifiers and word == "CONSTANT"}',
        assert_declarations,
    ),
    Planted(
        "in and out change places",
        "tc6",
        'VarKind.INPUT: "inputVars", VarKind.OUTPUT: "outputVars"',
        'VarKind.INPUT: "outputVars", VarKind.OUTPUT: "inputVars"',
        assert_declarations,
    ),
    Planted(
        "an array loses its upper bound",
        "tc6",
        '"upper": self.said(bounds.high)',
        '"upper": self.said(bounds.low)',
        assert_declarations,
    ),
    Planted(
        "an array loses a dimension",
        "tc6",
        "for one in spec.ranges]",
        "for one in spec.ranges[:1]]",
        assert_declarations,
    ),
    Planted(
        "a function is a block",
        "tc6",
        '"FUNCTION": "function"',
        '"FUNCTION": "functionBlock"',
        assert_declarations,
    ),
    Planted(
        "a function loses its type",
        "tc6",
        "self.spec(returns)) if returns",
        "self.spec(returns)) if 0",
        assert_declarations,
    ),
    Planted(
        "a unit has another name",
        "tc6",
        '{"name": one.name, "pouType"',
        '{"name": one.name.upper(), "pouType"',
        assert_names,
    ),
    Planted(
        "a type is lost",
        "tc6",
        "(e for e in parts if e.tag == tag)",
        "([e for e in parts if e.tag == tag][:-1])",
        assert_names,
    ),
    Planted("units are doubled", "tc6", "parts = tuple(parts)", "parts = 2 * tuple(parts)", assert_names),
    Planted(
        "the namespace is another",
        "tc6",
        'Dialect("http://www.plcopen.org/xml/tc6_0201"',
        'Dialect("http://www.plcopen.org/xml/tc6_0200"',
        assert_names,
        ("plcopen",),
    ),
    Planted(
        "a body is trimmed",
        "tc6",
        "self.dialect.text(self.part.body)",
        "self.dialect.text(self.part.body.strip())",
        assert_bodies,
    ),
    Planted(
        "a body loses its comments",
        "tc6",
        "self.dialect.text(self.part.body)",
        'self.dialect.text(re.sub(r"[(][*].*?[*][)]", "", self.part.body))',
        assert_bodies,
    ),
    Planted("an ampersand is not escaped", "element", '"&": "&amp;", ', "", assert_schema, BOTH),
    Planted("a bracket is not escaped", "element", '"<": "&lt;", ', "", assert_schema, ("codesys",)),
    Planted("a quote is not escaped", "element", ', \'"\': "&quot;"', "", assert_schema, BOTH),
    Planted(
        "other than ASCII breaks",
        "element",
        '{text}</{self.tag}>"',
        "{text.encode('ascii', 'replace').decode()}</{self.tag}>\"",
        assert_comments,
    ),
    Planted("a text is not CDATA", "tc6", "text=cdata(text)", "text=escaped(text)", assert_marks, ("plcopen",)),
    Planted(
        "all have one identity",
        "codesys",
        'f"driveblocks:{part.name}"',
        '"driveblocks"',
        assert_folders,
        ("codesys",),
    ),
    Planted(
        "the text of a declaration has a name that nobody knows",
        "codesys",
        '"interfaceasplaintext"',
        '"declaration"',
        assert_plain,
        ("codesys",),
    ),
    Planted(
        "the text of a declaration lacks its end",
        "codesys",
        "{part.declaration}",
        "{part.declaration[:-7]}",
        assert_plain,
        ("codesys",),
    ),
    Planted(
        "a folder is lost",
        "codesys",
        "for name, objects in folders.items()]",
        "for name, objects in list(folders.items())[1:]]",
        assert_folders,
        ("codesys",),
    ),
    Planted(
        "nobody says which library the port needs",
        "codesys",
        '"libraries", element',
        '"library", element',
        assert_libraries,
        ("codesys",),
    ),
    Planted("a network has no title", "rungs", 'text="networktitle"', 'text="title"', assert_ladders, ("codesys",)),
    Planted(
        "a call is not on the rail",
        "rungs",
        'ins = [\n            _pin("EN", _wires([_RAIL])),',
        'ins = [\n            _pin("EN", _wires([])),',
        assert_ladders,
        ("codesys",),
    ),
    Planted(
        "an open contact is a closed one",
        "rungs",
        "str(negated).lower()",
        '"true"',
        assert_ladders,
        ("codesys",),
    ),
    Planted(
        "an or is an and",
        "rungs",
        "*self.contacts(value.right, begin)]",
        "*self.contacts(value.right, self.contacts(value.left, begin))]",
        assert_ladders,
        ("codesys",),
    ),
    Planted(
        "the task is too slow",
        "plcopen",
        '"interval": f"T#{SCAN_MS}ms"',
        '"interval": f"T#{SCAN_MS}s"',
        assert_tasks,
        ("plcopen",),
    ),
    Planted(
        "a wire misses its pin",
        "ladder",
        "return number, (x + 21, y)\n\n    @static",
        "return number, (x, y)\n\n    @static",
        assert_ladders,
        ("plcopen",),
    ),
    Planted("statements are done in another order", "ladder", "str(self.turn)", "str(99 - self.turn)", assert_ladders),
    Planted("two boxes touch", "ladder", "_PITCH = 32", "_PITCH = 20", assert_room, ("plcopen",)),
    Planted(
        "a closed contact is an open one",
        "ladder",
        'how = {"negated": "true"} if negated',
        "how = {} if negated",
        assert_ladders,
    ),
    Planted(
        "parallel contacts are in series",
        "ladder",
        "ends, x, right = self.network(value.right, begin",
        "ends, x, right = self.network(value.right, begin[:1]",
        assert_ladders,
    ),
    Planted(
        "a contact is a wire",
        "ladder",
        "number, there = self.contact(said(value), (_CONTACT, here[1]), [])",
        "number, there = 1, (_RAIL + 3, here[1])",
        assert_ladders,
        ("plcopen",),
    ),
    Planted(
        "a pin is not wired",
        "ladder",
        'return _pin("In", place, _link(number, here, there))',
        'return _pin("In", place)',
        assert_ladders,
        ("plcopen",),
    ),
)
"""The mark that ends a CDATA section has a test of its own: with it the writer has to refuse the part."""
