"""The ways that CONTRIBUTING.md walks through the code: every file is there, and each way has one direction."""

import re

import pytest
from tests.rooms import MODULES, graph

REPOSITORY = next(iter(MODULES.values())).parents[2]
PAGE = (REPOSITORY / "CONTRIBUTING.md").read_text("utf-8")
STEP = re.compile(r"^\| `([^`]+)` \| `([^`]+)` \| .+ \|$", re.MULTILINE)
WAYS = {title: STEP.findall(part) for title, part in re.findall(r"^## (From [^\n]+)\n(.*?)(?=^## )", PAGE, re.M | re.S)}
"""The rows of each way: file, and what to look for in it."""
TYPE = re.compile(r": (\w+);")


def used(file: str) -> set[str]:
    """Files of a way that a file imports, itself or by others; of a block, the blocks that it holds."""
    if file.endswith(".st"):
        text = re.sub(r"\(\*.*?\*\)", "", (REPOSITORY / file).read_text("utf-8"), flags=re.DOTALL)
        return set(TYPE.findall(text))
    waiting, found = [name(file)], set[str]()
    while waiting:
        for each in graph().get(waiting.pop(), ()):
            if each not in found:
                found.add(each)
                waiting.append(each)
    return found


def name(file: str) -> str:
    """The module or block of a file."""
    stem = file.rpartition(".")[0]
    return stem.removeprefix("generator/").replace("/", ".") if file.endswith(".py") else stem.rpartition("/")[2]


def test_there_are_three_ways() -> None:
    assert [title.split()[2] for title in WAYS] == ["bit", "frame", "mistake"]


@pytest.mark.parametrize("way", WAYS)
def test_every_file_of_a_way_is_there_and_holds_what_to_look_for(way: str) -> None:
    assert len(WAYS[way]) > 5
    assert [file for file, words in WAYS[way] if words not in (REPOSITORY / file).read_text("utf-8")] == []


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.thorough
def test_a_way_has_one_direction(way: str) -> None:
    """Of all its files that use one another, either all later ones use earlier ones, or all earlier ones later ones."""
    files = [file for file, _ in WAYS[way]]
    back = {(a, b) for i, a in enumerate(files) for b in files[:i] if name(b) in used(a)}
    ahead = {(a, b) for i, a in enumerate(files) for b in files[i + 1 :] if name(b) in used(a)}
    assert not (back and ahead), (back, ahead)
    assert back or ahead
