"""The long form: what it prints, and what it exits with."""

import sys

import pytest
from tests.blocks.compare import long
from tests.blocks.compare.comparison import build
from tests.blocks.compare.pou import AROUND, read, shipped

from structured_text.engines.embedded import EmbeddedEngine
from structured_text.engines.engine import Source


def _run(monkeypatch: pytest.MonkeyPatch, *arguments: str) -> int:
    monkeypatch.setattr(sys, "argv", ["long", *arguments])
    return long.main()


def test_a_block_that_is_the_same_is_listed_with_its_engines(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """The engines first, found or not; then one line per block, and the sum."""
    assert _run(monkeypatch, "--scans", "30", "--blocks", "MB_HexDigit") == 0
    told = capsys.readouterr().out
    assert "embedded: runs" in told
    line = next(each for each in told.splitlines() if each.startswith("MB_HexDigit: 30 scans the same on "))
    assert "embedded" in line
    assert "1 blocks and functions, 30 scans each, 0 that differ" in told


def test_a_difference_is_reported_with_the_command_that_repeats_it(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """One constant changed on one of two engines."""
    texts = [each for each in shipped().sources if each.path != AROUND]
    wrong = read([Source(each.path, each.text.replace("Digit + 55", "Digit + 87")) for each in texts])
    libraries = {**build({"right": EmbeddedEngine()}), **build({"wrong": EmbeddedEngine()}, wrong)}
    monkeypatch.setattr(long, "_libraries", lambda: libraries)
    assert _run(monkeypatch, "--scans", "100", "--blocks", "MB_HexDigit", "--seed", "5") == 1
    told = capsys.readouterr().out
    scan = int(told.partition("MB_HexDigit, scan ")[2].partition(",")[0])
    assert f"again: python -m tests.blocks.compare.long --blocks MB_HexDigit --scans {scan + 1} --seed 5" in told
    assert "right: 6" in told


def test_a_block_that_there_is_not_is_refused(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """By name, with exit status 2."""
    with pytest.raises(SystemExit) as stopped:
        _run(monkeypatch, "--blocks", "MB_HexDigit,MB_Nothing")
    assert stopped.value.code == 2
    assert "the library has no MB_Nothing" in capsys.readouterr().err
