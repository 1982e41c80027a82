"""Judge a plant: everything that is wrong with it at once. What is good here can be built, and its motors turn."""

from dataclasses import dataclass, field
from pathlib import Path

from driveblocks.desk.site.line import Figures, Line, figures
from driveblocks.maps.collection import clashes
from driveblocks.maps.problem import Problem, Report
from driveblocks.plant import load
from driveblocks.plant.line import lines, sources
from driveblocks.plant.model import SECTIONS, Plant
from driveblocks.plant.rules import drive, line, memory, name, reference
from structured_text.visible import file_name


@dataclass(frozen=True)
class Judged:
    """A good plant, the figures of its lines at their own rates, and what to look at all the same."""

    plant: Plant
    figures: dict[str, Figures] = field(repr=False)
    warnings: tuple[Problem, ...] = ()

    @property
    def held(self) -> str:
        """What it holds, for a person: 2 lines, 6 drives."""
        counts = {key.replace("_", " "): len(getattr(self.plant, key)) for key in SECTIONS}
        return ", ".join(f"{n} {key.removesuffix('s') if n == 1 else key}" for key, n in counts.items() if n)


def good(path: Path) -> Plant:
    """The plant of a file, without a mistake. Raises MapError with every mistake."""
    return judged(path).plant


def judged(path: Path) -> Judged:
    """The same with its figures and warnings. Raises MapError."""
    report, warnings = Report(file_name(path)), Report(file_name(path))
    plant = load.read(path, report)
    found: dict[str, Figures] = {}
    if plant is not None:
        _clash(plant, report)
        line.check(plant, report)
        drive.check(plant, report)
        if not report.problems and _whole(plant):
            found = _figures(plant, report, warnings)
        name.check(plant, report)
        reference.check(plant, report)
        memory.check(plant, report)
        drive.unable(plant, warnings)
        _unused(plant, warnings)
    report.raise_if_any()
    assert plant is not None  # noqa: S101 - else something was noted
    return Judged(plant, found, tuple(sorted(set(warnings.problems))))


def spoken(path: Path) -> tuple[Plant, dict[str, Line]]:
    """A plant and its lines, whatever is wrong with what their figures do not need. Raises MapError with the rest."""
    report = Report(file_name(path))
    plant = load.read(path, report)
    if plant is not None:
        _clash(plant, report)
        line.check(plant, report)
        drive.check(plant, report)
        if not _whole(plant):
            report.miss(plant.at, "a drive or a meter has no line", "run `driveblocks check`, which says all")
    report.raise_if_any()
    assert plant is not None  # noqa: S101 - else something was noted
    return plant, _lines(plant)


def _whole(plant: Plant) -> bool:
    """Whether there is a line for each unit, and a drive at all."""
    named = {each.line for each in plant.drives.values()}
    return bool(named) and named | {each.line for each in plant.meters.values()} <= plant.lines.keys()


def _lines(plant: Plant) -> dict[str, Line]:
    """The lines that have drives."""
    return lines(plant, [each for each in plant.lines if plant.on(each)])


def _clash(plant: Plant, report: Report) -> None:
    """Note maps that cannot be in one library."""
    some = sources(plant)
    for each in clashes(some):
        motor = next(one for one in plant.drives.values() if str(one.path) == each.file)
        report.add(motor.place("drive"), each.wrong, each.right)


def _figures(plant: Plant, report: Report, warnings: Report) -> dict[str, Figures]:
    """The figures of the lines that have drives; what does not hold is noted."""
    made = _lines(plant)
    found = {each: figures(one, one.rate) for each, one in made.items()}
    for each, own in found.items():
        line.hold(plant, own, report)
        line.mixed(plant, each, own, warnings)
    memory.fits(plant, made.values(), report, warnings)
    return found


def _unused(plant: Plant, warnings: Report) -> None:
    """Warn of what commission found of no drive of the plant, or of another map."""
    for label, one in plant.found.items():
        motor = plant.drives.get(label)
        if motor is None:
            right = "name it as its drive, or run `driveblocks commission` again with that --label"
            warnings.add(one.at, f"no drive is called {label}, of which commission has found this", right)
        elif one.map != motor.path.stem:
            wrong = f"commission has found a {one.map} at {label}, and the plant has {motor.path.stem}"
            warnings.add(one.at, wrong, "commission the drive again")
