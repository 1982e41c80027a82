"""Statements: choices, loops and how they are left, bounded scans."""

from __future__ import annotations

import pytest
from tests.structured_text.engines.embedded.snippets import block, build

from structured_text.engines.engine import BuildError, ScanError

COUNTER = "VAR_INPUT n : INT; END_VAR VAR_OUTPUT y : INT; END_VAR VAR i : INT; k : INT; END_VAR"


def run(body: str, n: int) -> int:
    """The output `y` after one scan with the input `n`."""
    made = block(COUNTER, body)
    made["n"] = n
    made.scan()
    answer = made["y"]
    assert isinstance(answer, int)
    return answer


IF = "IF n > 10 THEN y := 1; ELSIF n > 5 THEN y := 2; ELSIF n > 0 THEN y := 3; ELSE y := 4; END_IF;"
CASE = """CASE n OF
  -3: y := 1;
  1, 2: y := 2;
  5..8, 10: y := 3;
  -20..-10: y := 4;
ELSE y := 9; END_CASE;"""


@pytest.mark.parametrize(("n", "expected"), [(11, 1), (10, 2), (6, 2), (5, 3), (1, 3), (0, 4), (-7, 4)])
def test_if(n: int, expected: int) -> None:
    """The first branch whose condition holds."""
    assert run(IF, n) == expected


@pytest.mark.parametrize(
    ("n", "expected"), [(-3, 1), (1, 2), (2, 2), (3, 9), (5, 3), (8, 3), (9, 9), (10, 3), (-20, 4), (-10, 4), (-9, 9)]
)
def test_case(n: int, expected: int) -> None:
    """Labels, lists and ranges."""
    assert run(CASE, n) == expected


def test_case_without_match_and_else_does_nothing() -> None:
    """IEC 61131-3 3.3.2.3."""
    assert run("y := 7; CASE n OF 1: y := 1; END_CASE;", 2) == 7


@pytest.mark.parametrize("count", [50, 51, 100, 1200])
def test_a_case_of_many_branches(count: int) -> None:
    """More branches than Python takes inside each other, one of them, and what follows ELSE."""
    labels = " ".join(f"{number}: y := {number + 1};" for number in range(count))
    made = block(COUNTER, f"y := 7; CASE n OF {labels} ELSE y := -1; END_CASE;")
    for number, expected in ((0, 1), (49, 50), (count - 1, count), (count, -1), (-1, -1)):
        made["n"] = number
        made.scan()
        assert made["y"] == expected


def test_while_and_exit() -> None:
    """The sum of 1..n, left early at 7."""
    body = "y := 0; i := 0; WHILE i < n DO i := i + 1; IF i = 7 THEN EXIT; END_IF; y := y + i; END_WHILE;"
    assert [run(body, n) for n in (0, 1, 3, 6, 7, 20)] == [0, 1, 6, 21, 21, 21]


def test_repeat_runs_at_least_once() -> None:
    """The condition follows."""
    body = "y := 0; REPEAT y := y + 1; UNTIL y >= n END_REPEAT;"
    assert [run(body, n) for n in (-5, 1, 4)] == [1, 1, 4]


@pytest.mark.parametrize(
    ("head", "expected"),
    [("0 TO 4", 10), ("4 TO 0 BY -1", 10), ("0 TO 9 BY 3", 18), ("5 TO 4", 0), ("0 TO n BY 2", 6), ("n TO 0 BY -2", 8)],
)
def test_for(head: str, expected: int) -> None:
    """The sum of the values that the control variable takes; n is 5, except that no loop here runs once."""
    assert run(f"y := 0; FOR i := {head} DO y := y + i; END_FOR;", 5) == expected + (head.startswith("n"))


def test_for_that_runs_once_is_a_miscompile_of_beremiz() -> None:
    """Beremiz' compiler leaves it out, so that it is refused."""
    body = "y := 0; FOR i := n TO 3 DO y := y + 1; END_FOR;"
    with pytest.raises(ScanError, match=r"exactly once"):
        run(body, 3)
    assert run(body, 2) == 2


