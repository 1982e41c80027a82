"""The page of figures and its pictures come from the record alone, and read well; no time is judged here."""

import re
from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree

import pytest
from tests.bench import chart, page, record
from tests.bench.chart import Bar, Chart, Group
from tests.bench.record import Part, Record, Rows
from tests.bench.run import MEASUREMENTS, Measurement, Tools, measured
from tests.bench.sections import checksum, growth
from tests.bench.table import prose, short, table

from structured_text.engines.engine import EngineError

SVG = "{http://www.w3.org/2000/svg}"
DRAWN = Chart(
    "A <title>",
    "ns & more",
    (Group("one", (Bar("short", 1.0, "1 ns", "c"), Bar("long", 100.0, "100 ns", "ours"))),),
    {"c": "C", "ours": "the library"},
)


@pytest.fixture(scope="module")
def figures() -> Record:
    """The record in `docs/`."""
    return record.read()


def test_page_and_pictures_are_written_from_the_record(figures: Record) -> None:
    for name, text in page.files(figures).items():
        assert (record.DOCS / name).read_text("utf-8") == text, f"{name}: run python -m tests.bench.run --page"


def test_record_holds_every_measurement(figures: Record) -> None:
    assert list(figures) == list(MEASUREMENTS)
    assert page.UNKNOWN not in page.page(figures)


def test_tables_of_the_page_are_whole(figures: Record) -> None:
    """Every row of a table has as many cells as its head."""
    width = 0
    for line in page.page(figures).splitlines():
        width = (width or line.count("|")) if line.startswith("|") else 0
        assert line.count("|") == width or not width, line


def test_page_names_no_place_of_the_machine(figures: Record) -> None:
    assert not re.search(r"/(home|root|usr|tmp|work|opt)/", page.page(figures) + repr(figures))


def test_part_that_was_not_measured_is_named() -> None:
    assert page.page({}).count(page.UNKNOWN.strip()) == 8


def test_part_of_another_machine_says_so(figures: Record) -> None:
    other = replace(figures["growth"], machine={**figures["growth"].machine, "processor": "Z80"})
    assert "Measured in another run (growth): processor Z80." in page.page({**figures, "growth": other})


def test_missing_tool_is_named_and_costs_no_figures(figures: Record, capsys: pytest.CaptureFixture[str]) -> None:
    found = dict(figures)
    nothing = Tools(matiec=(), valgrind=False, pymodbus=True)
    assert all(measured(name, found, nothing) for name in ("crc", "exchange", "memory", "instructions", "times"))
    assert found == figures
    assert "instructions: not measured, there is no matiec and valgrind; its figures stay" in capsys.readouterr().out


def test_figures_that_cannot_be_repeated_are_an_error(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def refuse(_: Tools) -> Rows:
        raise EngineError("another count")

    monkeypatch.setitem(MEASUREMENTS, "growth", Measurement((), refuse))
    found: Record = {}
    assert not measured("growth", found, Tools((), False, False))
    assert found == {}
    assert capsys.readouterr().err == "growth: another count\n"


def test_record_comes_back_as_it_was_written(tmp_path: Path) -> None:
    some = {"crc": Part({"processor": "Z80"}, record.rounded({"row": {"least": 1.23456, "count": 12345}}))}
    record.write(some, tmp_path / "figures.json")
    assert record.read(tmp_path / "figures.json") == some
    assert some["crc"].rows == {"row": {"least": 1.235, "count": 12345}}
    assert record.read(tmp_path / "none.json") == {}


def test_picture_is_xml_with_a_bar_and_two_texts_for_each_figure() -> None:
    root = ElementTree.fromstring(chart.svg(DRAWN))  # noqa: S314 (our own text)
    bars = [float(each.get("width", "")) for each in root.iter(f"{SVG}rect") if each.get("class") in DRAWN.legend]
    assert [width for width in bars if width != 12] == [pytest.approx(chart.LONGEST / 100), chart.LONGEST]
    words = [each.text for each in root.iter(f"{SVG}text")]
    assert words == ["A <title>: ns & more", "C", "the library", "one", "short", "1 ns", "long", "100 ns"]


def test_logarithmic_bars_grow_by_equal_steps() -> None:
    bars = tuple(Bar(str(value), value, "", "c") for value in (1.0, 10.0, 100.0))
    text = chart.svg(replace(DRAWN, groups=(Group("one", bars),), legend={}, logarithmic=True))
    widths = [float(width) for width in re.findall(r'class="c".* width="([\d.]+)"', text)]
    assert widths[2] - widths[1] == pytest.approx(widths[1] - widths[0], abs=0.2)
    assert widths[2] == chart.LONGEST


def test_bar_of_nothing_is_refused() -> None:
    with pytest.raises(ValueError, match="longer than nothing"):
        chart.svg(replace(DRAWN, groups=(Group("one", (Bar("none", 0.0, "", "c"),)),)))


def test_long_words_are_found_to_overlap() -> None:
    bars = (Bar("x" * 40, 1.0, "", "c"), Bar("most", 2.0, "y" * 30, "c"))
    assert chart.overlaps(replace(DRAWN, groups=(Group("one", bars),))) == ["x" * 40, "y" * 30]


def test_pictures_of_the_page_have_no_overlaps(figures: Record) -> None:
    for part, draw in page.CHARTS.items():
        assert chart.overlaps(draw(figures[part].rows)) == []


def test_ratio_is_that_of_the_slower_line() -> None:
    rows = {
        "table 256 independent": {"matiec-beremiz stock": 500.0, "matiec-openplc stock": 400.0},
        "block 256 independent": {"matiec-beremiz stock": 900.0, "matiec-openplc stock": 800.0},
    }
    assert checksum.ratio(rows, "block", 256) == 2.0
    assert checksum.taken(rows, "block", 256) == 900.0


def test_growth_is_a_straight_line_where_it_is_one() -> None:
    rows = {f"{count} registers": {"load": 0.1 + 0.002 * count, "tests": 0.2} for count in (50, 100, 400)}
    assert [*growth.line(rows)] == pytest.approx([0.3, 0.002])


@pytest.mark.parametrize(
    ("figure", "text"),
    [(None, "-"), (1.664, "1.66"), (20.62, "20.6"), (876.6, "877"), (12345.6, "12,300"), (8, "8"), (8.0, "8.00")],
)
def test_figures_have_three_digits(figure: float | None, text: str) -> None:
    assert short(figure) == text


def test_table_and_prose_are_markdown() -> None:
    assert table(["a", "b"], [["1", "2"]]) == ["| a | b |", "| --- | ---: |", "| 1 | 2 |", ""]
    assert prose("One\n two.\n\n- item\n\n- item") == ["One two.", "", "- item", "- item", ""]
