"""From what the C and the ST declare to nodes that read and write memory.

Every number that depends on the C compiler is asked for as a C expression (`offsetof(BLOCK, X.value)`). So the same
walk runs twice: once to collect the expressions for the runtime, once with the numbers that the library gives.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

from structured_text.engines.engine import EngineError
from structured_text.engines.matiec.declarations import ArrayOf, Declarations, Named, Record, Spec, Unit
from structured_text.engines.matiec.header import (
    AliasType,
    ArrayType,
    Block,
    EnumType,
    Function,
    Header,
    Member,
    Storage,
    StructType,
)
from structured_text.engines.matiec.layout import (
    ArrayNode,
    Node,
    Part,
    PointerNode,
    RecordNode,
    boolean,
    floating,
    integer,
    span,
    text,
)

Measure = Callable[[str], int]

_INTEGERS = {
    "SINT": "b", "INT": "h", "DINT": "i", "LINT": "q", "USINT": "B", "UINT": "H", "UDINT": "I", "ULINT": "Q",
    "BYTE": "B", "WORD": "H", "DWORD": "I", "LWORD": "Q",
}  # fmt: skip
_SPANS = ("TIME", "DATE", "TOD", "DT")
_VALUE = {
    Storage.VALUE: ".value", Storage.POINTER: ".value", Storage.LOCATED: ".value",
    Storage.BLOCK: "", Storage.BLOCK_POINTER: "",
}  # fmt: skip
# Every block has them, and no ST declares them.
IMPLICIT = ("EN", "ENO")


class Expressions:
    """A Measure that collects; the order is the order of first use."""

    def __init__(self) -> None:
        self.found: dict[str, None] = {}

    def __call__(self, expression: str) -> int:
        """Note the expression; the answer does for any size."""
        self.found[expression] = None
        return 1


@dataclass
class Plan:
    """All nodes: blocks (those of the sources and the standard ones inside them) and functions."""

    blocks: dict[str, RecordNode] = field(default_factory=dict)
    functions: dict[str, "Signature"] = field(default_factory=dict)


@dataclass(frozen=True)
class Signature:
    """A function's parameters in the order of the C call, and its result."""

    parameters: dict[str, Node]
    result: Node


@dataclass
class Planner:
    """Builds nodes; `standard` gives the blocks of matiec's own headers."""

    header: Header
    standard: Callable[[], Mapping[str, Block]]
    declared: Declarations
    measure: Measure
    plan: Plan = field(default_factory=Plan)

    def blocks(self) -> None:
        """Plan every block and function of the sources. Raises EngineError for what nobody knows."""
        for name in self.header.blocks:
            self.block(name)
        for function in self.header.functions.values():
            self.plan.functions[function.name] = self._signature(function)

    def block(self, name: str) -> RecordNode:
        """Plan a block and all inside it."""
        if name not in self.plan.blocks:
            block = self.header.blocks.get(name) or self.standard().get(name)
            if block is None:
                raise EngineError(f"the C of iec2c has a variable of type {name}, which is not known")
            self.plan.blocks[name] = self._record_of_block(block)
        return self.plan.blocks[name]

    def node(self, type_name: str, spec: Spec | None) -> Node:
        spec = self.declared.resolve(spec)
        if type_name == "BOOL":
            return boolean()
        if code := _INTEGERS.get(type_name):
            return integer(type_name, code)
        if type_name in ("REAL", "LREAL"):
            return floating("f" if type_name == "REAL" else "d")
        if type_name in _SPANS:
            return span(self.measure(f"sizeof((({type_name} *)0)->tv_sec)"))
        if type_name == "STRING":
            return self._text()
        return self._declared(type_name, spec)

    def _text(self) -> Node:
        length = self.measure("sizeof(((STRING *)0)->len)")
        return text(length, self.measure("offsetof(STRING, body)"), self.measure("sizeof(((STRING *)0)->body)"))

    def _declared(self, type_name: str, spec: Spec | None) -> Node:
        declared = self.header.types.get(type_name)
        match declared:
            case ArrayType(base, lengths):
                return self._array(base, lengths, spec)
            case StructType():
                return self._record(type_name, declared, spec)
            case EnumType(names):
                code = {1: "B", 2: "H", 8: "Q"}.get(self.measure(f"sizeof({type_name})"), "I")
                return integer(type_name, code, max(len(names) - 1, 0))
            case AliasType(base):
                return self.node(base, spec)
        raise EngineError(f"the C of iec2c has a variable of type {type_name}, which is not known")

    def _array(self, base: str, lengths: tuple[int, ...], spec: Spec | None) -> ArrayNode:
        bounds = tuple((0, length - 1) for length in lengths)
        element = None
        if isinstance(spec, ArrayOf):
            element = spec.element
            if tuple(high - low + 1 for low, high in spec.bounds) != lengths:
                raise EngineError(f"iec2c made an array of {lengths} elements of ARRAY{list(spec.bounds)}")
            bounds = spec.bounds
        return ArrayNode(self.node(base, element), bounds, self.measure(f"sizeof({base})"))

    def _record(self, name: str, struct: StructType, spec: Spec | None) -> RecordNode:
        specs = spec.fields if isinstance(spec, Record) else {}
        parts = {
            each: Part(self.measure(f"offsetof({name}, {each})"), self.node(type_name, specs.get(each)))
            for type_name, each in struct.fields
        }
        return RecordNode(self.measure(f"sizeof({name})"), parts)

    def _record_of_block(self, block: Block) -> RecordNode:
        unit = self.declared.units.get(block.name)
        parts = dict(self._part(block.name, member, unit) for member in block.members)
        if unit is not None:  # the C puts the interface first; the ST may declare it anywhere
            places = {name: place for place, name in enumerate(unit.variables)}
            parts = dict(sorted(parts.items(), key=lambda each: places.get(each[0], -1)))
        return RecordNode(self.measure(f"sizeof({block.name})"), parts)

    def _part(self, owner: str, member: Member, unit: Unit | None) -> tuple[str, Part]:
        variable = unit.variables.get(member.name) if unit else None
        node = self._held(member.type, member.storage, variable.spec if variable else Named(member.type))
        offset = self.measure(f"offsetof({owner}, {member.name}{_VALUE[member.storage]})")
        # Inside a standard block each engine may keep what it likes; a VAR_TEMP does not outlive the scan.
        listed = variable.section != "VAR_TEMP" if variable else member.interface and unit is None
        constant = variable is not None and "CONSTANT" in variable.section
        return member.name, Part(offset, node, listed and member.name not in IMPLICIT, constant)

    def _held(self, type_name: str, storage: Storage, spec: Spec | None) -> Node:
        if storage is Storage.BLOCK:
            return self.block(type_name)
        if storage is Storage.BLOCK_POINTER:
            return PointerNode(self.block(type_name))
        node = self.node(type_name, spec)
        return node if storage is Storage.VALUE else PointerNode(node)

    def _signature(self, function: Function) -> Signature:
        unit = self.declared.units.get(function.name)
        variables = unit.variables if unit else {}
        parameters = {
            name: self.node(type_name, variables[name].spec if name in variables else None)
            for type_name, name, _ in function.parameters
        }
        return Signature(parameters, self.node(function.result, None))
