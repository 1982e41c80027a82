"""How findings and rules of the linter are printed: as lines, or as JSON for other programs."""

import json
from collections.abc import Sequence

from structured_text.language.problems import Problem
from structured_text.language.rules import RULES


def print_problems(problems: Sequence[Problem], output: str) -> None:
    """Print findings, as `text` or `json`."""
    if output == "json":
        rows = [
            {
                "path": each.path,
                "line": each.line,
                "column": each.column,
                "code": RULES[each.rule].code,
                "rule": each.rule,
                "message": each.text,
            }
            for each in problems
        ]
        print(json.dumps(rows, indent=2, ensure_ascii=False))
        return
    for each in problems:
        print(f"{each.path}:{each.line}:{each.column}: {RULES[each.rule].code} {each.rule}: {each.text}")


def print_rules(output: str) -> None:
    """Print every rule, as `text` or `json`."""
    if output == "json":
        rows = [{"code": rule.code, "rule": rule.name, "summary": rule.summary} for rule in RULES.values()]
        print(json.dumps(rows, indent=2))
        return
    for rule in RULES.values():
        print(f"{rule.code}  {rule.name:<22} {rule.summary}")
