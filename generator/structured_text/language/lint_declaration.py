"""Rules about names, types and variables."""

from collections.abc import Iterator

from structured_text.language import tree
from structured_text.language.lint_scope import Scope
from structured_text.language.names import badly_underscored, reserved, reserved_outside
from structured_text.language.report import Report
from structured_text.language.types import Kind
from structured_text.language.walk import expressions

_PARAMETERS = frozenset([tree.VarKind.INPUT, tree.VarKind.OUTPUT, tree.VarKind.IN_OUT])


def unit(unit: tree.Unit, report: Report) -> None:
    """All rules about the declarations of one file outside of POUs."""
    _order(unit, report)
    for element in unit.elements:
        if isinstance(element, tree.TypeDecl):
            _type(element, report)
        elif isinstance(element, tree.VarBlock):
            _block(element, report)
        elif isinstance(element, tree.Configuration):
            _configuration(element, report)
    for named in unit.elements:
        if isinstance(named, tree.Program) and named.name.upper() == "MAIN":
            text = "a PROGRAM called main is refused by matiec's C: choose another name"
            report.add(named.name_at, "reserved-name", text)
        if isinstance(named, tree.TypeDecl | tree.Pou | tree.Configuration):
            _outer_name(named.name_at if isinstance(named, tree.Pou) else named.at, named.name, report)


def pou(scope: Scope) -> None:
    """All rules about the declarations of one POU."""
    names, values = _outer_names(scope.checked), _values(scope.checked)
    for block in scope.pou.blocks:
        _block(block, scope.report)
        for variable in block.variables:
            _clash(scope, variable, names)
            _hidden(scope, variable, values)
            _parameter(scope, variable)
            _trigger(scope, variable)
    if isinstance(scope.pou, tree.Function):
        _function(scope, scope.pou)


def _outer_name(at: int, name: str, report: Report) -> None:
    """The name of a type, POU or configuration."""
    why = reserved_outside(name)
    if why and not reserved(name):
        report.add(at, "reserved-name", f"{name} is {why}: choose another name")
    _name(at, name, report)


def _name(at: int, name: str, report: Report) -> None:
    """A declared name."""
    why = reserved(name)
    if why:
        report.add(at, "reserved-name", f"{name} is {why}: choose another name")
    if badly_underscored(name):
        report.add(at, "underscore-name", f"matiec crashes on {name}: single underscores inside the name only")
    if not name.isascii():
        report.add(at, "non-ascii-name", f"{name} has letters beyond ASCII, which most compilers refuse")


def _type(declared: tree.TypeDecl, report: Report) -> None:
    """A TYPE declaration."""
    _spec(declared.spec, report)
    if isinstance(declared.spec, tree.NamedSpec) and declared.spec.type.kind is not Kind.NONE:
        text = f"IronPLC refuses another name for a type: write {declared.spec.name} in place of {declared.name}"
        report.add(declared.at, "alias-type", text)
    if declared.initial is not None:
        text = "STruC++ refuses initial values in TYPE: give them where the variable is declared"
        report.add(declared.initial.at, "type-initial", text)
        _initial(declared.initial, report)


def _spec(spec: tree.Spec, report: Report) -> None:
    if isinstance(spec, tree.StringSpec):
        if spec.length is not None:
            report.add(spec.at, "sized-string", "STRING with a length is refused by matiec: write STRING")
        if spec.wide:
            report.add(spec.at, "wide-string", "WSTRING is refused by matiec: write STRING")
    elif isinstance(spec, tree.ArraySpec):
        _array(spec, report)
    elif isinstance(spec, tree.SubrangeSpec):
        report.add(spec.at, "subrange", f"STruC++ and IronPLC refuse subranges: write {spec.base} and check the limits")
    elif isinstance(spec, tree.StructSpec):
        _struct(spec, report)
    elif isinstance(spec, tree.EnumSpec):
        _enum(spec, report)


def _array(spec: tree.ArraySpec, report: Report) -> None:
    """An array."""
    _spec(spec.element, report)
    if isinstance(spec.element.type, tree.Array):
        text = "an array of arrays is refused by matiec: use two dimensions, or an array of structures"
        report.add(spec.at, "array-of-array", text)
    for each in spec.ranges:
        for bound in (each.low, each.high) if each is not None else ():
            if isinstance(bound, tree.Literal) and (bound.base != 10 or bound.prefix):
                text = f"matiec refuses {bound.text} as a bound: write {bound.value!r}"
                report.add(bound.at, "constant-bound", text)


def _struct(spec: tree.StructSpec, report: Report) -> None:
    """A structure."""
    if not spec.fields:
        report.add(spec.at, "empty-var-block", "matiec refuses a structure without fields: give it one")
    for field in spec.fields:
        _variable(field, report)
        if field.grouped:
            text = f"matiec refuses several names in one line of a structure: give {field.name} a line of its own"
            report.add(field.at, "grouped-fields", text)


