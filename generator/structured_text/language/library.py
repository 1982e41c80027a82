"""Every name that several files declare together, and the constants that types are made of."""

from collections.abc import Callable

from structured_text.language import tree
from structured_text.language.report import Report
from structured_text.language.reserved import ELEMENTARY_NAMES

Named = tree.TypeDecl | tree.Function | tree.FunctionBlock | tree.Program | tree.Configuration


class Library:
    """All declarations by upper-case name, in source order. A name that is declared twice keeps its first meaning."""

    __slots__ = ("configurations", "enum_values", "global_variables", "names", "report", "units")

    def __init__(self, units: list[tree.Unit], report: Report) -> None:
        """Collect what the files declare at the outermost level; duplicates are reported."""
        self.units = units
        self.report = report
        self.names: dict[str, tuple[Named, tree.Unit]] = {}
        self.configurations: dict[str, tree.Configuration] = {}
        self.enum_values: dict[str, list[tree.EnumValue]] = {}
        self.global_variables: dict[str, tree.VarDecl] = {}
        for unit in units:
            report.unit = unit
            for element in unit.elements:
                self._declare(element, unit)

    def _declare(self, element: tree.Element, unit: tree.Unit) -> None:
        """Enter one element."""
        if isinstance(element, tree.VarBlock):
            self.enter_globals([element])
        elif isinstance(
            element, tree.TypeDecl | tree.Function | tree.FunctionBlock | tree.Program | tree.Configuration
        ):
            first = self.names.setdefault(element.name.upper(), (element, unit))
            if first[0] is not element:
                line = first[1].line(first[0].at)
                where = f"{first[1].path}:{line}"
                self.report.add(element.at, "duplicate-name", f"{element.name} is declared at {where} already")
            if isinstance(element, tree.Configuration):
                self.configurations.setdefault(element.name.upper(), element)
                self.enter_globals(element.blocks)
                for resource in element.resources:
                    self.enter_globals(resource.blocks)

    def enter_globals(self, blocks: list[tree.VarBlock]) -> None:
        """Enter the variables of VAR_GLOBAL blocks."""
        for block in blocks:
            for variable in block.variables if block.kind is tree.VarKind.GLOBAL else ():
                self.global_variables.setdefault(variable.name.upper(), variable)

    def find(self, name: str) -> Named | None:
        """What a name means at the outermost level, in any case of letters."""
        found = self.names.get(name.upper())
        return found[0] if found else None

    def type_names(self) -> list[str]:
        """Every name that may follow the colon of a declaration, for suggestions."""
        return [*ELEMENTARY_NAMES, *(named.name for named, _ in self.names.values())]


def fold(value: tree.Expression, constant: Callable[[str], tree.Expression | None], depth: int = 0) -> int | None:
    """The value of an integer expression of literals and constants; None if it is something else.

    `constant` gives the initial value of a constant by its name.
    """
    if isinstance(value, tree.Literal):
        return value.value if isinstance(value.value, int) and not isinstance(value.value, bool) else None
    if isinstance(value, tree.Name):
        initial = constant(value.name) if depth < 8 else None
        return None if initial is None else fold(initial, constant, depth + 1)
    if isinstance(value, tree.Unary):
        inner = fold(value.operand, constant, depth)
        return None if inner is None or value.op == "NOT" else (-inner if value.op == "-" else inner)
    if isinstance(value, tree.Binary):
        return _fold_binary(value.op, fold(value.left, constant, depth), fold(value.right, constant, depth))
    return None


def _fold_binary(op: str, left: int | None, right: int | None) -> int | None:
    """Integer arithmetic of ST: division cuts towards zero."""
    if left is None or right is None or op not in "+-*/MOD" or abs(left) >> 64 or abs(right) >> 64:
        return None
    if op in ("/", "MOD"):
        if right == 0:
            return None
        quotient = abs(left) // abs(right) * (1 if (left < 0) == (right < 0) else -1)
        return quotient if op == "/" else left - quotient * right
    return left + right if op == "+" else left - right if op == "-" else left * right
