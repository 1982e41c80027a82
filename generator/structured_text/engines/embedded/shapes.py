"""How values of ST types look in Python: their initial values, their copies, and the classes that hold them.

Scalars are Python's; TIME and the dates are nanoseconds; an array is a list (one list per
dimension), a structure or instance an object with one slot per field. Arrays and structures keep their identity for
life: assignments copy into them, so that references to them (in-outs) stay valid.
"""

from collections.abc import Callable, Sequence
from typing import Any

from structured_text.engines.embedded.certainty import known, present
from structured_text.language import tree
from structured_text.language.tree import Array, Block, Enum, Struct
from structured_text.language.types import TEMPORAL, Kind, Subrange, Type

# Makes an initial value; it is given the globals that instances of blocks see.
Maker = Callable[[Any], Any]
Copier = Callable[[Any, Any], None]
Evaluator = Callable[[tree.Expression, Type], Any]

_PLAIN_SCALARS = (Kind.BOOL, Kind.BITS, Kind.INTEGER, Kind.REAL, Kind.STRING, Kind.ENUM, *TEMPORAL)


def is_scalar(each: Type) -> bool:
    """Whether a value of a type is immutable in Python, so that assigning it copies it."""
    return each.kind in _PLAIN_SCALARS


class Record:
    """A structure or an instance; subclasses have one slot per field."""

    __slots__ = ()


def record_class(name: str, slots: Sequence[str]) -> type[Record]:
    """A class of records. It gets its name late: Python would write the class into a slot such as `__A`."""
    made = type("_", (Record,), {"__slots__": tuple(slots)})
    made.__name__ = name
    return made


