"""The page of figures comes from the record alone, and reads well; no time is judged here."""

from dataclasses import replace
from pathlib import Path

import pytest
from tests.bench import page, record
from tests.bench.record import Part, Record, Rows
from tests.bench.run import MEASUREMENTS, Measurement, Tools, measured
from tests.bench.table import short

from structured_text.engines.engine import EngineError


@pytest.fixture(scope="module")
def figures() -> Record:
    """The record in `docs/`."""
    return record.read()


def test_the_page_is_written_from_the_record_which_holds_every_measurement(figures: Record) -> None:
    assert (record.DOCS / page.NAME).read_text("utf-8") == page.page(figures), "run python -m tests.bench.run --page"
    assert list(figures) == list(MEASUREMENTS)


def test_part_that_was_not_measured_or_elsewhere_says_so(figures: Record) -> None:
    assert page.page({}).count(page.UNKNOWN.strip()) == 8
    other = replace(figures["growth"], machine={**figures["growth"].machine, "processor": "Z80"})
    assert "Measured in another run (growth): processor Z80." in page.page({**figures, "growth": other})


def test_missing_tool_is_named_and_costs_no_figures(figures: Record, capsys: pytest.CaptureFixture[str]) -> None:
    found = dict(figures)
    assert measured("instructions", found, Tools(matiec=(), valgrind=False, pymodbus=True))
    assert found == figures
    assert "instructions: not measured, there is no matiec and valgrind; its figures stay" in capsys.readouterr().out


def test_figures_that_cannot_be_repeated_are_an_error(monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(_: Tools) -> Rows:
        raise EngineError("another count")

    monkeypatch.setitem(MEASUREMENTS, "growth", Measurement((), refuse))
    found: Record = {}
    assert not measured("growth", found, Tools((), False, False))
    assert found == {}


def test_record_comes_back_as_it_was_written(tmp_path: Path) -> None:
    some = {"crc": Part({"processor": "Z80"}, record.rounded({"row": {"least": 1.23456, "count": 12345}}))}
    record.write(some, tmp_path / "figures.json")
    assert record.read(tmp_path / "figures.json") == some
    assert some["crc"].rows == {"row": {"least": 1.235, "count": 12345}}


@pytest.mark.parametrize(
    ("figure", "text"),
    [(None, "-"), (1.664, "1.66"), (20.62, "20.6"), (876.6, "877"), (12345.6, "12,300"), (8, "8"), (8.0, "8.00")],
)
def test_figures_have_three_digits(figure: float | None, text: str) -> None:
    assert short(figure) == text
