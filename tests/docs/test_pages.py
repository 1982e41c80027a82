"""The pages of the drive blocks: whole, true beside the blocks, and with pictures that a browser takes."""

import re
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any
from xml.etree import ElementTree as ET

import pytest
from tests.blocks.library import BLOCKS, built, shipped, sources
from tests.examples.port import Port

from driveblocks.docs import timing
from driveblocks.host.embedded.engine import EmbeddedEngine
from driveblocks.host.engine import Instance, Source
from driveblocks.render.reasons import REASONS
from driveblocks.simulator.drive import SimulatedDrive
from driveblocks.st.lint import lint_sources

FOLDER = Path(BLOCKS).parent / "docs"
FAMILIES = sorted(shipped())
SOURCES = {Path(each.path).stem: each for each in sources()}
_PIN = re.compile(r"^  (\w+) : (\w+)", re.MULTILINE)
every_family = pytest.mark.parametrize("family", FAMILIES)


def page(family: str) -> str:
    """The page of a family as it is checked in; `build --check` holds it to the generator."""
    return (FOLDER / f"{family}_Drive.md").read_text(encoding="utf-8")


def example(family: str) -> Source:
    """The program on the page."""
    return Source(f"{family}.st", re.findall(r"```\n(PROGRAM .*?)```", page(family), re.DOTALL)[0])


def declared(family: str) -> dict[str, str]:
    """Every pin of a block by its text, with its type."""
    text = re.sub(r"\(\*.*?\*\)", "", SOURCES[f"{family}_Drive"].text, flags=re.DOTALL)
    return dict(_PIN.findall(text.partition("\nVAR\n")[0]))


@cache
def picture(name: str) -> ET.Element:
    """A picture as a browser reads it."""
    return ET.parse(FOLDER / name).getroot()  # noqa: S314  (the generator wrote it)


@every_family
def test_every_pin_and_reason_is_on_the_page_and_every_pin_in_the_picture(family: str) -> None:
    pins = declared(family)
    assert len(pins) > 70
    rows = dict(re.findall(r"^\| (?:\*\*)?`(\w+)`(?:\*\*)?[^|]*\| (\w+)", page(family), re.MULTILINE))
    assert rows == pins
    assert {int(code) for code in re.findall(r"^\| (\d+) \|", page(family), re.MULTILINE)} == {r.code for r in REASONS}
    drawn = [each.text for each in picture(f"{family}_Drive.svg").iter() if each.tag.endswith("text")]
    assert set(pins) <= set(drawn)
    assert sorted(pins.values()) == sorted(each for each in drawn if each in set(pins.values()))


def test_required_pins_are_those_without_which_nothing_starts() -> None:
    always = {"MaximumHz", "Address", "TurnRoundMs", "StopWithinMs", "Slot"}
    bold = {family: set(re.findall(r"^\| \*\*`(\w+)`", page(family), re.MULTILINE)) for family in FAMILIES}
    assert bold == {"CHF": always, "JSCC": always | {"ReferenceScale"}, "SN300G5": always}


def test_links_and_pictures_are_there_and_pictures_are_whole() -> None:
    for path in [*FOLDER.glob("*.md"), FOLDER.parent / "README.md"]:
        text = path.read_text(encoding="utf-8")
        anchors = {
            re.sub(r"[^\w -]", "", head.lower()).replace(" ", "-") for head in re.findall(r"^#+ (.*)", text, re.M)
        }
        for target in re.findall(r"\]\(([^)]+)\)", text):
            assert target[1:] in anchors if target.startswith("#") else (path.parent / target).exists(), target
    linked = {each for family in FAMILIES for each in re.findall(r"\((\w+\.svg)\)", page(family))}
    assert linked == {each.name for each in FOLDER.glob("*.svg")}
    for name in linked:
        size = picture(name).attrib
        for each in picture(name).iter():
            assert 0 <= float(each.get("x", 0)) <= float(size["width"])
            assert 0 <= float(each.get("y", 0)) <= float(size["height"])


