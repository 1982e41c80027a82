"""Typed trees: names, types and calls of several files resolved together."""

from collections.abc import Mapping, Sequence
from operator import is_not

from structured_text.language import tree
from structured_text.language.collector import paused
from structured_text.language.library import Library
from structured_text.language.problems import CheckError, Problem
from structured_text.language.report import Report
from structured_text.language.resolve import Resolver
from structured_text.language.semantics import operands, operators
from structured_text.language.semantics.calls import call_type
from structured_text.language.semantics.configurations import check_configuration
from structured_text.language.semantics.declarations import declare_pou, declare_type
from structured_text.language.semantics.scope import Inference, Scope
from structured_text.language.semantics.statements import check_statements
from structured_text.language.semantics.variables import check_globals, check_type, check_variables
from structured_text.language.tree import Array, Block, Checked, Function, FunctionBlock, Pou
from structured_text.language.types import VOID, Type

INFERENCE: Inference = {
    tree.Literal: operands.literal, tree.Name: operands.name, tree.Qualified: operands.qualified,
    tree.Member: operands.member, tree.Index: operands.index, tree.BitAccess: operands.bit_access,
    tree.Dereference: operands.dereference, tree.Direct: operands.direct, tree.Unary: operators.unary,
    tree.Binary: operators.binary, tree.Call: call_type, tree.Repeat: operands.misplaced,
    tree.ArrayInitial: operands.misplaced, tree.StructInitial: operands.misplaced,
}  # fmt: skip


def check(units: Sequence[tree.Unit]) -> tree.Checked:
    """Resolve and type files as one text in the given order. Raises CheckError with everything that is wrong.

    Raises ValueError as `analyse` does.
    """
    checked, problems = analyse(units)
    if problems:
        raise CheckError(problems)
    return checked


def analyse(units: Sequence[tree.Unit]) -> tuple[tree.Checked, list[Problem]]:
    """As `check`, but give what could be typed together with the problems, for those who go on nevertheless.

    The trees are completed in place, once: asked again for the same files, it gives what it gave. Raises ValueError for
    a file that was analysed with others before, since its tree refers to those.
    """
    found = _analysed(units)
    if found is None:
        report = Report()
        with paused():
            checked = _checked(Library(list(units), report), report)
        found = tree.Analysis(checked, report.problems())
        for unit in units:
            unit.analysis = found
    return found.checked, list(found.problems)


def _analysed(units: Sequence[tree.Unit]) -> tree.Analysis | None:
    """What was made of these very files, in this order, before. Raises ValueError as `analyse` does."""
    found = units[0].analysis if units else None
    known = found.checked.units if found is not None else units
    others = len(known) != len(units) or any(map(is_not, known, units))
    for unit in units:
        if others or unit.analysis is not found:
            raise ValueError(f"{unit.path} was analysed with other files already: parse it again")
    return found


def _checked(library: Library, report: Report) -> tree.Checked:
    """Check everything: first what is declared, then what is in it."""
    checked, resolver = tree.Checked(units=library.units), Resolver(library)
    _sort_elements(checked, resolver)
    pous: list[tree.Pou] = [*checked.functions.values(), *checked.blocks.values(), *checked.programs.values()]
    for pou in pous:
        report.unit = pou.unit
        declare_pou(resolver, pou)
    outside = Scope(library, report, INFERENCE)
    check_globals(outside, resolver)
    _check_types(outside, checked)
    calls = {id(pou): _check_pou(outside.around(pou.symbols), pou) for pou in pous}
    sort_callees(checked, calls, report)
    for configuration in checked.configurations.values():
        report.unit = configuration.unit
        check_configuration(outside.around(configuration.symbols), configuration)
    return checked


def _sort_elements(checked: tree.Checked, resolver: Resolver) -> None:
    """Fill the tables; resolve the types; report what is unsupported."""
    for unit in checked.units:
        resolver.report.unit = unit
        for element in unit.elements:
            if isinstance(element, tree.Unsupported):
                _unsupported(resolver.report, element)
            elif isinstance(element, tree.TypeDecl):
                declare_type(resolver, element)
                checked.types.setdefault(element.name.upper(), element.type)
            elif isinstance(element, tree.Function):
                checked.functions.setdefault(element.name.upper(), element)
            elif isinstance(element, tree.FunctionBlock):
                checked.blocks.setdefault(element.name.upper(), element)
            elif isinstance(element, tree.Program):
                checked.programs.setdefault(element.name.upper(), element)
            elif isinstance(element, tree.Configuration):
                checked.configurations.setdefault(element.name.upper(), element)


