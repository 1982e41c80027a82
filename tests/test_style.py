"""The words that no page uses: docs/style.md says what is written instead."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
WORST = {
    r"\bbehind (the|a|an|its|their|it|each|this|that)\b": "after, or a place",
    r"\bin vain\b": "unanswered",
    r"\bby chance\b": "random",
    r"\b(is|are|was|were) told\b": "is reported",
    r"\bwish(es)?\b": "request",
    r"\bpoll goes\b|\bstop leaves\b|\bframe leaves\b|\bstops leave\b|\breads leave\b": "is sent",
    r"\bmotor stands\b|\bdrive stands\b": "is at standstill",
    r"\bthat many\b": "the number",
    r"\bby halves\b": "only complete",
}
PAGES = sorted(
    path
    for path in (*ROOT.glob("*.md"), ROOT / "vendor_maps/README.md", *ROOT.glob("docs/**/*.md"))
    if path.name not in ("style.md", "CHANGELOG.md")
)


def worst(text: str) -> list[str]:
    """What a text should not say, with its line and what to say."""
    found = [
        (text.count("\n", 0, match.start()) + 1, match[0], instead)
        for pattern, instead in WORST.items()
        for match in re.finditer(pattern, text, re.IGNORECASE)
    ]
    return [f"{line}: {words!r}: {instead}" for line, words, instead in sorted(found)]


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_a_page_has_none_of_the_worst_words(page: Path) -> None:
    assert worst(page.read_text(encoding="utf-8")) == []


def test_each_of_them_is_found() -> None:
    text = (
        "A poll goes\nbehind the stop by chance; it is told, in vain, as a wish, that many, by halves: a motor stands."
    )
    assert [each.partition(":")[0] for each in worst(text)] == ["1"] + ["2"] * 8
