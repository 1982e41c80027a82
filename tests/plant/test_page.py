"""The page on plants: its tables are those of the model."""

from pathlib import Path

from driveblocks.plant import draft, page

PAGE = Path(__file__).parents[2] / "docs/plant.md"


def test_the_page_says_every_key() -> None:
    text = PAGE.read_text("utf-8")
    assert page.update(text) == text, "python -m tests.plant.write_page makes it anew"
    assert draft.example() in text
