"""Literals as defaults of function parameters."""

import pytest

from structured_text.engines.engine import EngineError, Value
from structured_text.engines.matiec.library import constant


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("TRUE", True),
        ("bool#false", False),
        ("0", 0),
        ("-12", -12),
        ("BYTE#16#FE", 254),
        ("16#1E3", 0x1E3),
        ("1.5", 1.5),
        ("REAL#-2.5e-1", -0.25),
        ("1E3", 1000.0),
        ("T#1h2m3s4ms", 3723_004_000_000),
        ("time#-1.5s", -1_500_000_000),
        ("''", b""),
        ("'a$$b$'c$0d$N$R$L'", b"a$b'c\r\n\r\n"),
    ],
)
def test_value(text: str, value: Value) -> None:
    found = constant(text)
    assert found == value
    assert type(found) is type(value)


@pytest.mark.parametrize("text", ["Red", "D#2020-01-01", "T#", "[1,2]", "(A:=1)", "1 + 2"])
def test_what_is_no_literal_is_refused(text: str) -> None:
    with pytest.raises(EngineError, match="give the argument"):
        constant(text)
