"""A decision is taken once: nothing that was decided in a call, and used, is assigned again in the same call."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from enum import IntEnum

from structured_text.language.lint_scope import Scope
from structured_text.language.tree import (
    Assign,
    Call,
    CallStatement,
    Case,
    Expression,
    For,
    FunctionBlock,
    If,
    Literal,
    Member,
    Name,
    Qualified,
    RepeatUntil,
    Statement,
    VarDecl,
    VarKind,
    While,
)
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
    if not isinstance(scope.pou, FunctionBlock):
        return
    own = {
        variable.name.upper()
        for block in scope.pou.blocks
        if block.kind in (VarKind.LOCAL, VarKind.OUTPUT)
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

    def walk(self, body: list[Statement], stages: Stages) -> Stages:
        """The stages after the statements."""
        for statement in body:
            stages = self._statement(statement, stages)
        return stages

    def _statement(self, statement: Statement, stages: Stages) -> Stages:
        if isinstance(statement, Assign):
            return self._assign(statement, stages)
        if isinstance(statement, CallStatement):
            return self._read([statement.call], stages)
        if isinstance(statement, If):
            stages = self._read([branch.condition for branch in statement.branches], stages)
            return self._join([branch.body for branch in statement.branches], statement.otherwise, stages)
        if isinstance(statement, Case):
            stages = self._read([statement.selector], stages)
            return self._join([branch.body for branch in statement.branches], statement.otherwise, stages)
        if isinstance(statement, While | RepeatUntil | For):
            return self._loop(statement, stages)
        return stages

    def _loop(self, statement: While | RepeatUntil | For, stages: Stages) -> Stages:
        """Each round decides anew."""
        heads = [statement.start, statement.stop] if isinstance(statement, For) else [statement.condition]
        self.looping += 1
        inside = self.walk(statement.body, dict.fromkeys(stages, Stage.OLD))
        self.looping -= 1
        return self._read(
            heads, {**stages, **{name: max(stage, stages.get(name, stage)) for name, stage in inside.items()}}
        )

    def _join(self, bodies: list[list[Statement]], otherwise: list[Statement] | None, stages: Stages) -> Stages:
        ends = [self.walk(body, dict(stages)) for body in [*bodies, otherwise or []]]
        return {name: max(end.get(name, Stage.OLD) for end in ends) for end in ends for name in end}

    def _assign(self, statement: Assign, stages: Stages) -> Stages:
        target = path(statement.target)
        itself = target in set(_paths([statement.value]))
        stages = self._read([statement.value], stages, but=target)
        if target is None or target.split(".")[0] not in self.own:
            return stages
        stage = stages.get(target, Stage.OLD)
        if stage is Stage.GIVEN and not (itself and self.looping):
            text = f"{_written(statement.target)} was decided and used already in this call: decide it once"
            self.scope.add(statement.target.at, RULE, text)
        old = target in self.kept and (stage is Stage.OLD or (stage is Stage.USED and itself))
        return {**stages, target: Stage.OLD if old else Stage.DECIDED}

    def _read(self, values: Iterable[Expression], stages: Stages, but: str | None = None) -> Stages:
        made = dict(stages)
        for name in _paths(values):
            for each in [name, *(known for known in stages if known.startswith(name + "."))]:
                if each != but:
                    made[each] = Stage.GIVEN if made.get(each, Stage.OLD) >= Stage.DECIDED else Stage.USED
        return made


def _counters(body: list[Statement]) -> set[str]:
    """What loops end by and move on, and what is nowhere given another value than a literal or its own, moved on."""
    counters: set[str] = set()
    others: set[str | None] = set()
    for statement in statements(body):
        if isinstance(statement, While | RepeatUntil):
            counters |= set(_paths([statement.condition])) & _moved(statement.body)
        elif isinstance(statement, Assign) and not (isinstance(statement.value, Literal) or _moved([statement])):
            others.add(path(statement.target))
    return counters - others


def _moved(body: list[Statement]) -> set[str | None]:
    """What the statements assign from itself."""
    assigns = [each for each in statements(body) if isinstance(each, Assign)]
    return {path(each.target) for each in assigns if path(each.target) in set(_paths([each.value]))}


def _written(value: Expression) -> str:
    if isinstance(value, Member):
        return f"{_written(value.base)}.{value.name}"
    return value.name if isinstance(value, Name) else "it"


def path(value: Expression) -> str | None:
    """`A.B` in upper case; None for an element of an array and what is no variable."""
    if isinstance(value, Member):
        base = path(value.base)
        return None if base is None else f"{base}.{value.name.upper()}"
    return value.name.upper() if isinstance(value, Name) and isinstance(value.symbol, VarDecl) else None


def _paths(values: Iterable[Expression]) -> Iterator[str]:
    """The variables that expressions read, each as long as it is written."""
    for value in values:
        inner = {id(each.base) for each in expressions(value) if isinstance(each, Member)}
        callees = {id(each.callee) for each in expressions(value) if isinstance(each, Call)}
        for each in expressions(value):
            if isinstance(each, Name | Member) and not isinstance(each, Qualified) and id(each) not in inner | callees:
                found = path(each)
                if found is not None:
                    yield found


def _kept(body: list[Statement], own: set[str]) -> set[str]:
    """The variables that may be read before this call has assigned them."""
    kept: set[str] = set()
    _definite(body, set(), own, kept)
    return kept


def _definite(body: list[Statement], known: set[str], own: set[str], kept: set[str]) -> set[str]:
    """What is surely assigned after the statements; what was read unassigned is added to `kept`."""
    for statement in body:
        if isinstance(statement, Assign):
            _miss([statement.value], known, kept)
            target = path(statement.target)
            if target is not None:
                known = known | {target}
        elif isinstance(statement, CallStatement):
            _miss([statement.call], known, kept)
        elif isinstance(statement, If | Case):
            heads = (
                [branch.condition for branch in statement.branches]
                if isinstance(statement, If)
                else [statement.selector]
            )
            _miss(heads, known, kept)
            ends = [_definite(branch.body, set(known), own, kept) for branch in statement.branches]
            ends.append(_definite(statement.otherwise or [], set(known), own, kept))
            known = set.intersection(*ends)
        elif isinstance(statement, While | RepeatUntil | For):
            _miss([statement.stop if isinstance(statement, For) else statement.condition], known, kept)
            _definite(statement.body, set(known), own, kept)
    return known


def _miss(values: Iterable[Expression], known: set[str], kept: set[str]) -> None:
    for name in _paths(values):
        if name not in known and name.split(".")[0] not in known:
            kept.add(name)
