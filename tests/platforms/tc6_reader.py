"""A reader of TC6 files in both dialects: it knows the format, and nothing of how the files are written."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cached_property
from itertools import pairwise

from lxml import etree
from tests.platforms.tc6_form import Row, Unit, single

VENDOR = "http://www.3s-software.com/plcopenxml/"
XHTML = "{http://www.w3.org/1999/xhtml}"
SECTIONS = {
    "inputVars": "VAR_INPUT", "outputVars": "VAR_OUTPUT", "inOutVars": "VAR_IN_OUT", "localVars": "VAR",
    "tempVars": "VAR_TEMP", "externalVars": "VAR_EXTERNAL",
}  # fmt: skip
KINDS = {"function": "FUNCTION", "functionBlock": "FUNCTION_BLOCK", "program": "PROGRAM"}
HEADS = {"p": "documentation", "xhtml": "interface/documentation"}
"""Where a dialect has the head of a block."""
Node = etree._Element
Point = tuple[int, int]


@dataclass(frozen=True)
class Rung:
    """What is wired in a ladder: pins of blocks and coils, each with its source, and what is wrong or said beside.

    `order` has what is executed by a number, in the order of these numbers: names of blocks and of variables.
    """

    calls: dict[str, dict[str, str]] = field(default_factory=dict)
    coils: dict[str, str] = field(default_factory=dict)
    loose: list[str] = field(default_factory=list)
    remarks: list[str] = field(default_factory=list)
    order: dict[int, str] = field(default_factory=dict)


@dataclass(frozen=True)
class Box:
    """What a ladder shows at a place, in pixels; y goes down."""

    what: str
    left: int
    top: int
    right: int
    bottom: int

    def near(self, other: "Box", room: int) -> bool:
        """Whether there is less than some room between the two."""
        across = self.left < other.right + room and other.left < self.right + room
        return across and self.top < other.bottom + room and other.top < self.bottom + room


NAME = (8, 12, 2)
"""Of a name above a contact, a coil or a block: width of a letter, height, and distance; as Beremiz draws it."""


@dataclass(frozen=True)
class File:
    """A file of one dialect: `tag` holds the text of bodies and comments."""

    text: str
    namespace: str
    tag: str

    @cached_property
    def root(self) -> Node:
        """The project; raises XMLSyntaxError."""
        root = etree.fromstring(self.text.encode("utf-8"))
        assert root.tag == f"{{{self.namespace}}}project", root.tag
        return root

    def all(self, path: str, node: Node | None = None) -> list[Node]:
        """Elements by a path of plain names."""
        steps = [f"t:{step}" if step[:1].isalpha() else step for step in path.split("/")]
        return (self.root if node is None else node).findall("/".join(steps), {"t": self.namespace})

    def one(self, path: str, node: Node) -> Node | None:
        """The first element by a path."""
        return next(iter(self.all(path, node)), None)

    def named(self) -> list[str]:
        """The names of all types, then of all program units."""
        return [each.get("name", "") for each in self.all("types/dataTypes/dataType") + self.all("types/pous/pou")]

    def written(self, node: Node | None) -> str:
        """The text in an element that holds one."""
        if node is None:
            return ""
        assert [child.tag for child in node] == [XHTML + self.tag], [child.tag for child in node]
        return "".join(str(each) for each in node[0].itertext())

    @cached_property
    def units(self) -> list[Unit]:
        """Everything that is declared; a ladder has no body."""
        return list(self.read())

    def read(self) -> Iterator[Unit]:
        """Read what is declared."""
        for node in self.all("types/dataTypes/dataType"):
            yield self.type(node)
        for node in self.all("types/pous/pou"):
            rows = [row for part in self.all("interface/*", node) for row in self.section(part)]
            returns = self.one("interface/returnType", node)
            yield Unit(
                KINDS[node.get("pouType", "")],
                node.get("name", ""),
                self.said(returns) if returns is not None else "",
                single(self.written(self.one(HEADS[self.tag], node))),
                tuple(rows),
                self.written(self.one("body/ST", node)),
            )

    def type(self, node: Node) -> Unit:
        """A dataType."""
        name, base = node.get("name", ""), self.all("baseType", node)[0]
        struct = self.one("struct", base)
        if struct is None:
            rows = [Row("TYPE", name, self.said(base), self.initial(node))]
        else:
            rows = [self.row("STRUCT", each) for each in self.all("variable", struct)]
        return Unit("TYPE", name, "", single(self.written(self.one("documentation", node))), tuple(rows), "")

    def section(self, node: Node) -> Iterator[Row]:
        """A list of variables."""
        word = SECTIONS.get(etree.QName(node).localname)
        if word:
            flags = "".join(f" {flag.upper()}" for flag in ("constant", "retain") if node.get(flag) == "true")
            yield from (self.row(word + flags, each) for each in self.all("variable", node))

    def row(self, section: str, node: Node) -> Row:
        """A variable."""
        comment = single(self.written(self.one("documentation", node)))
        return Row(section, node.get("name", ""), self.said(self.all("type", node)[0]), self.initial(node), comment)

    def said(self, holder: Node) -> str:
        """The type in an element, in tokens of ST."""
        (node,) = holder
        tag = etree.QName(node).localname
        if tag == "derived":
            return node.get("name", "")
        if tag == "array":
            sides = [f"{each.get('lower')} .. {each.get('upper')}" for each in self.all("dimension", node)]
            return f"ARRAY [ {' , '.join(sides)} ] OF {self.said(self.all('baseType', node)[0])}"
        return tag.upper()

    def initial(self, holder: Node) -> str:
        """The initial value in an element, in tokens of ST."""
        node = self.one("initialValue", holder)
        return self.value(node) if node is not None else ""

    def value(self, holder: Node) -> str:
        """A value in an element."""
        (node,) = holder
        tag = etree.QName(node).localname
        if tag == "simpleValue":
            return node.get("value", "")
        if tag == "structValue":
            return _listed("()", [f"{each.get('member')} := {self.value(each)}" for each in node])
        times = [(each.get("repetitionValue"), self.value(each)) for each in node]
        return _listed("[]", [f"{count} ( {one} )" if count else one for count, one in times])

    def data(self, name: str, node: Node) -> list[Node]:
        """What the vendor's extension of a name holds, of an element or of the project."""
        return [child for each in self.all("addData/data", node) if each.get("name") == VENDOR + name for child in each]

    def ladder(self, pou: Node) -> Rung:
        """The ladder of a program, wire by wire."""
        body = self.all("body/LD", pou)[0]
        if self.tag == "xhtml":
            return self.networks(body)
        drawn = {each.get("localId", ""): each for each in body}
        assert len(drawn) == len(body), "a number twice"
        made = Rung()
        for node in body:
            tag = etree.QName(node).localname
            if tag == "block":
                pins = self.all("inputVariables/variable", node)
                remarks = (self.written(self.one("documentation", pin)) for pin in pins)
                made.remarks.extend(filter(None, remarks))
                name = node.get("instanceName", "")
                made.calls[name] = {
                    pin.get("formalParameter", ""): source
                    for pin in pins
                    if (source := self.source(self.all("connectionPointIn", pin)[0], node, drawn, made))
                }
            elif tag in ("coil", "outVariable"):
                name = self.all("variable" if tag == "coil" else "expression", node)[0].text or ""
                made.coils[name] = node.get("storage", "") + self.source(
                    self.all("connectionPointIn", node)[0], node, drawn, made
                )
            elif tag == "rightPowerRail":
                for pin in self.all("connectionPointIn", node):
                    self.source(pin, node, drawn, made)
            if number := int(node.get("executionOrderId", 0)):
                assert number not in made.order
                made.order[number] = name
        return made

    def networks(self, body: Node) -> Rung:
        """The ladder of a program in CODESYS's form: network by network, a comment and a title in front of each."""
        drawn = {each.get("localId", ""): each for each in body}
        assert len(drawn) == len(body), "a number twice"
        assert {(each.get("x"), each.get("y")) for each in self.all("*/position", body)} == {("0", "0")}
        made, titled = Rung(), 0
        for node in body:
            tag, name = etree.QName(node).localname, ""
            if tag == "vendorElement":
                assert [each.text for each in self.data("fbdelementtype", node)] == ["networktitle"]
                titled += 1
            elif tag == "coil":
                name = self.all("variable", node)[0].text or ""
                storage = node.get("storage", "").removeprefix("none")
                made.coils[name] = storage + self.power(node, drawn, made)
            elif tag == "block":
                name = self.called(node, drawn, made)
            if name:
                made.order[titled] = name
        assert len(made.order) == titled == len(self.all("comment", body))
        return made

    def called(self, node: Node, drawn: dict[str, Node], made: Rung) -> str:
        """A box: the call of an instance, or a MOVE; EN is on the rail."""
        pins = {pin.get("formalParameter", ""): pin for pin in self.all("inputVariables/variable", node)}
        values = {name: self.power(pin, drawn, made) for name, pin in pins.items()}
        assert values.pop("EN") == "TRUE"
        kinds = [each.text for each in self.data("fbdcalltype", node)]
        (types,) = (str(each.text).split() for each in self.data("inputparamtypes", node))
        ends = {
            pin.get("formalParameter", ""): "".join(
                each.text or "" for each in self.all("connectionPointOut/expression", pin)
            )
            for pin in self.all("outputVariables/variable", node)
        }
        if node.get("typeName") == "MOVE":
            assert (kinds, list(ends), types) == (["operator"], ["ENO", "Out2"], ["BOOL"])
            made.coils[ends["Out2"]] = values["In2"]
            return ends["Out2"]
        assert (kinds, len(types)) == (["functionblock"], len(pins))
        assert not any(ends.values())
        made.calls[node.get("instanceName", "")] = values
        return node.get("instanceName", "")

    def power(self, node: Node, drawn: dict[str, Node], made: Rung) -> str:
        """What a coil, a contact or a pin is wired to; several wires are an OR."""
        found = [self.before(drawn[each.get("refLocalId", "")], drawn, made)
                 for each in self.all("connectionPointIn/connection", node)]  # fmt: skip
        return found[0] if len(found) == 1 else f"({' OR '.join(found)})"

    def before(self, node: Node, drawn: dict[str, Node], made: Rung) -> str:
        """What an element gives to the right."""
        tag = etree.QName(node).localname
        if tag == "leftPowerRail":
            return "TRUE"
        if tag == "inVariable":
            return self.all("expression", node)[0].text or ""
        assert (tag, node.get("edge"), node.get("storage")) == ("contact", "none", "none")
        said = self.all("variable", node)[0].text or ""
        said = f"NOT {said}" if node.get("negated") == "true" else said
        before = self.power(node, drawn, made)
        return said if before == "TRUE" else f"{before} AND {said}"

    def boxes(self, pou: Node) -> list[Box]:
        """Everything that is drawn in the ladder of a program, but for its wires; names above count as theirs."""
        return [self.box(node) for node in self.all("body/LD", pou)[0]]

    def box(self, node: Node) -> Box:
        """The place of an element, with the name that an editor writes above it."""
        x, y = _at(self.all("position", node)[0])
        width, height = int(node.get("width", "")), int(node.get("height", ""))
        named = self.one("variable", node)
        name = (named.text or "" if named is not None else "") or node.get("instanceName", "")
        letter, tall, above = NAME
        beside = max(0, letter * len(name) - width + 1) // 2
        top = y - (tall + above if name else 0)
        return Box(f"{node.get('localId')} {name}", x - beside, top, x + width + beside, y + height)

    def source(self, pin: Node, node: Node, drawn: dict[str, Node], made: Rung) -> str:
        """What a pin is wired to, in ST; several wires are an OR. Each must begin and end where the pins are."""
        found = []
        for wire in self.all("connection", pin):
            other, name = drawn[wire.get("refLocalId", "")], wire.get("formalParameter", "")
            ends = [_at(each) for each in self.all("position", wire)]
            bent = any(a[0] != b[0] and a[1] != b[1] for a, b in pairwise(ends))
            if bent or ends[0] != self.place(pin, node) or ends[-1] not in self.outs(other, name):
                made.loose.append(f"{wire.get('refLocalId')} to {node.get('localId')}: {ends}")
            found.append(self.given(other, name, drawn, made))
        return found[0] if len(found) == 1 else f"({' OR '.join(found)})" if found else ""

    def given(self, node: Node, pin: str, drawn: dict[str, Node], made: Rung) -> str:
        """What an element gives to the right."""
        tag = etree.QName(node).localname
        if tag == "leftPowerRail":
            return "TRUE"
        if tag == "block":
            return f"{node.get('instanceName')}.{pin}"
        said = self.all("variable" if tag in ("contact", "coil") else "expression", node)[0].text or ""
        if tag != "contact":
            return said
        before = self.source(self.all("connectionPointIn", node)[0], node, drawn, made)
        assert before, "a contact that hangs on nothing"
        said = f"NOT {said}" if node.get("negated") == "true" else said
        return said if before == "TRUE" else f"{before} AND {said}"

    def outs(self, node: Node, pin: str) -> list[Point]:
        """Where the pins on the right of an element are; of a block, the one of that name."""
        if etree.QName(node).localname != "block":
            return [self.place(each, node) for each in self.all("connectionPointOut", node)]
        named = [each for each in self.all("outputVariables/variable", node) if each.get("formalParameter") == pin]
        return [self.place(self.all("connectionPointOut", each)[0], node) for each in named]

    def place(self, pin: Node, node: Node) -> Point:
        """Where a pin of an element is."""
        (x, y), (right, down) = _at(self.all("position", node)[0]), _at(self.all("relPosition", pin)[0])
        return x + right, y + down


def _listed(marks: str, items: list[str]) -> str:
    return f"{marks[0]} {' , '.join(items)} {marks[1]}"


def _at(node: Node) -> Point:
    return int(node.get("x", "")), int(node.get("y", ""))
