"""The pages of the drive blocks: whole, true beside the blocks, and with pictures that a browser takes."""

import re
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any
from xml.etree import ElementTree as ET

import pytest
from tests import families
from tests.blocks.library import BLOCKS, built, sources
from tests.examples.port import Port
from tests.shapes import shapes
from tests.shipped import drives

from driveblocks.bench.simulator.drive import SimulatedDrive
from driveblocks.docs import timing
from driveblocks.docs.page import Own, documents
from driveblocks.maps import trust
from driveblocks.maps.form import Plate
from driveblocks.maps.model import Drive, Model
from driveblocks.platforms import EXPORTS, PLATFORMS
from driveblocks.platforms.port import first_motor
from driveblocks.render.library import drive as library_of
from driveblocks.render.library import generic
from driveblocks.render.reasons import REASONS, STATES
from driveblocks.render.text import languages
from structured_text.engines.embedded.engine import EmbeddedEngine
from structured_text.engines.engine import Engine, Instance, Source
from structured_text.language.lint import lint_sources

FOLDER = Path(BLOCKS).parent / "docs"
FAMILIES = sorted(drives())
SOURCES = {Path(each.path).stem: each for each in sources()}
LANGUAGES = languages(["en"], "utf-8")
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


def rows(family: str, heading: str) -> list[list[str]]:
    """The cells of the tables of a section, without their heads, marks and headings of groups."""
    section = page(family).partition(f"\n{heading}\n")[2].partition("\n#")[0]
    found = [
        [cell.strip().replace("**", "") for cell in line[1:-1].split(" |")]
        for line in section.splitlines()
        if line[:1] == "|"
    ]
    return [cells for cells in found if cells[0].startswith("`")]


@every_family
def test_every_pin_and_reason_is_on_the_page_and_every_pin_in_the_picture(family: str) -> None:
    pins = declared(family)
    assert len(pins) == 18 + 17 + 1
    cells = rows(family, "## The block")
    assert [(re.findall(r"\w+", name)[0], type_.partition(",")[0]) for name, type_, *_ in cells] == [
        *list(pins.items())[:18], ("Slot", "MB_Slot"), *list(pins.items())[18:35],
    ]  # fmt: skip
    assert {int(code) for code in re.findall(r"^\| (\d+) \|", page(family), re.MULTILINE)} == {r.code for r in REASONS}
    drawn = [each.text for each in picture(f"{family}_Drive.svg").iter() if each.tag.endswith("text")]
    assert [each for each in drawn if each in pins] == list(pins)
    assert sorted(pins.values()) == sorted(each for each in drawn if each in set(pins.values()))


@every_family
@pytest.mark.parametrize("structure", ["Settings", "Diagnosis"])
def test_every_member_of_both_structures_is_on_the_page(family: str, structure: str) -> None:
    text = re.sub(r"\(\*.*?\*\)", "", SOURCES[f"VFD_{structure}"].text, flags=re.DOTALL)
    members = re.findall(r"^    (\w+) : (\w+)", text, re.MULTILINE)
    cells = rows(family, f"### {structure}")
    assert [(name.strip("`"), type_.partition(",")[0]) for name, type_, *_ in cells] == members
    assert all(says for _, _, says, *_ in cells)
    assert structure == "Diagnosis" or all(zero for _, _, _, zero, _ in cells)


