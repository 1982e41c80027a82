"""The corpus and the regressions through every target, with libFuzzer where it is found; and that they would notice."""

import functools
import os
import subprocess
from pathlib import Path

import pytest
from tests.blocks.library import sources
from tests.native.driver import Driver
from tests.native.fuzz import corpus
from tests.native.fuzz.program import fuzzer, libfuzzer, replayer, targets, text
from tests.native.fuzz.seeds import seeds
from tests.native.sanitize.sanitizers import Checked, compilers, found_lines, why_none

from driveblocks.host.engine import Source
from driveblocks.host.matiec import MatiecEngine
from driveblocks.render.results import RESULTS

KILOBYTES = 40


def kept(target: str) -> list[corpus.Input]:
    """All inputs of a target in the repository."""
    files = (folder / f"{target}.txt" for folder in (corpus.CORPUS, corpus.REGRESSIONS))
    return [each for file in files for each in corpus.read(file)]


def plain(engine: MatiecEngine) -> Checked:
    """The first compiler with sanitizers."""
    if not (found := compilers(engine)):
        pytest.skip(why_none(engine))
    return found[0]


@pytest.mark.parametrize("target", targets())
def test_every_input_gives_the_error_id_that_is_noted(matiec: MatiecEngine, target: str) -> None:
    """On the first line; the other is the one that libFuzzer runs, if it is there."""
    if libfuzzer() and matiec.name != found_lines()[0].name:
        pytest.skip("libFuzzer replays on this line")
    inputs = kept(target)
    assert corpus.replay(replayer(matiec, plain(matiec)), target, [each.data for each in inputs]) == [
        each.code for each in inputs
    ]


@pytest.mark.parametrize("target", targets())
def test_libfuzzer_replays_every_input(target: str, tmp_path: Path) -> None:
    """The program of the long form, on the last line."""
    checked, lines = libfuzzer(), found_lines()
    if checked is None or not lines:
        pytest.skip("needs clang with libFuzzer, and iec2c")
    inputs = [*(each.data for each in kept(target)), *seeds(target)]
    for number, data in enumerate(inputs):
        (tmp_path / f"{number}").write_bytes(data)
    files = [str(tmp_path / f"{number}") for number in range(len(inputs))]
    command = [str(fuzzer(lines[-1], checked)), *files]
    done = subprocess.run(
        command,
        env={**os.environ, "DRIVEBLOCKS_TARGET": target},
        capture_output=True,
        text=True,
        errors="replace",
        timeout=300,
        check=False,
    )
    assert done.returncode == 0, f"{done.stdout[-1000:]}{done.stderr[-4000:]}"
    assert done.stderr.count("Executed ") == len(inputs)


def test_the_corpus_is_small_and_reaches_every_error_id_of_a_request_and_a_reply() -> None:
    files = [*corpus.CORPUS.glob("*"), *corpus.REGRESSIONS.glob("*")]
    assert {file.stem for file in files} == set(targets())
    assert sum(file.stat().st_size for file in corpus.CORPUS.glob("*")) < KILOBYTES * 1024
    reached = {each.code for target in targets() for each in kept(target)}
    commands_and_lengths = {8, 12, 13, 14, 15, 16}
    assert reached == {each.code for each in RESULTS} - commands_and_lengths


FAULTS = {
    "rtu_open": ("MB_RtuOpen", "ELSIF AduLength > 256 THEN", "ELSIF AduLength > 65000 THEN"),
    "ascii_decode": ("MB_AsciiDecode", "ELSIF CharCount > 513 THEN", "ELSIF CharCount > 65000 THEN"),
    "parse_reply": ("MB_ParseReply", "ELSIF Tail <> Request.Value THEN", "ELSIF Tail = WORD#16#0001 THEN"),
    "chf_request": ("MB_BuildRead", "UINT_TO_BYTE(Quantity)", "UINT_TO_BYTE(Quantity + 1)"),
    "chf_reply": ("CHF_Reply", "TwoByteCount := TRUE", "TwoByteCount := FALSE"),
    "jscc_reply": ("JSCC_Reply", "ErrorAddress := WORD#16#0000", "ErrorAddress := WORD#16#0000, EN := FALSE"),
    "sn300g5_request": ("MB_BuildDiagnostics", "IF (UnitAddress < 1) OR (UnitAddress > 247)", "IF (UnitAddress > 0)"),
}
"""By target: a block, what is changed in it, and into what."""


@functools.cache
def spoilt() -> Path:
    """The replaying program of a library with all faults at once, compiled once."""
    engine = found_lines()[0]
    by_block = {block: (good, bad) for block, good, bad in FAULTS.values()}
    texts = []
    for each in sources():
        good, bad = by_block.get(Path(each.path).stem, ("", ""))
        assert good in each.text, each.path
        texts.append(Source(each.path, each.text.replace(good, bad) if good else each.text))
    checked = plain(engine)
    return Driver(text(engine), checked.options, checked.command).build(engine, texts)


@pytest.mark.parametrize("target", FAULTS)
def test_a_fault_in_a_block_stops_the_replay(target: str) -> None:
    if not found_lines():
        pytest.skip("iec2c was not found")
    with pytest.raises(AssertionError, match=f"{target} stops at [0-9a-f]+"):
        corpus.replay(spoilt(), target, [each.data for each in kept(target)])


def test_a_line_without_an_error_id_is_refused(tmp_path: Path) -> None:
    (tmp_path / "bad.txt").write_text("0103\n", encoding="utf-8")
    with pytest.raises(ValueError, match="no ErrorID behind the bytes: 0103"):
        corpus.read(tmp_path / "bad.txt")


def test_what_is_written_is_read_again(tmp_path: Path) -> None:
    inputs = corpus.described([b"", b"\x01\x03"], [20, 21])
    corpus.write(tmp_path / "good.txt", "two", inputs)
    assert corpus.read(tmp_path / "good.txt") == inputs
