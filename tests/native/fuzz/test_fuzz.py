"""The corpus and the regressions through every target."""

import functools
from dataclasses import replace
from pathlib import Path

import pytest
from tests.native.fuzz import corpus
from tests.native.fuzz.program import replayer, targets
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


@pytest.mark.parametrize("target", targets())
def test_every_input_gives_the_error_id_that_is_noted(target: str) -> None:
    if not (lines := found_lines()):
        pytest.skip("iec2c was not found")
    inputs = kept(target)
    for number, engine in enumerate(lines):
        codes = corpus.replay(program(number), target, [each.data for each in inputs])
        assert codes == [each.code for each in inputs], engine.name


def test_the_corpus_is_small_and_reaches_every_error_id_of_a_request_and_a_reply() -> None:
    files = [*corpus.CORPUS.glob("*"), *corpus.REGRESSIONS.glob("*")]
    assert {file.stem for file in files} == set(targets())
    assert sum(file.stat().st_size for file in corpus.CORPUS.glob("*")) < KILOBYTES * 1024
    reached = {each.code for target in targets() for each in kept(target)}
    commands_and_lengths = {8, 12, 13, 14, 15, 16, 17, 18, 19}
    line = 50
    assert reached == {each.code for each in RESULTS if each.code < line} - commands_and_lengths