def test_the_page_says_what_a_family_needs_and_shows_of_both_structures() -> None:
    said = {(family, cells[0].strip("`")): cells[-1] for family in FAMILIES for cells in rows(family, "### Settings")}
    assert said["JSCC", "ReferenceScale"] == "required: the manual gives no scale of 1001H"
    assert said["CHF", "ReferenceScale"] == said["SN300G5", "FrequencyScale"] == "no use: the map has the scale"
    assert said["CHF", "FrequencyScale"] == "of 3000H: without it `OutputFrequencyHz` is the raw count"
    assert said["JSCC", "CurrentScale"] == "no use: the drive does not show it"
    assert (said["SN300G5", "KeepWord"], said["CHF", "KeepWord"]) == ("16#00FC of 0000H", "no use: no bit is left over")
    shown = {(family, cells[0].strip("`")): cells[-1] for family in FAMILIES for cells in rows(family, "### Diagnosis")}
    assert shown["JSCC", "OutputPowerKW"] == "always 0: the drive does not show it"
    assert shown["JSCC", "OutputPowerValid"] == "always FALSE"
    assert shown["SN300G5", "DcBusVoltageValid"] == "FALSE without `DcVoltageScale`"
    assert [shown[family, "CanCoastStop"] for family in ("CHF", "JSCC", "SN300G5")] == ["TRUE", "FALSE", "FALSE"]


def test_catalogue_and_page_say_what_is_on_the_nameplate() -> None:
    drive = drives()["JSCC"]
    files = [*generic(LANGUAGES), *library_of("jscc", drive, LANGUAGES)]
    assert "nameplate" not in documents(files, [drive])["docs/Families.md"].lower()
    models = [Model(plate=Plate(one), printed=(f"{one[:-1]}7",), source="page 4") for one in ("J2-X*", "J1-A*")]
    made = documents(files, [replace(drive, models=tuple(models))])
    rows_ = made["docs/Families.md"].partition("\n## By nameplate\n")[2].strip().split("\n\n")[0].splitlines()[2:]
    assert rows_ == [f"| `{one}*` | {one}7 | [`JSCC`](JSCC_Drive.md) |" for one in ("J1-A", "J2-X")]
    assert "`driveblocks show J1-A7`" in made["docs/Families.md"]
    assert "Nameplates: `J2-X*`, `J1-A*`.\n\n>" in made["docs/JSCC_Drive.md"]


def test_required_pins_are_those_without_which_nothing_starts() -> None:
    always = {"MaximumHz", "Address", "StopWithinMs", "Slot"}
    bold = {family: set(re.findall(r"^\| \*\*`(\w+)`", page(family), re.MULTILINE)) for family in FAMILIES}
    assert bold == {family: always | more for family, more in families.said("PINS").items()}


def test_the_page_of_a_second_hand_map_prints_the_number_that_lets_it_run() -> None:
    drive = drives()["SN300G5"]
    heard = replace(drive, manual=replace(drive.manual, second_hand=True))
    files = [*generic(LANGUAGES), *library_of("heard", heard, LANGUAGES)]
    text = documents(files, [heard])["docs/SN300G5_Drive.md"]
    (needed,) = re.findall(r"ManualChecked <> (\d+)", next(file.text for file in files if file.name == "SN300G5_Drive"))
    assert f"**`ManualChecked := {needed}`**" in text
    assert f"ManualChecked := 0, (* {needed} once" in text
    assert "| **`ManualChecked`** | UINT |" in text
    asked = {family for family in FAMILIES if "ManualChecked :=" in page(family)}
    others = {family for family, pins in families.said("PINS").items() if "ManualChecked" in pins}
    assert asked == others, "bits, watchdog or settings that nobody could open"


def test_the_page_of_a_users_map_names_it_in_commands_by_its_file() -> None:
    drive = drives()["JSCC"]
    files = [*generic(LANGUAGES), *library_of("mine", drive, LANGUAGES)]
    text = documents(files, [drive], {"JSCC": Own("mine.yaml")})["docs/JSCC_Drive.md"]
    assert "`driveblocks show mine.yaml absent`" in text
    assert "`driveblocks show jscc absent`" in page("JSCC")


def test_a_map_that_names_no_gap_promises_no_list_of_them() -> None:
    drive = replace(drives()["JSCC"], absent=())
    files = [*generic(LANGUAGES), *library_of("mine", drive, LANGUAGES)]
    text = documents(files, [drive])["docs/JSCC_Drive.md"]
    assert "0 thing" not in text
    assert (
        "look for what is missing" in text.partition("\n## Find out before the first start\n")[2].partition("\n## ")[0]
    )
    assert (
        text.partition("\n## What the manual does not say\n")[2].partition("\n## ")[0].endswith("The map names none.\n")
    )


