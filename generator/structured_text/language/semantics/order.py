"""Functions and blocks in an order in which callees come first."""

from collections.abc import Mapping

from structured_text.language.report import Report
from structured_text.language.tree import Array, Block, Checked, Function, FunctionBlock, Pou
from structured_text.language.types import Type

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
