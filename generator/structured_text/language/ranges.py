"""What values an integer or bit string can take, as far as a glance at one POU shows.

Not a proof: a variable has the range of all that is ever assigned to it in its POU, whatever the order. Inputs,
in-outs, what is passed by reference and what nobody assigns to may be anything of their type.
"""

from dataclasses import dataclass, field
from functools import cache

from structured_text.language import tree
from structured_text.language.types import Elementary, Kind, Subrange, Type, plain

Interval = tuple[int, int]
_OWN = frozenset([tree.VarKind.LOCAL, tree.VarKind.OUTPUT, tree.VarKind.TEMP, tree.VarKind.RESULT])
_ROUNDS = 4


@cache
def whole(each: Type) -> Interval | None:
    """All values of a type; None for what is no integer or bit string."""
    if isinstance(each, Subrange):
        return each.first, each.last
    if isinstance(each, Elementary) and each.kind in (Kind.INTEGER, Kind.BITS, Kind.BOOL):
        return each.low, each.high
    return None


@dataclass(slots=True)
class Ranges:
    """The ranges of a POU's variables, by identity of their declaration."""

    known: dict[int, Interval] = field(default_factory=dict)

    def of(self, value: tree.Expression) -> Interval | None:
        """The range of an expression before it is cut to its type; None if it is no integer or bit string."""
        if isinstance(value, tree.Literal):
            return (int(value.value), int(value.value)) if isinstance(value.value, int) else None
        if isinstance(value, tree.Name) and isinstance(value.symbol, tree.VarDecl):
            return self.known.get(id(value.symbol)) or whole(value.type)
        if isinstance(value, tree.Unary) and value.op == "-":
            inner = self.of(value.operand)
            return inner and (-inner[1], -inner[0])
        return self.computed(value)

    def computed(self, value: tree.Expression) -> Interval | None:
        """The range of an operation or call; of anything else that of its type."""
        if isinstance(value, tree.Binary):
            return self.binary(value)
        if isinstance(value, tree.Call) and isinstance(value.target, tree.Builtin):
            return self.call(value, value.target)
        return whole(value.type)

    def cut(self, value: tree.Expression) -> Interval | None:
        """The range of an expression as its type can hold it."""
        found, limits = self.of(value), whole(plain(value.type))
        if found is None or limits is None:
            return limits
        return found if limits[0] <= found[0] and found[1] <= limits[1] else limits

    def binary(self, value: tree.Binary) -> Interval | None:
        """The range of an operation."""
        left, right = self.cut(value.left), self.cut(value.right)
        if left is None or right is None or whole(value.type) is None:
            return whole(value.type)
        if value.op in ("+", "-", "*"):
            return _corners(value.op, left, right)
        if value.op in ("/", "MOD") and right[0] > 0:
            return _corners("/", left, right) if value.op == "/" else _rest(left, right)
        if value.op in ("AND", "OR", "XOR") and left[0] >= 0 and right[0] >= 0:
            return 0, min(left[1], right[1]) if value.op == "AND" else (1 << max(left[1], right[1]).bit_length()) - 1
        return whole(value.type)

    def call(self, value: tree.Call, target: tree.Builtin) -> Interval | None:
        """The range of a standard function's result."""
        result = whole(plain(value.type))
        first = value.bindings[0].value if value.bindings else None
        inner = self.cut(first) if first is not None else None
        if result is None or inner is None:
            return result
        if target.family == "CONVERT" and result[0] <= inner[0] and inner[1] <= result[1]:
            return inner
        if target.family in ("SHR", "SHL"):
            return self.shift(value, target.family, inner)
        return result

    def shift(self, value: tree.Call, family: str, inner: Interval) -> Interval | None:
        """The range of a shift by a literal; of SHL before it is cut."""
        count = value.bindings[1].value if len(value.bindings) > 1 else None
        if not isinstance(count, tree.Literal) or not isinstance(count.value, int) or not 0 <= count.value < 64:
            return whole(plain(value.type)) if family == "SHR" else (0, inner[1] << 63)
        if family == "SHR":
            return inner[0] >> count.value, inner[1] >> count.value
        return inner[0] << count.value, inner[1] << count.value