def test_the_page_says_that_a_drive_answers_nobody_at_first() -> None:
    drive = shapes()["two_registers"]
    files = [*generic(LANGUAGES), *library_of("one", drive, LANGUAGES)]
    text = documents(files, [drive])["docs/TWO_Drive.md"]
    assert "unit addresses 1 to 247. **As delivered the drive\nanswers nobody**: set P3.00 first." in text
    assert "| the address that the PLC uses |" in text
    assert "| P3.01 Run command from | **1 = Bus** |" in text
    assert "P3.01 (run command from) = 1," not in text  # no setting chooses the terminals
    set_already = replace(drive, serial=replace(drive.serial, unit=replace(drive.serial.unit, default=1)))
    text = documents(files, [set_already])["docs/TWO_Drive.md"]
    assert "unit addresses 1 to 247. With P3.00 = 0 it answers nobody.\n" in text


def by_itself(drive: Drive) -> dict[str, str]:
    """What the generated page of a drive says that it does by itself, by what happens."""
    files = [*generic(LANGUAGES), *library_of("one", drive, LANGUAGES)]
    text = documents(files, [drive])[f"docs/{drive.prefix}_Drive.md"]
    section = text.partition("\n### What the drive does by itself\n")[2].partition("\n#")[0]
    return dict(re.findall(r"^\| ([A-Z][^|]*) \| (.*) \|$", section, re.MULTILINE))


def test_the_page_says_what_a_drive_does_by_itself_and_what_the_manual_does_not_say() -> None:
    said = by_itself(drives()["SN300G5"])
    assert list(said) == [
        "The cable is cut", "The drive trips", "The bus is in command", "The drive is of this family",
        "Its own maximum frequency", "The speed asked for is below its lower limit",
    ]  # fmt: skip
    cut, trips, *rest, below = said.values()
    for words in ("1 emergency stop (factory): the motor stops quickly", "2 coast stop: the motor coasts"):
        assert words in cut
    for words in ("H5-05 = 0: the motor runs on", "does not say after how long nor what feeds", "more than 2 s before"):
        assert words in cut
    assert trips == "The manual does not say whether the motor coasts or is ramped down."
    assert all(each.startswith("The manual does not say") for each in rest)
    assert below == "D2-02 (Frequency reference lower limit): with less, 0 too, the motor may turn at it."
    assert list(by_itself(shapes()["cia402"]).values())[1:] == [
        "The output is switched off and the motor coasts.", "While 2000H bit 9 = 1.", "2003H = 786.",
        "2004H (P1.08) x 0.1 Hz.", "The manual does not say whether 0 Hz may turn the motor.",
    ]  # fmt: skip


@every_family
def test_the_ladder_of_the_page_has_the_wires_of_the_first_motor(family: str) -> None:
    motor = first_motor("iec61131", drives()[family]).text
    drawn = [each.text for each in picture(f"{family}_Drive_ladder.svg").iter() if each.tag.endswith("text")]
    wired = re.findall(r"\w+ := ([^,()]+?)(?=[,)])", re.sub(r"\(\*.*?\*\)", "", motor, flags=re.DOTALL))
    assert len(wired) > 15
    for value in set(wired) - {"TRUE"}:
        assert drawn.count(value) >= wired.count(value), value
    assert set(declared(family)) <= set(drawn)


def test_the_states_are_named_by_their_numbers() -> None:
    for family in FAMILIES:
        named = [(number.strip("`"), name) for number, name, _ in rows(family, "## States")]
        assert named == [(str(number), name) for number, (name, _) in enumerate(STATES)]


BRAKE = "Not for hoists, lifts, or loads that can fall or run back: no output releases or holds a brake."


