"""A program of calls and assignments as a ladder diagram: each call a block, each BOOL a contact or a coil.

AND is contacts in series, OR contacts in parallel, NOT a normally closed contact.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace

from driveblocks.platforms.element import Element, element, escaped
from driveblocks.platforms.part import Part
from driveblocks.platforms.tc6 import NEUTRAL
from structured_text.language import tree
from structured_text.language.tree import Expression, FunctionBlock, VarDecl, VarKind

Point = tuple[int, int]
Source = tuple[int, Point]
"""Where a wire begins: the number of an element, and its pin."""
_RAIL = 40
_CONTACT = 130
_BLOCK = 440
_VALUE = 400
"""Left ends of the left rail, the contacts and the blocks, and the right end of what is wired to a block."""
_NEXT = 150
_ROW = 48
"""From a contact to the next one beside it, with the room of a name; and to the one below it."""
_TITLE = 20
_PITCH = 32
"""Height of a block's title and of each line of pins; Beremiz shares out the rest of the height among the lines.

A value is a box 20 high. Contacts and coils are 21 x 15, their pins 8 below the top, their names above them.
"""


def ladder(written: Element, drawn: Element) -> Element:
    """A program that was written with its text, with the same as a ladder in place of it; see `diagram`."""
    body = element("body", {}, drawn)
    return replace(written, content=tuple(body if each.tag == "body" else each for each in written.content))


def diagram(part: Part, blocks: Mapping[str, FunctionBlock], *, coils: bool = True) -> Element:
    """A program of calls and assignments as the element LD of TC6; `blocks` are those that it calls, by name.

    Without `coils` a BOOL is assigned as other variables are: Beremiz gives those their turn, and coils the last.
    """
    assert isinstance(part.element, tree.Program)  # noqa: S101  (the first motor is a program)
    return element("LD", {}, *_Drawing(part, part.element, blocks, coils).whole())


@dataclass(frozen=True)
class _Block:
    """A call that was drawn: its number, and where the pins on its right are."""

    number: int
    pins: Mapping[str, Point]


@dataclass
class _Drawing:
    """A ladder while it is drawn, from the top down."""

    part: Part
    program: tree.Program
    known: Mapping[str, FunctionBlock]
    coils: bool = True
    y: int = 60
    last: int = 2
    turn: int = 0
    right: int = 0
    """Where the widest variable ends."""
    drawn: list[Element] = field(default_factory=list)
    starts: list[int] = field(default_factory=list)
    ends: list[tuple[int, Point]] = field(default_factory=list)
    blocks: dict[str, _Block] = field(default_factory=dict)

    def whole(self) -> Iterator[Element]:
        for statement in self.program.body:
            self.turn += 1
            if isinstance(statement, tree.CallStatement):
                self.block(statement.call)
            elif isinstance(statement, tree.Assign):
                self.coil(statement)
        width = max([self.right, *(x for _, (x, _) in self.ends)]) + 60
        yield _rail("leftPowerRail", 1, _RAIL, self.y, [_pin("Out", (3, y), rail=True) for y in self.starts])
        ends = [_pin("In", (0, y), _link(number, (width, y), (x, y))) for number, (x, y) in self.ends]
        yield _rail("rightPowerRail", 2, width, self.y, ends)
        yield from self.drawn

    def number(self) -> int:
        self.last += 1
        return self.last

    def declared(self, name: str) -> VarDecl:
        return next(v for block in self.program.blocks for v in block.variables if v.name == name)

    def is_bool(self, value: Expression) -> bool:
        """Whether a variable, or an output of a block, is a BOOL."""
        if isinstance(value, tree.Name):
            return is_bool(self.declared(value.name))
        kinds = {v.name: v.spec for block in self.program.blocks for v in block.variables}
        kind = kinds.get(said(value.base)) if isinstance(value, tree.Member) else None
        if not (isinstance(value, tree.Member) and isinstance(kind, tree.NamedSpec) and kind.name in self.known):
            return False  # what is global, or in a structure, is drawn as a value
        return any(is_bool(pin) for pin in self.pins(said(value.base))[1] if pin.name == value.name)

    def pins(self, instance: str) -> tuple[list[VarDecl], list[VarDecl]]:
        """What a block has on its left and on its right: an in-out is on both."""
        named = self.declared(instance).spec
        assert isinstance(named, tree.NamedSpec)  # noqa: S101  (an instance has the name of its block)
        groups = self.known[named.name].blocks
        by = {kind: [v for b in groups if b.kind is kind for v in b.variables] for kind in VarKind}
        both = by[VarKind.IN_OUT]
        return by[VarKind.INPUT] + both, by[VarKind.OUTPUT] + both

    def block(self, call: tree.Call) -> None:
        name = said(call.callee)
        left, right = self.pins(name)
        width = 8 * (max(len(v.name) for v in left) + max(len(v.name) for v in right)) + 30
        height = _TITLE + _PITCH * max(len(left), len(right))
        given, remarks = {each.name: each for each in call.arguments}, self.remarks(call)
        rows = [(v.name, _below(row)) for row, v in enumerate(left)]
        inputs = [self.formal(pin, self.pin(below, given.get(pin)), remarks.get(pin)) for pin, below in rows]
        rows = [(v.name, _below(row)) for row, v in enumerate(right)]
        outputs = [self.formal(pin, _pin("Out", (width, below))) for pin, below in rows]
        spec = self.declared(name).spec
        assert isinstance(spec, tree.NamedSpec)  # noqa: S101
        named = {"typeName": spec.name, "instanceName": name, **self.order()}
        made = _Block(self.number(), {pin: (_BLOCK + width, self.y + below) for pin, below in rows})
        self.drawn.append(
            element(
                "block",
                _sized(made.number, width, height) | named,
                _position(_BLOCK, self.y),
                element("inputVariables", {}, *inputs),
                element("inOutVariables"),
                element("outputVariables", {}, *outputs),
            )
        )
        self.blocks[name] = made
        self.y += height + 2 * _PITCH

    def order(self) -> dict[str, str]:
        """The place of a statement among all, so that what is drawn is done in the order of the text."""
        return {"executionOrderId": str(self.turn)}

    @staticmethod
    def formal(name: str, pin: Element, remark: Element | None = None) -> Element:
        return element("variable", {"formalParameter": name}, pin, remark)

    def remarks(self, call: tree.Call) -> dict[str | None, Element | None]:
        unit, found = self.part.unit, dict[str | None, Element | None]()
        for comment in unit.comments:
            line = [
                each for each in call.arguments if each.at < comment.at and unit.line(each.at) == unit.line(comment.at)
            ]
            if line:
                found[line[-1].name] = NEUTRAL.documentation(" ".join(comment.text.split()))
        return found

    def pin(self, below: int, argument: tree.Argument | None) -> Element:
        """A pin on the left of a block, and what is wired to it: the rail, a contact, or a value."""
        here, place, value = (_BLOCK, self.y + below), (0, below), argument.value if argument else None
        if value is None:
            return _pin("In", place)
        if isinstance(value, tree.Literal) and value.value is True:
            return _pin("In", place, self.rail(here))
        if self.is_bool(value):
            number, there = self.contact(said(value), (_CONTACT, here[1]), [])
        else:
            number, there = self.value(said(value), here[1])
        return _pin("In", place, _link(number, here, there))

    def rail(self, here: Point) -> Element:
        self.starts.append(here[1])
        return _link(1, here, (_RAIL + 3, here[1]))

    def value(self, expression: str, y: int) -> tuple[int, Point]:
        number, width = self.number(), 8 * len(expression) + 20
        x = _VALUE - width
        text = Element("expression", {}, text=escaped(expression))
        place = _position(x, y - 10)
        self.drawn.append(element("inVariable", _sized(number, width, 20), place, _pin("Out", (width, 10)), text))
        return number, (x + width, y)

    def coil(self, statement: tree.Assign) -> None:
        """An assignment: from an output of a block, or of a constant, which sets or resets."""
        target, value = said(statement.target), statement.value
        plain = isinstance(statement.target, tree.Name) and self.is_bool(statement.target)
        if plain and isinstance(value, tree.Name | tree.Unary | tree.Binary):
            self.rung(target, value)
            return
        if isinstance(value, tree.Name):
            self.move(target, value.name)
            return
        if isinstance(value, tree.Literal) and not (self.coils and isinstance(value.value, bool)):
            number, there = self.value(value.text, self.y)
            self.out(target, number, there, None)
            self.y += 2 * _PITCH
            return
        if isinstance(value, tree.Literal):
            start, y = (_RAIL + 3, self.y), self.y
            self.starts.append(y)
            self.y += _PITCH
            self.end(target, start, 1, None, {"storage": "set" if value.value else "reset"})
            return
        assert isinstance(value, tree.Member)  # noqa: S101  (all that the first motor assigns)
        block = self.blocks[said(value.base)]
        self.end(target, block.pins[value.name], block.number, value.name, {})

    def rung(self, target: str, value: Expression) -> None:
        """Contacts from the left rail to a coil."""
        ends, x, below = self.network(value, [], _CONTACT, self.y)
        y, x = self.y, max(x, _BLOCK + 100)
        wires = [_link(one, (x, y), *self.joint(there, x, y)) for one, there in ends]
        self.y = below + 2 * _PITCH
        if not self.coils:
            self.variable(target, (x, y), wires)
            return
        number = self.number()
        name, sized = Element("variable", {}, text=target), {**_sized(number, 21, 15), **self.order()}
        pins = (_pin("In", (0, 8), *wires), _pin("Out", (21, 8)))
        self.drawn.append(element("coil", sized, _position(x, y - 8), *pins, name))
        self.ends.append((number, (x + 21, y)))

    def network(self, value: Expression, begin: list[Source], x: int, y: int) -> tuple[list[Source], int, int]:
        """Contacts after what they begin at, from a place on; where they end, the next place, and the lowest row."""
        if isinstance(value, tree.Binary) and value.op == "AND":
            begin, x, left = self.network(value.left, begin, x, y)
            ends, x, right = self.network(value.right, begin, x, y)
            return ends, x, max(left, right)
        if isinstance(value, tree.Binary) and value.op == "OR":
            above, wide, low = self.network(value.left, begin, x, y)
            below, wider, lowest = self.network(value.right, begin, x, low + _ROW)
            return [*above, *below], max(wide, wider), lowest
        negated = isinstance(value, tree.Unary)
        name = said(value.operand if isinstance(value, tree.Unary) else value)
        return [self.contact(name, (x, y), begin, negated=negated)], x + _NEXT, y

    def contact(self, variable: str, place: Point, begin: list[Source], *, negated: bool = False) -> Source:
        """A contact at a place, wired to the left rail or to what is before it."""
        number, (x, y) = self.number(), place
        wires = [_link(one, place, *self.joint(there, x, y)) for one, there in begin] or [self.rail(place)]
        name, sized = Element("variable", {}, text=escaped(variable)), _sized(number, 21, 15)
        how = {"negated": "true"} if negated else {}
        pins = (_pin("In", (0, 8), *wires), _pin("Out", (21, 8)))
        self.drawn.append(element("contact", sized | how, _position(x, y - 8), *pins, name))
        return number, (x + 21, y)

    @staticmethod
    def joint(there: Point, x: int, y: int) -> tuple[Point, ...]:
        """The way of a wire back from a pin: straight, or by the upright that joins parallel contacts."""
        upright = x - _NEXT // 2 + 21
        return (there,) if there[1] == y else ((upright, y), (upright, there[1]), there)

    def move(self, target: str, source: str) -> None:
        """A variable that gets the value of another."""
        number, there = self.value(source, self.y)
        self.out(target, number, there, None)
        self.y += 2 * _PITCH

    def out(self, target: str, source: int, start: Point, pin: str | None) -> None:
        """Draw a variable at the right end of a wire."""
        place = (max(start[0], _BLOCK) + 100, start[1])
        self.variable(target, place, [_link(source, place, start, pin=pin)])

    def variable(self, target: str, place: Point, wires: list[Element]) -> None:
        where, text = _position(place[0], place[1] - 10), Element("expression", {}, text=target)
        width = 8 * len(target) + 20
        self.right = max(self.right, place[0] + width)
        sized = _sized(self.number(), width, 20) | self.order()
        self.drawn.append(element("outVariable", sized, where, _pin("In", (0, 10), *wires), text))

    def end(self, target: str, start: Point, source: int, pin: str | None, how: Mapping[str, str]) -> None:
        """What is at the right end of a wire: a coil, or for other than BOOL a variable."""
        if not (self.coils and is_bool(self.declared(target))):
            self.out(target, source, start, pin)
            return
        number, (x, y) = self.number(), (max(start[0], _BLOCK) + 100, start[1])
        wire = _pin("In", (0, 8), _link(source, (x, y), start, pin=pin))
        name, sized = Element("variable", {}, text=target), {**_sized(number, 21, 15), **self.order(), **how}
        self.drawn.append(element("coil", sized, _position(x, y - 8), wire, _pin("Out", (21, 8)), name))
        self.ends.append((number, (x + 21, y)))


def _below(row: int) -> int:
    """How far below the top of its block a pin is."""
    return _TITLE + _PITCH // 2 + _PITCH * row


def is_bool(variable: VarDecl) -> bool:
    return isinstance(variable.spec, tree.NamedSpec) and variable.spec.name == "BOOL"


def said(value: Expression) -> str:
    """A name, an element or a literal as written."""
    if isinstance(value, tree.Index):
        return f"{said(value.base)}[{', '.join(map(said, value.indices))}]"
    if isinstance(value, tree.Member):
        return f"{said(value.base)}.{value.name}"
    if isinstance(value, tree.Literal):
        return value.text
    assert isinstance(value, tree.Name)  # noqa: S101  (all that the first motor hands to its blocks)
    return value.name


def _sized(number: int, width: int, height: int) -> dict[str, str]:
    return {"localId": str(number), "width": str(width), "height": str(height)}


def _position(x: int, y: int, tag: str = "position") -> Element:
    return element(tag, {"x": str(x), "y": str(y)})


def _pin(way: str, below: Point, *wires: Element | None, rail: bool = False) -> Element:
    given = {"formalParameter": ""} if rail else {}
    return element(f"connectionPoint{way}", given, _position(*below, "relPosition"), *wires)


def _link(source: int, here: Point, *there: Point, pin: str | None = None) -> Element:
    """A wire, from its end back to its source."""
    given = {"refLocalId": str(source), "formalParameter": pin}
    return element("connection", given, _position(*here), *(_position(*each) for each in there))


def _rail(tag: str, number: int, x: int, height: int, pins: list[Element]) -> Element:
    """A power rail from the top to the bottom."""
    return element(tag, _sized(number, 3, height), _position(x, 0), *pins)
