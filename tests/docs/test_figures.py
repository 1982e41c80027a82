"""Every figure on a page is the one in its file under docs/measured, or what the code counts."""

import re
from pathlib import Path

import pytest
from tests.prove import agreement
from tests.shipped import drives

DOCS = Path(__file__).parents[2] / "docs"

QUOTED = [
    (
        "line.md",
        r"(\d+) ms if the port keeps the silence",
        "line.md",
        r"seven drives, the port keeps the silence \| (\d+)",
    ),
    (
        "line.md",
        r"(\d+) ms if the line must",
        "line.md",
        r"refresh of seven drives, the line keeps the silence \| (\d+)",
    ),
    ("run.md", r"a scan takes about ([\d.]+) ms", "soft-plc.md", r"\| 3 \| ([\d.]+) ms"),
    (
        "run.md",
        r"for an hour at a port.*?(no) stop was lost",
        "soft-plc.md",
        r"`make long WHAT=desk-line` \| [\d,]+ \| (\d+)",
    ),
    (
        "linux.md",
        r"hour with 1 % .*?(no) stop was lost",
        "soft-plc.md",
        r"`make long WHAT=linux-line` \| [\d,]+ \| (\d+)",
    ),
    ("stop.md", r"(no) stop was lost", "line.md", r"100000 random lines of kind stops, .*? stops: (\d+) lost"),
    ("stop.md", r"(none) was later", "line.md", r"100000 random lines of kind stops, .*? lost, (\d+) late"),
    *(
        ("linux.md", rf"{rate} bit/s \|[^\n]*\| (\d+) ms \|", "line.md", rf"\| {rate} 8N1 \|(?: \d+ \|){{5}} (\d+) \|")
        for rate in (9600, 19200, 38400, 115200)
    ),
]
"""A page and the figure on it, a measured page and the figure there: one group each."""


def _figure(page: Path, pattern: str) -> str:
    found = re.search(pattern, page.read_text(encoding="utf-8"), re.DOTALL)
    assert found, f"{page.name} has no figure like {pattern}"
    return {"no": "0", "none": "0"}.get(found[1], found[1])


@pytest.mark.parametrize(("page", "quoted", "measured", "source"), QUOTED)
def test_a_guide_quotes_what_was_measured(page: str, quoted: str, measured: str, source: str) -> None:
    assert _figure(DOCS / page, quoted) == _figure(DOCS / "measured" / measured, source)


def _rows(page: Path) -> dict[str, list[int]]:
    """The tables of a page: their first cells, and the milliseconds in the others."""
    rows = [
        line.strip("| ").split(" | ") for line in page.read_text(encoding="utf-8").splitlines() if line.startswith("|")
    ]
    return {
        first: [int(cell.partition(" ms")[0]) for cell in cells if re.fullmatch(r"\d+ ms", cell)]
        for first, *cells in rows
    }


def test_fewer_drives_on_linux_wait_in_proportion() -> None:
    table = {first: row for first, row in _rows(DOCS / "linux.md").items() if first.endswith("bit/s")}
    assert len(table) == 4
    assert all([7 * one, 7 * three] == [seven, 3 * seven] for one, three, seven in table.values())


def test_the_stop_of_seven_drives_is_between_those_of_six_and_eight() -> None:
    shown, measured = _rows(DOCS / "stop.md"), _rows(DOCS / "measured/drives.md")
    lines = [first for first in measured if first.endswith("the silence")]
    assert {first.partition(",")[0] for first in lines} == drives().keys()
    assert len(lines) == 2 * len(drives())
    for first in lines:
        *_, alone, worst = measured[first]
        one, two, four, six, eight = shown[first]
        each = two - one
        assert [one, four, six, eight] == [alone, one + 3 * each, one + 5 * each, one + 7 * each]
        assert worst == one + 6 * each


COUNTED = [
    ("prove.md", r"is run ([\d,]+) times", agreement.CALLS),
]
"""A page, a figure on it, and what the code counts."""


@pytest.mark.parametrize(("page", "pattern", "number"), COUNTED)
def test_a_page_counts_as_the_code_does(page: str, pattern: str, number: int) -> None:
    assert _figure(DOCS / page, pattern).replace(",", "") == str(number)
