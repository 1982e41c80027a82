"""The folder of a plant, written again and again: what is the user's stays, and what was changed elsewhere is left."""

from pathlib import Path

import pytest
from _pytest.mark import ParameterSet
from click.testing import CliRunner, Result
from tests.plant.bench import EXAMPLES

from driveblocks.commands import project as command
from driveblocks.plant import forms, yours

OWN = "  IF Fan.Running AND (Fan.OutputFrequencyHz < 10.0) THEN (* mine *)\n    Mixer_Stop := TRUE;\n  END_IF;\n"
LIFT = """  Lift:
    drive: chf
    line: A
    unit: 9
    maximum_hz: 50
    full_scale_hz: 50
    stop_within_ms: 9000
"""
PROGRAMS = {
    "openplc": "yours/Mixing.st", "text": "yours/Mixing.st", "codesys": "yours/Mixing.xml",
    "beremiz": "yours/Mixing/plc.xml", "twincat": "yours/Mixing.TcPOU", "siemens": "yours/Mixing.scl",
}  # fmt: skip
ESCAPED = ("codesys",)


class Desk:
    """A plant file and its folder."""

    def __init__(self, folder: Path, target: str) -> None:
        self.file, self.folder, self.target = folder / "plant.yaml", folder / "out", target
        self.file.write_bytes((EXAMPLES / "small.yaml").read_bytes())
        self.program = self.folder / PROGRAMS[target]

    def project(self, status: int = 0, target: str = "") -> Result:
        words = [str(self.file), "--to", target or self.target, "-o", str(self.folder)]
        done = CliRunner().invoke(command.run, words, catch_exceptions=False)
        assert done.exit_code == status, done.output
        return done

    def edit(self, old: str, new: str) -> None:
        """Change the plant file."""
        text = self.file.read_text("utf-8")
        assert old in text
        self.file.write_text(text.replace(old, new), encoding="utf-8")

    def write(self, place: str, content: str) -> None:
        """Write one's own between marks, as an editor of the platform does."""
        text = self.text()
        mark = f"(* your own: begin {place} *)"
        assert mark in text
        ends = "\r\n" if "\r\n" in text else "\n"
        inner = content.replace("<", "&lt;") if self.target in ESCAPED else content
        new = text.replace("\r\n", "\n").replace(f"{mark}\n", f"{mark}\n{inner}").replace("\n", ends)
        self.program.write_bytes(new.encode("utf-8"))

    def text(self) -> str:
        return self.program.read_bytes().decode("utf-8")

    def all(self) -> dict[str, bytes]:
        return {str(each): each.read_bytes() for each in self.folder.rglob("*") if each.is_file()}


def some(*targets: str) -> list[ParameterSet]:
    """Targets; of each test, all but the first take part in thorough runs alone."""
    return [pytest.param(each, marks=[pytest.mark.thorough] if at else []) for at, each in enumerate(targets)]


@pytest.mark.parametrize("target", some("codesys", *(each for each in PROGRAMS if each != "codesys")))
def test_own_logic_stays_whatever_becomes_of_the_plant(target: str, tmp_path: Path) -> None:
    desk = Desk(tmp_path, target)
    desk.project()
    desk.write("AfterLines", OWN)
    if target in forms.DECLARED:
        desk.write("Declarations", "  Mine : BOOL; (* my own *)\n")
    before = desk.text()
    assert ", 0 changed" in desk.project().output
    assert desk.text() == before
    desk.edit("unit: 3", "unit: 7")
    desk.edit("  Pump:\n    drive: atv312", "  Pump:\n    drive: gd200a\n    manual_checked: 56864")
    desk.edit("inputs:", LIFT + "inputs:")
    said = desk.project().output
    after = desk.text()
    assert yours.contents(before) == yours.contents(after) != {}
    assert after.count("(* mine *)") == 1
    assert ("\r\n" in after) == ("\r\n" in before)
    assert after.startswith("\ufeff") == before.startswith("\ufeff")
    assert "Address := 7" in after
    assert "GD200A_Drive" in after
    assert "Lift_Run" in after
    assert len(said.splitlines()) < 250
    assert "+  Lift_Starts := Lift_Start;" in said or target == "siemens"


