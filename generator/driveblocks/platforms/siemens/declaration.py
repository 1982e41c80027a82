"""The head and the declarations of a type or block in SCL."""

from collections.abc import Iterable, Iterator

from driveblocks.platforms.part import Part
from driveblocks.platforms.siemens.names import Names
from driveblocks.platforms.siemens.words import ELEMENTARY, STANDARD_ACCESS, SYSTEM, quoted
from structured_text.language import tree
from structured_text.language.library import fold

_SECTIONS = {
    tree.VarKind.INPUT: "VAR_INPUT",
    tree.VarKind.OUTPUT: "VAR_OUTPUT",
    tree.VarKind.IN_OUT: "VAR_IN_OUT",
    tree.VarKind.LOCAL: "VAR",
    tree.VarKind.TEMP: "VAR_TEMP",
}
_CONSTANT, _RETAIN = "VAR CONSTANT", "VAR RETAIN"
_PER_ROW = 8


def head(part: Part) -> Iterator[str]:
    yield from (f"// {line}".rstrip() for line in part.head.splitlines())


def sections(part: Part, names: Names) -> Iterator[str]:
    """The variables of a block, section by section.

    SCL has no arrays among its constants, so they are static variables with an initial value; and a function has
    nothing but temporary variables, which an S7 sets to zero in each call where access is optimized.
    """
    pou = part.element
    assert isinstance(pou, tree.Pou)  # noqa: S101  (a type has no sections)
    found: dict[str, list[tree.VarDecl]] = {name: [] for name in (*_SECTIONS.values(), _RETAIN, _CONSTANT)}
    for block in pou.blocks:
        for one in block.variables:
            found[_section(part, one, names)].append(one)
    found["VAR"].sort(key=lambda one: one.constant)
    for name, variables in found.items():
        if variables:
            yield f"   {name}"
            yield from lines(part, variables, names)
            yield "   END_VAR"
            yield ""


def _section(part: Part, one: tree.VarDecl, names: Names) -> str:
    name = _SECTIONS.get(one.kind)
    if one.retain and name == "VAR" and isinstance(part.element, tree.Program):
        return _RETAIN
    if name is None or one.retain or one.edge or one.address:
        names.refuse(part, one.at, f"{one.name}: SCL has no such declaration; a plain VAR can be written")
        return "VAR"
    if isinstance(part.element, tree.Function) and one.kind is not tree.VarKind.OUTPUT:
        if one.initial is not None and not one.constant:
            names.refuse(part, one.at, f"{one.name}: a function has no initial values in SCL; assign it in the body")
        name = "VAR_TEMP" if one.kind is tree.VarKind.LOCAL else name
    if one.constant and _is_array(one.spec, names):
        if isinstance(part.element, tree.Function):
            names.refuse(part, one.at, f"{one.name}: a function keeps no array in SCL; a function block can")
        return "VAR"
    return _CONSTANT if one.constant else name


def lines(part: Part, variables: Iterable[tree.VarDecl], names: Names) -> Iterator[str]:
    """Declarations, each with its comment after it."""
    for one in variables:
        first, *rest = _initial(part, one.initial, names) if one.initial is not None else [""]
        made = [f"      {quoted(one.name)} : {spelled(part, one.spec, names)}{first}", *rest]
        made[-1] += ";"
        if said := " ".join(" ".join(each.text for each in _comments(one)).split()):
            made[-1] += f"   // {said}"
        yield from made


def _comments(one: tree.VarDecl) -> tuple[tree.Comment, ...]:
    return (*one.leading, one.trailing) if one.trailing else one.leading


def spelled(part: Part, spec: tree.Spec, names: Names) -> str:
    """A type in SCL. An array has no name of its own: it is written out wherever its TYPE is named."""
    if isinstance(spec, tree.NamedSpec):
        return _named(part, spec, names)
    if isinstance(spec, tree.StringSpec) and not spec.wide:
        return f"String[{_number(part, spec.length, names)}]" if spec.length else "String"
    if isinstance(spec, tree.ArraySpec):
        if _is_array(spec.element, names):
            names.refuse(part, spec.at, "SCL has no arrays of arrays; a structure around the inner one can be written")
        bounds = ", ".join(_bounds(part, one, names) for one in spec.ranges)
        return f"Array[{bounds}] of {spelled(part, spec.element, names)}"
    names.refuse(part, spec.at, "SCL has no such type; name an elementary type, a STRUCT, an ARRAY or a STRING")
    return "?"


