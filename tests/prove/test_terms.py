"""Bodies as terms: what they say is what the engine does, and what they cannot say is an error."""

import pytest
import z3
from tests.prove.agreement import compared

from driveblocks.prove.model import models
from driveblocks.prove.question import Verdict, answers, questions
from driveblocks.prove.rules import Rule, Subject
from driveblocks.prove.sorts import UnsupportedError
from structured_text.engines.embedded.engine import EmbeddedEngine
from structured_text.engines.engine import Source

HEAD = """FUNCTION_BLOCK Sample
VAR_INPUT
  Number : UINT;
  Other : INT;
  Pin : BOOL;
END_VAR
VAR_OUTPUT
  Result : UINT;
  Kept : INT;
  Seen : BOOL;
END_VAR
VAR
  Index : UINT;
  Words : ARRAY[0..3] OF WORD;
END_VAR
"""
BODIES = {
    "arithmetic": "Result := (Number * 3 + 7) MOD 11 - Number / 2;",
    "a sign": "Kept := (Other - 5) / 3; Seen := Kept < -2;",
    "comparisons": "Seen := (Other < 5) XOR (Other >= 7) XOR (Number <= 6) XOR (Number > 8) XOR (Number <> 9);",
    "branches": "IF Pin THEN Result := 1; ELSIF Number > 9 THEN Result := 2; ELSE Result := Result + 1; END_IF;",
    "a case": "CASE Number OF 1: Result := 5; 2..4, 9: Result := 6; ELSE Result := 0; END_CASE;",
    "an index": "Words[Number MOD 4] := UINT_TO_WORD(Number); Result := WORD_TO_UINT(Words[1]);",
    "a loop": "Index := 0; WHILE Index < 3 DO Words[Index] := WORD#16#0001; Index := Index + 1; END_WHILE;",
    "functions": "Result := MAX(Number, 3); Seen := NOT Seen XOR Pin;",
    "shifts": "Words[0] := SHL(UINT_TO_WORD(Number), 3) OR SHR(Words[1], 12); Kept := LIMIT(-3, Other, 3);",
}


def sources(body: str) -> list[Source]:
    return [Source("sample.st", f"{HEAD}  {body}\nEND_FUNCTION_BLOCK\n")]


def verdicts(body: str, **given: object) -> dict[str, Verdict]:
    """What becomes of each question about a block."""
    (model,) = models(sources(body), [Subject("Sample", **given)])  # type: ignore[arg-type]
    return {each.question.words: each.verdict for each in answers(questions(model))}


@pytest.mark.parametrize("body", BODIES.values(), ids=BODIES)
def test_the_terms_say_what_the_engine_does(body: str) -> None:
    (model,) = models(sources(body), [Subject("Sample")])
    score = compared(model, EmbeddedEngine().build(sources(body)), 300)
    assert (score.wrong, score.free) == ((), 0)
    assert score.compared > 300


@pytest.mark.parametrize(
    ("body", "said"),
    [
        ("Result := Number + 1;", "the result of + is a UINT"),
        ("Result := Number - 1;", "the result of - is a UINT"),
        ("Result := 9 / Number;", "the divisor is not 0"),
        ("Words[Number] := WORD#16#0000;", "the index is within 0..3"),
        ("Result := Number * 2;", "the result of * is a UINT"),
        ("Kept := -Other;", "the result of - is a INT"),
    ],
)
def test_what_compilers_do_not_agree_on_is_found(body: str, said: str) -> None:
    found = verdicts(body)
    assert found == {f"sample.st line 16: {said}": Verdict.BROKEN}


@pytest.mark.parametrize(
    "body",
    [
        "IF Number < 65535 THEN Result := Number + 1; END_IF;",
        "IF Number >= 5 THEN Result := Number - 5; END_IF;",
        "IF Number <= 13107 THEN Result := 5 * Number; END_IF;",
        "IF Other >= -32763 THEN Kept := Other - 5; END_IF;",
    ],
)
def test_a_guard_keeps_a_result_within_its_width(body: str) -> None:
    assert set(verdicts(body).values()) == {Verdict.PROVED}


@pytest.mark.parametrize(
    ("body", "why"),
    [
        ("WHILE Number > 0 DO Number := Number - 1; END_WHILE;", "a loop without a constant bound"),
        ("IF Pin THEN RETURN; END_IF;", "the statement Return"),
        ("FOR Index := 0 TO 3 DO Words[Index] := WORD#16#0000; END_FOR;", "the statement For"),
    ],
)
def test_what_the_terms_cannot_say_is_an_error(body: str, why: str) -> None:
    with pytest.raises(UnsupportedError, match=why):
        models(sources(body), [Subject("Sample")])


def test_a_premise_that_no_call_comes_to_is_not_proved() -> None:
    never = Rule("never", "", "Seen AND NOT Seen", "FALSE")
    assert verdicts("Seen := Pin;", rules=(never,)) == {"never": Verdict.EMPTY}


def test_memory_at_power_up_has_to_hold_what_always_holds() -> None:
    always = Rule("it is above 0", "", "TRUE", "Result > 0")
    (model,) = models(sources("Result := 1;"), [Subject("Sample", always=(always,))])
    found = {each.question.about: each.verdict for each in answers(questions(model))}
    assert found == {"call by call": Verdict.PROVED, "as declared": Verdict.BROKEN, "all zero": Verdict.BROKEN}


def test_what_is_no_number_compares_as_it_does_everywhere() -> None:
    head = HEAD.replace("Other : INT", "Other : REAL").replace("Kept : INT", "Kept : REAL")
    text = f"{head}  Seen := (Other >= 0.0) OR (Other < 0.0);\nEND_FUNCTION_BLOCK\n"
    (model,) = models([Source("sample.st", text)], [Subject("Sample", rules=(Rule("it is", "", "TRUE", "Seen"),))])
    (answer,) = answers(questions(model))
    assert answer.verdict is Verdict.BROKEN
    assert answer.example is not None
    assert z3.is_true(z3.simplify(z3.fpIsNaN(answer.example.eval(z3.Const("OTHER", z3.Float32())))))
