"""Loading as a whole: good maps, all mistakes at once, what a partial map leaves unsaid, and the model's look-ups."""

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from driveblocks.maps import load
from driveblocks.maps.form import Span
from driveblocks.maps.model import Range
from driveblocks.maps.problem import MAX_PROBLEMS, MapError, Problem, Report

ROOT = Path(__file__).parents[2]
EXAMPLE = ROOT / "tests/maps/example.yaml"
TEXT = EXAMPLE.read_text(encoding="utf-8")
LOADED = load.load(EXAMPLE)
MAPS = [EXAMPLE, *sorted((ROOT / "vendor_maps").glob("*.yaml"))]


def wrong(text: str) -> list[str]:
    with pytest.raises(MapError) as caught:
        load.loads(text, "map.yaml")
    return [problem.wrong for problem in caught.value.problems]


@pytest.mark.parametrize("path", MAPS, ids=lambda path: path.stem)
@pytest.mark.every_family
def test_a_good_map_loads(path: Path) -> None:
    drive = load.load(path)
    assert bool(drive.frames) != drive.prefix.startswith("PF"), "their manuals print none"
    assert drive.base or drive == load.loads(path.read_text(encoding="utf-8"), "another name")


def test_a_map_on_windows_is_the_same(tmp_path: Path) -> None:
    path = tmp_path / "map.yaml"
    path.write_bytes(b"\xef\xbb\xbf" + TEXT.replace("\n", "\r\n").encode())
    assert load.load(path) == load.load(EXAMPLE)


def test_mistakes_of_every_step_come_at_once() -> None:
    text = TEXT.replace("replies: false", "replies: off")  # a trap
    text = text.replace("unit: A, source", "unit: Amp, source")  # a form
    text = text.replace("{bit: 4-7, unused: true}", "{bit: 3-7, unused: true}")  # a rule on one row
    text = text.replace("correct: 01 03 02 15 70 B7 30", "correct: 01 03 02 15 70 B7 31")  # a checksum
    text = text.replace("about: [register 0201H]", "about: [register 0201H, register 0202H, register 0201H]")
    assert [line.partition(" ")[0] for line in wrong(text)] == ["`off`", "bit", "`unit:", "the", "`register"]


def test_messages_come_in_the_order_of_the_file() -> None:
    with pytest.raises(MapError) as caught:
        load.loads(TEXT.replace("access: r\n", "access: x\n").replace("zh: 过流", "zh: "), "map.yaml")
    places = [(problem.line, problem.column) for problem in caught.value.problems]
    assert places == sorted(places)
    assert str(caught.value) == "\n".join(map(str, caught.value.problems))


def test_what_may_stand_in_an_unread_part_is_not_missed() -> None:
    """The section of the faults could not be read; nobody is reported that its registers are nowhere."""
    assert wrong(TEXT.replace("  - id: status\n", "  - id: Status\n")) == ["`id: Status` is not a word"]


def test_what_is_missing_is_said_when_everything_could_be_read() -> None:
    assert "0020H is in no register table" in wrong(
        TEXT.replace("address: 0020H, id: U1-01", "address: 0025H, id: C2-01")
    )


def test_one_mistake_twice_in_one_place_is_said_once() -> None:
    problem = Problem("map.yaml", 1, 1, "wrong", "right")
    assert MapError([problem, problem]).problems == (problem,)


def test_nobody_reads_ten_thousand_mistakes() -> None:
    report = Report("map.yaml")
    for line in range(2, MAX_PROBLEMS + 1):
        report.add((line, 1), "wrong", "right")
    with pytest.raises(MapError) as caught:
        report.add((1, 1), "wrong", "right")
    assert len(caught.value.problems) == MAX_PROBLEMS + 1
    assert caught.value.problems[-1].wrong.startswith("more than 1000 mistakes")


def test_a_report_without_mistakes_says_nothing() -> None:
    report = Report("map.yaml", partial=True)
    report.miss((1, 1), "missing", "add it")
    report.raise_if_any()
    assert report.problems == []


def test_a_row_is_found_by_each_of_its_addresses() -> None:
    for section, row in LOADED.registers():
        for address in row.address:
            assert LOADED.row_at(address) == (section, row)
            assert LOADED.register_at(address) is row


@pytest.mark.parametrize("address", [0x001F, 0x0024, 0x010A, 0x0800, 0xFFFC, 0xFFFE])
def test_an_address_between_rows_has_none(address: int) -> None:
    assert LOADED.row_at(address) is None
    assert LOADED.register_at(address) is None


@given(first=st.integers(0, 0x500), length=st.integers(0, 0x40))
def test_rows_of_a_span_are_those_that_share_an_address(first: int, length: int) -> None:
    span = Span(first, first + length)
    due = [row for _, row in LOADED.registers() if row.address.overlaps(span)]
    assert sorted(LOADED.rows_in(span), key=lambda row: row.address) == sorted(due, key=lambda row: row.address)


@pytest.mark.parametrize(("number", "held"), [(-5, True), (5, True), (0, True), (-6, False), (6, False)])
def test_a_range_holds(number: int, held: bool) -> None:
    assert Range(min=-5, max=5).holds(number) == held


def test_a_backward_range_is_a_mistake_of_its_own() -> None:
    assert Range(min=5, max=-5).holds(100)
