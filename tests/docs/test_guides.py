"""What the guides say of the blocks: paths from file to file, and what a slot shows online."""

import re
from pathlib import Path

import pytest

from driveblocks.render.constants import NUMBERS

ROOT = Path(__file__).parents[2]
STEPS = re.findall(r"^\| `([^`]+)` \| `([^`]+)` \|", (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8"), re.M)
LINE = (ROOT / "docs" / "line.md").read_text(encoding="utf-8")


@pytest.mark.parametrize(("path", "word"), [(path, word) for path, word in STEPS if "/" in path])
def test_a_path_from_file_to_file_finds_its_words(path: str, word: str) -> None:
    found = ROOT / path
    text = "".join(each.read_text(encoding="utf-8") for each in ([found] if found.is_file() else found.glob("*.py")))
    assert word in text, f"{path} has no {word}"


def test_the_page_of_the_line_has_every_cause_of_being_passed_over_and_every_rank() -> None:
    table = LINE.partition("| `Barred` |")[2].partition("\n\n")[0]
    shown = {int(number): says for number, says in re.findall(r"^\| (\d+) \| ([^|]+) \|", table, re.M)}
    assert shown == {number: says for name, (number, says) in NUMBERS.items() if name.startswith("BARRED_")}
    order = LINE.partition("## What is sent first")[2].partition("\n## ")[0]
    named = {int(number) for number in re.findall(r"\((\d+)\)", order)}
    assert named == {number for name, (number, _) in NUMBERS.items() if name.startswith("RANK_")} - {13}
