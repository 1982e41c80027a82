"""Maps of an earlier format, and keys of this one that nothing reads yet."""

import re
from pathlib import Path

import pytest
from tests.maps.test_base import BASE, write

from driveblocks.diff.facts import compared
from driveblocks.maps import view
from driveblocks.maps.decode import build
from driveblocks.maps.load import load, loads
from driveblocks.maps.nodes import Scalar
from driveblocks.maps.problem import MapError, Report
from driveblocks.maps.revision import revision
from driveblocks.maps.shape import OneOf


def refused(text: str) -> list[str]:
    """What is wrong with a map."""
    with pytest.raises(MapError) as caught:
        loads(text, "acme.yaml")
    return [f"{each.line}: {each.wrong}" for each in caught.value.problems]


def test_a_map_of_format_1_is_told_all_that_it_has_to_say_at_once() -> None:
    older = re.sub(", does: \\[[^]]*\\]", "", BASE).replace("format: 2", "format: 1")
    assert [each.partition(": ")[2] for each in refused(older)] == [
        "`format: 1` is the form of earlier maps",
        "nothing says what the values of 1000H do to the motor",
    ]


def test_what_is_no_longer_a_word_says_what_to_write() -> None:
    report = Report("acme.yaml")
    build(OneOf({"any": "any", "writes": "writes"}), Scalar("reference", plain=True, at=(3, 9)), report, "feeds")
    assert report.problems[0].right == "write `writes`, or the register of the reference under `fed_by`"


RESERVED = (("interface: {en: RS-485}", "interface: {en: RS-485}\n  pins: [{pin: 1, signal: A}]"),)


def test_keys_for_later_are_taken_and_change_nothing(tmp_path: Path) -> None:
    more = BASE
    for old, new in RESERVED:
        assert old in more
        more = more.replace(old, new, 1)
    map_, plain = loads(more, "acme.yaml"), loads(BASE, "acme.yaml")
    assert revision(map_) == revision(plain)
    assert not [*compared(view.of_drive(plain, "acme"), view.of_drive(map_, "acme"))]
    assert load(write(tmp_path, "", more)).prefix == "BEST"


@pytest.mark.parametrize("wrong_key", ["pins: 1, ", "display: x, "])
def test_elsewhere_they_are_unknown(wrong_key: str) -> None:
    assert "unknown key" in refused(BASE.replace("{code: 02H, name", f"{{{wrong_key}code: 02H, name"))[0]
