"""Record of the figures: `docs/measured/performance.json`, from which the page is written.

One part for each measurement; a part that cannot be measured, for want of a tool, keeps what was measured before.
"""

import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from pathlib import Path

DOCS = Path(__file__).parents[2] / "docs" / "measured"
PATH = DOCS / "performance.json"
Rows = dict[str, dict[str, float]]
"""Row -> column -> figure."""


@dataclass(frozen=True)
class Part:
    """Figures of one measurement, and the machine that they belong to: processor, compiler, versions."""

    machine: Mapping[str, str]
    rows: Rows


Record = dict[str, Part]
"""Name of the measurement -> its figures."""


def read(path: Path = PATH) -> Record:
    """The record as it stands; empty if there is none."""
    if not path.is_file():
        return {}
    return {name: Part(**part) for name, part in json.loads(path.read_text("utf-8")).items()}


def write(record: Record, path: Path = PATH) -> None:
    """Write it in the order of its parts."""
    text = json.dumps({name: asdict(part) for name, part in record.items()}, indent=1, ensure_ascii=False)
    path.write_text(f"{text}\n", encoding="utf-8", newline="\n")


def rounded(rows: Rows) -> Rows:
    """Four digits of each figure, whole numbers as they are: more would be noise."""
    return {row: {column: _four(figure) for column, figure in columns.items()} for row, columns in rows.items()}


def _four(figure: float) -> float:
    return figure if isinstance(figure, int) else float(f"{figure:.4g}")