def test_figures_of_the_line_follow_its_formula() -> None:
    """JSCC at 9600, worked out by hand from docs/line.md."""
    rows = re.findall(
        r"^\| 9600 8N1, (the \w+) keeps the silence \| (\d+) ms \| (\d+) ms \| (\d+) ms \|", page("JSCC"), re.M
    )
    # 13 + 2 characters a word, of 1.04 ms, and 5 ms: 22.7 ms for two words, 20.6 ms for one; S is JSCC's 10 ms.
    # By the port 4 scans for each of three reads, the status twice; by the line 3 + 1 + 1.
    assert rows == [("the port", "120", "360", "840"), ("the line", "150", "450", "1050")]


# ---------------------------------------------------------------- the example runs, and does what the picture shows


@cache
def library() -> dict[str, Instance]:
    """The programs of all pages, each in an instance."""
    examples = {family: example(family) for family in FAMILIES}
    files = [*sources(), *examples.values()]
    assert [each for each in lint_sources((f.path, f.text) for f in files) if each.path.count("/") == 0] == []
    blocks = built(EmbeddedEngine(), "pages", files).library
    return {family: blocks.instance(f"{family}_Motor") for family in FAMILIES}


class Story:
    """A program with its drive, and the columns of what it does."""

    def __init__(self, family: str) -> None:
        """A drive at the address and rate of the page."""
        rate, bits = re.findall(r"BitRate := (\d+), CharacterBits := (\d+)", page(family))[0]
        self.program = library()[family]
        self.drive = SimulatedDrive(shipped()[family], shipped()[family].serial.unit.min)
        self.port = Port(self.program, [self.drive], 1000 * int(bits) / int(rate))
        self.program["Hertz"] = 20.0
        if family == "JSCC":
            self.program["CountsPerHertz"] = 100.0
        self.program["Motor.FrequencyScale"] = 0.01
        self.columns: list[timing.Column] = []

    def run(self, ms: int, **pins: bool) -> None:
        """Let time pass, column after column."""
        for pin, value in pins.items():
            self.program[pin] = value
        for _ in range(ms // 10):
            self.port.scan()
            self._note()

    def _note(self) -> None:
        says: dict[str, Any] = {name: bool(self.program[f"Motor.{pin}"]) for pin, name in timing.SIGNALS.items()}
        state = self.program["Motor.Control.State"]
        assert isinstance(state, int)
        now = timing.Column(state, **says)
        sent = self._sent(state)
        if not self.columns or replace(self.columns[-1], sends=()) != now:
            self.columns.append(now)
        before = self.columns[-1].sends
        self.columns[-1] = replace(now, sends=(*before, *(each for each in sent if each not in before)))

    def _sent(self, state: int) -> list[str]:
        stop = ["stop"] if self.program["Motor.Control.PostStop"] else []
        if not self.program["Motor.Control.PostCommand"]:
            return stop
        if self.program["Motor.Control.Sent"] == 9:
            return [*stop, "reset"]
        return [*stop, {2: "reference", 3: "run"}.get(state, "refresh")]


def drawn(columns: tuple[timing.Column, ...]) -> list[timing.Column]:
    """Columns without what only the picture has."""
    return [replace(each, speed=(0.0, 0.0), event="") for each in columns]


@every_family
def test_the_example_runs_and_does_what_the_picture_shows(family: str) -> None:
    story, drive = Story(family), shipped()[family]
    story.run(2000)
    story.run(6000, StartSwitch=True)
    story.run(4000, StartSwitch=False)
    # status and frequency may come by different reads; a drive that has just left off running is then not proved yet
    assert [each for each in story.columns if each != timing.Column(0)] == drawn(timing.start_and_stop())
    story.run(6000, StartSwitch=True)
    del story.columns[:-1]
    story.drive.trip(2)
    story.run(3000)
    story.run(6000, StartSwitch=False)
    story.drive.clear_cause()
    if "ResetButton" in example(family).text:
        story.run(2000, ResetButton=True)
    else:
        story.drive.reset()
        story.run(2000)
    assert story.columns == drawn(timing.fault_and_reset(drive))
    assert story.drive.hertz == 0
