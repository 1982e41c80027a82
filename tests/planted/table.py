"""The table of planted mistakes, and what becomes of one in a copy of the checkout."""

from dataclasses import dataclass
from pathlib import Path

import yaml
from tests.planted.checkout import Checkout

from structured_text.engines.discovery import MATIEC_NAMES, survey

PYTEST = "python -m pytest -x -n0 -p no:cacheprovider -o addopts= --import-mode=importlib"
CANONICAL = "--to iec61131 --only"
"""What is built: no judge of a block reads another form of it."""
FOUND, MISSED = "found", "NOT found"


@dataclass(frozen=True)
class Place:
    """A mistake: the rule that it breaks, what is in a file, what instead, and the judge that must turn red."""

    kind: str
    id: str
    rule: str
    file: str
    old: str
    new: str
    judge: str
    matiec: bool = False

    @property
    def command(self) -> str:
        """How its judge is called."""
        return f"{PYTEST if self.judge.startswith('tests/') else 'python -m'} {self.judge}"

    @property
    def builds(self) -> bool:
        """Whether its judge reads `blocks/`, which the mistake alters."""
        renders = ("driveblocks ", "tests.planted.programs ")
        return not self.file.endswith(".py") and not self.judge.startswith(renders)


def places() -> list[Place]:
    """All of them, in the order of the table."""
    kinds = yaml.safe_load(Path(__file__).with_name("places.yaml").read_text(encoding="utf-8"))
    return [Place(kind, **row) for kind, rows in kinds.items() for row in rows]


def judged(copy: Checkout, one: Place) -> str:
    """What becomes of a mistake: found, NOT found, or why it cannot be judged."""
    if one.matiec and (missing := without_matiec()):
        return f"skipped: needs matiec: {missing}"
    before = copy.read(one.file)
    copy.write(one.file, before.replace(one.old, one.new))
    try:
        if one.builds and not copy.build(CANONICAL):
            return f"{MISSED}: blocks/ cannot be built"
        status = copy.run(one.command)
    finally:
        copy.write(one.file, before)
        if one.builds:
            copy.restore()
    return verdict_of(status)


def without_matiec() -> str:
    """Why neither line of matiec runs, as the engines say it; "" if one does, by PATH or by MATIEC_HOME."""
    found = [each for each in survey().candidates() if each.name in MATIEC_NAMES]
    return "" if any(each.engine for each in found) else "; ".join(sorted({each.note for each in found}))


def verdict_of(status: int | None) -> str:
    """What the exit status of a judge means, None if it did not end; a judge that could not run has found nothing."""
    return FOUND if status in (1, None) else MISSED if status == 0 else f"{MISSED}: the judge ends with {status}"
