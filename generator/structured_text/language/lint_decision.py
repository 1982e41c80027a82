"""A decision is taken once: nothing that was decided in a call, and used, is assigned again in the same call."""

from collections.abc import Iterable, Iterator
from enum import IntEnum

from structured_text.language import tree
from structured_text.language.lint_scope import Scope
from structured_text.language.walk import expressions, statements

RULE = "taken-back"


class Stage(IntEnum):
    """How far a variable has come in a call."""

    OLD = 0  # nothing yet, or brought up to date: it holds what was decided before
    USED = 1  # that was read
    DECIDED = 2  # it has its value of this call
    GIVEN = 3  # that was read


Stages = dict[str, Stage]


def pou(scope: Scope) -> None:
    """Of a block the variables that it declares itself, parts of structures each for itself."""
    if not isinstance(scope.pou, tree.FunctionBlock):
        return
    own = {
        variable.name.upper()
        for block in scope.pou.blocks
        if block.kind in (tree.VarKind.LOCAL, tree.VarKind.OUTPUT)
        for variable in block.variables
    }
    own -= _counters(scope.pou.body)
    kept = _kept(scope.pou.body, own)
    _Walk(scope, own, kept).walk(scope.pou.body, {})


class _Walk:
    """One way through a body. `kept` are the variables whose value of the last call is read somewhere."""

    def __init__(self, scope: Scope, own: set[str], kept: set[str]) -> None:
        self.scope, self.own, self.kept = scope, own, kept
        self.looping = 0
        self.parts = _parts(scope.expressions)

    def walk(self, body: list[tree.Statement], stages: Stages) -> Stages:
        """Bring the stages to where they are after the statements."""
        for statement in body:
            self._statement(statement, stages)
        return stages

    def _statement(self, statement: tree.Statement, stages: Stages) -> None:
        if isinstance(statement, tree.Assign):
            self._assign(statement, stages)
        elif isinstance(statement, tree.CallStatement):
            self._read(_paths([statement.call]), stages)
        elif isinstance(statement, tree.If):
            self._read(_paths(branch.condition for branch in statement.branches), stages)
            self._join([branch.body for branch in statement.branches], statement.otherwise, stages)
        elif isinstance(statement, tree.Case):
            self._read(_paths([statement.selector]), stages)
            self._join([branch.body for branch in statement.branches], statement.otherwise, stages)
        elif isinstance(statement, tree.While | tree.RepeatUntil | tree.For):
            self._loop(statement, stages)

    def _loop(self, statement: tree.While | tree.RepeatUntil | tree.For, stages: Stages) -> None:
        """Each round decides anew."""
        heads = [statement.start, statement.stop] if isinstance(statement, tree.For) else [statement.condition]
        self.looping += 1
        inside = self.walk(statement.body, dict.fromkeys(stages, Stage.OLD))
        self.looping -= 1
        _latest(stages, inside)
        self._read(_paths(heads), stages)

    def _join(self, bodies: list[list[tree.Statement]], otherwise: list[tree.Statement] | None, stages: Stages) -> None:
        ends = [self.walk(body, dict(stages)) for body in [*bodies, otherwise or []]]
        stages.clear()
        for end in ends:
            _latest(stages, end)

    def _assign(self, statement: tree.Assign, stages: Stages) -> None:
        target = path(statement.target)
        read = list(_paths([statement.value]))
        self._read(read, stages, but=target)
        if target is None or target.split(".")[0] not in self.own:
            return
        itself = target in read
        stage = stages.get(target, Stage.OLD)
        if stage is Stage.GIVEN and not (itself and self.looping):
            text = f"{_written(statement.target)} was decided and used already in this call: decide it once"
            self.scope.add(statement.target.at, RULE, text)
        old = target in self.kept and (stage is Stage.OLD or (stage is Stage.USED and itself))
        stages[target] = Stage.OLD if old else Stage.DECIDED

    def _read(self, names: Iterable[str], stages: Stages, but: str | None = None) -> None:
        for name in names:
            for each in (name, *(part for part in self.parts.get(name, ()) if part in stages)):
                if each != but:
                    stages[each] = Stage.GIVEN if stages.get(each, Stage.OLD) >= Stage.DECIDED else Stage.USED


