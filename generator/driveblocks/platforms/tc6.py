"""The library in the XML of PLCopen's technical committee 6 (TC6), of which two dialects are in use.

Declarations become elements, each with its comment as documentation; a body is text, and stays as it is.
"""

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field

from driveblocks.platforms.element import Element, cdata, element, escaped
from driveblocks.platforms.part import Declared, Part
from structured_text.language import tree
from structured_text.language.problems import Problem
from structured_text.language.tree import Comment, Expression, Spec, VarBlock, VarDecl, VarKind
from structured_text.language.types import ELEMENTARY

_XHTML = "http://www.w3.org/1999/xhtml"
_VENDOR = "http://www.3s-software.com/plcopenxml/"
_SECTIONS = {
    VarKind.INPUT: "inputVars", VarKind.OUTPUT: "outputVars", VarKind.IN_OUT: "inOutVars", VarKind.LOCAL: "localVars",
    VarKind.TEMP: "tempVars", VarKind.EXTERNAL: "externalVars",
}  # fmt: skip
_QUALIFIERS = {"CONSTANT": "constant", "RETAIN": "retain", "NON_RETAIN": "nonretain", "PERSISTENT": "persistent"}
_WORDS = {"FUNCTION": "function", "FUNCTION_BLOCK": "functionBlock", "PROGRAM": "program"}
_SHORT = {"TIME_OF_DAY": "TOD", "DATE_AND_TIME": "DT"}
_NO_XML = re.compile(r"[^\t\n -\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")


@dataclass(frozen=True)
class Dialect:
    """How a file is written: `plain` is CODESYS's way, with each declaration a second time, as text.

    `marks` are texts that its readers take for their own.
    """

    namespace: str
    plain: bool
    marks: tuple[str, ...] = ()

    def text(self, text: str) -> Element:
        """A text as readers of the dialect expect it."""
        if self.plain:
            return Element("xhtml", {"xmlns": _XHTML}, text=escaped(text))
        return Element("xhtml:p", {}, text=cdata(text))

    def documentation(self, text: str) -> Element | None:
        """The documentation of what holds it; nothing for no text."""
        return element("documentation", {}, self.text(text)) if text else None


NEUTRAL = Dialect("http://www.plcopen.org/xml/tc6_0201", False, ("]]>", "<![CDATA[", "<xhtml:p>", "</xhtml:p>"))
"""TC6 2.01. Beremiz and its relatives put tags around every CDATA section that is not inside theirs."""
CODESYS = Dialect("http://www.plcopen.org/xml/tc6_0200", True)


def project(dialect: Dialect, name: str, version: str, *content: Element | None) -> str:
    """A whole file: always the same date, since the same blocks give the same file."""
    product = {"companyName": "DriveBlocks", "productName": "DriveBlocks", "productVersion": version}
    scales = [element(each, {}, element("scaling", {"x": "10", "y": "10"})) for each in ("fbd", "ld", "sfc")]
    spaces = {"xmlns": dialect.namespace, "xmlns:xhtml": None if dialect.plain else _XHTML}
    whole = element(
        "project",
        spaces,
        element("fileHeader", {**product, "creationDateTime": "2000-01-01T00:00:00"}),
        element("contentHeader", {"name": name}, element("coordinateInfo", {}, *scales)),
        *content,
    )
    return "\n".join(['<?xml version="1.0" encoding="utf-8"?>', *whole.lines(), ""])


def types(parts: Iterable[Element]) -> Element:
    """The types and program units of a file, each kind in the order of its use."""
    parts = tuple(parts)
    kinds = (("dataTypes", "dataType"), ("pous", "pou"))
    return element("types", {}, *(element(name, {}, *(e for e in parts if e.tag == tag)) for name, tag in kinds))


def vendor(name: str, content: Element, *, keep: bool = False) -> Element:
    """What only CODESYS reads: others may drop it."""
    return element("data", {"name": _VENDOR + name, "handleUnknown": "implementation" if keep else "discard"}, content)