def test_a_for_over_its_whole_type_does_not_end() -> None:
    """The control variable wraps and never gets beyond the end: the budget stops it."""
    made = block("VAR u : USINT; n : UINT; END_VAR", "FOR u := 0 TO 255 DO n := n + 1; END_FOR;")
    with pytest.raises(ScanError, match="does not end"):
        made.scan()


def test_limits_of_for_are_taken_once() -> None:
    """Except on matiec, which looks again before each turn."""
    body = "k := 3; y := 0; FOR i := 1 TO k DO k := 5; y := y + 1; END_FOR;"
    assert run(body, 0) == 3


def test_nested_loops() -> None:
    """EXIT leaves the innermost one."""
    body = """y := 0; i := 0;
    WHILE i < 10 DO
      k := 0;
      WHILE TRUE DO k := k + 1; IF k > i THEN EXIT; END_IF; y := y + 1; END_WHILE;
      i := i + 1;
    END_WHILE;"""
    assert run(body, 0) == sum(range(10))


def test_return_from_inside_a_loop_keeps_what_was_written() -> None:
    """Variables that live in Python variables during the loop are put back."""
    body = "i := 0; WHILE i < 100 DO i := i + 1; y := i * 2; IF i = n THEN RETURN; END_IF; END_WHILE; y := -1;"
    assert run(body, 5) == 10
    made = block(COUNTER, body)
    made["n"] = 5
    made.scan()
    assert made["i"] == 5


def test_a_fault_inside_a_loop_keeps_what_was_written() -> None:
    """So that the state after a ScanError shows what happened."""
    made = block(COUNTER, "i := 0; WHILE i < 100 DO i := i + 1; y := 10 / (n - i); END_WHILE;")
    made["n"] = 5
    with pytest.raises(ScanError, match="division by zero"):
        made.scan()
    assert (made["i"], made["y"]) == (5, 10)


class TestBudget:
    """A scan may take this many turns of loops, all loops together; the look that ends a WHILE counts as one."""

    TEXT = """FUNCTION_BLOCK Test
VAR_INPUT n : UINT; END_VAR
VAR i : UINT; END_VAR
  i := 0;
  WHILE i < n DO
    i := i + 1;
  END_WHILE;
  i := 0;
  REPEAT
    i := i + 1;
  UNTIL i >= n END_REPEAT;
END_FUNCTION_BLOCK
"""

    @pytest.mark.parametrize("kind", ["FUNCTION_BLOCK", "PROGRAM"])
    def test_up_to_the_limit(self, kind: str) -> None:
        """Exactly this many are allowed, and each scan has a new budget, that of a program, too."""
        text = self.TEXT.replace("FUNCTION_BLOCK", kind).replace("VAR_INPUT n", "VAR n")
        made = build(text, loop_limit=101).instance("Test")
        made["n"] = 50
        for _ in range(3):
            made.scan()

    def test_beyond_the_limit(self) -> None:
        """The error is at the loop in which the budget ended."""
        made = build(self.TEXT, loop_limit=101).instance("Test")
        made["n"] = 60
        with pytest.raises(ScanError) as caught:
            made.scan()
        assert (caught.value.message.line, caught.value.message.column) == (9, 3)

    def test_loops_of_functions_and_inner_blocks_count(self) -> None:
        """The budget is the scan's, not the block's."""
        text = """FUNCTION Spin : UINT
VAR_INPUT n : UINT; END_VAR
  WHILE Spin < n DO Spin := Spin + 1; END_WHILE;
END_FUNCTION
FUNCTION_BLOCK Inner
VAR_INPUT n : UINT; END_VAR
VAR u : UINT; END_VAR
  u := Spin(n);
END_FUNCTION_BLOCK
FUNCTION_BLOCK Test
VAR_INPUT n : UINT; END_VAR
VAR a, b : Inner; END_VAR
  a(n := n);
  b(n := n);
END_FUNCTION_BLOCK
"""
        made = build(text, loop_limit=101).instance("Test")
        made["n"] = 49
        made.scan()
        made["n"] = 50
        with pytest.raises(ScanError) as caught:
            made.scan()
        assert caught.value.message.line == 3


