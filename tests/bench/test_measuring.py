"""What the bench measures does what it says: the forms agree, the inputs are taken; no time is judged here."""

import pytest
from tests.bench import blocks, checksums, drives, engines, exchange, growth
from tests.bench.forms import NATIVE, driver, texts
from tests.bench.inputs import SPECIAL, pins
from tests.bench.units import units
from tests.blocks.library import built
from tests.native.driver import run

from structured_text.engines.embedded import EmbeddedEngine
from structured_text.engines.engine import EngineError
from structured_text.engines.matiec import MatiecEngine


def test_every_block_takes_its_typical_input() -> None:
    library = built(EmbeddedEngine()).library
    for unit in units():
        blocks.work(library, unit)()


def test_refused_input_is_reported(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(SPECIAL, "JSCC_Request", {"Quantity": 13})
    unit = next(unit for unit in units() if unit.name == "JSCC_Request")
    assert pins(unit)["Quantity"] == 13
    with pytest.raises(EngineError, match="JSCC_Request refuses its typical input: 3"):
        blocks.work(built(EmbeddedEngine()).library, unit)


def test_forms_of_the_crc_agree_and_are_timed(matiec: MatiecEngine) -> None:
    rows = checksums.measure([matiec], rounds=1)
    assert len(rows) == 42
    assert {column for columns in rows.values() for column in columns} == {
        f"{matiec.name} {build}{kind}" for build in checksums.BUILDS for kind in ("", " median")
    }


def test_form_that_differs_is_reported(matiec: MatiecEngine) -> None:
    text = (NATIVE / "crc.c").read_text("utf-8").replace("uint8_t upper = 0xFF", "uint8_t upper = 0xFE")
    done = run(driver(text).build(matiec, texts()), 1)
    assert (done.returncode, done.stderr) == (1, "the forms differ\n")


def test_everybody_asks_the_same_and_believes_the_reply(matiec: MatiecEngine) -> None:
    rows = exchange.native([matiec], rounds=1)
    assert set(rows) == {f"{what} {mode}" for what in ("ask", "read") for mode in ("rtu", "ascii")}
    assert all(f"{who} {matiec.name}" in columns for who in ("c", "drive", "any") for columns in rows.values())


def test_embedded_engine_and_pymodbus_are_timed() -> None:
    for columns in exchange.python(rounds=1).values():
        assert {"pymodbus", "drive embedded", "any embedded"} <= set(columns)


@pytest.mark.thorough
def test_build_is_measured_step_by_step() -> None:
    rows = growth.measure(maps=(1,), whole=(1,), registers=(50,), rounds=1)
    assert list(rows) == ["shipped", "shipped without libyaml", "50 registers", "1 maps", "1 maps whole"]
    assert list(rows["1 maps whole"]) == ["load", "blocks", "page", "tests", "MiB"]
    assert list(rows["1 maps"]) == ["load", "blocks"]


def test_every_step_of_the_front_end_is_measured() -> None:
    found = engines.steps("FUNCTION F : INT\n  F := 1;\nEND_FUNCTION\n", rounds=1)
    assert list(found) == ["lex", "parse", "check", "lint"]
    assert min(found.values()) > 0


def test_drive_blocks_run_while_they_are_timed(matiec: MatiecEngine, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(drives, "MIXED", ("JSCC",))
    rows = drives.measure([matiec], rounds=1)
    assert set(rows) == {"JSCC_Drive", drives.LINE, drives.SLOT}
    assert rows["JSCC_Drive"][f"{matiec.name} ns of eight and the line"] > 0
    assert rows[drives.LINE][f"{matiec.name} bytes"] > 1000
