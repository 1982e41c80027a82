"""What real matiec says about real mistakes."""

from dataclasses import replace

import pytest

from structured_text.engines.engine import BuildError, EngineError, Source
from structured_text.engines.matiec import BadCError, CompilerCrashError, Flags, MatiecEngine

GOOD = Source(
    "good.st",
    "TYPE\n  Frame : ARRAY[0..3] OF BYTE;\nEND_TYPE\n"
    "FUNCTION One : INT\n  VAR_INPUT\n    A : INT;\n  END_VAR\n  One := A;\nEND_FUNCTION",
)


LAST = Source("last.st", "FUNCTION Two : INT\n  VAR_INPUT\n    A : INT;\n  END_VAR\n  Two := A;\nEND_FUNCTION\n")


def block(body: str, path: str = "bad.st") -> Source:
    """Make a block with one statement, on line 5."""
    text = f"FUNCTION_BLOCK Bad\n  VAR\n    X : INT; F : Frame; R, Q : REAL;\n  END_VAR\n{body}\nEND_FUNCTION_BLOCK\n"
    return Source(path, text)


def test_message_has_our_file_line_and_column(matiec: MatiecEngine) -> None:
    """On the second line of a body: on the first, matiec counts columns one too far."""
    with pytest.raises(BuildError) as caught:
        matiec.build([GOOD, block("  X := 1;\n  X := TRUE + 1;"), LAST])
    assert type(caught.value) is BuildError
    first = caught.value.messages[0]
    assert (first.path, first.line, first.column) == ("bad.st", 6, 8)
    assert "'+'" in first.text


def test_syntax_error_has_our_file_and_line(matiec: MatiecEngine) -> None:
    with pytest.raises(BuildError) as caught:
        matiec.build([GOOD, block("  Nothing := 1;")])
    assert [(each.path, each.line) for each in caught.value.messages] == [("bad.st", 5)]


def test_text_that_iec2c_gives_up_on_is_refused(matiec: MatiecEngine) -> None:
    """It names no place then."""
    with pytest.raises(BuildError, match="too many consecutive syntax errors"):
        matiec.build([GOOD, block("  X = 1;")])


def test_configuration_that_makes_no_sense_has_our_line(matiec: MatiecEngine) -> None:
    """Found late, while the C is written, and told in other words."""
    text = (
        "PROGRAM Once\n  VAR\n    N : INT;\n  END_VAR\n  N := 1;\nEND_PROGRAM\nCONFIGURATION Plant\n"
        "  RESOURCE Cpu ON PLC\n    PROGRAM P1 : Once;\n  END_RESOURCE\nEND_CONFIGURATION\n"
    )
    with pytest.raises(BuildError, match="at least one periodic task") as caught:
        matiec.build([Source("plant.st", text)])
    assert (caught.value.messages[0].path, caught.value.messages[0].line) == ("plant.st", 7)


def test_c_that_does_not_compile_is_recognised_and_placed(matiec: MatiecEngine) -> None:
    """matiec cannot pass an array to a function; the C of such a call has several lines."""
    text = "FUNCTION First : BYTE\n  VAR_INPUT\n    F : Frame;\n  END_VAR\n  First := F[0];\nEND_FUNCTION\n"
    caller = (
        "FUNCTION_BLOCK Caller\n  VAR\n    F : Frame; B : BYTE;\n  END_VAR\n  B := First(F);\n  B := BYTE#1;\n"
        "  B := BYTE#2;\n  B := BYTE#3;\n  B := BYTE#4;\nEND_FUNCTION_BLOCK\n"
    )
    with pytest.raises(BadCError) as caught:
        matiec.build([GOOD, Source("array.st", text), Source("caller.st", caller)])
    assert {(each.path, each.line) for each in caught.value.messages} == {("caller.st", 5)}


def test_crash_without_a_word(matiec: MatiecEngine) -> None:
    text = "FUNCTION_BLOCK B\n  VAR\n    a__b : INT;\n  END_VAR\n  a__b := 1;\nEND_FUNCTION_BLOCK\n"
    with pytest.raises(EngineError) as caught:
        matiec.build([Source("crash.st", text)])
    assert isinstance(caught.value, CompilerCrashError | BuildError)
    assert "crash" in str(caught.value)


def test_warning_of_the_c_compiler_is_kept_with_the_build(fresh: MatiecEngine) -> None:
    """The second time it comes from the cache, and then names the file that is built then."""
    wary = replace(fresh, flags=Flags(extra=("-Wfloat-equal",)))
    body = "  IF R = Q THEN\n    X := 1;\n  END_IF;"
    for path in ("one.st", "two.st"):
        warnings = wary.build([GOOD, block(body, path)]).warnings
        assert [(each.path, each.line) for each in warnings] == [(path, 5)]
        assert "float" in warnings[0].text
    assert not fresh.build([GOOD, block(body)]).warnings


def test_name_that_the_library_of_matiec_uses_is_explained(matiec: MatiecEngine) -> None:
    """All that iec2c says then is about its own files; one line on ours gives the cause."""
    text = "(* head *)\nPROGRAM P\n  VAR\n    X : INT;\n  END_VAR\n  X := 1;\nEND_PROGRAM\n"
    with pytest.raises(BuildError) as caught:
        matiec.build([Source("p.st", text)])
    (only,) = caught.value.messages
    assert (only.path, only.line) == ("p.st", 2)
    assert "P is named as a parameter there" in only.text
    assert "give it another name" in only.text


def test_nothing_at_all(matiec: MatiecEngine) -> None:
    with pytest.raises(EngineError, match=r"\w"):
        matiec.build([])
