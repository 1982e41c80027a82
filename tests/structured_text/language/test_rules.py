"""Every rule finds what its rows call bad, and finds nothing in what they call good."""

import re
from collections.abc import Callable
from pathlib import Path

import pytest

from structured_text.language.lint import Selection, lint_sources
from structured_text.language.problems import Problem
from structured_text.language.reserved import TARGET_WORDS
from structured_text.language.rules import CODES, ON_REQUEST, RULES

FOLDER = Path(__file__).parent / "rules"
PAGE = Path(__file__).parents[3] / "docs" / "lint.md"
OF_TARGETS = ("target-name", "long-name")
Complete = Callable[[str], str]


def rows_of(name: str) -> list[tuple[str, str]]:
    """The (bad or good, text) rows of a rule's file."""
    parts = re.split(r"^--- (bad|good)\n", (FOLDER / f"{name}.st").read_text(encoding="utf-8"), flags=re.M)
    return [(parts[at], parts[at + 1].rstrip("\n")) for at in range(1, len(parts), 2)]


def all_rows() -> list[object]:
    """Every row of every rule, with an id that names it."""
    made: list[object] = []
    for name in RULES:
        for number, (kind, text) in enumerate(rows_of(name)):
            made.append(pytest.param(name, kind, text, id=f"{name}-{kind}-{number}"))
    return made


def judged(name: str, text: str, selection: Selection | None = None) -> list[Problem]:
    """What is found in a row or example of a rule: those about targets want to know for which."""
    targets = TARGET_WORDS if name in OF_TARGETS else ()
    if selection is None and name in ON_REQUEST:
        selection = Selection.of([name], [])
    return lint_sources([("row.st", text)], selection, targets)


def test_every_rule_has_rows_of_both_kinds_and_nothing_else_has() -> None:
    assert {path.stem for path in FOLDER.glob("*.st")} == set(RULES)
    for name in RULES:
        assert {kind for kind, _ in rows_of(name)} == {"bad", "good"}


@pytest.mark.parametrize(("name", "kind", "text"), all_rows())
def test_row(name: str, kind: str, text: str, complete: Complete) -> None:
    found = judged(name, complete(text))
    if kind == "bad":
        assert name in {each.rule for each in found}, [str(each) for each in found]
    else:
        assert not found, [str(each) for each in found]


@pytest.mark.parametrize("name", RULES)
def test_ignoring_a_rule_silences_it_and_selecting_it_silences_the_others(name: str, complete: Complete) -> None:
    text = next(text for kind, text in rows_of(name) if kind == "bad")
    whole = complete(text)
    if name in ("syntax", "long-expression"):
        pytest.skip("what cannot be parsed is reported whatever the selection")
    assert {each.rule for each in judged(name, whole, Selection.of([name], []))} == {name}
    assert name not in {each.rule for each in judged(name, whole, Selection.of([], [RULES[name].code]))}


def test_the_page_explains_every_rule_in_order_with_examples_that_hold(complete: Complete) -> None:
    page = PAGE.read_text(encoding="utf-8")
    sections = re.split(r"^### (ST\d+) ([\w-]+)\n", page, flags=re.M)[1:]
    assert [tuple(sections[at : at + 2]) for at in range(0, len(sections), 3)] == [
        (rule.code, rule.name) for rule in RULES.values()
    ]
    for at in range(0, len(sections), 3):
        name, examples = sections[at + 1], re.findall(r"^```st\n(.*?)\n```$", sections[at + 2], re.M | re.S)
        found = [{each.rule for each in judged(name, complete(each))} for each in examples]
        assert found, name
        assert found[-1] == set(), (name, found)
        assert all(name in each for each in found[:-1]), (name, found)


def test_messages_say_what_to_do_in_one_line(complete: Complete) -> None:
    for name in RULES:
        for _, text in rows_of(name):
            for each in judged(name, complete(text)):
                assert "\n" not in each.text
                assert len(each.text) < 240, each.text
                assert each.line >= 1
                assert each.column >= 1


def test_codes_are_unique_and_sorted() -> None:
    assert len(CODES) == len(RULES)
    assert list(CODES) == sorted(CODES)


def test_a_name_is_reported_for_the_targets_that_keep_it_alone(complete: Complete) -> None:
    text = complete("VAR\n  Label : INT;\n  Adr : INT;\nEND_VAR\nLabel := 1;\nAdr := 1;")
    found = {
        target: [each.text for each in lint_sources([("row.st", text)], None, [target])] for target in TARGET_WORDS
    }
    assert found == {
        "openplc": [],
        "beremiz": [],
        "codesys": ["Adr is a word of codesys: choose another name"],
        "twincat": ["Adr is a word of twincat: choose another name"],
        "siemens": ["Label is a word of siemens: choose another name"],
    }