def test_both_sides_of_and_are_evaluated() -> None:
    """IEC 61131-3 leaves it open; matiec takes C's short circuit."""
    types = "TYPE Row : ARRAY[0..3] OF INT; END_TYPE"
    declarations = "VAR_INPUT n : INT; END_VAR VAR_OUTPUT y : BOOL; END_VAR VAR a : Row; END_VAR"
    for body in ("y := (n < 4) AND (a[n] = 0);", "y := (n > 3) OR (a[n] = 0);"):
        made = block(declarations, body, types=types)
        made["n"] = 4
        with pytest.raises(ScanError, match="index 4 of a is outside"):
            made.scan()


@pytest.mark.parametrize("branches", [1, 15, 16, 17, 32, 33, 3000])
@pytest.mark.parametrize("word", ["IF", "CASE"])
def test_chains_of_any_length(word: str, branches: int) -> None:
    texts = [f"n = {each} THEN y := {each}; " if word == "IF" else f"{each}: y := {each}; " for each in range(branches)]
    chain = "ELSIF ".join(texts) if word == "IF" else "".join(texts)
    body = f"{'IF ' if word == 'IF' else 'CASE n OF '}{chain}ELSE y := -1; END_{word};"
    made = block(COUNTER, body)
    for n in {-1, 0, 14, 15, 16, 17, 31, 32, branches - 1, branches, 2999}:
        made["n"] = n
        made.scan()
        assert made["y"] == (n if 0 <= n < branches else -1)


def test_a_long_chain_is_left_and_counted_as_a_short_one() -> None:
    chain = "ELSIF ".join(f"i = {each} THEN k := {each}; " for each in range(40))
    body = f"WHILE TRUE DO i := i + 1; IF {chain}ELSE EXIT; END_IF; END_WHILE; y := k;"
    library = build(f"FUNCTION_BLOCK Test {COUNTER} {body} END_FUNCTION_BLOCK", coverage=True)
    made = library.instance("Test")
    made.scan()
    assert made["y"] == 39
    (outcomes,) = library.branches().values()
    counts = [hits for outcome, hits in sorted(outcomes.items()) if "IF" in outcome[2]]
    assert sum(counts) == 39 + sum(range(1, 40)) + 40


@pytest.mark.parametrize(
    "loop", ["WHILE i < 1 DO {} i := i + 1; END_WHILE;", "REPEAT {} i := i + 1; UNTIL TRUE END_REPEAT;"]
)
def test_loops_in_loops_as_deep_as_python_goes(loop: str) -> None:
    text = "y := y + 1;"
    for _ in range(19):
        text = loop.format(text)
    assert run(text, 0) == 1
    with pytest.raises(BuildError, match=r"test\.st:4:\d+: the embedded engine runs at most 19 loops in one another"):
        run(loop.format(text), 0)


def test_what_may_be_too_deep_for_python_runs_or_is_reported() -> None:
    """How deep Python goes differs from version to version."""
    chain = "".join(f"{each}: y := {each}; " for each in range(1, 16))
    text = f"r := r{' * 1.5' * 249};"
    for _ in range(38):
        text = f"CASE n OF {chain}0: {text} ELSE y := 2; END_CASE;"
    try:
        block(f"{COUNTER} VAR r : REAL; END_VAR", text).scan()
    except BuildError as error:
        assert "Test is nested too deeply for the embedded engine" in str(error)  # noqa: PT017 - it may run, too


def test_names_that_mean_something_to_python() -> None:
    names = ["__a", "__a__", "_", "self", "None", "s", "t1", "run", "turn", "globals_"]
    types = "TYPE __T : STRUCT __f : INT; END_STRUCT; END_TYPE\n"
    declared = f"{COUNTER} VAR {', '.join(names)} : INT; t : __T; END_VAR"
    turn = " ".join(f"{each} := k;" for each in names)
    body = f"WHILE k < 2 DO k := k + 1; {turn} END_WHILE; t.__f := {' + '.join(names)}; y := t.__f;"
    made = block(declared, body, types=types)
    made.scan()
    assert (made["y"], made["t.__f"], made["__a"]) == (20, 20, 2)
