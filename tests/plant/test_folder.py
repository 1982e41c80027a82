"""The folder of the example plants, against what a person reads off their plant files and the drives' manuals."""

import re
from collections.abc import Iterable
from functools import cache
from html.parser import HTMLParser
from typing import Any

import pytest
from tests.plant.bench import PLANTS, example

from driveblocks.plant import folder, paper

VOID = {"meta", "br", "rect", "polyline", "path"}


@cache
def files(name: str) -> dict[str, str]:
    """The folder of an example."""
    return folder.files(example(name))


def marked(cases: Iterable[Any]) -> list[Any]:
    """Cases by their plants; all but those of the smallest one take seconds."""
    plants = ((each, each[0] if isinstance(each, tuple) else each) for each in cases)
    return [
        pytest.param(*(each if isinstance(each, tuple) else (each,)), marks=[pytest.mark.thorough] * (plant != "small"))
        for each, plant in plants
    ]


def section(page: str, begins: str) -> str:
    """A section of a page, by how its heading begins."""
    return next(each for each in page.split("\n## ") if each.startswith(begins))


def cells(text: str, first: str) -> list[str]:
    """The row of a table that begins with a cell."""
    row = next(each for each in text.splitlines() if each.startswith(f"| {first} |"))
    return [each.strip() for each in row.strip("|").split(" | ")]


def set_to(sheet: str) -> dict[str, str]:
    """Of a keypad sheet: setting -> what it is to be set to, without what is left open."""
    rows = re.findall(r"^\| \[.\] \| (\S+) .*? \| \*\*(.+?)\*\* \|", sheet, re.MULTILINE)
    return dict(rows)


LINES = {
    ("pumps", "2a. Line A"): {"PLC": "on", "P1": "off", "P2": "off", "P3": "on"},
    ("pumps", "2b. Line B"): {"PLC": "on", "P4": "off", "P5": "off", "P6": "on"},
    ("conveyor", "2. Line A"): {"PLC": "on", **{f"Belt{at}": "off" for at in range(1, 9)}, "Energy": "on"},
    ("small", "2. Line A"): {"PLC": "on", "Mixer": "off", "Pump": "off", "Fan": "on"},
}
"""Plant and line -> its units in their order, and whether each is terminated."""
ADDRESSES = {
    "pumps": {"P1": 1, "P2": 2, "P3": 3, "P4": 1, "P5": 2, "P6": 3},
    "conveyor": {**{f"Belt{at}": 10 + at for at in range(1, 9)}, "Energy": 30},
    "small": {"Mixer": 1, "Pump": 2, "Fan": 3},
}
KEYPADS = {
    ("pumps", "5.1"): {
        "F0.04": "4 = RS-485", "F0.08": "8 = RS-485", "FA.00": "1", "FA.01": "3 = 19200 bit/s",
        "FA.02": "2 = 8 data bits, even parity, 1 stop bit", "FA.03": "2 = RTU mode",
    },
    ("pumps", "5.5"): {
        "Add": "2", "tbr": "19.2 = 19200 bit/s", "tFO": "8E1", "ttO": "5.0 s", "ACC": "5 s", "dEC": "10 s",
    },
    ("pumps", "5.6"): {
        "P14.00": "3", "P14.01": "4 = 19200 bit/s", "P14.02": "1 = 8E1, RTU", "P00.11": "5 s", "P00.12": "10 s",
    },
    ("conveyor", "5.8"): {
        "P046": "3 = Serial/DSI", "P047": "3 = Serial/DSI", "C124": "18", "C123": "5 = 38400 bit/s",
        "C127": "0 = RTU 8-N-1",
        "C126": "20.0 s", "P041": "3 s", "P042": "3 s",
    },
    ("small", "5.1"): {"C124": "1", "C123": "4 = 19200 bit/s", "C127": "1 = RTU 8-E-1", "P041": "10 s", "P042": "10 s"},
    ("small", "5.2"): {"Add": "2", "tbr": "19.2 = 19200 bit/s", "tFO": "8E1"},
    ("small", "5.3"): {
        "C072": "3", "C071": "06 = 19200 bit/s", "C074": "01 = Even parity", "F002": "30 s", "F003": "30 s",
    },
}  # fmt: skip
"""Plant and section -> settings of a drive by what its keypad shows, as its manual names them."""


@pytest.mark.parametrize(("plant", "title"), marked(LINES))
def test_a_line_has_its_units_in_order_and_is_terminated_at_both_ends(plant: str, title: str) -> None:
    text = section(files(plant)["electrician.md"], title)
    table = text[text.index("| unit | address |") :].split("\n\n")[0].splitlines()[2:]
    found = {row[0]: row[-1] for row in ([each.strip() for each in line.strip("|").split(" | ")] for line in table)}
    assert list(found) == list(LINES[plant, title])
    assert {name: "on" if says.startswith("**on**") else "off" for name, says in found.items()} == LINES[plant, title]


