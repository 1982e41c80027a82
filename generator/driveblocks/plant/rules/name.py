"""Rules on names: each becomes a variable of the program, in every programming system."""

from collections.abc import Collection

from driveblocks.desk.site.kept import LABEL
from driveblocks.maps import names
from driveblocks.maps.problem import Report
from driveblocks.plant.model import SECTIONS, Called, Plant, identifier
from structured_text.language.names import kept
from structured_text.language.reserved import TARGET_WORDS

LONGEST, LONGEST_PROGRAM = 22, 24
"""Letters and digits: the program adds up to nine, as in P1_Settings."""
OWN = ("FirstScan", "ElapsedMs", "All", "Hmi")
"""Names that every program has, and what some of them begin with."""


def check(plant: Plant, report: Report) -> None:
    """Note every name that no program can have, and what two things share."""
    _program(plant, report)
    own = {name.upper() for name in OWN} | {each.name.upper() for each in plant.hard_stops.values() if unwritten(each)}
    taken: dict[str, Called] = {}
    for section in SECTIONS:
        for name, each in getattr(plant, section).items():
            if unwritten(each):
                continue
            if wrong := _wrong(name, own):
                report.add(each.name_at, f"`{name}` {wrong}", "choose another name")
            first = taken.setdefault(name.upper(), each)
            if first is not each:
                wrong = f"`{name}` is the name of something else, too: `{first.name}` in line {first.name_at[0]}"
                report.add(each.name_at, wrong, "give each a name of its own; capital letters make no difference")


def unwritten(each: Called) -> bool:
    """Whether it is not in the file: the hard stop of a plant without any."""
    return each.name_at == (0, 0)


def _wrong(name: str, own: Collection[str]) -> str:
    """Why a variable of a program cannot have a name; empty: it can."""
    if not LABEL.fullmatch(name):
        return ""  # said where it was read
    if why := names.wrong_pin(name):
        return why
    if len(name) > LONGEST:
        return f"has {len(name)} letters and digits, and {LONGEST} are possible"
    if kept(name, TARGET_WORDS):
        return "is a word of a programming system"
    return "is a variable of the program itself" if name.upper() in own else ""


def _program(plant: Plant, report: Report) -> None:
    made, place = identifier(plant.plant), plant.place("plant")
    if not made[:1].isalpha():
        wrong = f"`plant: {plant.plant}` gives no name of a program: `{made}` does not begin with a letter"
        report.add(place, wrong, "begin it with a letter A to Z")
    elif len(made) > LONGEST_PROGRAM:
        wrong = f"the program would be called {made}, {len(made)} letters and digits"
        report.add(place, wrong, f"write a name with at most {LONGEST_PROGRAM}")
    elif why := names.wrong_block(made) or (kept(made, TARGET_WORDS) and "is a word of a programming system"):
        report.add(place, f"the program would be called {made}, which {why}", "choose another name")
    elif made.upper() in {name.upper() for section in SECTIONS for name in getattr(plant, section)}:
        report.add(place, f"the program would be called {made}, and so is something in it", "choose another name")
