"""The bodies of functions and function blocks as terms: from what every scalar was, what it is after a call.

A branch that is not taken leaves the scalars as they were; a nested block is run in place, its memory under the name of
its instance; a loop is unrolled, so its bounds have to be constants. What has to hold for all compilers to agree is
collected as obligations: results within their width, indexes within their bounds, divisors that are not 0.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import product

import z3

from driveblocks.prove import operations
from driveblocks.prove.operations import Term, both, choice, inverse
from driveblocks.prove.sorts import UnsupportedError, initial, leaves, number
from structured_text.language.tree import (
    Array,
    Assign,
    Binary,
    Block,
    Builtin,
    Call,
    CallStatement,
    Case,
    Direction,
    Empty,
    Expression,
    Function,
    If,
    Index,
    LabelRange,
    Literal,
    Member,
    Name,
    Pou,
    Statement,
    Unary,
    VarDecl,
    VarKind,
    While,
)
from structured_text.language.types import REAL, Elementary, Type, plain

Store = dict[str, Term]
"""What every scalar is, by its path."""
Run = Callable[[], None]
"""What a branch does."""
GLANCE = 100_000
"""Steps of the solver to see whether a loop is over."""
TURNS = 40
"""Turns of a loop that are unrolled at most."""


@dataclass(frozen=True)
class Obligation:
    """What has to hold where all compilers are to agree: file and line, what, and the term."""

    path: str
    line: int
    words: str
    term: Term


@dataclass(frozen=True)
class Frame:
    """A body that runs: its declaration, the path of its instance with a dot, and where its in-outs are."""

    pou: Pou
    prefix: str
    in_outs: dict[str, str]

    def path(self, symbol: VarDecl) -> str:
        name = symbol.name.upper()
        return self.in_outs[name] if symbol.kind is VarKind.IN_OUT else self.prefix + name


class Terms:
    """Runs bodies on a store of terms."""

    def __init__(self, store: Store, *, exact: bool = False, loose: Sequence[str] = ()) -> None:
        """Begin with what every scalar is; `exact`: REALs are computed with, too; `loose`: instances left free."""
        self.exact = exact
        self.loose = {name.upper() for name in loose}
        self.store = store
        self.guard: Term = z3.BoolVal(True)
        self.obligations: list[Obligation] = []
        self.frame: Frame
        self.at = 0
        self._functions = 0

    def block(self, pou: Pou, prefix: str, in_outs: dict[str, str]) -> None:
        """Run the body of a block whose memory lies at a prefix. UnsupportedError."""
        before = getattr(self, "frame", None), self.at
        self.frame = Frame(pou, prefix, in_outs)
        if len(set(in_outs.values())) < len(in_outs):
            raise UnsupportedError(f"{pou.name} with one variable in two in-outs")
        try:
            self.statements(pou.body)
        except UnsupportedError as error:
            if "line" in str(error) or pou.unit is None:
                raise
            raise UnsupportedError(f"{pou.unit.path} line {pou.unit.line(self.at)}: {error}") from error
        if before[0] is not None:
            self.frame, self.at = before[0], before[1]

    # ------------------------------------------------------------ statements

    def statements(self, body: Sequence[Statement]) -> None:
        for each in body:
            self.statement(each)

    def statement(self, each: Statement) -> None:
        self.at = each.at
        if isinstance(each, Assign) and each.op == ":=":
            self._assign(each)
        elif isinstance(each, If):
            self._branches([(branch.condition, branch.body) for branch in each.branches], each.otherwise or [])
        elif isinstance(each, CallStatement) and isinstance(each.call.target, Block):
            self._call(each.call, each.call.target)
        elif isinstance(each, Case):
            self._case(each)
        elif isinstance(each, While):
            self._while(each, 0)
        elif not isinstance(each, Empty):
            raise UnsupportedError(f"the statement {type(each).__name__}")

    def _assign(self, each: Assign) -> None:
        kind = plain(each.target.type)
        if isinstance(kind, Elementary):
            self._put(each.target, self.value(each.value))
        else:
            self._copy(self._place(each.target), self._places(each.value), kind)

    def _put(self, target: Expression, value: Term) -> None:
        for condition, path in self._places(target):
            self.store[path] = choice(condition, value, self.store[path])

    def _copy(self, to: str, sources: list[tuple[Term, str]], kind: Type) -> None:
        for leaf in leaves(kind):
            self.store[to + leaf.path] = self._chosen([(condition, path + leaf.path) for condition, path in sources])

    def _branches(self, branches: list[tuple[Expression, list[Statement]]], otherwise: list[Statement]) -> None:
        if not branches:
            self.statements(otherwise)
            return
        (condition, body), *others = branches
        self._fork(self.value(condition), lambda: self.statements(body), lambda: self._branches(others, otherwise))

    def _fork(self, condition: Term, then: Run, otherwise: Run) -> None:
        """Run both ways, and join their results."""
        if z3.is_true(condition):
            then()
        elif z3.is_false(condition):
            otherwise()
        else:
            before, guard, at = self.store, self.guard, self.at
            made = []
            for holds, run in ((condition, then), (inverse(condition), otherwise)):
                self.store, self.guard, self.at = dict(before), both(guard, holds), at
                run()
                made.append(self.store)
            self.guard = guard
            self.store = self._joined(condition, made[0], made[1])

    @staticmethod
    def _joined(condition: Term, first: Store, second: Store) -> Store:
        joined = second | {path: value for path, value in first.items() if path not in second}
        for path, value in first.items():
            other = second.get(path)
            if other is not None and other is not value:
                joined[path] = choice(condition, value, other)
        return joined

    def _case(self, each: Case) -> None:
        selector = self.value(each.selector)
        kind = _elementary(each.selector.type)

        def run(index: int) -> None:
            if index == len(each.branches):
                self.statements(each.otherwise or [])
                return
            branch = each.branches[index]
            holds = [inverse(self._label(label, selector, kind)) for label in branch.labels]
            self._fork(inverse(both(*holds)), lambda: self.statements(branch.body), lambda: run(index + 1))

        run(0)

    def _label(self, label: Expression | LabelRange, selector: Term, kind: Elementary) -> Term:
        if isinstance(label, LabelRange):
            low, high = self.value(label.low), self.value(label.high)
            return both(operations.compare(">=", selector, low, kind), operations.compare("<=", selector, high, kind))
        return operations.compare("=", selector, self.value(label), kind)

    def _while(self, each: While, turns: int) -> None:
        """Unroll a loop until its condition cannot hold any more, whatever the variables are."""
        condition = z3.simplify(self.value(each.condition))
        if z3.is_false(condition) or (not z3.is_true(condition) and self._never(condition)):
            return
        if turns >= TURNS:
            raise UnsupportedError("a loop without a constant bound")

        def run() -> None:
            self.statements(each.body)
            self._while(each, turns + 1)

        self._fork(condition, run, lambda: None)

    def _never(self, condition: Term) -> bool:
        """Whether a condition cannot hold here, as the solver sees at a glance."""
        solver = z3.SolverFor("QF_BVFP")
        solver.set("rlimit", GLANCE)
        return bool(solver.check(self.guard, condition) == z3.unsat)

    # ------------------------------------------------------------ calls

    def _call(self, call: Call, target: Block) -> None:
        """Call a block: hand inputs and in-outs over, run its body, take what is wanted of its outputs."""
        if target.declaration is None:
            raise UnsupportedError(f"the standard block {target.name}")
        place = self._place(call.callee)
        in_outs: dict[str, str] = {}
        for binding in call.bindings:
            if binding.value is None:
                continue
            name, direction = binding.parameter.name.upper(), binding.parameter.direction
            if direction is Direction.INPUT:
                self._hand(f"{place}.{name}", binding.value, binding.parameter.type)
            elif direction is Direction.IN_OUT:
                in_outs[name] = self._place(binding.value)
        at = self.at
        if place in self.loose:
            for path in [path for path in self.store if path.startswith(f"{place}.")]:
                self.store[path] = operations.free(self.store[path].sort())
        else:
            self.block(target.declaration, f"{place}.", in_outs)
        self.at = at
        for binding in call.bindings:
            if binding.value is not None and binding.parameter.direction is Direction.OUTPUT:
                result = self.store[f"{place}.{binding.parameter.name.upper()}"]
                self._put(binding.value, inverse(result) if binding.negated else result)

    def _hand(self, path: str, value: Expression, kind: Type) -> None:
        if isinstance(plain(kind), Elementary):
            self.store[path] = self.value(value)
        else:
            self._copy(path, self._places(value), kind)

    def _function(self, call: Call, target: Function) -> Term:
        """Call a function: its variables begin anew each time."""
        self._functions += 1
        prefix = f"@{self._functions}."
        in_outs: dict[str, str] = {}
        for symbol in target.symbols.values():
            if not symbol.constant and symbol.kind is not VarKind.IN_OUT:
                for leaf in leaves(symbol.type, symbol.start):
                    self.store[prefix + symbol.name.upper() + leaf.path] = initial(leaf)
        for binding in call.bindings:
            name = binding.parameter.name.upper()
            if binding.value is not None and binding.parameter.direction is Direction.IN_OUT:
                in_outs[name] = self._place(binding.value)
            elif binding.value is not None:
                self._hand(prefix + name, binding.value, binding.parameter.type)
        self.block(target, prefix, in_outs)
        result = self.store[prefix + target.name.upper()]
        for path in [each for each in self.store if each.startswith(prefix)]:
            del self.store[path]
        return result

    # ------------------------------------------------------------ expressions

    def value(self, each: Expression) -> Term:
        """The term of an expression of a scalar type."""
        if isinstance(each, Literal) and isinstance(each.value, bool | int | float):
            return number(each.value, each.type)
        if isinstance(each, Name) and isinstance(each.symbol, VarDecl) and each.symbol.constant:
            return self._constant(each.symbol)
        if isinstance(each, Name | Member | Index):
            return self._read(each)
        if isinstance(each, Unary):
            return self._unary(each)
        if isinstance(each, Binary):
            return self._binary(each)
        if isinstance(each, Call):
            return self._called(each)
        raise UnsupportedError(f"the expression {type(each).__name__}")

    def _constant(self, symbol: VarDecl) -> Term:
        if symbol.start is None:
            return number(0, symbol.type)
        return self.value(symbol.start)

    def _read(self, each: Expression) -> Term:
        return self._chosen(self._places(each))

    def _chosen(self, places: list[tuple[Term, str]]) -> Term:
        *others, (_, last) = places
        found = self.store[last]
        for condition, path in others:
            found = choice(condition, self.store[path], found)
        return found

    def _unary(self, each: Unary) -> Term:
        inner = self.value(each.operand)
        if each.op == "NOT":
            return inverse(inner) if z3.is_bool(inner) else operations.folded(~inner)
        if each.op == "-":
            return operations.negated(inner, _elementary(each.type), self._demand)
        return inner

    def _binary(self, each: Binary) -> Term:
        left, right = self.value(each.left), self.value(each.right)
        kind = _elementary(each.operand_type if each.op in _COMPARISONS else each.type)
        if each.op in _COMPARISONS:
            return operations.compare(each.op, left, right, kind)
        if kind is REAL and self.exact:
            return operations.arithmetic(each.op, left, right)
        return operations.binary(each.op, left, right, kind, self._demand)

    def _called(self, each: Call) -> Term:
        if isinstance(each.target, Function):
            return self._function(each, each.target)
        if not isinstance(each.target, Builtin):
            raise UnsupportedError("a call in an expression")
        terms = [self.value(binding.value) for binding in each.bindings if binding.value is not None]
        kinds = [_elementary(binding.parameter.type) for binding in each.bindings]
        if self.exact and each.target.family == "CONVERT" and REAL in (kinds[0], each.target.result):
            result = _elementary(each.target.result)
            return (
                operations.real(terms[0], kinds[0])
                if result is REAL
                else operations.whole(terms[0], result, self._demand)
            )
        return operations.function(each.target.family, terms, kinds, each.target.result, self._demand)

    def _demand(self, words: str, term: Term) -> None:
        """Note what has to hold here."""
        term = z3.simplify(term) if not z3.is_true(term) else term
        if not z3.is_true(term):
            unit = self.frame.pou.unit
            where = (unit.path, unit.line(self.at)) if unit else ("", 0)
            self.obligations.append(Obligation(*where, words, z3.Implies(self.guard, term)))

    # ------------------------------------------------------------ places

    def _place(self, each: Expression) -> str:
        """The one place that an expression names."""
        places = self._places(each)
        if len(places) != 1:
            raise UnsupportedError("a whole element by a variable index")
        return places[0][1]

    def _places(self, each: Expression) -> list[tuple[Term, str]]:
        """The places that an expression can name, each with its condition; the last holds where no other does."""
        if isinstance(each, Name) and isinstance(each.symbol, VarDecl):
            return [(z3.BoolVal(True), self.frame.path(each.symbol))]
        if isinstance(each, Member):
            return [(condition, f"{path}.{each.name.upper()}") for condition, path in self._places(each.base)]
        if isinstance(each, Index):
            return [
                (both(first, second), f"{path}[{index}]")
                for (first, path), (second, index) in product(self._places(each.base), self._indexes(each))
            ]
        raise UnsupportedError(f"a place that is a {type(each).__name__}")

    def _indexes(self, each: Index) -> list[tuple[Term, int]]:
        """The elements that an index can name."""
        kind = plain(each.base.type)
        if not isinstance(kind, Array) or len(kind.bounds) != 1:
            raise UnsupportedError("an array of several dimensions")
        low, high = kind.bounds[0]
        of = _elementary(each.indices[0].type)
        index = z3.simplify(self.value(each.indices[0]))
        if z3.is_bv_value(index):
            found = index.as_signed_long() if of.signed else index.as_long()
            if low <= found <= high:
                return [(z3.BoolVal(True), found)]
        first, last = (
            operations.compare(op, index, number(bound, of), of) for op, bound in ((">=", low), ("<=", high))
        )
        self._demand(f"the index is within {low}..{high}", both(first, last))
        top = min(high, of.high)
        return [(index == number(each_one, of), each_one) for each_one in range(low, top + 1)]


_COMPARISONS = frozenset(["=", "<>", "<", ">", "<=", ">="])


def _elementary(each: Type) -> Elementary:
    each = plain(each)
    if not isinstance(each, Elementary):
        raise UnsupportedError(f"a value of type {each}")
    return each
