"""Literals, comments and columns of generated text."""

import pytest

from structured_text.language import writing


@pytest.mark.parametrize(
    ("text", "wanted"),
    [
        ("plain", "'plain'"),
        ("it's $5", "'it$'s $$5'"),
        ("过流", "'$E8$BF$87$E6$B5$81'"),
        ("1: 过流", "'$31$3A$20$E8$BF$87$E6$B5$81'"),
    ],
)
def test_strings_escape_what_compilers_trip_over(text: str, wanted: str) -> None:
    assert writing.string(text.encode()) == wanted


def test_a_comment_cannot_end_itself() -> None:
    assert "*)" not in writing.comment("a *) b (* c")
    assert "(*" not in writing.comment("a *) b (* c")


def test_comments_of_a_run_of_declarations_share_a_column() -> None:
    text = "VAR\n  A : BOOL; (* one *)\n  Longer : UINT := 5; (* two *)\nEND_VAR\n  B : INT; (* three *)"
    lines = writing.aligned(text).split("\n")
    assert lines[1].index("(*") == lines[2].index("(*")
    assert lines[4] == "  B : INT; (* three *)"


def test_a_long_statement_is_broken_at_its_commas_and_operators() -> None:
    calls = [f"    Block({', '.join(f'Input{n} := Reads.Word{n}' for n in range(count))});" for count in (4, 9)]
    tests = f"  Good := {' AND '.join(f'(Condition{n} = Wanted{n})' for n in range(9))};"
    spoken = f"  Text := '{'a, b ' * 40}';"
    lines = writing.folded("\n".join((*calls, tests, spoken))).split("\n")
    assert lines[0] == calls[0]
    assert lines[-1] == spoken
    assert max(map(len, lines[:-1])) <= writing.MOST
    assert " ".join(line.strip() for line in lines[1:-1]) == f"{calls[1].strip()} {tests.strip()}"
    assert lines[2].startswith("      Input")
    assert lines[-2].startswith("    AND (Condition")
