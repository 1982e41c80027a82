"""A fixed sample of the matrix, small enough for the suite, and the cells of it that fail today."""

from functools import cache
from pathlib import Path

import yaml
from tests.drives.station import FAMILIES
from tests.second import pairs
from tests.second.events import EVENTS
from tests.second.matrix import JOGS, MODES, STATES, Cell, Outcome

FAILING = Path(__file__).with_name("failing.yaml")
SIZE = 120
"""Cells of the sample."""


@cache
def _rows() -> dict[str, list[dict[str, str | list[str]]]]:
    found: dict[str, list[dict[str, str | list[str]]]] = yaml.safe_load(FAILING.read_text(encoding="utf-8"))
    return found


def sample() -> list[tuple[Cell, int]]:
    """Cells with their seeds: all pairs of family, mode, event and state; every second seed has a second event."""
    options = {"event": list(EVENTS), "state": STATES, "mode": MODES, "family": FAMILIES}
    rows = pairs.rows(options)
    step = max(1, len(rows) // SIZE)
    return [
        (Cell(row["family"] if row["mode"] != "jog" else JOGS[0], row["mode"], row["event"], row["state"]), index % 4)
        for index, row in enumerate(rows[::step][:SIZE])
    ]


def failing() -> dict[tuple[str, int], str]:
    """Cells of the sample that fail today, with the finding that each shows."""
    return {(str(row["cell"]), int(str(row["seed"]))): str(row["finding"]) for row in _rows()["sample"]}


def passing() -> list[tuple[Cell, int]]:
    """The others."""
    return [(cell, seed) for cell, seed in sample() if (str(cell), seed) not in failing()]


def finding(outcome: Outcome) -> str:
    """The finding that explains a failure, by its rule, its events, its mode and its state; empty: none does."""
    for row in _rows()["findings"]:
        facts = {
            "rule": outcome.rules[:1], "event": outcome.events, "mode": [outcome.cell.mode],
            "state": [outcome.cell.state], "family": [outcome.cell.family],
        }  # fmt: skip
        if all(set(_list(row[name])) & set(given) for name, given in facts.items() if name in row):
            return str(row["finding"])
    return ""


def _list(value: str | list[str]) -> list[str]:
    return [value] if isinstance(value, str) else value
