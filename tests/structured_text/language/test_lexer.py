"""Tokens: kinds, places, comments and what is no token."""

import pytest

from structured_text.language.lexer import END, LOOKAHEAD, tokenize


@pytest.mark.parametrize(
    ("text", "kinds"),
    [
        ("a := b + 1;", ["name", ":=", "name", "+", "number", ";"]),
        ("IF a THEN b(); end_if", ["IF", "name", "THEN", "name", "(", ")", ";", "END_IF"]),
        ("x<=y<>z>=1", ["name", "<=", "name", "<>", "name", ">=", "number"]),
        ("a**b=>c", ["name", "**", "name", "=>", "name"]),
        ("1..5", ["number", "..", "number"]),
        ("1.5..2.5", ["number", "..", "number"]),
        ("w.3", ["name", ".", "number"]),
        ("w.%X3", ["name", ".", "direct"]),
        ("%IX0.0 %QW2 %M*", ["direct", "direct", "direct"]),
        ("16#FF 2#1_0 1.5E-3 1E3", ["number"] * 4),
        ("WORD#16#FF INT#-5 T#1d2h3m4.5s REAL#-1.5E+3", ["typed"] * 4),
        ("INT#5-3", ["typed", "-", "number"]),
        ("D#2024-02-29 TOD#12:30:05.5 DT#2024-02-29-12:30:05", ["typed"] * 3),
        ("E_LINE#IDLE STRING#'a'", ["typed", "typed"]),
        ("'it$'s' \"wide$\"\"", ["string", "wstring"]),
        ("_a a_1 Größe", ["name"] * 3),
    ],
)
def test_kinds(text: str, kinds: list[str]) -> None:
    tokens = tokenize(text)
    assert tokens.kinds == [*kinds] + [END] * LOOKAHEAD
    assert not tokens.problems
    for kind, word, at in zip(tokens.kinds, tokens.texts, tokens.ats, strict=True):
        assert text[at : at + len(word)] == word, kind


def test_comments_are_kept_with_what_follows_them() -> None:
    tokens = tokenize("(* one *) a (* two *)\n// three\n/* four */ {five}\nb")
    assert [(each.text, each.style, each.own_line) for each in tokens.comments] == [
        ("one", "(*", True),
        ("two", "(*", False),
        ("three", "//", True),
        ("four", "/*", True),
        ("five", "{", False),
    ]
    assert [each.text for each in tokens.before[0]] == ["one"]
    assert [each.text for each in tokens.before[1]] == ["two", "three", "four", "five"]


@pytest.mark.parametrize(
    ("text", "comment", "rest"),
    [
        ("(* a (* b *) c *) x", "a (* b *) c", ["x"]),
        ("(* a (* b *) x", "a (* b", ["x"]),
        ("(*) *) x", ")", ["x"]),
        ("(***) x", "*", ["x"]),
        ("(**) x", "", ["x"]),
        ("(* ** *) x", "**", ["x"]),
    ],
)
def test_comments_end_where_they_should(text: str, comment: str, rest: list[str]) -> None:
    tokens = tokenize(text)
    assert tokens.comments[0].text == comment
    assert tokens.texts[:-LOOKAHEAD] == rest
    assert (("nested-comment", 0) in tokens.notes) == ("(*" in comment)


@pytest.mark.parametrize(
    ("text", "at", "said"),
    [
        ("a (* open", 2, "end of this comment"),
        ("a /* open", 2, "end of this comment"),
        ("{ open", 0, "end of this comment"),
        ("x := 'open\ny", 5, "closing '"),
        ('x := "open', 5, 'closing "'),
        ("12ab", 0, "expected a number, found 12ab"),
        ("a ? b", 2, "found ?"),
        ("a \x01 b", 2, "U+0001"),
    ],
)
def test_what_is_no_token(text: str, at: int, said: str) -> None:
    problems = tokenize(text).problems
    assert problems[0][0] == at
    assert said in problems[0][1]


def test_garbage_ends_early() -> None:
    assert len(tokenize("?" * 100_000).problems) <= 51