def _enum(spec: tree.EnumSpec, report: Report) -> None:
    """An enumeration."""
    if spec.base is not None:
        report.add(spec.at, "enum-number", "a base type for an enumeration is refused by matiec: write (A, B, C)")
    for item in spec.items:
        _name(item.at, item.name, report)
        if item.value is not None:
            text = "numbers in an enumeration are refused by matiec: use an INT and literals with a comment"
            report.add(item.at, "enum-number", text)


def _configuration(configuration: tree.Configuration, report: Report) -> None:
    """The globals of a configuration."""
    blocks = [*configuration.blocks, *(block for resource in configuration.resources for block in resource.blocks)]
    for block in blocks:
        _block(block, report)
    for resource in configuration.resources:
        for instance in resource.programs:
            if instance.task is None:
                text = (
                    f"matiec wants a task for every program: write PROGRAM {instance.name} WITH a task of this resource"
                )
                report.add(instance.at, "program-task", text)
            if instance.connections:
                text = f"matiec crashes on the connected variables of {instance.name}: assign them in the program"
                report.add(instance.at, "program-connection", text)


def _block(block: tree.VarBlock, report: Report) -> None:
    if not block.variables:
        report.add(block.at, "empty-var-block", "matiec crashes on a VAR block without variables: remove it")
    _qualifiers(block, report)
    if block.kind in (tree.VarKind.GLOBAL, tree.VarKind.EXTERNAL):
        text = f"{block.kind.value}: libraries have no globals; compilers differ on them: use parameters"
        report.add(block.at, "global-variable", text)
    for variable in block.variables:
        _variable(variable, report)


def _qualifiers(block: tree.VarBlock, report: Report) -> None:
    """What follows VAR."""
    if block.kind in (tree.VarKind.STAT, tree.VarKind.INSTANCE):
        report.add(block.at, "var-qualifier", f"{block.kind.value} is refused by matiec: write VAR")
    for word in block.qualifiers:
        if word == "CONSTANT" and block.kind not in (tree.VarKind.LOCAL, tree.VarKind.GLOBAL, tree.VarKind.EXTERNAL):
            text = f"matiec crashes on {block.kind.value} CONSTANT: write VAR CONSTANT"
            report.add(block.at, "var-qualifier", text)
        elif word not in ("CONSTANT", "RETAIN", "NON_RETAIN"):
            report.add(block.at, "var-qualifier", f"{word} is refused by matiec: leave it out, or write RETAIN")


def _variable(variable: tree.VarDecl, report: Report) -> None:
    """A variable or field."""
    if variable.name and variable.kind not in (tree.VarKind.CONFIG, tree.VarKind.ACCESS):
        _name(variable.at, variable.name, report)
    if variable.address is not None:
        text = f"AT {variable.address} ties the text to one machine: pass the value through a parameter"
        report.add(variable.at, "direct-address", text)
    if variable.grouped:
        return
    if isinstance(variable.spec, tree.StructSpec | tree.EnumSpec):
        text = f"matiec crashes on a type written out for a variable: name it in a TYPE, and {variable.name} by that"
        report.add(variable.at, "anonymous-type", text)
    _spec(variable.spec, report)
    if variable.initial is not None:
        _initial(variable.initial, report)


def _initial(value: tree.Expression, report: Report) -> None:
    """An initial value."""
    for each in expressions(value):
        if isinstance(each, tree.StructInitial):
            rule, what = "struct-initial", "a structure is refused by STruC++, and by matiec with typed literals"
            if isinstance(each.type, tree.Block):
                rule, what = "instance-initial", "an instance is refused by STruC++"
            report.add(each.at, rule, f"an initial value for {what}: assign the members in the first scan")
        elif isinstance(each, tree.Repeat):
            report.add(each.at, "repeat-initial", "STruC++ refuses n(x): write every value")


def _outer_names(checked: tree.Checked) -> dict[str, str]:
    """The names that a variable would clash with, and what they are."""
    made = dict.fromkeys(checked.types, "a type")
    made |= dict.fromkeys(checked.functions, "a function")
    made |= dict.fromkeys(checked.blocks, "a function block")
    return made | dict.fromkeys(checked.programs, "a program")


def _clash(scope: Scope, variable: tree.VarDecl, names: dict[str, str]) -> None:
    """A variable with the name of something else."""
    what = names.get(variable.name.upper())
    if what:
        text = f"{variable.name} is also the name of {what}, which matiec refuses: choose another name"
        scope.add(variable.at, "name-clash", text)


def _values(checked: tree.Checked) -> dict[str, str]:
    """Every enumerated value, and its type."""
    enums = [each for each in checked.types.values() if isinstance(each, tree.Enum)]
    return {value: enum.name for enum in enums for value in enum.values}


def _hidden(scope: Scope, variable: tree.VarDecl, values: dict[str, str]) -> None:
    """A variable that hides an enumerated value."""
    enum = values.get(variable.name.upper())
    if enum:
        text = f"{variable.name} is also a value of {enum}, which nothing here can then name: choose another name"
        scope.add(variable.at, "hidden-value", text)


