"""The corpus and the regressions through every target, and through libFuzzer where it is found."""

import functools
import os
import subprocess
from dataclasses import replace
from pathlib import Path

import pytest
from tests.native.fuzz import corpus
from tests.native.fuzz.program import fuzzer, libfuzzer, replayer, targets
from tests.native.fuzz.seeds import seeds
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
