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
