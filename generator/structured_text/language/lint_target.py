"""Rules about names that count where a text is to go to a certain target."""

from collections.abc import Collection, Iterator

from structured_text.language.names import kept, reserved
from structured_text.language.report import Report
from structured_text.language.reserved import LONGEST
from structured_text.language.tree import Configuration, EnumSpec, Pou, Spec, StructSpec, TypeDecl, Unit, VarBlock


def unit(unit: Unit, targets: Collection[str], report: Report) -> None:
    """All rules about the names that one file declares."""
    for at, name in _declared(unit):
        keepers = kept(name, targets)
        if keepers and not reserved(name):
            text = f"{name} is a word of {' and '.join(keepers)}: choose another name"
            report.add(at, "target-name", text)
        if targets and len(name) > LONGEST:
            text = f"{name} has {len(name)} characters: {LONGEST} at most are safe everywhere"
            report.add(at, "long-name", text)


def _declared(unit: Unit) -> Iterator[tuple[int, str]]:
    """Every name that a file declares, with its place."""
    for element in unit.elements:
        if isinstance(element, TypeDecl):
            yield element.at, element.name
            yield from _inside(element.spec)
        elif isinstance(element, Pou):
            yield element.name_at, element.name
            yield from (each for block in element.blocks for each in _variables(block))
        elif isinstance(element, Configuration):
            yield from (each for block in element.blocks for each in _variables(block))
        elif isinstance(element, VarBlock):
            yield from _variables(element)


def _variables(block: VarBlock) -> Iterator[tuple[int, str]]:
    for variable in block.variables:
        yield variable.at, variable.name
        yield from _inside(variable.spec)


def _inside(spec: Spec) -> Iterator[tuple[int, str]]:
    """The fields and values that a specification names."""
    if isinstance(spec, StructSpec):
        for field in spec.fields:
            yield field.at, field.name
            yield from _inside(field.spec)
    elif isinstance(spec, EnumSpec):
        yield from ((item.at, item.name) for item in spec.items)