def test_every_place_that_a_user_reads_first_says_that_it_holds_no_brake() -> None:
    """Rule of safety: on the first screen, in the heads of the blocks, on pages of wiring, platforms and motors."""
    root = FOLDER.parents[1]
    screen = "\n".join((root / "README.md").read_text("utf-8").splitlines()[:12])
    blocks = [*(f"{family}_Drive" for family in FAMILIES), "VFD_HardStop"]
    heads = {name: SOURCES[name].text.partition("*)")[0] for name in blocks}
    platforms = [root / f"blocks/{name}/README.md" for name in ("codesys", "openplc", "beremiz", "siemens", "twincat")]
    pages = [root / "docs/line.md", root / "blocks/README.md", *FOLDER.glob("*.md"), *platforms]
    motors = [root / "examples/one_motor.st", root / "examples/three_makes.st"]
    texts = {"README.md": screen, **heads, **{str(path): path.read_text("utf-8") for path in [*pages, *motors]}}
    assert len(pages) == 2 + len(blocks) + len(FAMILIES) + len(("Wiring", "Swapping", "Families", "FirstMotor")) + len(
        platforms
    )
    lost = [name for name, text in texts.items() if BRAKE not in " ".join(text.replace("> ", "").split())]
    assert lost == []
    for family in FAMILIES:
        assert BRAKE in page(family).partition("## Keypad and wiring")[2].partition("\n## ")[0]


@pytest.mark.parametrize("platform", EXPORTS)
def test_the_page_of_a_platform_is_short_and_says_what_a_turning_motor_does_when_the_plc_stops(platform: str) -> None:
    text = (FOLDER.parent / platform / "README.md").read_text("utf-8")
    prose = re.sub(r"```.*?```", "", text, flags=re.DOTALL).split()
    assert sum(re.search(r"\w", word) is not None for word in prose) <= 1250
    head = r"\| what happens \| the line is silent \| output of `HardStopOk` \| known from \|\n\|---\|---\|---\|---\|\n"
    found = re.search(head + r"((?:\|.*\|\n)+)", text)
    assert found
    cells = [line.strip("|").split(" | ") for line in found[1].splitlines()]
    assert len(cells) >= 4
    assert all(len(row) == 4 and all(map(str.strip, row)) for row in cells)


def test_the_page_of_the_contact_of_the_hard_stop_has_its_pins() -> None:
    text = (FOLDER / "VFD_HardStop.md").read_text(encoding="utf-8")
    pins = re.findall(r"^  (\w+) : (BOOL);", SOURCES["VFD_HardStop"].text, re.MULTILINE)
    assert re.findall(r"^\| `(\w+)` \| (\w+) \|", text, re.MULTILINE) == pins[:4]
    assert "**In series with the hard stop, never instead of it**, and never as the only channel of an STO" in text


@every_family
def test_what_the_manual_leaves_open_is_at_the_top_with_its_count(family: str) -> None:
    drive, text = drives()[family], page(family)
    top = text.partition("\n## Find out before the first start\n")[2].partition("\n## ")[0]
    rows_ = text.partition("\n## What the manual does not say\n")[2].partition("\n## ")[0]
    count = len(re.findall(r"^\| (?!---|the manual does)", rows_, re.MULTILINE))
    assert f"**{count} things**" in top
    assert text.index("Find out before the first start") < text.index("## In this order")
    assert "terminals" in top or families.own("WIRED").get(family), "whose line is connected as their manuals say"
    assert all(f"- {each.what}" in top for each in drive.absent if "serial" in each.about)
    keypad = text.partition("\n## Keypad and wiring\n")[2].partition("\n## ")[0]
    assert "(#find-out-before-the-first-start)" in keypad
    assert (drive.manual.edition or "") in text.partition("\n>")[0]


