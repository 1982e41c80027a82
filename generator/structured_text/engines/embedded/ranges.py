"""What the compiler knows about the values of local variables while it walks through a body.

An interval per variable, narrowed by conditions and assignments, joined where ways meet. It is what makes most masks
and checks unnecessary, for `i` in `WHILE i < n` cannot overflow its type by `i := i + 1`.
"""

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field

from structured_text.engines.embedded.certainty import known
from structured_text.engines.embedded.terms import is_integral
from structured_text.language import tree
from structured_text.language.types import Elementary, Subrange

Interval = tuple[int, int]

_MIRROR = {"<": ">", ">": "<", "<=": ">=", ">=": "<=", "=": "=", "<>": "<>"}
_OPPOSITE = {"<": ">=", ">": "<=", "<=": ">", ">=": "<", "=": "<>", "<>": "="}


def declared(variable: tree.VarDecl) -> Interval:
    """The values that a variable can hold; every store into a subrange is checked."""
    kind = known(variable.type, Elementary)
    if isinstance(kind, Subrange):
        return kind.first, kind.last
    return kind.low, kind.high


@dataclass(slots=True)
class Ranges:
    """Intervals by variable; a variable that is missing can hold all of its type. `dead`: nothing gets here."""

    known: dict[tree.VarDecl, Interval] = field(default_factory=dict)
    dead: bool = False

    def copy(self) -> "Ranges":
        """An independent copy."""
        return Ranges(dict(self.known), self.dead)

    def of(self, variable: tree.VarDecl) -> Interval:
        return self.known.get(variable) or declared(variable)

    def set(self, variable: tree.VarDecl, low: int, high: int) -> None:
        """Note an assignment. A global can change behind our back and is never tracked."""
        if variable.kind is not tree.VarKind.EXTERNAL:
            self.known[variable] = low, high

    def forget(self, variables: Iterable[tree.VarDecl]) -> None:
        """Note that somebody else may have written these."""
        for each in variables:
            self.known.pop(each, None)

    def become(self, other: "Ranges") -> None:
        """Take over another state."""
        self.known, self.dead = dict(other.known), other.dead

    def join(self, other: "Ranges") -> None:
        """Meet another way through the body."""
        if other.dead:
            return
        if self.dead:
            self.become(other)
            return
        for each in list(self.known):
            if each not in other.known:
                del self.known[each]
                continue
            (low, high), (low2, high2) = self.known[each], other.known[each]
            self.known[each] = min(low, low2), max(high, high2)

    def widen(self, after: "Ranges", variables: Iterable[tree.VarDecl]) -> bool:
        """Give up the bounds that a turn of a loop has moved. Return whether there were any."""
        moved = False
        for each in variables:
            if after.dead or not is_integral(each.type):
                continue
            (low, high), (low2, high2) = self.of(each), after.of(each)
            if low2 < low or high2 > high:
                lowest, highest = declared(each)
                self.known[each] = lowest if low2 < low else low, highest if high2 > high else high
                moved = True
        return moved

    # ------------------------------------------------------------ conditions

    def assume(self, condition: tree.Expression, truth: bool, interval: Callable[[tree.Expression], Interval]) -> None:
        """Narrow by a condition that is known to hold, or not to."""
        if isinstance(condition, tree.Unary) and condition.op == "NOT":
            self.assume(condition.operand, not truth, interval)
        elif isinstance(condition, tree.Binary) and condition.op == ("AND" if truth else "OR"):
            self.assume(condition.left, truth, interval)
            self.assume(condition.right, truth, interval)
        elif isinstance(condition, tree.Binary) and condition.op in _MIRROR and is_integral(condition.left.type):
            operator = condition.op if truth else _OPPOSITE[condition.op]
            left, right = interval(condition.left), interval(condition.right)
            self.narrow(condition.left, operator, right)
            self.narrow(condition.right, _MIRROR[operator], left)

    def narrow(self, side: tree.Expression, operator: str, other: Interval) -> None:
        """Note that a comparison with something in `other` holds; only variables of the POU itself are tracked."""
        if not isinstance(side, tree.Name) or not isinstance(side.symbol, tree.VarDecl) or side.symbol.constant:
            return
        low, high = self.of(side.symbol)
        if operator in ("<", "<="):
            high = min(high, other[1] - (operator == "<"))
        elif operator in (">", ">="):
            low = max(low, other[0] + (operator == ">"))
        elif operator == "=":
            low, high = max(low, other[0]), min(high, other[1])
        if low <= high:
            self.set(side.symbol, low, high)
