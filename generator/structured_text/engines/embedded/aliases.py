"""Whether two in-outs of one call can be the same variable, or one a part of the other.

matiec copies in-outs in and out, others pass references: only without aliases do both mean the same.
"""

from dataclasses import dataclass
from itertools import combinations

from structured_text.engines.embedded.usage import root
from structured_text.language import tree


@dataclass(slots=True)
class Overlap:
    """Two in-outs that overlap if every pair of indices is equal; without pairs they always do."""

    left: tree.Expression
    right: tree.Expression
    indices: list[tuple[tree.Expression, tree.Expression]]


def overlaps(targets: list[tree.Expression]) -> list[Overlap]:
    """Every pair of in-outs that overlaps or may overlap."""
    found = (_overlap(left, right) for left, right in combinations(targets, 2))
    return [each for each in found if each is not None]


def _overlap(left: tree.Expression, right: tree.Expression) -> Overlap | None:
    if root(left) is None or root(left) is not root(right):
        return None
    pairs: list[tuple[tree.Expression, tree.Expression]] = []
    for mine, other in zip(_steps(left), _steps(right), strict=False):
        if isinstance(mine, tree.Member) and isinstance(other, tree.Member):
            if mine.name.upper() != other.name.upper():
                return None
        elif isinstance(mine, tree.Index) and isinstance(other, tree.Index):
            for one, two in zip(mine.indices, other.indices, strict=True):
                if isinstance(one, tree.Literal) and isinstance(two, tree.Literal):
                    if one.value != two.value:
                        return None
                else:
                    pairs.append((one, two))
    return Overlap(left, right, pairs)


def _steps(expression: tree.Expression) -> list[tree.Expression]:
    """The fields and indices from the variable inwards."""
    steps: list[tree.Expression] = []
    while isinstance(expression, tree.Member | tree.Index):
        steps.append(expression)
        expression = expression.base
    return steps[::-1]
