"""The call that breaks a rule, or that comes to it: with as few values other than 0 as the solver finds."""

from collections.abc import Iterable, Sequence

import z3

from driveblocks.prove.operations import Term
from driveblocks.prove.sorts import SINGLE

Values = dict[str, z3.ExprRef]
"""Every free scalar by its name, and its value."""


def variables(terms: Iterable[Term]) -> dict[str, Term]:
    """The free scalars that terms depend on, by name."""
    found: dict[str, Term] = {}
    seen: set[int] = set()
    stack = list(terms)
    while stack:
        term = stack.pop()
        if term.get_id() not in seen:
            seen.add(term.get_id())
            if z3.is_const(term) and term.decl().kind() == z3.Z3_OP_UNINTERPRETED:
                found[term.decl().name()] = term
            stack += term.children()
    return found


def nothing(term: Term) -> Term:
    """FALSE or 0."""
    if z3.is_bool(term):
        return z3.BoolVal(False)
    return z3.FPVal(0.0, SINGLE) if z3.is_fp(term) else z3.BitVecVal(0, term.size())


def least(terms: Sequence[Term]) -> Values:
    """Values for which the terms hold, which they can: one after the other is made 0 where that is possible."""
    known = variables(terms)
    solver = z3.Solver()
    solver.add(*terms)
    if solver.check() != z3.sat:
        raise ValueError("the terms cannot hold")
    model = solver.model()
    _zeros(solver, [term == nothing(term) for term in known.values()])
    if solver.check() == z3.sat:
        model = solver.model()
    return {name: model.eval(term, model_completion=True) for name, term in known.items()}


def _zeros(solver: z3.Solver, wishes: list[Term]) -> None:
    """Add as many of the terms as can hold together, half of them at a time."""
    if not wishes:
        return
    solver.push()
    solver.add(*wishes)
    granted = solver.check() == z3.sat
    solver.pop()
    if granted:
        solver.add(*wishes)
    elif len(wishes) > 1:
        middle = len(wishes) // 2
        _zeros(solver, wishes[:middle])
        _zeros(solver, wishes[middle:])
