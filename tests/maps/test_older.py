"""Maps of an earlier format, and keys where this one has none."""

import re

import pytest
from tests.maps.test_base import BASE

from driveblocks.maps.decode import build
from driveblocks.maps.load import loads
from driveblocks.maps.nodes import Scalar
from driveblocks.maps.problem import MapError, Report
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


@pytest.mark.parametrize("wrong_key", ["pins: 1, ", "display: x, ", "rung: read, ", "printed: [x], "])
def test_keys_of_other_entries_are_unknown(wrong_key: str) -> None:
    assert "unknown key" in refused(BASE.replace("{code: 02H, name", f"{{{wrong_key}code: 02H, name"))[0]
