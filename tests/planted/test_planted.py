"""Every place of the table is still there, once, and a mistake of each rule turns its judge red."""

import re

import pytest
from tests.planted.checkout import ROOT, Checkout
from tests.planted.table import FOUND, Place, judged, places

PLACES = places()
ONE_OF_EACH = list({one.rule: one for one in reversed(PLACES)}.values())[::-1]


def test_every_place_is_there_once_with_its_judge() -> None:
    texts = {one.file: (ROOT / one.file).read_bytes().decode() for one in PLACES}
    assert [one.id for one in PLACES if texts[one.file].count(one.old) != 1 or one.old == one.new] == []
    nodes = [one.judge.split("::") for one in PLACES if one.judge.startswith("tests/")]
    defined = {node[0]: re.findall(r"def (test_\w+)", (ROOT / node[0]).read_text("utf-8")) for node in nodes}
    assert [node for node in nodes if not set(node[1:]) <= set(defined[node[0]])] == []
    assert len({one.id for one in PLACES}) == len(PLACES)


@pytest.fixture(scope="session")
def copy(tmp_path_factory: pytest.TempPathFactory) -> Checkout:
    """A copy of the checkout."""
    return Checkout(tmp_path_factory.mktemp("planted") / "copy")


@pytest.mark.thorough
@pytest.mark.parametrize("one", ONE_OF_EACH, ids=lambda one: str(one.id))
def test_a_mistake_of_each_rule_is_found(copy: Checkout, one: Place) -> None:
    verdict = judged(copy, one)
    if verdict.startswith("skipped"):
        pytest.skip(verdict)
    assert verdict == FOUND