def written(part: Part, dialect: Dialect, problems: list[Problem], extra: Sequence[Element] = ()) -> Element:
    """A part as `dataType` or `pou`, with extra data; what the dialect cannot say is added to the problems."""
    return _Sheet(part, dialect, problems).whole(extra)


def refused(part: Part, at: int, text: str) -> Problem:
    """Something that a part says and a target cannot."""
    return Problem(part.unit.path, *part.unit.place(at), text, "export")


@dataclass
class _Sheet:
    """One part while it is written; `used` are the comments that have found their place."""

    part: Part
    dialect: Dialect
    problems: list[Problem]
    used: set[int] = field(default_factory=set)

    def refuse(self, at: int, text: str) -> None:
        self.problems.append(refused(self.part, at, text))

    def whole(self, extra: Sequence[Element]) -> Element:
        one = self.part.element
        self.used.add(self.part.unit.comments[0].at)
        head = "\n".join(line.removeprefix("   ") for line in self.part.head.split("\n"))
        made = self.type(one, head, extra) if isinstance(one, tree.TypeDecl) else self.pou(one, head, extra)
        self.characters()
        self.comments(one)
        return made

    def type(self, one: tree.TypeDecl, head: str, extra: Sequence[Element]) -> Element:
        documented = "\n".join(filter(None, (head, self.documented(one.leading, one.trailing))))
        return element(
            "dataType",
            {"name": one.name},
            element("baseType", {}, self.spec(one.spec)),
            self.initial(one.initial),
            element("addData", {}, *extra) if extra else None,
            self.dialect.documentation(documented),
        )

    def pou(self, one: tree.Pou, head: str, extra: Sequence[Element]) -> Element:
        """CODESYS has the documentation of a block last in its interface, others beside it."""
        for odd in one.extras:
            self.refuse(odd.at, f"{odd.word} has no form in this XML; write it as a block or function of its own")
        if isinstance(one, tree.FunctionBlock) and one.heritage:
            self.refuse(one.at, f"`{one.heritage}` has no form in this XML; write the block without")
        above, below = (head, "") if self.dialect.plain else ("", head)
        returns = one.returns if isinstance(one, tree.Function) else None
        interface = element(
            "interface",
            {},
            element("returnType", {}, self.spec(returns)) if returns else None,
            *(self.section(block) for block in one.blocks),
            self.dialect.documentation("\n".join(filter(None, (above, self.documented(one.head, None))))),
        )
        return element(
            "pou",
            {"name": one.name, "pouType": _WORDS[one.word]},
            interface,
            element("body", {}, element("ST", {}, self.dialect.text(self.part.body))),
            element("addData", {}, *extra) if extra else None,
            self.dialect.documentation(below),
        )

    def section(self, block: VarBlock) -> Element | None:
        if block.kind not in _SECTIONS:
            self.refuse(block.at, f"{block.kind.value} has no form in this XML; a variable is VAR, a parameter or TEMP")
            return None
        for word in block.qualifiers:
            if word not in _QUALIFIERS:
                self.refuse(block.at, f"{word} has no form in this XML; right are {', '.join(_QUALIFIERS)}")
        return element(
            _SECTIONS[block.kind],
            {flag: "true" for word, flag in _QUALIFIERS.items() if word in block.qualifiers},
            *map(self.variable, block.variables),
            self.dialect.documentation(self.documented(block.leading, None)),
        )

    def variable(self, one: VarDecl) -> Element:
        if one.edge:
            self.refuse(one.at, f"{one.edge} has no form in this XML; call R_TRIG in the body")
        return element(
            "variable",
            {"name": one.name, "address": one.address},
            element("type", {}, self.spec(one.spec)),
            self.initial(one.initial),
            self.dialect.documentation(self.documented(one.leading, one.trailing)),
        )

    def spec(self, spec: Spec) -> Element:
        if isinstance(spec, tree.NamedSpec):
            word = spec.name.upper()
            return element(_SHORT.get(word, word)) if word in ELEMENTARY else element("derived", {"name": spec.name})
        if isinstance(spec, tree.StringSpec):
            length = self.said(spec.length) if spec.length is not None else None
            return element("wstring" if spec.wide else "string", {"length": length})
        if isinstance(spec, tree.StructSpec):
            return element("struct", {}, *map(self.variable, spec.fields))
        if isinstance(spec, tree.ArraySpec):
            sides = [self.dimension(spec, one) for one in spec.ranges]
            return element("array", {}, *sides, element("baseType", {}, self.spec(spec.element)))
        self.refuse(spec.at, "this type is not written as XML; a type is an array, a structure or a name")
        return element("derived", {"name": "?"})

    def dimension(self, spec: Spec, bounds: tree.Range | None) -> Element:
        if bounds is None:
            self.refuse(spec.at, "ARRAY[*] has no form in this XML; write the bounds")
            return element("dimension")
        return element("dimension", {"lower": self.said(bounds.low), "upper": self.said(bounds.high)})

    def initial(self, value: Expression | None) -> Element | None:
        return element("initialValue", {}, self.value(value)) if value is not None else None

    def value(self, value: Expression) -> Element:
        if isinstance(value, tree.ArrayInitial):
            return element("arrayValue", {}, *map(self.item, value.items))
        if isinstance(value, tree.StructInitial):
            return element("structValue", {}, *map(self.member, value.items))
        return element("simpleValue", {"value": self.said(value)})

    def item(self, value: Expression) -> Element:
        if not isinstance(value, tree.Repeat):
            return element("value", {}, self.value(value))
        inner = self.value(value.value) if value.value is not None else None
        return element("value", {"repetitionValue": self.said(value.count)}, inner)

    def member(self, one: tree.Argument) -> Element:
        return element("value", {"member": one.name}, self.value(one.value) if one.value is not None else None)

    def said(self, value: Expression) -> str:
        """A literal, a name, or either with a sign, as written."""
        if isinstance(value, tree.Literal):
            return value.text
        if isinstance(value, tree.Unary) and value.op in "+-":
            return value.op + self.said(value.operand)
        if isinstance(value, tree.Name):
            return value.name
        if isinstance(value, tree.Member):
            return f"{self.said(value.base)}.{value.name}"
        if isinstance(value, tree.Qualified):
            return f"{value.type_name}#{value.name}"
        self.refuse(value.at, "an expression has no form as a value in this XML; write what it comes to")
        return ""

    def documented(self, leading: Iterable[Comment], trailing: Comment | None) -> str:
        """The comments of one declaration, one to a line."""
        comments = [one for one in (*leading, trailing) if one is not None and one.at not in self.used]
        self.used |= {one.at for one in comments}
        for one in comments:
            if one.style != "(*":
                self.refuse(one.at, f"a comment by `{one.style}` would not come back as it is; write (* *)")
        return "\n".join(" ".join(one.text.split()) for one in comments)

    def comments(self, one: Declared) -> None:
        """No comment may be lost: outside of the body each belongs to a declaration."""
        begin = one.at + len(self.part.declaration) if isinstance(one, tree.Pou) else one.end
        for comment in self.part.unit.comments:
            inside = isinstance(one, tree.Pou) and begin <= comment.at < one.end
            if not inside and comment.at not in self.used:
                self.refuse(comment.at, "a comment that belongs to no declaration would be lost; put it after one")

    def characters(self) -> None:
        for at, text in _marks(self.part.text, self.dialect.marks):
            self.refuse(at, f"`{text}` has no form in this XML; write it with a blank in it")
        for match in _NO_XML.finditer(self.part.text):
            self.refuse(match.start(), f"character {ord(match[0]):04X}H has no form in XML; leave it out")


def _marks(text: str, marks: tuple[str, ...]) -> Iterator[tuple[int, str]]:
    for mark in marks:
        for match in re.finditer(re.escape(mark), text):
            yield match.start(), mark
