"""The checker says of every program what is recorded, matiec too where it is found, and every difference is wanted."""

from collections.abc import Iterator
from pathlib import Path

import pytest
import yaml
from tests.structured_text.engines.accept.programs import load_programs
from tests.structured_text.engines.accept.verdicts import (
    ACCEPT,
    COLUMNS,
    checker_verdict,
    matiec_verdict,
    read_verdicts,
)

from structured_text.engines.engine import Engine
from structured_text.language.rules import RULES

PROGRAMS = load_programs()
VERDICTS = read_verdicts()
REASONS = yaml.safe_load((Path(__file__).parent / "reasons.yaml").read_text(encoding="utf-8"))
MATIEC = COLUMNS[1:]
# A build takes a third of a second, so each run of the suite tries some programs; `record --check` tries all of them.
SAMPLE = 24


def test_the_checker_says_what_is_recorded() -> None:
    """`python -m tests.structured_text.engines.accept.record --checker` records anew, once the change is wanted."""
    said = {name: checker_verdict(text) for name, text in PROGRAMS.items()}
    recorded = {name: row["checker"] for name, row in VERDICTS.items()}
    assert {
        name: (verdict, recorded.get(name)) for name, verdict in said.items() if verdict != recorded.get(name)
    } == {}


@pytest.mark.parametrize("part", range(4))
def test_matiec_says_what_is_recorded(part: int, matiec: Engine) -> None:
    """A sample, spread over the corpus."""
    names = list(PROGRAMS)[part :: len(PROGRAMS) // SAMPLE * 4]
    said = {name: matiec_verdict(matiec, PROGRAMS[name]) for name in names}
    assert said == {name: VERDICTS[name][matiec.name] for name in names}


def test_what_only_matiec_refuses_is_wanted() -> None:
    """What the checker accepts and a line does not: each program with its reason."""
    found = {name for name, row in VERDICTS.items() if row["checker"] == ACCEPT and not _both_accept(row)}
    assert found == set(REASONS["accepted"])


def test_what_only_the_checker_refuses_is_wanted() -> None:
    """What both lines accept and the checker does not: each rule with its reason."""
    assert set(_refusing_rules()) == set(REASONS["refused"])
    assert set(REASONS["refused"]) <= RULES.keys()


def _refusing_rules() -> Iterator[str]:
    for row in VERDICTS.values():
        if row["checker"] != ACCEPT and _both_accept(row):
            yield from row["checker"].split()


def _both_accept(row: dict[str, str]) -> bool:
    return all(row[column] == "ok" for column in MATIEC)
