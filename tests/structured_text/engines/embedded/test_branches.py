"""Each decision counts each of its outcomes, written or not; nothing is counted unless asked for."""

from __future__ import annotations

from collections.abc import Sequence

import pytest
from tests.structured_text.engines.embedded.snippets import build

from structured_text.engines.embedded import EmbeddedEngine
from structured_text.engines.engine import ScanError, Source

HEAD = "FUNCTION_BLOCK Test\nVAR_INPUT n : INT; END_VAR\nVAR i : INT; y : INT; END_VAR\n"


def counted(body: str, inputs: Sequence[int]) -> dict[str, int]:
    """The outcomes of a body's decisions, `line:column text` -> hits; line 1 is the first of the body."""
    library = build(f"{HEAD}{body}\nEND_FUNCTION_BLOCK\n", coverage=True)
    made = library.instance("Test")
    for n in inputs:
        made["n"] = n
        made.scan()
    (hits,) = library.branches().values()
    return {f"{each.line - 3}:{each.column} {each.text}": number for each, number in hits.items()}


def test_if_without_else_is_true_or_false() -> None:
    assert counted("IF n > 1 THEN y := 1; END_IF;", [1, 2, 3]) == {"1:4 IF FALSE": 1, "1:4 IF TRUE": 2}


def test_elsif_is_asked_only_where_those_before_are_false() -> None:
    body = "IF n = 1 THEN y := 1;\nELSIF n = 2 THEN y := 2;\nELSIF n = 3 THEN y := 3;\nELSE y := 4; END_IF;"
    assert counted(body, [1, 1, 2, 3, 4]) == {
        "1:4 IF FALSE": 3, "1:4 IF TRUE": 2,
        "2:7 ELSIF FALSE": 2, "2:7 ELSIF TRUE": 1,
        "3:7 ELSIF FALSE": 1, "3:7 ELSIF TRUE": 1,
    }  # fmt: skip


@pytest.mark.parametrize("otherwise", ["", "ELSE y := 0;"])
def test_case_has_its_branches_and_an_else_written_or_not(otherwise: str) -> None:
    body = f"CASE n OF\n  1: y := 1;\n  2, 5..7, -3: y := 2;\n  9: y := 3;\n{otherwise}\nEND_CASE;"
    assert counted(body, [1, 2, 6, -3, 4, 0, 8]) == {
        "1:1 CASE ELSE": 3, "2:3 CASE 1": 1, "3:3 CASE 2, 5..7, -3": 3, "4:3 CASE 9": 0,
    }  # fmt: skip


def test_while_takes_a_turn_ends_or_takes_none() -> None:
    body = "i := 0;\nWHILE i < n DO\n  i := i + 1;\n  IF i = 5 THEN EXIT; END_IF;\nEND_WHILE;"
    assert counted(body, [0, 2, 7]) == {
        "2:7 WHILE FALSE": 2, "2:7 WHILE TRUE": 7, "2:7 WHILE without a turn": 1,
        "4:6 IF FALSE": 6, "4:6 IF TRUE": 1,
    }  # fmt: skip


def test_a_loop_in_a_loop_is_counted_each_time_that_it_is_met() -> None:
    body = "i := 0;\nWHILE i < 3 DO\n  y := i;\n  WHILE y < n DO y := y + 1; END_WHILE;\n  i := i + 1;\nEND_WHILE;"
    assert counted(body, [2]) == {
        "2:7 WHILE FALSE": 1, "2:7 WHILE TRUE": 3, "2:7 WHILE without a turn": 0,
        "4:9 WHILE FALSE": 3, "4:9 WHILE TRUE": 3, "4:9 WHILE without a turn": 1,
    }  # fmt: skip


def test_repeat_asks_after_each_turn_one_that_continue_cuts_short_too() -> None:
    body = "i := 0;\nREPEAT\n  i := i + 1;\n  IF i < 3 THEN CONTINUE; END_IF;\n  y := i;\nUNTIL i > n END_REPEAT;"
    assert counted(body, [0, 2, 3]) == {
        "4:6 IF FALSE": 3, "4:6 IF TRUE": 5, "6:7 UNTIL FALSE": 5, "6:7 UNTIL TRUE": 3,
    }  # fmt: skip


def test_for_takes_a_turn_ends_or_takes_none() -> None:
    body = "FOR i := 1 TO n DO\n  y := i;\n  IF y = 5 THEN RETURN; END_IF;\nEND_FOR;"
    assert counted(body, [0, 2, 7]) == {
        "1:1 FOR FALSE": 2, "1:1 FOR TRUE": 7, "1:1 FOR without a turn": 1,
        "3:6 IF FALSE": 6, "3:6 IF TRUE": 1,
    }  # fmt: skip


def test_functions_and_all_sources_are_counted_outcomes_that_never_came_with_0() -> None:
    function = "FUNCTION Sign : INT\nVAR_INPUT n : INT; END_VAR\nIF n < 0 THEN Sign := -1; END_IF;\nEND_FUNCTION\n"
    block = f"{HEAD}IF n = 1 THEN y := Sign(n); END_IF;\nEND_FUNCTION_BLOCK\n"
    library = EmbeddedEngine(coverage=True).build([Source("sign.st", function), Source("test.st", block)])
    made = library.instance("Test")
    made["n"] = 1
    made.scan()
    assert {(path, *each): n for path, hits in library.branches().items() for each, n in hits.items()} == {
        ("sign.st", 3, 4, "IF FALSE"): 1, ("sign.st", 3, 4, "IF TRUE"): 0,
        ("test.st", 4, 4, "IF FALSE"): 0, ("test.st", 4, 4, "IF TRUE"): 1,
    }  # fmt: skip


def test_a_condition_that_fails_has_no_outcome() -> None:
    text = f"{HEAD}y := 0;\nIF 1 / n = 1 THEN y := 1; END_IF;\nEND_FUNCTION_BLOCK\n"
    library = build(text, coverage=True)
    with pytest.raises(ScanError):
        library.instance("Test").scan()
    assert set(library.branches()["test.st"].values()) == {0}


def test_nothing_is_counted_unless_asked() -> None:
    text = f"{HEAD}WHILE y < n DO y := y + 1; END_WHILE;\nCASE n OF 1: y := 1; END_CASE;\nEND_FUNCTION_BLOCK\n"
    library = build(text)
    library.instance("Test").scan()
    assert library.branches() == {}
    assert not [name for name in library.compiler.objects if name.startswith(("hits_", "outcomes_"))]
