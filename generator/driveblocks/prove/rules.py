"""The rules of `rules.yaml`: which block, what its caller promises, what always holds of its memory, and the rules."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cache
from importlib.resources import files
from string import Template
from typing import Any

import yaml

FILE = "rules.yaml"


@dataclass(frozen=True)
class Rule:
    """A sentence, the rules of the design that it holds, and its condition: whenever `when`, then `then`."""

    say: str
    of: str
    when: str
    then: str


@dataclass(frozen=True)
class Subject:
    """A block and what is proved of it.

    `restart`: the condition under which a call begins anew, whatever the memory holds; empty: there is none.
    `given`: what the caller promises of the inputs. `means`: words for conditions, in order. `always`: what holds of
    the memory after every call. `inside`: the instance of another subject, whose promises are proved here.
    `exact`: it computes with REALs, which others leave free; its obligations are its own.
    `loose`: instances inside it that are left free: any value of theirs may come, which proves less, never more.
    `by_caller`: it is the caller that sees to a restart in the first call.
    """

    block: str
    restart: str = ""
    given: tuple[Rule, ...] = ()
    means: Mapping[str, str] = field(default_factory=dict)
    always: tuple[Rule, ...] = ()
    rules: tuple[Rule, ...] = ()
    inside: Mapping[str, str] = field(default_factory=dict)
    by_caller: bool = False
    exact: bool = False
    loose: tuple[str, ...] = ()

    def conditions(self) -> dict[str, str]:
        """Every condition as a BOOL by its name, in an order in which each names only those before it."""
        made = dict(self.means)
        if self.restart:
            made["Restarts"] = self.restart
        for word, rules in (("Given", self.given), ("Always", self.always), ("Rule", self.rules)):
            for number, rule in enumerate(rules):
                made[f"{word}When{number}"] = rule.when
                made[f"{word}Then{number}"] = rule.then
        return made


def shared() -> list[Subject]:
    return [_subject(name, found, {}) for name, found in _read().items() if "$" not in name]


def family(facts: Mapping[str, str]) -> list[Subject]:
    named = ((name, found) for name, found in _read().items() if "$" in name)
    return [_subject(Template(name).substitute(facts), found, facts) for name, found in named]


@cache
def _read() -> dict[str, Any]:
    found: dict[str, Any] = yaml.safe_load(files(__package__).joinpath(FILE).read_text("utf-8"))
    return found


def _subject(block: str, found: dict[str, Any], values: Mapping[str, str]) -> Subject:
    known = {"restart", "given", "means", "always", "rules", "inside", "restart_by_caller", "exact", "loose"}
    if unknown := set(found) - known:
        raise ValueError(f"{FILE}: {block}: {', '.join(sorted(unknown))}")
    return Subject(
        block,
        str(found.get("restart", "")),
        *(tuple(_rule(each, values) for each in found.get("given", ())),),
        means={name: _put(text, values) for name, text in found.get("means", {}).items()},
        always=tuple(_rule(each, values) for each in found.get("always", ())),
        rules=tuple(_rule(each, values) for each in found.get("rules", ())),
        inside=found.get("inside", {}),
        exact=bool(found.get("exact")),
        loose=tuple(found.get("loose", ())),
        by_caller=bool(found.get("restart_by_caller")),
    )


def _rule(found: dict[str, Any], values: Mapping[str, str]) -> Rule:
    then, when = _put(found["then"], values), _put(found.get("when", "TRUE"), values)
    return Rule(_put(found["say"], values), str(found.get("of", "")), when, then)


def _put(text: Any, values: Mapping[str, str]) -> str:
    """A condition with the facts of a family."""
    return Template(" ".join(str(text).split())).substitute(values)