def _rest(left: Interval, right: Interval) -> Interval:
    """The range of MOD by a positive number."""
    return (0 if left[0] >= 0 else 1 - right[1]), min(max(left[1], 0), right[1] - 1)


def _corners(op: str, left: Interval, right: Interval) -> Interval:
    """The extremes of a monotonic operation."""
    if op == "+":
        return left[0] + right[0], left[1] + right[1]
    if op == "-":
        return left[0] - right[1], left[1] - right[0]
    if op == "*":
        products = [a * b for a in left for b in right]
        return min(products), max(products)
    quotients = [abs(a) // b * (1 if a >= 0 else -1) for a in left for b in right]
    return min(*quotients, 0), max(*quotients, 0)


def ranges_of(pou: tree.Pou, body: list[tree.Statement], parts: list[tree.Expression]) -> Ranges:
    """The ranges of the variables that a POU owns and only assigns to, from all of its statements and expressions."""
    assigned, opened = _assignments(body), _passed(parts)
    made = Ranges()
    own = {}
    for variable in pou.symbols.values():
        if variable.constant or (variable.kind in _OWN and id(variable) not in opened):
            own[id(variable)] = variable
    written = {key for key, _ in assigned}
    for variable in own.values():
        start = _initial(variable)
        if start is not None and (variable.constant or id(variable) in written):
            made.known[id(variable)] = start
    for number in range(_ROUNDS):
        if not _round(made, own, assigned, last=number == _ROUNDS - 1):
            break
    return made


def _initial(variable: tree.VarDecl) -> Interval | None:
    """The range of the initial value."""
    if whole(variable.type) is None:
        return None
    initial = variable.start
    if initial is None:
        limits = whole(variable.type)
        return (0, 0) if limits and limits[0] <= 0 <= limits[1] else limits
    if isinstance(initial, tree.Literal) and isinstance(initial.value, int):
        return int(initial.value), int(initial.value)
    return whole(variable.type)


def _round(made: Ranges, own: dict[int, tree.VarDecl], assigned: list[tuple[int, tree.Expression]], last: bool) -> bool:
    """Widen every variable by what is assigned to it; whether something changed. What still grows is anything."""
    changed = False
    for key, value in assigned:
        if key not in own or key not in made.known:
            continue
        found, limits = made.cut(value), whole(own[key].type)
        if found is None or limits is None:
            found = limits or (0, 0)
        low, high = made.known[key]
        wider = min(low, found[0]), max(high, found[1])
        if wider != (low, high):
            made.known[key] = limits if last and limits else wider
            changed = True
    return changed


def _assignments(body: list[tree.Statement]) -> list[tuple[int, tree.Expression]]:
    """Every assignment to a whole variable; the limits of FOR count as such."""
    assigned: list[tuple[int, tree.Expression]] = []
    for statement in body:
        if isinstance(statement, tree.Assign) and isinstance(statement.target, tree.Name):
            assigned.append((id(statement.target.symbol), statement.value))
        elif isinstance(statement, tree.For) and isinstance(statement.variable, tree.Name):
            limits = (statement.start, statement.stop, statement.step)
            assigned.extend((id(statement.variable.symbol), each) for each in limits if each is not None)
    return assigned


def _passed(parts: list[tree.Expression]) -> set[int]:
    """The variables that a call receives by reference or writes its outputs to."""
    opened: set[int] = set()
    for each in parts:
        if not isinstance(each, tree.Call):
            continue
        for binding in each.bindings:
            if binding.parameter.direction is not tree.Direction.INPUT and isinstance(binding.value, tree.Name):
                opened.add(id(binding.value.symbol))
        if isinstance(each.eno, tree.Name):
            opened.add(id(each.eno.symbol))
    return opened
