"""What the stop of one family is at a drive of another, and what tells the two apart; typed from the manuals."""

from dataclasses import replace

import pytest
from tests.second.pf4 import VARIANTS
from tests.second.station import FAMILIES, maps

from driveblocks.maps import rivals
from driveblocks.maps.model import Drive

POWERFLEX = ("PF4", *VARIANTS)
MOTION = {*((one, "GD200A") for one in POWERFLEX), *(("GD200A", one) for one in POWERFLEX), ("JSCC", "CHF")}
"""2000H = 1 runs a GD200A; 5 is stop and jog, 6 start and jog of a PowerFlex; 1000H = 3 jogs a CHF."""
OTHER = {
    *((one, "CHF") for one in (*POWERFLEX, "GD200A")), *(("SN300G5", one) for one in ("JSCC", "GD200A", "MX2", "V20")),
    *(("ACS355", one) for one in ("CHF", "GD200A", "JSCC", "MX2", "V20")), ("V20", "CHF"), ("V20", "JSCC"),
}  # fmt: skip
"""2000H is the reference of a CHF; 0000H a parameter of JSCC and GD200A, and the frequency of an MX2."""


def shipped() -> list[Drive]:
    """The shipped families."""
    return [maps()[one] for one in FAMILIES]


def test_every_pair_of_the_shipped_families_has_its_meaning() -> None:
    found = {(each.block.prefix, each.drive.prefix): each.worst.means for each in rivals.pairs(shipped())}
    assert found == dict.fromkeys(MOTION, "motion") | dict.fromkeys(OTHER, "other")


def test_every_such_pair_is_told_apart() -> None:
    assert [each for each in rivals.pairs(shipped()) if not each.told] == []


def worst(block: str, drive: str) -> rivals.Stop:
    """The worst of the stops of one at the other."""
    return rivals.stops_at(maps()[block], maps()[drive])[0]


@pytest.mark.parametrize(
    ("block", "drive", "means", "says"),
    [
        ("PF525", "GD200A", "motion", "its run forward"),
        ("JSCC", "CHF", "motion", "its jog forward"),
        ("GD200A", "PF4", "motion", "its bit 2 `Jog` at 1"),
        ("SN300G5", "JSCC", "other", "one of its parameters"),
        ("PF4", "PF525", "stop", "its stop"),
        ("CHF", "JSCC", "unknown", "its map lists no such value"),
        ("CHF", "ATV312", "unknown", "its map does not list it"),
        ("CHF", "MX2", "refused", 'its "Output frequency", which is only read'),
        ("SN300G5", "CHF", "refused", "it has no function 10H"),
        ("MX2", "CHF", "refused", "it has no function 05H"),
    ],
)
def test_what_a_stop_is(block: str, drive: str, means: str, says: str) -> None:
    found = worst(block, drive)
    assert (found.means, found.says) == (means, says)


@pytest.mark.parametrize(
    ("family", "reads"),
    [
        ("PF525", [(0x7C, "unit"), (0x2100, "any")]), ("PF4M", [(0x12F, "unit"), (0x2100, "any")]),
        ("GD200A", [(0x0E00, "unit")]), ("SN300G5", [(0x041C, "unit")]), ("JSCC", [(0x2001, "bits")]),
        ("CHF", []), ("ATV312", [(0x0D49, "values")]), ("MX2", []),
    ],
)  # fmt: skip
def test_what_a_block_reads_first(family: str, reads: list[tuple[int, str]]) -> None:
    assert [(each.read.address, each.shows) for each in rivals.first_reads(maps()[family])] == reads


def test_an_address_that_the_other_lists_without_values_tells_nothing() -> None:
    """CHF has function codes at 0000H to 01FFH, and one of them may hold the unit address by chance."""
    address, status = rivals.first_reads(maps()["PF525"])
    assert not rivals._tells(address, maps()["CHF"])
    assert rivals._tells(status, maps()["CHF"])
    assert rivals._tells(address, maps()["GD200A"])


def test_a_family_with_an_identity_reads_that_alone() -> None:
    drive = maps()["CIA"]
    assert [each.read.address for each in rivals.first_reads(drive)] == [0x2003]
    assert rivals.against(drive) == []
    assert rivals.told_apart(drive, maps()["CHF"]) == "its identity"


def test_what_nothing_tells_apart_is_in_the_table() -> None:
    """A made-up drive with registers of a CHF alone, whose stop is its jog."""
    chf = maps()["CHF"]
    stop = next(one for one in chf.operation.commands if one.does == "stop")
    others = [one for one in chf.operation.commands if one.does not in ("stop", "jog_forward")]
    twin = replace(chf, prefix="TWIN", operation=replace(chf.operation, commands=(replace(stop, value=3), *others)))
    (pair,) = [each for each in rivals.pairs([twin, chf]) if each.block is twin]
    assert (pair.worst.means, pair.told) == ("motion", "")
    assert "nothing tells the two apart" in rivals.warning(pair)
