"""Type specifications -> types."""

from structured_text.language import tree
from structured_text.language.library import Library, fold
from structured_text.language.report import nearest
from structured_text.language.standard import BLOCKS, default_string
from structured_text.language.types import ELEMENTARY, UNKNOWN, VOID, Elementary, Kind, Pointer, String, Subrange, Type

# An array of more elements is an accident, and would stop every tool after the checker.
MOST_ELEMENTS = 1 << 24
MOST_CHARACTERS = 65535
# Structures in structures in structures: more levels are an accident.
DEEPEST_TYPES = 40


class Resolver:
    """Turns specifications into types. `constants` are the constants in scope while a POU's declarations are read."""

    def __init__(self, library: Library) -> None:
        self.library = library
        self.report = library.report
        self.constants: dict[str, tree.VarDecl] = {}
        self.open: set[str] = set()
        self.depths: dict[int, int] = {}
        self.declared: dict[str, Type] = {}
        self.starts: dict[str, tree.Expression | None] = {}

    def declaration(self, declared: tree.TypeDecl) -> Type:
        """The type that a TYPE declaration makes; reported if it contains itself."""
        key = declared.name.upper()
        if key in self.declared:
            return self.declared[key]
        if key in self.open:
            self.report.add(declared.at, "recursion", f"the type {declared.name} contains itself")
            return UNKNOWN
        if len(self.open) >= DEEPEST_TYPES:
            self.report.add(declared.at, "recursion", f"expected at most {DEEPEST_TYPES} types within each other")
            return UNKNOWN
        self.open.add(key)
        unit, self.report.unit = self.report.unit, self.library.names[key][1]
        made = self.spec(declared.spec, declared.name)
        if isinstance(declared.spec, tree.StructSpec | tree.ArraySpec | tree.EnumSpec) and isinstance(
            made, tree.Struct | tree.Array | tree.Enum
        ):
            made.initial = declared.initial
        else:
            self.starts[key] = declared.initial if declared.initial is not None else declared.spec.start
        self.report.unit = unit
        self.open.discard(key)
        made = self.shallow(declared, made)
        self.declared[key] = declared.type = made
        return made

    def shallow(self, declared: tree.TypeDecl, made: Type) -> Type:
        """The type, unless it nests so deeply that nothing could walk over it."""
        inner: list[Type] = []
        if isinstance(made, tree.Array):
            inner = [made.element]
        elif isinstance(made, tree.Struct):
            inner = [each.type for each in made.fields.values()]
        depth = 1 + max((self.depths.get(id(each), 0) for each in inner), default=0)
        self.depths[id(made)] = max(depth, self.depths.get(id(made), 0))
        if depth > DEEPEST_TYPES:
            self.report.add(declared.at, "recursion", f"expected at most {DEEPEST_TYPES} types within each other")
            return UNKNOWN
        return made

    def spec(self, spec: tree.Spec, name: str = "") -> Type:
        """The type of a specification; `name` if a TYPE declaration gives it one."""
        made = self._made(spec, name)
        spec.type = made
        return made

    def _made(self, spec: tree.Spec, name: str) -> Type:
        if isinstance(spec, tree.NamedSpec):
            return self.named(spec)
        if isinstance(spec, tree.StringSpec):
            return self.string(spec)
        if isinstance(spec, tree.PointerSpec):
            return self.pointer(spec)
        return self._composed(spec, name)

    def _composed(self, spec: tree.Spec, name: str) -> Type:
        """The forms that make a new type."""
        if isinstance(spec, tree.ArraySpec):
            return self.array(spec, name)
        if isinstance(spec, tree.StructSpec):
            return self.struct(spec, name)
        if isinstance(spec, tree.EnumSpec):
            return self.enum(spec, name)
        return self.subrange(spec, name) if isinstance(spec, tree.SubrangeSpec) else UNKNOWN

    def pointer(self, spec: tree.PointerSpec) -> Type:
        """A pointer or reference, which is reported."""
        self.report.add(spec.at, "pointer", f"{spec.word} is not in the second edition: pass a VAR_IN_OUT instead")
        target = self.spec(spec.target)
        return Pointer(f"{spec.word} TO {target.name}", Kind.POINTER, target)

    def named(self, spec: tree.NamedSpec) -> Type:
        """An elementary type, a declared one, or a function block."""
        upper = spec.name.upper()
        if upper in ELEMENTARY:
            return ELEMENTARY[upper]
        if upper == "VOID":
            return VOID
        found = self.library.find(upper)
        if isinstance(found, tree.TypeDecl):
            made = self.declaration(found)
            spec.start = self.starts.get(upper)
            return made
        if isinstance(found, tree.FunctionBlock):
            return self.block(found)
        if upper in BLOCKS:
            return BLOCKS[upper]
        hint = nearest(spec.name, self.library.type_names())
        kind = type(found).__name__.lower()
        what = "expected the name of a type" if found is None else f"expected a type, found the {kind}"
        self.report.add(spec.at, "unknown-type", f"{what}{' ' if found else ', found '}{spec.name}{hint}")
        return UNKNOWN

    def block(self, declared: tree.FunctionBlock) -> tree.Block:
        """The type of a function block; its parameters are filled when its own declarations are read."""
        if declared.type is None:
            declared.type = tree.Block(declared.name, Kind.BLOCK, declaration=declared)
        return declared.type

    def string(self, spec: tree.StringSpec) -> Type:
        """STRING with or without a length."""
        base = default_string(spec.wide)
        if spec.length is None:
            return base
        length = self.constant(spec.length, "the length of a string")
        if length is None or not 0 < length <= MOST_CHARACTERS:
            if length is not None:
                text = f"expected a length of 1..{MOST_CHARACTERS}, found {length}"
                self.report.add(spec.length.at, "literal-range", text)
            return base
        return String(f"{base.name}[{length}]", Kind.STRING, length, spec.wide)

    def constant(self, value: tree.Expression, what: str) -> int | None:
        """The value of a constant integer expression; reported if it is none."""
        found = fold(value, self.initial_of)
        if found is None:
            self.report.add(value.at, "type-mismatch", f"expected an integer literal for {what}")
        elif not isinstance(value, tree.Literal):
            text = f"expected an integer literal for {what}: matiec refuses constants and expressions here"
            self.report.add(value.at, "constant-bound", text)
        return found

    def initial_of(self, name: str) -> tree.Expression | None:
        """The initial value of a constant by its name."""
        variable = self.constants.get(name.upper()) or self.library.global_variables.get(name.upper())
        return variable.initial if variable and variable.constant else None

    def array(self, spec: tree.ArraySpec, name: str) -> Type:
        """An array; an empty or conformant range is reported."""
        element = self.spec(spec.element)
        bounds = [self.bound(each, spec.at) for each in spec.ranges]
        shown = ", ".join("*" if each is None else f"{each[0]}..{each[1]}" for each in bounds)
        known = tuple(each for each in bounds if each is not None)
        if len(known) < len(bounds):
            return UNKNOWN
        made = tree.Array(
            name or f"ARRAY[{shown}] OF {element.name}", Kind.ARRAY, element, known, start=spec.element.start
        )
        if made.length > MOST_ELEMENTS:
            self.report.add(spec.at, "literal-range", f"expected at most {MOST_ELEMENTS} elements, found {made.length}")
            return UNKNOWN
        return made

    def bound(self, each: tree.Range | None, at: int) -> tuple[int, int] | None:
        """The limits of one dimension."""
        if each is None:
            text = "ARRAY[*] is not in the second edition: give the bounds"
            self.report.add(at, "conformant-array", text)
            return None
        low, high = self.constant(each.low, "an array bound"), self.constant(each.high, "an array bound")
        if low is None or high is None:
            return None
        if low > high:
            self.report.add(each.at, "literal-range", f"expected a low bound below the high one, found {low}..{high}")
            return None
        return low, high

    def struct(self, spec: tree.StructSpec, name: str) -> Type:
        """A structure."""
        made = tree.Struct(name or "STRUCT", Kind.STRUCT)
        for each in spec.fields:
            each.type = each.spec.type if each.grouped else self.spec(each.spec)
            upper = each.name.upper()
            if upper in made.fields:
                self.report.add(each.at, "duplicate-name", f"the field {each.name} is declared twice")
            made.fields.setdefault(upper, tree.Field(each.name, each.type, each.start, each))
        return made

    def enum(self, spec: tree.EnumSpec, name: str) -> Type:
        """An enumeration; its values become known by name everywhere."""
        base = ELEMENTARY.get((spec.base or "").upper())
        made = tree.Enum(name or "an enumeration", Kind.ENUM, base=base)
        number = 0
        for item in spec.items:
            if item.value is not None:
                written = self.constant(item.value, "the number of an enumerated value")
                number = number if written is None else written
            value = tree.EnumValue(item.name, number, made)
            if item.name.upper() in made.values:
                self.report.add(item.at, "duplicate-name", f"the value {item.name} is declared twice")
            made.values.setdefault(item.name.upper(), value)
            self.library.enum_values.setdefault(item.name.upper(), []).append(value)
            number += 1
        return made

    def subrange(self, spec: tree.SubrangeSpec, name: str) -> Type:
        """`INT (0..9)`."""
        low = self.constant(spec.range.low, "the limit of a subrange")
        high = self.constant(spec.range.high, "the limit of a subrange")
        base = ELEMENTARY.get(spec.base.upper())
        if not isinstance(base, Elementary) or base.kind is not Kind.INTEGER:
            self.report.add(spec.at, "type-mismatch", f"expected an integer type for a subrange, found {spec.base}")
            return UNKNOWN
        if low is None or high is None:
            return base
        if not base.low <= low <= high <= base.high:
            text = f"expected limits within {base.name} and in order, found {low}..{high}"
            self.report.add(spec.range.at, "literal-range", text)
            return base
        shown = name or f"{base.name} ({low}..{high})"
        return Subrange(shown, base.kind, base.width, base.signed, base=base, first=low, last=high)
