"""What `commission` says of drives that were written apart from the maps, and of lines: a matrix map x drive x line."""

import pytest
from tests.desk.peers import CHAR_US, FATES, TABLES, TWINS, Fate, Later, Line, Peer, everything
from tests.desk.run.desk import maps
from tests.desk.site.test_commission import Person
from tests.second.kinds import drive

from driveblocks.desk.site.adapter import PortLine
from driveblocks.desk.site.found import Found
from driveblocks.desk.site.session import Wish, commission

MAPS = {each.path.stem: each.drive for each in maps()}
KINDS = {
    "sn": "shuen_sn300g5", "jscc": "jscc", "chf": "invt_chf", "atv": "schneider_altivar_312", "mx": "omron_mx2",
    "gd": "invt_gd200a", "pf": "rockwell_powerflex_4", "pf40p": "rockwell_powerflex_40p",
    "pf4m": "rockwell_powerflex_4m", "pf400": "rockwell_powerflex_400", "pf525": "rockwell_powerflex_525",
    "pf525 whole": "rockwell_powerflex_525",
}  # fmt: skip
"""Second models, and the maps of their makes."""
SISTERS = {stem for stem in KINDS.values() if stem.startswith("rockwell")}
"""Families with the same registers, as far as a drive block reads them."""
DRIVES = list(KINDS | TABLES)
ENOUGH, FEW = 200, 20
LINES = (*FATES, *TWINS)


def peer(name: str) -> Peer:
    """A drive by its name."""
    return TABLES[name]() if name in TABLES else drive(name, 1, char_us=CHAR_US)


def went(stem: str, line: Line, reads: int = FEW) -> Found:
    """All steps with a map, in a way that is known."""
    others = {name: each for name, each in MAPS.items() if name != stem}
    wish = Wish(MAPS[stem], others, 9600, "8N1", "rtu", 1, quiet_us=1_000_000, reads=reads)
    return commission(PortLine(line.opened, line.clock), Person(), wish, lambda _: None)


def own(name: str, on: str, seed: int = 0, reads: int = FEW) -> None:
    """A make at its own map is not turned down, and nothing is said of its line that is not so."""
    peers = [peer(name), Later(peer(name), TWINS[on])] if on in TWINS else [peer(name)]
    line = Line(peers, FATES.get(on, Fate()), seed)
    found = went(KINDS[name], line, reads)
    kinds = [each.kind for each in found.faults]
    seen = (name, on, seed, found.family, found.faults, str(found.quality), line.share)
    assert not {"family", "identity", "lost"} & {*kinds}, seen
    assert line.bodies <= {1, 2, 3, 4, 0x11, 0x2B}
    if found.quality is not None and found.quality.is_good:
        assert line.share <= 0.03, seen
        assert line.asked >= ENOUGH, seen
        assert not on.startswith(("doubled", "twins")), seen
    if on.startswith(("late", "once", "echo")):
        assert (found.family, found.ended, "two" in kinds, "foreign" in kinds) == ("fits", "", False, False), seen
        assert found.measured is not None
        refused = found.measured.unlisted[-7:] == "refused"
        assert refused or name in ("gd", "pf525 whole"), (seen, found.measured.unlisted)
    if on.startswith(("doubled", "twins")):
        assert {"two", "damaged"} & {*kinds}, seen


def foreign(stem: str, name: str) -> None:
    """A drive of another make is turned down; or its own map is named, if all that is read fits here, too."""
    found = went(stem, Line([peer(name)]))
    notes, kinds = " ".join(found.evidence), {each.kind for each in found.faults}
    sisters = {KINDS.get(name), stem} <= SISTERS
    named = KINDS.get(name, "no map") in notes or (sisters and "refused" in kinds)
    assert named if found.family else kinds & {"family", "identity"}, (stem, name, found.family, found.faults, notes)


@pytest.mark.parametrize(
    ("name", "on"),
    [
        ("pf", "late 895"), ("jscc", "once 1200"), ("pf", "flipped 25"), ("chf", "doubled 55"), ("pf", "twins 55"),
        ("chf", "echo 200"), ("jscc", "late 0"),
    ],
)  # fmt: skip
def test_a_drive_is_no_stranger_to_its_own_map_on_any_line(name: str, on: str) -> None:
    own(name, on)


@pytest.mark.parametrize("name", DRIVES)
@pytest.mark.parametrize("stem", ["jscc", "rockwell_powerflex_4"])
def test_another_make_is_no_drive_of_a_map(stem: str, name: str) -> None:
    own(name, "late 0") if KINDS.get(name) == stem else foreign(stem, name)


def test_what_answers_every_address_has_no_family_that_can_be_seen() -> None:
    found = went("jscc", Line([everything()]))
    assert found.family == "unknown" or {each.kind for each in found.faults} == {"family"}


@pytest.mark.parametrize("share", [0.0, 0.02])
def test_no_line_is_called_good_that_damages_more_than_three_in_a_hundred(share: float) -> None:
    for reads in (FEW, ENOUGH):
        line = Line([peer("jscc")], Fate(damage=share), 1)
        figures = went("jscc", line, reads).quality
        assert figures is not None
        assert figures.is_good == (share == 0 and reads == ENOUGH)


@pytest.mark.long
@pytest.mark.parametrize("on", LINES)
@pytest.mark.parametrize("name", KINDS)
def test_no_drive_is_ever_a_stranger_to_its_own_map(name: str, on: str) -> None:
    for seed in range(3):
        own(name, on, seed, ENOUGH)


@pytest.mark.long
@pytest.mark.parametrize("name", DRIVES)
@pytest.mark.parametrize("stem", MAPS)
def test_no_other_make_is_ever_a_drive_of_a_map(stem: str, name: str) -> None:
    own(name, "late 0") if KINDS.get(name) == stem else foreign(stem, name)
