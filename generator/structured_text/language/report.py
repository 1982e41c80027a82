"""Collects what is wrong in several files, each thing once."""

from collections.abc import Iterable
from difflib import get_close_matches

from structured_text.language.problems import Problem
from structured_text.language.tree import Unit


class Report:
    """Problems by place; the same rule at the same place is reported once."""

    __slots__ = ("found", "unit")

    def __init__(self) -> None:
        self.found: dict[tuple[int, int, str], tuple[Unit, str]] = {}
        self.unit: Unit | None = None

    def add(self, at: int, rule: str, text: str) -> None:
        if self.unit is not None:
            self.found.setdefault((id(self.unit), at, rule), (self.unit, text))

    def problems(self) -> list[Problem]:
        """Everything noted, in order of file name, line and column."""
        made = [Problem(unit.path, *unit.place(at), text, rule) for (_, at, rule), (unit, text) in self.found.items()]
        return sorted(made)


def nearest(name: str, known: Iterable[str]) -> str:
    """` (did you mean X?)`, or nothing, for the end of a message."""
    spelled = {each.upper(): each for each in known}
    close = get_close_matches(name.upper(), spelled, 1, 0.75)
    return f" (did you mean {spelled[close[0]]}?)" if close else ""