def test_a_reset_over_the_bus_is_advised_where_there_is_one() -> None:
    for family in FAMILIES:
        (advice,) = re.findall(r"^\| 40 \|.*", page(family), re.MULTILINE)
        can = any(one.does == "fault_reset" for one in drives()[family].operation.commands)
        assert ("rising `FaultReset`" in advice) == can
        assert ("the bus cannot reset it" in advice) != can
        assert "at the drive itself" not in page(family)
        assert "by hand" not in advice


def test_a_system_whose_text_has_no_ladder_has_a_picture_of_it_in_three_steps() -> None:
    for family in FAMILIES:
        for platform in ("siemens", "twincat"):
            drawn = [each.text for each in picture(f"{family}_Drive_ladder_{platform}.svg").iter()]
            assert {"HardStopClosed", "StartButton", "WasPressed", "NotStop", f"{family}_Drive"} <= set(drawn)
            assert f"[this picture]({family}_Drive_ladder_{platform}.svg)\n" in page(family)
        assert page(family).count("2. draw the networks of the picture, from top to bottom, 3. ") == 1


def test_a_system_alone_has_its_own_picture_of_the_ladder_and_no_other() -> None:
    chf = drives()["CHF"]
    files = [*generic(LANGUAGES), *library_of("chf", chf, LANGUAGES)]
    made = documents(files, [chf], targets=["twincat"])
    assert [name for name in made if "_ladder" in name] == ["docs/CHF_Drive_ladder_twincat.svg"]
    assert re.findall(r"CHF_Drive_ladder\w*\.svg|CHF_Ladder", made["docs/CHF_Drive.md"]) == [
        "CHF_Drive_ladder_twincat.svg"
    ]


def test_no_text_of_a_block_has_an_apostrophe() -> None:
    """`$'` is right, and two readers of SCL and one compiler stop at it."""
    assert [each.path for each in sources() if "$'" in each.text] == []
    assert [each.code for each in REASONS if "急停" in each.zh] == []


def test_a_first_motor_wires_nine_inputs_at_most() -> None:
    """Ten with the number that a second-hand map asks for; the slot is no input."""
    for drive in drives().values():
        for second_hand in {trust.second_hand(drive), True}:
            one = replace(drive, manual=replace(drive.manual, second_hand=second_hand))
            for platform in PLATFORMS:
                text = re.sub(r"\(\*.*?\*\)", "", first_motor(platform, one).text, flags=re.DOTALL)
                (call,) = re.findall(r"^  Motor\((.*?)\);", text, re.DOTALL | re.MULTILINE)
                wired = set(re.findall(r"(\w+) :=", call)) - {"Slot"}
                assert {"Enable", "RunForward", "MaximumHz", "StopWithinMs"} <= wired
                assert len(wired) <= 9 + second_hand
                assert ("ManualChecked" in wired) == second_hand


def test_pictures_are_there_and_whole() -> None:
    texts = [path.read_text(encoding="utf-8") for path in FOLDER.glob("*.md")]
    linked = {each for text in texts for each in re.findall(r"\((\w+\.svg)\)", text)}
    assert linked == {each.name for each in FOLDER.glob("*.svg")}
    for name in linked:
        size = picture(name).attrib
        for each in picture(name).iter():
            assert 0 <= float(each.get("x", 0)) <= float(size["width"])
            assert 0 <= float(each.get("y", 0)) <= float(size["height"])


def test_figures_of_the_line_follow_its_formula() -> None:
    """JSCC at 9600, worked out by hand from the formula of docs/line.md."""
    rows = re.findall(
        r"^\| 9600 8E1, (the \w+) keeps the silence \| (\d+) ms \| (\d+) ms \| (\d+) ms \|", page("JSCC"), re.M
    )
    # 13 + 2 characters a word, of 1.15 ms, and 5 ms: 24.5 ms for two words, 22.2 ms for one; S is JSCC's 10 ms.
    # By the port 4 scans for each of three reads, the status twice; by the line 3 + 1 + 1.
    assert rows == [("the port", "120", "360", "840"), ("the line", "150", "450", "1050")]