def _latest(stages: Stages, others: Stages) -> None:
    """Of each variable the later stage of two."""
    for name, stage in others.items():
        if stage >= stages.get(name, Stage.OLD):
            stages[name] = stage


def _parts(named: Iterable[tree.Expression]) -> dict[str, set[str]]:
    """By the name of a structure the parts of it that expressions name."""
    parts: dict[str, set[str]] = {}
    for whole in {found for each in named if isinstance(each, tree.Member) and (found := path(each))}:
        at = whole.find(".")
        while at >= 0:
            parts.setdefault(whole[:at], set()).add(whole)
            at = whole.find(".", at + 1)
    return parts


def _counters(body: list[tree.Statement]) -> set[str]:
    """What loops end by and move on, and what is nowhere given another value than a literal or its own, moved on."""
    counters: set[str] = set()
    others: set[str | None] = set()
    for statement in statements(body):
        if isinstance(statement, tree.While | tree.RepeatUntil):
            counters |= set(_paths([statement.condition])) & _moved(statement.body)
        elif isinstance(statement, tree.Assign) and not (
            isinstance(statement.value, tree.Literal) or _moved([statement])
        ):
            others.add(path(statement.target))
    return counters - others


def _moved(body: list[tree.Statement]) -> set[str | None]:
    """What the statements assign from itself."""
    assigns = [each for each in statements(body) if isinstance(each, tree.Assign)]
    return {path(each.target) for each in assigns if path(each.target) in set(_paths([each.value]))}


def _written(value: tree.Expression) -> str:
    if isinstance(value, tree.Member):
        return f"{_written(value.base)}.{value.name}"
    return value.name if isinstance(value, tree.Name) else "it"


def path(value: tree.Expression) -> str | None:
    """`A.B` in upper case; None for an element of an array and what is no variable."""
    if isinstance(value, tree.Member):
        base = path(value.base)
        return None if base is None else f"{base}.{value.name.upper()}"
    return value.name.upper() if isinstance(value, tree.Name) and isinstance(value.symbol, tree.VarDecl) else None


def _paths(values: Iterable[tree.Expression]) -> Iterator[str]:
    """The variables that expressions read, each as long as it is written."""
    for value in values:
        longer: set[int] = set()  # the bases of members and what is called, which come after them
        for each in expressions(value):
            if isinstance(each, tree.Call):
                longer.add(id(each.callee))
            elif isinstance(each, tree.Name | tree.Member):
                if isinstance(each, tree.Member):
                    longer.add(id(each.base))
                found = None if id(each) in longer or isinstance(each, tree.Qualified) else path(each)
                if found is not None:
                    yield found


def _kept(body: list[tree.Statement], own: set[str]) -> set[str]:
    """The variables that may be read before this call has assigned them."""
    kept: set[str] = set()
    _definite(body, set(), own, kept)
    return kept


def _definite(body: list[tree.Statement], known: set[str], own: set[str], kept: set[str]) -> set[str]:
    """What is surely assigned after the statements; what was read unassigned is added to `kept`."""
    for statement in body:
        if isinstance(statement, tree.Assign):
            _miss([statement.value], known, kept)
            target = path(statement.target)
            if target is not None:
                known = known | {target}
        elif isinstance(statement, tree.CallStatement):
            _miss([statement.call], known, kept)
        elif isinstance(statement, tree.If | tree.Case):
            heads = (
                [branch.condition for branch in statement.branches]
                if isinstance(statement, tree.If)
                else [statement.selector]
            )
            _miss(heads, known, kept)
            ends = [_definite(branch.body, set(known), own, kept) for branch in statement.branches]
            ends.append(_definite(statement.otherwise or [], set(known), own, kept))
            known = set.intersection(*ends)
        elif isinstance(statement, tree.While | tree.RepeatUntil | tree.For):
            _miss([statement.stop if isinstance(statement, tree.For) else statement.condition], known, kept)
            _definite(statement.body, set(known), own, kept)
    return known


def _miss(values: Iterable[tree.Expression], known: set[str], kept: set[str]) -> None:
    for name in _paths(values):
        if name not in known and name.split(".")[0] not in known:
            kept.add(name)
