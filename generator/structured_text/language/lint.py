"""The portability linter: what some compiler refuses, crashes on or compiles to something else, by name."""

import re
from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass

from structured_text.language import (
    lint_decision,
    lint_declaration,
    lint_expression,
    lint_literal,
    lint_statement,
    lint_target,
    lint_text,
)
from structured_text.language.checker import analyse
from structured_text.language.lint_scope import Scope
from structured_text.language.parser import ParseError, parse
from structured_text.language.problems import Problem
from structured_text.language.report import Report, nearest
from structured_text.language.rules import CODES, ON_REQUEST, RULES
from structured_text.language.tree import Checked, Function, FunctionBlock, Pou, Program, Unit

_WORD = re.compile(r"\w+")
_FOUND = re.compile(r"found (\w+)")


class UnknownRuleError(ValueError):
    """A rule name or code that does not exist; the text names the nearest one."""


@dataclass(frozen=True, slots=True)
class Selection:
    """Which rules to report: those named by `select` (empty: all but ON_REQUEST) but not those named by `ignore`."""

    select: frozenset[str] = frozenset()
    ignore: frozenset[str] = frozenset()

    @classmethod
    def of(cls, select: Iterable[str], ignore: Iterable[str]) -> "Selection":
        """From names, codes, or beginnings of codes (`ST3`), in any case of letters. Raises UnknownRuleError."""
        return cls(
            frozenset(name for each in select for name in _named(each)),
            frozenset(name for each in ignore for name in _named(each)),
        )

    def takes(self, rule: str) -> bool:
        """Whether problems of this rule are reported."""
        return rule not in self.ignore and (rule in self.select or (not self.select and rule not in ON_REQUEST))


def _named(word: str) -> list[str]:
    """The rules that a word on the command line means. Raises UnknownRuleError."""
    if word.lower() in RULES:
        return [word.lower()]
    upper = word.upper()
    found = [rule.name for code, rule in CODES.items() if upper.startswith("ST") and code.startswith(upper)]
    if not found:
        hint = nearest(word, [*RULES, *CODES])
        raise UnknownRuleError(f"no rule is called {word}{hint}; `driveblocks lint --list` shows all")
    return found


def lint(units: Sequence[Unit], selection: Selection | None = None, targets: Collection[str] = ()) -> list[Problem]:
    """Everything that the rules say about files that belong together, in order of place. Never raises for their text.

    `targets`, of TARGET_WORDS, are those that the text is to go to: each keeps names for itself.
    Trees that were checked together before can be linted as well. Raises ValueError for a file that was checked with
    others, as `analyse` does.
    """
    checked, problems = analyse(units)
    report = Report()
    for unit in units:
        report.unit = unit
        lint_text.unit(unit, report)
        lint_declaration.unit(unit, report)
        lint_target.unit(unit, targets, report)
    for pou in _pous(units):
        report.unit = pou.unit
        _pou(pou, checked, report)
    chosen = selection or Selection()
    return sorted({each for each in [*problems, *report.problems()] if chosen.takes(each.rule)})


def lint_sources(
    sources: Iterable[tuple[str, str]], selection: Selection | None = None, targets: Collection[str] = ()
) -> list[Problem]:
    """As `lint`, from (path, text).

    Of a file that cannot be parsed the syntax errors are reported, whatever the selection, and no more. The others are
    judged with what is whole in it; a name that only its broken parts may declare is not reported as unknown.
    """
    units: list[Unit] = []
    broken: dict[str, ParseError] = {}
    for path, text in sources:
        try:
            units.append(parse(text, path))
        except ParseError as error:
            units.append(error.unit)
            broken[path] = error
    found = lint(units, selection, targets)
    if not broken:
        return found
    words = {word.upper() for error in broken.values() for word in _WORD.findall(error.unit.text)}
    told = (each for each in found if each.path not in broken and not _may_be_known(each, words))
    return sorted({*told, *(each for error in broken.values() for each in error.problems)})


def _may_be_known(problem: Problem, words: set[str]) -> bool:
    """Whether a name that is reported as unknown is one of these words."""
    name = _FOUND.search(problem.text) if problem.rule in ("undeclared-name", "unknown-type") else None
    return name is not None and name[1].upper() in words


def _pous(units: Sequence[Unit]) -> list[Pou]:
    """Every POU of the files, those of doubled names too."""
    return [each for unit in units for each in unit.elements if isinstance(each, Function | FunctionBlock | Program)]


def _pou(pou: Pou, checked: Checked, report: Report) -> None:
    scope = Scope(pou, checked, report)
    lint_declaration.pou(scope)
    lint_statement.pou(scope)
    lint_expression.pou(scope)
    lint_literal.pou(scope)
    lint_decision.pou(scope)