def _unsupported(report: Report, element: tree.Unsupported) -> None:
    """Report METHOD, NAMESPACE and the like."""
    text = f"{element.word} {element.name} is not in the Structured Text of the second edition: {_INSTEAD}"
    report.add(element.at, "unsupported", text)


def _check_types(scope: Scope, checked: tree.Checked) -> None:
    for unit in checked.units:
        scope.report.unit = unit
        for element in unit.elements:
            if isinstance(element, tree.TypeDecl) and element.name.upper() in checked.types:
                check_type(scope, element)


def _check_pou(scope: Scope, pou: tree.Pou) -> set[str]:
    """Check the variables and statements of one POU; the functions that it calls."""
    scope.report.unit = pou.unit
    check_variables(scope, pou)
    for extra in pou.extras:
        _unsupported(scope.report, extra)
    if isinstance(pou, tree.FunctionBlock) and pou.heritage:
        scope.report.add(pou.name_at, "unsupported", f"{pou.heritage} is not in the second edition: {_INSTEAD}")
    check_statements(scope, pou.body)
    if isinstance(pou, tree.Function) and pou.name.upper() not in scope.written and pou.type is not VOID:
        text = f"expected an assignment to {pou.name} somewhere in FUNCTION {pou.name}: it gives the result"
        scope.report.add(pou.name_at, "no-result", text)
    return scope.called


_INSTEAD = "use a function block with an input that selects what to do"


# Blocks in blocks in blocks: more levels are an accident.
DEEPEST_BLOCKS = 40

# The functions that each POU calls, in upper case, by the identity of the POU.
Calls = Mapping[int, set[str]]


def sort_callees(checked: Checked, calls: Calls, report: Report) -> None:
    """Sort functions and blocks so that callees come first; report those that contain themselves."""
    waiting: dict[str, set[str]] = {}
    pous: dict[str, Function | FunctionBlock] = {**checked.functions, **checked.blocks}
    for key, pou in pous.items():
        waiting[key] = {each for each in _needs(pou, calls.get(id(pou), set())) if each in pous}
    users: dict[str, list[str]] = {key: [] for key in pous}
    for key, needed in waiting.items():
        for each in needed:
            users[each].append(key)
    ready = [key for key, needed in waiting.items() if not needed]
    level = dict.fromkeys(ready, 1)
    for key in ready:
        checked.callees_first.append(pous[key])
        for user in users[key]:
            waiting[user].discard(key)
            level[user] = max(level.get(user, 1), level[key] + 1)
            if not waiting[user]:
                ready.append(user)
    _tell_cycles(report, pous, set(pous) - set(ready), level)


def _tell_cycles(
    report: Report, pous: dict[str, Function | FunctionBlock], cyclic: set[str], level: dict[str, int]
) -> None:
    """Report POUs that call or contain themselves, and towers of blocks."""
    for key, pou in pous.items():
        report.unit = pou.unit
        if key in cyclic:
            text = f"{pou.name} calls or contains itself, directly or through another: ST has no recursion"
            report.add(pou.name_at, "recursion", text)
        elif level.get(key, 1) > DEEPEST_BLOCKS:
            text = f"expected at most {DEEPEST_BLOCKS} levels of calls below {pou.name}"
            report.add(pou.name_at, "recursion", text)


def _needs(pou: Pou, called: set[str]) -> list[str]:
    """The functions and blocks that a POU calls or contains, by upper-case name, each once."""
    found = dict.fromkeys(sorted(called))
    for variable in pou.symbols.values():
        made: Type = variable.type
        while isinstance(made, Array):
            made = made.element
        if isinstance(made, Block) and made.declaration is not None:
            found[made.name.upper()] = None
    return list(found)
