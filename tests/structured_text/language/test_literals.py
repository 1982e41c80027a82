"""Literals: spelling -> value."""

import pytest

from structured_text.language import literals
from structured_text.language.literals import LiteralError
from structured_text.language.tree import Literal, Qualified

DAY = 86_400_000_000_000


@pytest.mark.parametrize(
    ("text", "value", "base"),
    [
        ("0", 0, 10),
        ("1_000_000", 1000000, 10),
        ("16#FF", 255, 16),
        ("16#a0_01", 0xA001, 16),
        ("8#17", 15, 8),
        ("2#1010_0101", 165, 2),
        ("1.5", 1.5, 10),
        ("1.5E-3", 0.0015, 10),
        ("1E3", 1000.0, 10),
        ("1_0.2_5", 10.25, 10),
    ],
)
def test_numbers(text: str, value: float, base: int) -> None:
    made = literals.number(0, text)
    assert (made.value, made.base, made.prefix) == (value, base, None)
    assert type(made.value) is type(value)


@pytest.mark.parametrize(
    ("text", "prefix", "value"),
    [
        ("WORD#16#A001", "WORD", 0xA001),
        ("byte#2#11", "BYTE", 3),
        ("INT#-5", "INT", -5),
        ("UINT#16#FF", "UINT", 255),
        ("BOOL#1", "BOOL", True),
        ("BOOL#false", "BOOL", False),
        ("REAL#-2.5", "REAL", -2.5),
        ("LREAL#1.0E3", "LREAL", 1000.0),
        ("STRING#'ab'", "STRING", b"ab"),
        ('WSTRING#"ab"', "WSTRING", "ab"),
        ("T#500ms", "TIME", 500_000_000),
        ("T#1s500ms", "TIME", 1_500_000_000),
        ("TIME#1.5s", "TIME", 1_500_000_000),
        ("t#1d2h3m4s5ms", "TIME", DAY + 7_384_005_000_000),
        ("T#-1s", "TIME", -1_000_000_000),
        ("T#1d_2h", "TIME", DAY + 7_200_000_000_000),
        ("T#3500us", "TIME", 3_500_000),
        ("T#0.1ms", "TIME", 100_000),
        ("D#1970-01-02", "DATE", DAY),
        ("DATE#2024-02-29", "DATE", 19782 * DAY),
        ("TOD#23:59:59.5", "TIME_OF_DAY", DAY - 500_000_000),
        ("TIME_OF_DAY#00:00:01", "TIME_OF_DAY", 1_000_000_000),
        ("DT#1970-01-01-00:00:01", "DATE_AND_TIME", 1_000_000_000),
    ],
)
def test_typed(text: str, prefix: str, value: object) -> None:
    made = literals.typed(0, text)
    assert isinstance(made, Literal)
    assert (made.prefix, made.value, made.text) == (prefix, value, text)
    assert type(made.value) is type(value)


def test_a_prefix_that_is_no_type_is_an_enumeration() -> None:
    made = literals.typed(7, "E_Line#IDLE")
    assert isinstance(made, Qualified)
    assert (made.at, made.type_name, made.name) == (7, "E_Line", "IDLE")


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("''", b""),
        ("'AB'", b"AB"),
        ("'$$ $' $L$N$P$R$T'", b"$ ' \n\n\f\r\t"),
        ("'$0D$0a$963'", b"\r\n\x963"),
        ("'é'", b"\xc3\xa9"),
    ],
)
def test_strings_are_bytes(text: str, value: bytes) -> None:
    assert literals.string(0, text).value == value


def test_wide_strings_are_text() -> None:
    assert literals.wide_string(0, '"$00e9$"$N漢"').value == 'é"\n漢'


@pytest.mark.parametrize(
    "text",
    [
        "T#",
        "T#1",
        "T#ms",
        "T#1ms2s",
        "T#1.5s2ms",
        "T#1s1s",
        "D#2023-02-29",
        "D#2023-13-01",
        "D#20230101",
        "TOD#24:00:00",
        "TOD#12:60:00",
        "DT#2023-01-01",
        "BOOL#2",
        "INT#1.5",
        "INT#abc",
        "WORD#16#XY",
        "WORD#3#12",
        "BYTE#2#12",
        "REAL#abc",
        "REAL#1.0E999",
        "Nobody#16#FF",
        "STRING#'$4'",
        "STRING#'$Q'",
    ],
)
def test_what_has_no_value(text: str) -> None:
    with pytest.raises(LiteralError, match=r"expected"):
        literals.typed(0, text)


@pytest.mark.parametrize("text", ["0x1F", "16#XY", "10#5", "1__0", "3#12"])
def test_numbers_that_are_none(text: str) -> None:
    with pytest.raises(LiteralError, match=r"expected"):
        literals.number(0, text)