@pytest.mark.parametrize("target", some("siemens", "openplc", "codesys", "twincat"))
def test_file_that_was_changed_elsewhere_is_left_and_the_difference_shown(target: str, tmp_path: Path) -> None:
    desk = Desk(tmp_path, target)
    desk.project()
    desk.write("BeforeDrives", OWN)
    desk.program.write_bytes(desk.program.read_bytes().replace(b"MaxScanMs := 20", b"MaxScanMs := 30"))
    mine = desk.text()
    desk.edit("speed: 45", "speed: 41")
    said = desk.project(status=1).output
    assert desk.text() == mine
    assert "changed outside of the marks" in said
    assert "SpeedReferenceHz := 41.0" in said
    assert "MaxScanMs := 30" in said
    assert "(* mine *)" not in said
    desk.project(status=1)
    assert desk.text() == mine
    desk.program.write_bytes(desk.program.read_bytes().replace(b"MaxScanMs := 30", b"MaxScanMs := 20"))
    desk.project(status=1)
    desk.program.write_bytes(desk.program.read_bytes().replace(b":= 45.0", b":= 41.0"))
    desk.project()


def test_file_of_the_library_that_was_changed_is_left_and_all_others_are_written(tmp_path: Path) -> None:
    desk = Desk(tmp_path, "text")
    desk.project()
    library = desk.folder / "shared" / "DriveBlocks_Plant.st"
    library.write_text(library.read_text("utf-8").replace("MARGIN : REAL := 0.05", "MARGIN : REAL := 0.5"), "utf-8")
    mine = library.read_bytes()
    desk.edit("speed: 45", "speed: 41")
    said = desk.project(status=1).output
    assert library.read_bytes() == mine
    assert "+  MARGIN : REAL := 0.05;" in said
    assert "SpeedReferenceHz := 41.0" in desk.text()


def test_program_of_another_name_leaves_the_old_one_with_what_is_the_users(tmp_path: Path) -> None:
    desk = Desk(tmp_path, "text")
    desk.project()
    desk.write("AfterLines", OWN)
    mine = desk.text()
    desk.edit("plant: Mixing", "plant: Stirring")
    assert "with your own logic in it" in desk.project(status=1).output
    assert desk.text() == mine
    assert (desk.folder / "yours" / "Stirring.st").is_file()


def test_program_of_another_name_replaces_one_without(tmp_path: Path) -> None:
    desk = Desk(tmp_path, "text")
    desk.project()
    desk.edit("plant: Mixing", "plant: Stirring")
    desk.project()
    assert not desk.program.exists()


def test_bad_plant_or_folder_writes_nothing(tmp_path: Path) -> None:
    desk = Desk(tmp_path, "text")
    desk.project()
    before = desk.all()
    desk.project(status=2, target="openplc")
    assert desk.all() == before
    desk.edit("line: A\n    unit: 3", "line: A\n    unit: 2")
    assert "plant.yaml:" in desk.project(status=2).output
    assert desk.all() == before


def test_file_in_the_way_is_not_overwritten(tmp_path: Path) -> None:
    desk = Desk(tmp_path, "text")
    desk.program.parent.mkdir(parents=True)
    desk.program.write_text("PROGRAM Mine\nEND_PROGRAM\n", encoding="utf-8")
    before = desk.all()
    assert "nothing was written" in desk.project(status=2).output
    assert desk.all() == before


def test_marks_that_were_damaged_lose_nothing(tmp_path: Path) -> None:
    desk = Desk(tmp_path, "text")
    desk.project()
    desk.write("AfterLines", OWN)
    desk.program.write_text(desk.text().replace("(* your own: end AfterLines *)", ""), encoding="utf-8")
    mine = desk.text()
    desk.edit("speed: 45", "speed: 41")
    desk.project(status=1)
    assert desk.text() == mine
