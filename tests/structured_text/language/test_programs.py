"""Whatever has the form of a program: linter and embedded engine say what they think of it, and raise nothing else."""

from itertools import cycle

import pytest

from structured_text.language.lint import lint_sources
from structured_text.language.standard import FUNCTIONS, Signature

VALUES = ["7", "16#FF", "1.5", "TRUE", "WORD#16#00FF", "T#1s", "'ab'", "red", "SQRT(2)", "row", "w"]
PLACES = [
    "i := {};", "r := {};", "q := {};", "w := {};", "row[{}] := 1;", "pair(PT := {});", "i := SHL(w, {});",
    "IF {0} = {0} THEN i := 1; END_IF;", "CASE {} OF 1: i := 1; END_CASE;",
    "FOR i := {0} TO {0} BY {0} DO r := 1.0; END_FOR;",
]  # fmt: skip
OPERATORS = ["+", "-", "*", "/", "MOD", "**", "AND", "&", "OR", "XOR", "=", "<>", "<", ">", "<=", ">="]
HEAD = """TYPE E_Colour : (red, green, blue); END_TYPE
TYPE T_Row : ARRAY[0..3] OF INT; END_TYPE
PROGRAM Example
VAR i : INT; r : REAL; q : BOOL; w : WORD; row : T_Row; pair : TON; END_VAR
"""


def judged(text: str) -> bool:
    """Whether a text parses, so that the linter judges all of it."""
    return not any(each.rule == "syntax" for each in lint_sources([("any.st", text)]))


def program(values: list[str]) -> str:
    """A program with each value in a place that gives it a type, or in one that gives it none."""
    return HEAD + "\n".join(place.format(value) for value, place in zip(values, cycle(PLACES))) + "\nEND_PROGRAM\n"


def calls(name: str, signature: Signature) -> list[str]:
    """A standard function of every value, with too few and too many of them, and with names."""
    formals = [formal for formal, _ in signature.formals]
    made = [f"{name}()"]
    for value in VALUES:
        made += [f"{name}({', '.join([value] * count)})" for count in range(1, len(formals) + 2)]
        made.append(f"{name}({', '.join(f'{formal} := {value}' for formal in formals)})")
        made += [f"{name}({value}, 2)", f"{name}(2, {value})", f"{name}(1.5, {value})"]
    return made


@pytest.mark.parametrize("name", [name for name in FUNCTIONS if name != "NOT"])
def test_every_standard_function_takes_or_refuses_every_literal(name: str) -> None:
    assert judged(program(calls(name, FUNCTIONS[name])))


@pytest.mark.parametrize("operator", OPERATORS)
def test_every_operator_takes_or_refuses_every_literal(operator: str) -> None:
    assert judged(program([f"({left} {operator} {right})" for left in VALUES for right in VALUES]))


@pytest.mark.parametrize(
    ("statement", "rule", "said"),
    [
        ("r := SQRT(2)", "integer-for-real", "expected REAL, found the integer 2: write 2.0"),
        ("r := EXPT(2, 3)", "integer-for-real", "expected REAL, found the integer 2: write 2.0"),
        ("r := MAX(1, 2.5)", "integer-for-real", "expected REAL, found the integer 1: write 1.0"),
        ("i := MOD(7.5, 2.5)", "type-mismatch", "expected an integer for MOD, found a real literal"),
        ("r := 7.5 MOD 2.5", "type-mismatch", "expected an integer for MOD, found REAL"),
        ("w := SHL(1.5, 2)", "type-mismatch", "expected a bit string for SHL, found a real literal"),
        ("w := XOR(1.5, 2.5)", "type-mismatch", "expected a bit string for XOR, found a real literal"),
        ("i := AND(1, 3)", "implicit-conversion", "expected INT, found the bit string of AND: write WORD_TO_INT(AND"),
        ("i := SHL(1, 2) + 3", "implicit-conversion", "expected INT, found the bit string of SHL"),
        ("i := row[SHL(1, 1)]", "implicit-conversion", "expected an integer as index, found WORD"),
        ("i := row[1.5]", "type-mismatch", "expected an integer as index, found REAL"),
        ("w := OR(1, 2)", "untyped-bit-literal", "IronPLC refuses 1 as WORD: write WORD#16#0001"),
    ],
)
def test_what_a_number_without_type_cannot_be_is_reported(statement: str, rule: str, said: str) -> None:
    found = lint_sources([("any.st", f"{HEAD}{statement};\nEND_PROGRAM\n")])
    assert [each.text[: len(said)] for each in found if each.line == 5 and each.rule == rule][:1] == [said]


@pytest.mark.parametrize("statement", ["i := MOD(7, 3)", "r := SQRT(2.0)", "r := EXPT(2.0, 3)", "i := MAX(1, 2)"])
def test_what_it_can_be_is_not(statement: str) -> None:
    assert not [each for each in lint_sources([("any.st", f"{HEAD}{statement};\nEND_PROGRAM\n")]) if each.line == 5]
