"""What of a source has run: its lines, and the outcomes of its decisions.

A decision is a condition of IF, ELSIF, WHILE or UNTIL, a CASE, or a FOR. Its outcomes: TRUE and FALSE, with or without
an ELSE; each branch of a CASE and its ELSE, written or not; of a WHILE or FOR also that it ends without a turn.
"""

from typing import NamedTuple

from structured_text.language import tree


class Outcome(NamedTuple):
    """An outcome of the decision at a 1-based line and column, such as `ELSIF FALSE`, `CASE 3, 5..7`, `CASE ELSE`."""

    line: int
    column: int
    text: str


Lines = dict[str, dict[int, int]]
"""Path -> line with a statement -> how often it ran."""

Branches = dict[str, dict[Outcome, int]]
"""Path -> outcome of a decision -> how often it came about."""


def case_outcome(branch: tree.CaseBranch) -> str:
    """The text of a branch of CASE, by its labels."""
    return f"CASE {', '.join(_label(each) for each in branch.labels)}"


def _label(label: tree.Expression | tree.LabelRange) -> str:
    if isinstance(label, tree.LabelRange):
        return f"{_label(label.low)}..{_label(label.high)}"
    if isinstance(label, tree.Unary):
        return f"{label.op}{_label(label.operand)}"
    if isinstance(label, tree.Qualified):
        return f"{label.type_name}#{label.name}"
    if isinstance(label, tree.Member):
        return f"{_label(label.base)}.{label.name}"
    return label.text if isinstance(label, tree.Literal) else label.name if isinstance(label, tree.Name) else "?"