# ---------------------------------------------------------------- the example runs, and does what the picture shows


@cache
def library() -> dict[str, Instance]:
    """The programs of all pages, each in an instance, as they are and with RunForward on a switch."""
    examples = {family: replace(one := example(family), text=compared(one.text)) for family in FAMILIES}
    files = [*sources(), *examples.values()]
    assert [each for each in lint_sources((f.path, f.text) for f in files) if each.path.count("/") == 0] == []
    bare = [Source(f"{one.path}bare", bared(one.text)) for one in examples.values()]
    blocks = built(EmbeddedEngine(), "pages", [*files, *bare]).library
    names = [name for family in FAMILIES for name in (f"{family}_Motor", f"{family}_Bare")]
    return {name: blocks.instance(name) for name in names}


def compared(text: str) -> str:
    """A first motor whose user has compared the map with the manual, where it is not read off that."""
    return re.sub(r"ManualChecked := 0, \(\* (\d+) once", r"ManualChecked := \1, (* once", text)


def bared(text: str) -> str:
    """A first motor whose RunForward is a switch, as the picture has it."""
    for old, new in (
        ("_Motor\n", "_Bare\n"),
        ("RunForward := Run,", "RunForward := Switch,"),
        ("\nVAR\n", "\nVAR\n  Switch : BOOL;\n"),
    ):
        assert text.count(old) == 1
        text = text.replace(old, new)
    return text


class Story:
    """A program with its drive, and the columns of what it does."""

    def __init__(self, family: str, form: str) -> None:
        """A drive at the address and rate of the page."""
        rate, bits = re.findall(r"BitRate := (\d+), CharacterBits := (\d+)", page(family))[0]
        self.program = library()[f"{family}_{form}"]
        self.program["HardStopClosed"] = self.program["NotStop"] = True
        self.drive = SimulatedDrive(drives()[family], drives()[family].serial.unit.min)
        self.port = Port(self.program, [self.drive], 1000 * int(bits) / int(rate))
        self.program["Hertz"] = 20.0
        if family == "JSCC":
            self.program["CountsPerHertz"] = 100.0
        self.program["Motor.Settings.FrequencyScale"] = 0.01
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
    return [replace(each, speed=(0.0, 0.0), shaft=None, event="") for each in columns]


@every_family
@pytest.mark.thorough
def test_the_block_of_the_example_does_what_the_picture_shows(family: str) -> None:
    story, drive = Story(family, "Bare"), drives()[family]
    story.run(3500)
    story.run(6000, Switch=True)
    story.run(4000, Switch=False)
    # a drive that has just left off running is not proved to stand yet: two reads have to show it
    waits = [at for at, each in enumerate(story.columns) if at > 0 and replace(each, sends=()) == timing.Column(0)]
    # a drive with a long path may show a run before its last write
    early = [at for at, each in enumerate(story.columns) if each.state == 3 and each.running]
    wanted = [each for each in drawn(timing.start_and_stop()) if not early or each.state != 4 or each.running]
    assert [each for at, each in enumerate(story.columns) if at not in (*waits, *early)] == wanted
    story.run(6000, Switch=True)
    del story.columns[:-1]
    story.drive.trip(2)
    story.run(3000)
    story.run(6000, Switch=False)
    story.drive.clear_cause()
    if "FaultReset := ResetButton" in example(family).text:
        story.run(2000, ResetButton=True)
    else:
        story.drive.reset()
        story.run(2000)
    # the frequency may come before the status: not at speed, and not yet in fault; two reads prove standstill
    passing = replace(story.columns[0], at_speed=False, sends=()), timing.Column(0)
    shown = [each for each in story.columns if replace(each, sends=()) not in passing]
    told_by = {one.shows: {each.register for each in one.any} for one in drive.operation.status}
    if told_by["fault"] != told_by["running"] or any(
        one.does == "fault_reset" and one.first for one in drive.operation.commands
    ):
        # the picture draws a reset as one write; between those of several, a read may show a proof that is older,
        # and so it may between a fault and a run that are read one after the other
        told = iter(replace(each, sends=()) for each in shown)
        assert all(replace(each, sends=()) in told for each in drawn(timing.fault_and_reset(drive)))
    else:
        assert shown == drawn(timing.fault_and_reset(drive))
    assert story.drive.hertz == 0


