"""A program of calls and assignments as a ladder in CODESYS's form: a network for each statement.

The form is that of exports in public repositories: nothing has a place, since the editor lays a network out by its
wires; a comment and a title begin each; a call is a box on the rail by EN, and what is wired to it is a value.
"""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field

from driveblocks.platforms.element import Element, element, escaped
from driveblocks.platforms.ladder import is_bool, said
from driveblocks.platforms.part import Part
from driveblocks.platforms.tc6 import CODESYS, vendor
from structured_text.language import tree
from structured_text.language.tree import Expression, FunctionBlock, VarDecl, VarKind

Wire = tuple[int, str | None]
"""Where a wire begins: the number of an element, and the pin of a box."""
_RAIL: Wire = (0, None)
_RIGHT = 2147483646
"""The number of the right rail in every export."""
_PINS = (VarKind.INPUT, VarKind.IN_OUT)


def diagram(part: Part, blocks: Mapping[str, FunctionBlock]) -> Element:
    """A program as the element LD of CODESYS; `blocks` are those that it calls, by name."""
    assert isinstance(part.element, tree.Program)  # noqa: S101  (the first motor is a program)
    return element("LD", {}, *_Networks(part.element, blocks).whole())


@dataclass
class _Networks:
    program: tree.Program
    known: Mapping[str, FunctionBlock]
    last: int = 0
    written: list[Element] = field(default_factory=list)

    def whole(self) -> Iterator[Element]:
        yield element("leftPowerRail", {"localId": "0"}, _place(), element("connectionPointOut", _NONE))
        for statement in self.program.body:
            self.begin()
            if isinstance(statement, tree.CallStatement):
                self.call(statement.call)
            elif isinstance(statement, tree.Assign):
                self.assign(statement)
        yield from self.written
        yield element("rightPowerRail", {"localId": str(_RIGHT)}, _place(), element("connectionPointIn"))

    def put(self, tag: str, attributes: Mapping[str, str], *content: Element | None, number: int | None = None) -> int:
        own = self.number() if number is None else number
        self.written.append(element(tag, {"localId": str(own), **attributes}, _place(), *content))
        return own

    def number(self) -> int:
        self.last += 1
        return self.last

    def begin(self) -> None:
        """What is at the top of each network."""
        self.put("comment", {"height": "0", "width": "0"}, element("content", {}, CODESYS.text("")))
        title = vendor("fbdelementtype", Element("ElementType", {"xmlns": ""}, text="networktitle"), keep=True)
        self.put("vendorElement", {}, element("alternativeText", {}, CODESYS.text("")), element("addData", {}, title))

    def call(self, call: tree.Call) -> None:
        """A box with EN on the rail; a pin that nothing is wired to is left out, and keeps its usual value."""
        instance = said(call.callee)
        spec = self.declared(instance).spec
        assert isinstance(spec, tree.NamedSpec)  # noqa: S101  (an instance has the name of its block)
        pins = [v for kind in _PINS for b in self.known[spec.name].blocks if b.kind is kind for v in b.variables]
        outputs = [v for b in self.known[spec.name].blocks if b.kind is VarKind.OUTPUT for v in b.variables]
        given = {each.name: each.value for each in call.arguments if each.value is not None}
        wired = [pin for pin in pins if pin.name in given]
        types = " ".join(["BOOL", *(pin.type.name.upper() for pin in wired)])
        box = self.number()
        values = [self.value(said(given[pin.name])) for pin in wired]
        ins = [
            _pin("EN", _wires([_RAIL])),
            *(_pin(p.name, _wires([(n, None)])) for p, n in zip(wired, values, strict=True)),
        ]
        ends = [_pin("ENO", element("connectionPointOut")), *(_pin(v.name, _out("")) for v in outputs)]
        self.box({"typeName": spec.name, "instanceName": instance}, ins, ends, ("functionblock", types), box)

    def box(
        self, named: dict[str, str], ins: Iterable[Element], ends: Iterable[Element], what: tuple[str, str], number: int
    ) -> None:
        kind, types = what
        data = [
            vendor("fbdcalltype", Element("CallType", {"xmlns": ""}, text=kind), keep=True),
            vendor("inputparamtypes", Element("InputParamTypes", {"xmlns": ""}, text=types), keep=True),
        ]
        parts = (element("inputVariables", {}, *ins), element("inOutVariables"), element("outputVariables", {}, *ends))
        self.put("block", named, *parts, element("addData", {}, *data), number=number)

    def assign(self, statement: tree.Assign) -> None:
        """Contacts to a coil, a coil that sets or resets, or a MOVE for other than BOOL."""
        target, value = said(statement.target), statement.value
        if isinstance(value, tree.Literal) and isinstance(value.value, bool):
            self.coil(target, [_RAIL], "set" if value.value else "reset")
        elif isinstance(statement.target, tree.Name) and is_bool(self.declared(target)):
            self.coil(target, self.contacts(value, [_RAIL]), "none")
        else:
            box = self.number()
            source = self.value(said(value))
            ins = [_pin("EN", _wires([_RAIL])), _pin("In2", _wires([(source, None)]))]
            ends = [_pin("ENO", element("connectionPointOut")), _pin("Out2", _out(target))]
            self.box({"typeName": "MOVE"}, ins, ends, ("operator", "BOOL"), box)

    def coil(self, target: str, begin: list[Wire], storage: str) -> None:
        self.put(
            "coil",
            {"negated": "false", "storage": storage},
            _wires(begin),
            element("connectionPointOut"),
            _named(target),
        )

    def contacts(self, value: Expression, begin: list[Wire]) -> list[Wire]:
        """Contacts after what they begin at; where they end."""
        if isinstance(value, tree.Binary) and value.op == "AND":
            return self.contacts(value.right, self.contacts(value.left, begin))
        if isinstance(value, tree.Binary) and value.op == "OR":
            return [*self.contacts(value.left, begin), *self.contacts(value.right, begin)]
        negated = isinstance(value, tree.Unary)
        variable = said(value.operand if isinstance(value, tree.Unary) else value)
        how = {"negated": str(negated).lower(), "storage": "none", "edge": "none"}
        number = self.put("contact", how, _wires(begin), element("connectionPointOut"), _named(variable))
        return [(number, None)]

    def value(self, expression: str) -> int:
        text = Element("expression", {}, text=escaped(expression))
        return self.put("inVariable", {}, element("connectionPointOut"), text)

    def declared(self, name: str) -> VarDecl:
        return next(v for block in self.program.blocks for v in block.variables if v.name == name)


_NONE = {"formalParameter": "none"}


def _place() -> Element:
    return element("position", {"x": "0", "y": "0"})


def _wires(begin: Iterable[Wire]) -> Element:
    wires = (element("connection", {"refLocalId": str(number), "formalParameter": pin}) for number, pin in begin)
    return element("connectionPointIn", {}, *wires)


def _pin(name: str, point: Element) -> Element:
    return element("variable", {"formalParameter": name}, point)


def _out(target: str) -> Element:
    """An output, and the variable that it is assigned to, if any."""
    return element("connectionPointOut", {}, Element("expression", {}, text=escaped(target)))


def _named(variable: str) -> Element:
    return Element("variable", {}, text=escaped(variable))
