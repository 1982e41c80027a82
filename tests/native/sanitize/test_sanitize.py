"""The short form: every block by damaged and odd inputs under sanitizers, and proof that the drivers would notice."""

import functools
from dataclasses import replace
from pathlib import Path

import pytest
from tests.blocks.library import alone
from tests.native.driver import Driver
from tests.native.sanitize import __main__ as long
from tests.native.sanitize.campaign import Program, Share, at_once, build, execute, inputs
from tests.native.sanitize.pins import pous
from tests.native.sanitize.planted import FAULTS, spoilt
from tests.native.sanitize.program import text
from tests.native.sanitize.sanitizers import Checked, compilers, found_lines, why_none

from structured_text.engines.matiec import MatiecEngine

INPUTS = 20_000
PARSED = {"CHF_Reply", "JSCC_Reply", "SN300G5_Reply", "MB_ParseReply", "MB_RtuOpen", "MB_AsciiDecode"}
PARSED |= {f"MB_Unpack{box}{bits}" for box in ("Adu", "Chars") for bits in (8, 16)}


def checked(engine: MatiecEngine) -> Checked:
    """One compiler per line, another for the next line, so that all come up; the long form takes all with all."""
    found = compilers(engine)
    if not found:
        pytest.skip(why_none(engine))
    names = [each.name for each in found_lines()]
    return found[names.index(engine.name) % len(found)]


def test_no_block_goes_wrong(matiec: MatiecEngine) -> None:
    done = at_once(build(matiec, checked(matiec)), seed=1, count=INPUTS)
    assert done.finds == []
    built = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19}
    received = {20, 21, 22, 23, 24, 25, 26, 27, 30, 31, 32, 33, 34, 35, 36, 37, 38, 40}
    assert set(done.results) == {0} | built | received, "the inputs reach every ErrorID"


def test_parsers_get_ten_times_as_much_in_the_long_form(matiec: MatiecEngine) -> None:
    counts = {pou.name: inputs(pou) for pou in pous(matiec)}
    assert len(counts) == len(alone()) - 5, "every file but the five types"
    assert {name for name, count in counts.items() if count == 10_000_000} == PARSED
    assert set(counts.values()) == {1_000_000, 10_000_000}


@pytest.mark.parametrize("name", ["MB_RtuOpen", "JSCC_Reference", "MB_HexDigit"])
def test_each_block_compiles_alone(matiec: MatiecEngine, name: str) -> None:
    """As --only asks for it: what the C by hand names of other blocks is there, too."""
    library = pous(matiec)
    Driver(text([each for each in library if each.name == name], library), ("-fsyntax-only",)).build(matiec)


def test_a_share_that_takes_too_long_is_a_find(tmp_path: Path) -> None:
    """The rest of the campaign goes on."""
    waits = tmp_path / "waits"
    waits.write_text("#!/bin/sh\nexec sleep 60\n", encoding="utf-8")
    waits.chmod(0o755)
    (find,) = execute(Share(Program("line", waits, ()), "MB_Lrc", 3, 1, seconds=0.2)).finds
    assert find.startswith("seed 3: Command ")


def test_an_unknown_block_is_refused(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit, match="2"):
        long.main(["--only", "MB_RtuOpen,MB_Nothing"])
    assert "the library has no MB_NOTHING" in capsys.readouterr().err


def test_what_is_missing_is_reported(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    """A compiler by name; without any line of matiec nothing has run, which is no success."""
    monkeypatch.setattr(long, "compilers", lambda _: [])
    assert long.main([]) == 2
    assert all(f"{each.name} clang: does not run" in capsys.readouterr().out for each in found_lines()[:1])
    monkeypatch.setattr(long, "found_lines", list)
    assert long.main([]) == 2
    assert "nothing ran: needs iec2c" in capsys.readouterr().out


@functools.cache
def spoilt_program(engine_name: str) -> Program:
    """Its drivers, compiled once; a scan takes microseconds, one that takes a second of the processor does not end."""
    engine = next(each for each in found_lines() if each.name == engine_name)
    hasty = checked(engine)
    hasty = replace(hasty, options=(*hasty.options, "-DSECONDS_WITHOUT_END=1", "-DINPUTS_BETWEEN_ALARMS=1"))
    return build(engine, hasty, spoilt(), [name.upper() for name in FAULTS])


@pytest.mark.parametrize("name", FAULTS)
def test_a_fault_in_a_block_is_found(name: str) -> None:
    """On one line: the drivers are the same on the other."""
    if not found_lines():
        pytest.skip("iec2c was not found")
    outcome = execute(Share(spoilt_program(found_lines()[0].name), name, 1, 1_000_000))
    assert outcome.finds, "nothing was found"
    assert FAULTS[name][2] in outcome.finds[0]
    assert f"FOUND {name}, seed 1, input " in outcome.finds[0], "what to repeat is reported, and the input"