@pytest.mark.parametrize("plant", marked(PLANTS))
def test_each_unit_has_its_own_address_in_the_list_on_its_line_and_on_its_sheet(plant: str) -> None:
    page = files(plant)["electrician.md"]
    listed = section(page, "1. What there is")
    lines = "".join(section(page, title) for of, title in LINES if of == plant)
    for name, address in ADDRESSES[plant].items():
        assert cells(listed, name)[4] == str(address)
        assert cells(lines, name)[1] == str(address)
        sheets = [each for each in page.split("\n## ") if re.match(rf"5\.\d+ Keypad of {name}\b", each)]
        assert all(f"Unit address **{address}**" in each for each in sheets)
        assert len(sheets) == (name != "Energy")


@pytest.mark.parametrize(("plant", "title"), marked(KEYPADS))
def test_a_keypad_sheet_is_filled_in(plant: str, title: str) -> None:
    found, due = set_to(section(files(plant)["electrician.md"], f"{title} ")), KEYPADS[plant, title]
    assert {name: found.get(name) for name in due} == due


@pytest.mark.thorough
def test_the_terminals_are_those_of_the_manuals() -> None:
    rows = section(files("pumps")["electrician.md"], "2a.")
    assert cells(rows, "P2")[2:5] == [
        "pin 4, D1 Modbus signal",
        "pin 5, D0 Modbus signal",
        "pin 8, Common Modbus signal",
    ]
    assert cells(rows, "P3")[2:5] == ["485+, A (+)", "485-, B (-)", "______"]
    drawn = files("pumps")["line_A.svg"]
    assert drawn.index("P1: Pump 1") < drawn.index("P2: Pump 2") < drawn.index("P3: Pump 3")
    assert drawn.count("120 ohm") == 2


@pytest.mark.thorough
def test_who_stops_what() -> None:
    rows = section(files("pumps")["electrician.md"], "3.")
    assert cells(rows, "StopNorth")[1] == "P1, P2, P3"
    assert cells(rows, "StopEverything")[1] == "P1, P2, P3, P4, P5, P6"
    assert cells(rows, "hard stop HardStopSouth")[1] == "P4, P5, P6"
    assert cells(rows, "watchdog of P1")[1] == "nobody"
    assert cells(rows, "watchdog of P2")[2] == "coasts, ramps down or stops quickly after 5 s of silence, as SLL is set"


def test_lamps_reasons_and_faults_are_said_with_what_helps() -> None:
    page = files("small")["electrician.md"]
    assert cells(section(page, "6."), "FanFault")[1] == "Fan has a fault, or does not answer"
    assert cells(section(page, "7."), "24")[2] == "release all run and jog pins, then set one"
    assert "### Faults of Schneider Electric Altivar 312" in page


class Page(HTMLParser):
    """What a page holds: its tags, closed in order, and its text."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.open: list[str] = []
        self.tags: list[str] = []
        self.links: list[str] = []
        self.text = ""
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append(tag)
        self.links += [value or "" for name, value in attrs if name in ("src", "href", "srcset", "data")]
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag: str, _: list[tuple[str, str | None]]) -> None:
        self.tags.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        self.text += data


@pytest.mark.parametrize("plant", marked(PLANTS))
def test_the_page_for_paper_needs_nothing_else_and_says_the_same(plant: str) -> None:
    made = files(plant)
    page, text = Page(made["electrician.html"]), made["electrician.md"]
    assert not page.open
    assert not {"script", "link", "img", "iframe"} & set(page.tags)
    assert all(each.startswith("#") for each in page.links)
    assert "url(" not in made["electrician.html"]
    assert page.tags.count("svg") == text.count("![")
    assert made["electrician.html"].count(paper.CHECK) == text.count("[ ]") + text.count("[\u00a0]")
    assert page.tags.count("h2") == text.count("\n## ")
    for word in re.findall(r"\*\*(.+?)\*\*", text):
        assert word in page.text


def test_what_a_person_has_named_is_text_on_the_page() -> None:
    page = paper.page("<b>", "# <script>alert(1)</script>\n\n| a | b |\n|---|---|\n| x \\| y | `<i>` & \\<b |\n", {})
    assert "<script" not in page
    found = Page(page)
    assert "<script>alert(1)</script>" in found.text
    assert "x | y<i> & <b" in found.text


def test_two_folders_of_a_plant_are_the_same() -> None:
    assert folder.files(example("small")) == files("small")