@every_family
def test_the_example_starts_by_one_press_and_stops_by_its_button(family: str) -> None:
    story = Story(family, "Motor")
    story.run(6000)
    story.run(100, StartButton=True)
    story.run(6000, StartButton=False)
    assert round(story.drive.hertz, 2) == 20
    story.run(6000, NotStop=False)
    assert (story.drive.hertz, story.program["Motor.StopConfirmed"]) == (0, True)
    story.run(3000, NotStop=True)
    story.run(5000, StartButton=True)
    story.drive.trip(2)
    story.run(3000)
    story.drive.clear_cause()
    story.drive.reset()
    story.run(6000)
    assert (story.drive.hertz, story.program["Run"]) == (0, False), "a stuck button starts nothing"


HARD_STOP = (
    # Overdue, Restart, Reset -> HardStopOk, as the page says it row by row
    (False, False, True, False, "the first call"),
    (False, False, True, False, "a button that is held since then"),
    (False, False, False, False, "nothing happens"),
    (False, False, True, True, "the button rises"),
    (False, False, False, True, "and is released"),
    (True, False, False, False, "overdue"),
    (False, False, False, False, "no longer overdue: as before"),
    (True, False, True, False, "the button rises while something is overdue"),
    (False, False, True, False, "and is held"),
    (False, False, False, False, "and is released"),
    (False, False, True, True, "the button rises"),
    (False, True, True, False, "a restart"),
    (False, False, True, False, "the button was held through it"),
)


def test_the_contact_of_the_hard_stop_does_what_its_page_says(engine: Engine) -> None:
    block = built(engine, "hard stop", [SOURCES["VFD_HardStop"]]).library.instance("VFD_HardStop")
    for overdue, restart, reset, closed, why in HARD_STOP:
        block["Overdue"], block["Restart"], block["Reset"] = overdue, restart, reset
        block.scan()
        assert block["HardStopOk"] == closed, why


def test_the_page_of_swapping_says_who_wants_a_number() -> None:
    text = (FOLDER / "Swapping.md").read_text("utf-8")
    assert "   | JSCC | no use | required | no use | no use | no |" in text
    assert "   | MX2 | no use | no use | no use | required | yes |" in text


def test_the_page_of_swapping_says_whose_stop_moves_a_drive_of_another_make() -> None:
    text = (FOLDER / "Swapping.md").read_text("utf-8")
    assert "| JSCC | CHF | **motion**: 1000H = 0003H, there its jog forward | by 2001H, a value that only it" in text
    assert (
        "| PF525 | GD20, GD200A, PI130, VM600 | **motion**: 2000H = 0001H, there its run forward | by 007CH, its own"
        in text
    )
    drive = shapes()["active_low"]
    files = [*generic(LANGUAGES), *library_of("mine", drive, LANGUAGES)]
    (row,) = [each for each in documents(files, [drive])["docs/Swapping.md"].splitlines() if "LOW | CHF |" in each]
    assert "its run forward" in row, "a family that ships counts, too"


def test_every_first_motor_says_where_it_turns_though_0_is_asked_for() -> None:
    for family, says in (("GD200A", "P00.05 (Lower limit of the running frequency)"), ("ATV312", "LSP (Low speed)"),
                         ("JSCC", "a lower limit that its manual does not give")):  # fmt: skip
        motor = " ".join(first_motor("iec61131", drives()[family]).text.split())
        assert f"at 0.0 the drive runs, and the motor may turn at {says} *)" in motor
