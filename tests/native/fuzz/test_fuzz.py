"""The corpus and the regressions through every target, and through libFuzzer where it is found."""

import functools
import os
import subprocess
from dataclasses import replace
from pathlib import Path

import pytest
from tests.native.driver import Driver
from tests.native.fuzz import __main__ as long
from tests.native.fuzz import corpus
from tests.native.fuzz.program import fuzzer, libfuzzer, replayer, targets, text
from tests.native.fuzz.seeds import seeds
from tests.native.sanitize.planted import spoilt
from tests.native.sanitize.sanitizers import compilers, found_lines, why_none

from driveblocks.render.results import RESULTS

KILOBYTES = 76


def kept(target: str) -> list[corpus.Input]:
    """All inputs of a target in the repository."""
    files = (folder / f"{target}.txt" for folder in (corpus.CORPUS, corpus.REGRESSIONS))
    return [each for file in files for each in corpus.read(file)]


@functools.cache
def program(line: int) -> Path:
    """What replays on a line: not optimised, since so few inputs are not worth the time of a compiler."""
    engine = found_lines()[line]
    if not (found := compilers(engine)):
        pytest.skip(why_none(engine))
    return replayer(engine, replace(found[0], options=(*found[0].options, "-O0")))


@functools.cache
def libfuzzer_program(line: int) -> Path | None:
    """The program of the long form, if it can be."""
    checked, lines = libfuzzer(), found_lines()
    return fuzzer(lines[line], checked) if checked and lines else None


@pytest.mark.parametrize("target", targets())
def test_every_input_gives_the_error_id_that_is_noted(target: str) -> None:
    """On the first line, and on the others too where libFuzzer is not there for them."""
    if not (lines := found_lines()):
        pytest.skip("iec2c was not found")
    inputs = kept(target)
    for number, engine in enumerate(lines[:1] if libfuzzer() else lines):
        codes = corpus.replay(program(number), target, [each.data for each in inputs])
        assert codes == [each.code for each in inputs], engine.name


@functools.cache
def spoilt_program() -> Path:
    """The first line's, of the library with a fault in many blocks."""
    engine = found_lines()[0]
    if not (found := compilers(engine)):
        pytest.skip(why_none(engine))
    return Driver(text(engine), (*found[0].options, "-O0"), found[0].command).build(engine, spoilt())


@pytest.mark.parametrize("target", ["rtu_open", "ascii_decode", "parse_reply", "jscc_reply", "chf_request"])
def test_a_fault_in_a_block_stops_the_program(target: str) -> None:
    """A length one too high, a refusal of any length: what is kept reaches it, and its judge sees it."""
    if not found_lines():
        pytest.skip("iec2c was not found")
    with pytest.raises(AssertionError, match=f"{target} stops at "):
        corpus.replay(spoilt_program(), target, [each.data for each in kept(target)])


@pytest.mark.parametrize("target", targets())
def test_libfuzzer_replays_every_input(target: str, tmp_path: Path) -> None:
    """The program of the long form, on the last line."""
    if (whole := libfuzzer_program(-1)) is None:
        pytest.skip("needs clang with libFuzzer, and iec2c")
    inputs = [*(each.data for each in kept(target)), *seeds(target)]
    for number, data in enumerate(inputs):
        (tmp_path / f"{number}").write_bytes(data)
    files = [str(tmp_path / f"{number}") for number in range(len(inputs))]
    command = [str(whole), *files]
    done = subprocess.run(
        command,
        env={**os.environ, "DRIVEBLOCKS_TARGET": target},
        capture_output=True,
        text=True,
        errors="replace",
        timeout=1200,
        check=False,
    )
    assert done.returncode == 0, f"{done.stdout[-1000:]}{done.stderr[-4000:]}"
    assert done.stderr.count("Executed ") == len(inputs)


def test_the_corpus_is_small_and_reaches_every_error_id_of_a_request_and_a_reply() -> None:
    files = [*corpus.CORPUS.glob("*"), *corpus.REGRESSIONS.glob("*")]
    assert {file.stem for file in files} == set(targets())
    assert sum(file.stat().st_size for file in corpus.CORPUS.glob("*")) < KILOBYTES * 1024
    reached = {each.code for target in targets() for each in kept(target)}
    commands_and_lengths = {8, 12, 13, 14, 15, 16, 17, 18, 19}
    line = 50
    assert reached == {each.code for each in RESULTS if each.code < line} - commands_and_lengths


def test_a_line_without_an_error_id_is_refused(tmp_path: Path) -> None:
    (tmp_path / "bad.txt").write_text("0103\n", encoding="utf-8")
    with pytest.raises(ValueError, match="no ErrorID after the bytes: 0103"):
        corpus.read(tmp_path / "bad.txt")


def test_an_unknown_target_is_refused(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit, match="2"):
        long.main(["--target", "rtu_open,nothing"])
    assert "there is no target nothing" in capsys.readouterr().err


def test_without_a_line_nothing_has_run(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.setattr(long, "found_lines", list)
    assert long.main([]) == 2
    assert "needs clang with libFuzzer" in capsys.readouterr().out


def test_what_is_written_is_read_again(tmp_path: Path) -> None:
    inputs = corpus.described([b"", b"\x01\x03"], [20, 21])
    corpus.write(tmp_path / "good.txt", "two", inputs)
    assert corpus.read(tmp_path / "good.txt") == inputs
