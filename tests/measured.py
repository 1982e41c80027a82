"""Measured tables on pages, each between two marks, written by the command that measures them."""

import re
from pathlib import Path

MARKED = re.compile(r"(?s)(<!-- measured -->\n).*?(<!-- end -->)")


def put(page: Path, lines: list[str]) -> None:
    """Put the lines between the marks of a page. Raises ValueError where it has none, or several."""
    text, count = MARKED.subn(
        lambda found: "\n".join([f"{found[1]}{lines[0]}", *lines[1:], found[2]]), page.read_text("utf-8")
    )
    if count != 1:
        raise ValueError(f"{page} has {count} places for what was measured")
    page.write_text(text, encoding="utf-8")


def rows(page: Path) -> dict[str, str]:
    """The lines between the marks of a page, by their first cells."""
    found = MARKED.search(page.read_text("utf-8"))
    lines = found[0].splitlines() if found else []
    return {line.strip("| ").partition(" | ")[0]: line for line in lines if line.startswith("|")}