def _named(part: Part, spec: tree.NamedSpec, names: Names) -> str:
    upper = spec.name.upper()
    if upper in ELEMENTARY:
        return ELEMENTARY[upper]
    if array := names.array(spec.name):
        return spelled(part, array, names)
    if found := names.find(spec.name):
        return f'"{found.name}"'
    if upper not in SYSTEM:
        names.refuse(part, spec.at, f"{spec.name}: an S7-1200 has no such type")
    return SYSTEM.get(upper, spec.name)


def _bounds(part: Part, one: tree.Range | None, names: Names) -> str:
    low, high = (one.low, one.high) if one else (None, None)
    return f"{_number(part, low, names)}..{_number(part, high, names)}"


def _is_array(spec: tree.Spec, names: Names) -> bool:
    return isinstance(spec, tree.ArraySpec) or (isinstance(spec, tree.NamedSpec) and names.array(spec.name) is not None)


def _number(part: Part, value: tree.Expression | None, names: Names) -> int:
    number = None if value is None else fold(value, lambda _: None)
    if number is None:
        names.refuse(part, part.element.at if value is None else value.at, "expected a number as written")
    return number or 0


def _initial(part: Part, value: tree.Expression, names: Names) -> list[str]:
    """` := value`, an array on several lines."""
    if isinstance(value, tree.Literal):
        return [f" := {value.text}"]
    if isinstance(value, tree.ArrayInitial) and all(isinstance(each, tree.Literal) for each in value.items):
        texts = [each.text for each in value.items if isinstance(each, tree.Literal)]
        rows = [", ".join(texts[at : at + _PER_ROW]) for at in range(0, len(texts), _PER_ROW)]
        return [" := [", *(f"         {row}," for row in rows[:-1]), f"         {rows[-1]}", "      ]"]
    names.refuse(part, value.at, "expected literals as initial value; SCL takes no other here")
    return [""]


def type_lines(part: Part, names: Names) -> Iterator[str]:
    """A PLC data type. Arrays have none: see `array_lines`."""
    declared = part.element
    assert isinstance(declared, tree.TypeDecl)  # noqa: S101  (called for types alone)
    if not isinstance(declared.spec, tree.StructSpec) or declared.initial is not None:
        names.refuse(part, declared.at, f"{declared.name}: SCL has types of structures alone, without an initial value")
        return
    yield f'TYPE "{declared.name}"'
    yield "VERSION : 0.1"
    yield from head(part)
    yield "   STRUCT"
    yield from lines(part, declared.spec.fields, names)
    yield "   END_STRUCT;"
    yield ""
    yield "END_TYPE"
    yield ""


def _hands_memory(pou: tree.Pou) -> bool:
    """Whether a block hands memory to an instruction that wants it without optimized access.

    An optimized block would hand over a copy (S7-1200 System Manual V4.2, pp. 196-197).
    """
    specs = (one.spec for block in pou.blocks for one in block.variables)
    return any(isinstance(each, tree.NamedSpec) and each.name.upper() in STANDARD_ACCESS for each in specs)


def opening(part: Part, names: Names) -> Iterator[str]:
    """The first lines of a block, as far as BEGIN. A program is a function block, which keeps its variables."""
    pou = part.element
    assert isinstance(pou, (tree.Function, tree.FunctionBlock, tree.Program))  # noqa: S101  (called for blocks alone)
    if isinstance(pou, tree.Function):
        returns = spelled(part, pou.returns, names) if pou.returns else "Void"
        yield f'FUNCTION "{pou.name}" : {returns}'
    else:
        yield f'FUNCTION_BLOCK "{pou.name}"'
    yield f"{{ S7_Optimized_Access := '{'FALSE' if _hands_memory(pou) else 'TRUE'}' }}"
    yield "VERSION : 0.1"
    yield from head(part)
    yield from sections(part, names)
    yield "BEGIN"
