"""Literals, comments and columns of generated text."""

import pytest

from driveblocks.maps.rules.name import ENCODINGS, LONGEST
from driveblocks.render import environment, literal, results


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
    assert literal.string(text) == wanted


@pytest.mark.parametrize("encoding", ENCODINGS)
def test_the_texts_of_results_fit_as_those_of_a_map_must(encoding: str) -> None:
    texts = [text for result in results.RESULTS for text in (result.en, result.zh)]
    assert [text for text in texts if len(text.encode(encoding)) > LONGEST] == []


def test_a_comment_cannot_end_itself() -> None:
    assert "*)" not in literal.comment("a *) b (* c")
    assert "(*" not in literal.comment("a *) b (* c")


def test_comments_of_a_run_of_declarations_share_a_column() -> None:
    text = "VAR\n  A : BOOL; (* one *)\n  Longer : UINT := 5; (* two *)\nEND_VAR\n  B : INT; (* three *)"
    lines = literal.aligned(text).split("\n")
    assert lines[1].index("(*") == lines[2].index("(*")
    assert lines[4] == "  B : INT; (* three *)"


def test_a_block_declares_what_it_names() -> None:
    used, more, result = (
        "VAR\n  Used : UINT; (* Spare *)\n",
        "  Spare : UINT; (* Spare *)\n",
        "END_VAR\n\n  Used := 1;\n",
    )
    pins = "VAR_INPUT\n  Idle : BOOL; (* a pin stays *)\nEND_VAR\n"
    assert environment.needed(pins + used + more + result) == pins + used + result
    assert environment.needed(f"VAR CONSTANT\n{more}END_VAR\n{pins}") == pins