def _parameter(scope: Scope, variable: tree.VarDecl) -> None:
    """Arrays as parameters, and temporaries of structures."""
    composed = isinstance(variable.type, tree.Array | tree.Struct)
    if variable.kind is tree.VarKind.TEMP and composed:
        text = "matiec writes C that does not compile for a VAR_TEMP of a structure or array: write VAR"
        scope.add(variable.at, "temp-struct", text)
    if variable.kind not in _PARAMETERS or not isinstance(variable.type, tree.Array):
        return
    if isinstance(variable.spec, tree.ArraySpec):
        text = (
            f"matiec refuses an array type written out for a parameter: name it in a TYPE, and {variable.name} by that"
        )
        scope.add(variable.at, "anonymous-array", text)
    if variable.kind is tree.VarKind.IN_OUT:
        return
    if isinstance(scope.pou, tree.Function) and variable.kind is tree.VarKind.INPUT:
        text = "matiec writes C that does not compile for an array as input of a FUNCTION: use a block with VAR_IN_OUT"
        scope.add(variable.at, "function-array-input", text)
    else:
        text = f"an array as {variable.kind.value} is copied on every call: pass it as VAR_IN_OUT of a function block"
        scope.add(variable.at, "array-parameter", text)


def _trigger(scope: Scope, variable: tree.VarDecl) -> None:
    """F_TRIG differs between the matiecs."""
    if isinstance(variable.type, tree.Block) and variable.type.name == "F_TRIG":
        text = "F_TRIG differs between the matiecs on its first scan: use R_TRIG of the negation, or own edge memory"
        scope.add(variable.at, "f-trig", text)


def _function(scope: Scope, pou: tree.Function) -> None:
    """A FUNCTION."""
    kinds = {block.kind for block in pou.blocks if block.variables}
    if tree.VarKind.IN_OUT in kinds:
        text = "IronPLC refuses VAR_IN_OUT in a FUNCTION: use a function block"
        scope.add(_first(pou, tree.VarKind.IN_OUT), "function-in-out", text)
    if tree.VarKind.OUTPUT in kinds:
        text = "IronPLC refuses VAR_OUTPUT in a FUNCTION: use a function block"
        scope.add(_first(pou, tree.VarKind.OUTPUT), "function-output", text)
    if tree.VarKind.INPUT not in kinds:
        text = f"matiec refuses a FUNCTION without inputs: give {pou.name} a VAR_INPUT"
        scope.add(pou.name_at, "function-no-input", text)
    _constants_last(scope, pou)
    for variable in pou.symbols.values():
        if isinstance(variable.type, tree.Array) and variable.initial is not None:
            text = "the table is built again on every call of the FUNCTION: keep it in a function block"
            scope.add(variable.at, "function-array-table", text)


def _first(pou: tree.Pou, kind: tree.VarKind) -> int:
    """Where the first block of a kind is."""
    return next(block.at for block in pou.blocks if block.kind is kind)


def _constants_last(scope: Scope, pou: tree.Function) -> None:
    """VAR after VAR CONSTANT becomes constant in a FUNCTION."""
    constant = False
    for block in pou.blocks:
        if block.kind is not tree.VarKind.LOCAL:
            continue
        if "CONSTANT" in block.qualifiers:
            constant = True
        elif constant:
            text = "after VAR CONSTANT, matiec takes a FUNCTION's VAR for constant too: put VAR first"
            scope.add(block.at, "constant-before-var", text)


def _order(unit: tree.Unit, report: Report) -> None:
    """Types, functions, inner blocks and outer blocks come before what uses them."""
    places: dict[str, int] = {}
    for element in unit.elements:
        if isinstance(element, tree.TypeDecl | tree.Function | tree.FunctionBlock | tree.Program):
            places.setdefault(element.name.upper(), element.at)
    for element in unit.elements:
        for at, name in _uses(element):
            if places.get(name.upper(), -1) > at:
                text = f"{name} is declared further down: order types, functions, inner blocks, outer blocks, programs"
                report.add(at, "declaration-order", text)


def _uses(element: object) -> Iterator[tuple[int, str]]:
    """The names of types that a declaration uses, with their places."""
    if isinstance(element, tree.TypeDecl):
        yield from _used_by(element.spec)
    elif isinstance(element, tree.Pou):
        if isinstance(element, tree.Function) and element.returns is not None:
            yield from _used_by(element.returns)
        for block in element.blocks:
            for variable in block.variables:
                if not variable.grouped:
                    yield from _used_by(variable.spec)


def _used_by(spec: tree.Spec) -> Iterator[tuple[int, str]]:
    """The names in a specification."""
    if isinstance(spec, tree.NamedSpec):
        yield spec.at, spec.name
    elif isinstance(spec, tree.ArraySpec):
        yield from _used_by(spec.element)
    elif isinstance(spec, tree.StructSpec):
        for field in spec.fields:
            if not field.grouped:
                yield from _used_by(field.spec)