class Shapes:
    """Makes and copies values of the types of one build."""

    def __init__(self) -> None:
        self.classes: dict[Struct, type[Record]] = {}
        self.globals: dict[tree.VarDecl, str] = {}
        self.makers: dict[Type, Maker] = {}
        self.copiers: dict[Struct, Copier] = {}
        self.instances: Callable[[Block, Any], Any] | None = None
        self.evaluate: Evaluator | None = None

    def global_slot(self, variable: tree.VarDecl) -> str:
        """The slot of a global variable, distinct even if two resources use the same name."""
        if variable not in self.globals:
            self.globals[variable] = f"{variable.name.upper()}_{len(self.globals)}"
        return self.globals[variable]

    # ------------------------------------------------------------ initial values

    def maker(self, kind: Type, initial: tree.Expression | None = None) -> Maker:
        """A function that makes a fresh initial value of a type, or of a declaration with an initialiser."""
        if isinstance(kind, Array):
            return self._array_maker(kind, initial or kind.initial)
        if isinstance(kind, Struct):
            return self._struct_maker(kind, initial or kind.initial)
        if isinstance(kind, Block):
            return self._block_maker(kind, initial)
        value = self.scalar(kind, initial)
        return lambda _: value

    def scalar(self, kind: Type, initial: tree.Expression | None) -> Any:
        """The initial value of a scalar."""
        if initial is None and isinstance(kind, Enum):
            initial = kind.initial
        if initial is not None:
            return present(self.evaluate)(initial, kind)
        if isinstance(kind, Enum):
            return next(iter(kind.values.values())).number
        if isinstance(kind, Subrange):
            return kind.first
        return self.zero(kind)

    def zero(self, kind: Type) -> Any:
        """The initial value of an elementary type (IEC 61131-3 table 13)."""
        if kind.kind is Kind.BOOL:
            return False
        if kind.kind is Kind.REAL:
            return 0.0
        if kind.kind is Kind.STRING:
            return b""
        return 0

    def _block_maker(self, kind: Block, initial: tree.Expression | None) -> Maker:
        settings = self._settings(initial, {name: each.type for name, each in _members(kind).items()})

        def make(context: Any) -> Any:
            made = present(self.instances)(kind, context)
            for name, value in settings.items():
                setattr(made, name, value(context))
            return made

        return make

    def _settings(self, initial: tree.Expression | None, types: dict[str, Type]) -> dict[str, Maker]:
        """The makers of the fields that an initialiser `(a := 1, ...)` names."""
        if not isinstance(initial, tree.StructInitial):
            return {}
        named = {(each.name or "").upper(): each.value for each in initial.items}
        return {name: self.maker(types[name], value) for name, value in named.items() if value is not None}

    def _struct_maker(self, kind: Struct, initial: tree.Expression | None) -> Maker:
        makers = {name: self.maker(each.type, each.initial) for name, each in kind.fields.items()}
        makers |= self._settings(initial, {name: each.type for name, each in kind.fields.items()})
        made = self.class_of(kind)

        def make(context: Any) -> Any:
            record = made()
            for name, maker in makers.items():
                setattr(record, name, maker(context))
            return record

        return make

    def _array_maker(self, kind: Array, initial: tree.Expression | None) -> Maker:
        elements = [self.maker(kind.element, kind.start)] * kind.length
        if isinstance(initial, tree.ArrayInitial):
            given = self._elements(initial.items, kind.element, kind.start)[: kind.length]
            elements[: len(given)] = given
        sizes = [high - low + 1 for low, high in kind.bounds]
        if len(sizes) == 1 and is_scalar(kind.element):
            flat = [each(None) for each in elements]
            return lambda _: flat[:]
        return lambda context: nest([each(context) for each in elements], sizes)

    def _elements(self, items: list[tree.Expression], kind: Type, start: tree.Expression | None) -> list[Maker]:
        """One maker per element of an initialiser, repetitions written out."""
        makers: list[Maker] = []
        for each in items:
            if isinstance(each, tree.Repeat):
                count = self._count(each.count)
                inner = [each.value] if each.value is not None else []
                makers += (self._elements(inner, kind, start) or [self.maker(kind, start)]) * count
            elif isinstance(each, tree.ArrayInitial) and not isinstance(kind, Array):
                makers += self._elements(each.items, kind, start)
            else:
                makers.append(self.maker(kind, each))
        return makers

    def _count(self, count: tree.Expression) -> int:
        count = known(count, tree.Literal)
        return int(count.value)

    # ------------------------------------------------------------ classes and copies

    def class_of(self, kind: Struct) -> type[Record]:
        """The class of a structure."""
        if kind not in self.classes:
            self.classes[kind] = record_class(kind.name, tuple(kind.fields))
        return self.classes[kind]

    def copier(self, kind: Type) -> Copier:
        """A function `copy(into, source)` for an array or structure."""
        if isinstance(kind, Struct):
            if kind not in self.copiers:
                self.copiers[kind] = self._struct_copier(kind)
            return self.copiers[kind]
        kind = known(kind, Array)
        element = None if is_scalar(kind.element) else self.copier(kind.element)
        return nested_copier(element, len(kind.bounds))

    def _struct_copier(self, kind: Struct) -> Copier:
        inner = {name: self.copier(each.type) for name, each in kind.fields.items() if not is_scalar(each.type)}
        lines = [
            f"  copy_{name}(into.{name}, source.{name})" if name in inner else f"  into.{name} = source.{name}"
            for name in kind.fields
        ]
        made: dict[str, Any] = {f"copy_{name}": each for name, each in inner.items()}
        # one statement per field: these copies are half of what a call with structures costs
        exec("\n".join(["def copy(into, source):", *lines]), made)  # noqa: S102 - names of our own records
        copier: Copier = made["copy"]
        return copier


def nested_copier(element: Copier | None, dimensions: int) -> Copier:
    """A copier of an array of this number of dimensions whose elements need a copier of their own, or none."""
    if dimensions > 1:
        element = nested_copier(element, dimensions - 1)
    if element is None:
        return _copy_flat
    inner = element

    def copy(into: list[Any], source: list[Any]) -> None:
        for mine, other in zip(into, source, strict=True):
            inner(mine, other)

    return copy


def _copy_flat(into: list[Any], source: list[Any]) -> None:
    into[:] = source


def nest(flat: list[Any], sizes: list[int]) -> list[Any]:
    """Fold row-major elements into lists of lists."""
    for size in reversed(sizes[1:]):
        flat = [flat[start : start + size] for start in range(0, len(flat), size)]
    return flat


def _members(kind: Block) -> dict[str, Any]:
    """Everything of a block that an initialiser can name."""
    return dict(kind.parameters) if kind.declaration is None else dict(kind.declaration.symbols)
