"""Operators and standard functions of ST on terms, and what has to hold for all compilers to agree on the result.

Products and quotients of REALs, and what is converted to or from them, are left free unless they are asked for: any
value may come, which proves less, never more. So are sums, but one sum of the same terms has one value, in a rule as in
a block. Comparisons of REALs are exact, those with what is no number included.
"""

from collections.abc import Callable
from functools import reduce
from typing import TypeAlias

import z3

from driveblocks.prove.sorts import SINGLE, UnsupportedError, sort
from structured_text.language.types import Elementary, Kind, Type, plain

Term: TypeAlias = z3.ExprRef
Demand = Callable[[str, Term], None]
"""Takes what has to hold wherever the operation is reached."""
FREE = "free"
"""What the name of a value begins with that may be any."""


sums: dict[tuple[str, int, int], tuple[Term, Term, Term]] = {}
"""Names of sums of REALs by operator and terms, and these terms, which so keep their numbers."""


def free(of: z3.SortRef) -> Term:
    return z3.FreshConst(of, FREE)


def both(*terms: Term) -> Term:
    """AND, without what is known."""
    left = [each for each in terms if not z3.is_true(each)]
    if any(z3.is_false(each) for each in left):
        return z3.BoolVal(False)
    return z3.BoolVal(True) if not left else left[0] if len(left) == 1 else z3.And(left)


def inverse(term: Term) -> Term:
    """NOT, without what is known."""
    if z3.is_true(term) or z3.is_false(term):
        return z3.BoolVal(z3.is_false(term))
    return term.arg(0) if z3.is_not(term) else z3.Not(term)


def choice(condition: Term, then: Term, otherwise: Term) -> Term:
    if z3.is_true(condition) or then.eq(otherwise):
        return then
    return otherwise if z3.is_false(condition) else z3.If(condition, then, otherwise)


def folded(term: Term) -> Term:
    """A term of constants as a constant."""
    plain_parts = all(z3.is_bv_value(each) or z3.is_true(each) or z3.is_false(each) for each in term.children())
    return z3.simplify(term) if plain_parts else term


def compare(op: str, left: Term, right: Term, kind: Elementary) -> Term:
    if op in ("=", "<>"):
        same = z3.fpEQ(left, right) if left.sort() == SINGLE else folded(left == right)
        return same if op == "=" else inverse(same)
    if left.sort() == SINGLE:
        return {"<": z3.fpLT, ">": z3.fpGT, "<=": z3.fpLEQ, ">=": z3.fpGEQ}[op](left, right)
    if z3.is_bool(left):
        raise UnsupportedError(f"{op} of BOOLs")
    if kind.signed:
        return folded({"<": left < right, ">": left > right, "<=": left <= right, ">=": left >= right}[op])
    return folded({"<": z3.ULT, ">": z3.UGT, "<=": z3.ULE, ">=": z3.UGE}[op](left, right))


def arithmetic(op: str, left: Term, right: Term) -> Term:
    """+ - * / of two REALs, rounded as the standard says after every operation."""
    nearest = z3.RNE()
    made = {"+": z3.fpAdd, "-": z3.fpSub, "*": z3.fpMul, "/": z3.fpDiv}
    return made[op](nearest, left, right)


def whole(term: Term, kind: Elementary, demand: Demand) -> Term:
    """A REAL as an integer, cut or rounded to the nearest as the compiler likes."""
    low, high = z3.FPVal(float(kind.low), SINGLE), z3.FPVal(float(kind.high + 1), SINGLE)
    demand(f"the REAL fits into {kind.name}", z3.And(z3.fpGEQ(term, low), z3.fpLT(term, high)))
    to = z3.fpToSBV if kind.signed else z3.fpToUBV
    of = z3.BitVecSort(kind.width)
    return choice(free(z3.BoolSort()), to(z3.RTZ(), term, of), to(z3.RNE(), term, of))


def real(term: Term, kind: Elementary) -> Term:
    """An integer or bit string as a REAL."""
    return z3.fpSignedToFP(z3.RNE(), term, SINGLE) if kind.signed else z3.fpUnsignedToFP(z3.RNE(), term, SINGLE)


def binary(op: str, left: Term, right: Term, kind: Elementary, demand: Demand) -> Term:
    """AND, OR, XOR and arithmetic of two values of a type."""
    if z3.is_bool(left):
        if op == "AND":
            return both(left, right)
        return inverse(both(inverse(left), inverse(right))) if op == "OR" else folded(z3.Xor(left, right))
    if op in ("AND", "OR", "XOR"):
        return folded({"AND": left & right, "OR": left | right, "XOR": left ^ right}[op])
    if left.sort() == SINGLE:
        named = (free(SINGLE), left, right)
        return sums.setdefault((op, left.get_id(), right.get_id()), named)[0] if op in ("+", "-") else named[0]
    if op in ("/", "MOD"):
        return folded(_divided(op, left, right, kind, demand))
    demand(f"the result of {op} is a {kind.name}", _kept(op, left, right, kind))
    return folded(_plain(op, left, right))


def _plain(op: str, left: Term, right: Term) -> Term:
    if op not in ("+", "-", "*"):
        raise UnsupportedError(f"the operator {op}")
    return left + right if op == "+" else left - right if op == "-" else left * right


def _kept(op: str, left: Term, right: Term, kind: Elementary) -> Term:
    """Whether a sum, difference or product stays within its type."""
    if not kind.signed and op == "+":
        return folded(z3.UGE(folded(left + right), left))
    if not kind.signed and op == "-":
        return folded(z3.UGE(left, right))
    if not kind.signed and z3.is_bv_value(right) and right.as_long():
        return folded(z3.ULE(left, kind.high // right.as_long()))
    more = kind.width if op == "*" else 1
    extend = z3.SignExt if kind.signed else z3.ZeroExt
    exact = folded(_plain(op, folded(extend(more, left)), folded(extend(more, right))))
    return folded(exact == folded(extend(more, folded(_plain(op, left, right)))))


def _divided(op: str, left: Term, right: Term, kind: Elementary, demand: Demand) -> Term:
    """Division cuts towards zero; the remainder has the sign of the dividend."""
    demand("the divisor is not 0", folded(right != 0))
    if kind.signed:
        demand(f"the quotient is a {kind.name}", z3.Or(right != -1, left != z3.BitVecVal(kind.low, kind.width)))
        return left / right if op == "/" else z3.SRem(left, right)
    if op == "MOD" and z3.is_bv_value(right) and right.as_long() > kind.high // 2:
        return choice(folded(z3.ULT(left, right)), left, folded(left - right))
    if op == "/":
        return z3.UDiv(left, right)
    rest = z3.URem(left, right)  # that it is below the divisor the solver need not find out
    return choice(folded(z3.ULT(rest, right)), rest, z3.BitVecVal(0, kind.width))


def negated(term: Term, kind: Elementary, demand: Demand) -> Term:
    if term.sort() == SINGLE:
        return z3.fpNeg(term)
    demand(f"the result of - is a {kind.name}", term != z3.BitVecVal(kind.low, kind.width))
    return folded(-term)


def convert(term: Term, source: Type, result: Type) -> Term:
    """`X_TO_Y` between BOOL, bit strings and integers; what is or becomes a REAL is free."""
    source, result = plain(source), plain(result)
    of = sort(result)
    if term.sort() == of:
        return term
    if SINGLE in (term.sort(), of):
        return free(of)
    if z3.is_bool(term):
        return choice(term, z3.BitVecVal(1, of.size()), z3.BitVecVal(0, of.size()))
    if of == z3.BoolSort():
        return folded(term != 0)
    wide = of.size() - term.size()
    if wide <= 0:
        return folded(z3.Extract(of.size() - 1, 0, term))
    signed = isinstance(source, Elementary) and source.signed and source.kind is Kind.INTEGER
    return folded(z3.SignExt(wide, term) if signed else z3.ZeroExt(wide, term))


def function(family: str, terms: list[Term], kinds: list[Elementary], result: Type, demand: Demand) -> Term:
    if family in ("MAX", "MIN", "LIMIT"):
        return _extreme(family, terms, kinds[-1])
    if family in ("SHL", "SHR"):
        return _shifted(family, terms[0], terms[1])
    if family in ("AND", "OR", "XOR"):
        return reduce(lambda left, right: binary(family, left, right, kinds[0], demand), terms)
    if family in ("SEL", "NOT", "MOVE"):
        return _chosen(family, terms)
    if family == "CONVERT":
        return convert(terms[0], kinds[0], result)
    if family == "ABS" and terms[0].sort() == SINGLE:
        return z3.fpAbs(terms[0])
    raise UnsupportedError(f"the function {family}")


def _extreme(family: str, terms: list[Term], kind: Elementary) -> Term:
    if family == "LIMIT":
        return _extreme("MIN", [_extreme("MAX", terms[:2], kind), terms[2]], kind)
    op = ">=" if family == "MAX" else "<="
    return reduce(lambda left, right: choice(compare(op, left, right, kind), left, right), terms)


def _chosen(family: str, terms: list[Term]) -> Term:
    if family == "SEL":
        return choice(terms[0], terms[2], terms[1])
    if family == "MOVE":
        return terms[0]
    return inverse(terms[0]) if z3.is_bool(terms[0]) else folded(~terms[0])


def _shifted(family: str, term: Term, places: Term) -> Term:
    """SHL and SHR; by the width or more gives 0."""
    if places.size() > term.size():
        if not z3.is_bv_value(places):
            raise UnsupportedError(f"{family} by so wide a number")
        places = z3.BitVecVal(min(places.as_long(), term.size()), term.size())
    elif places.size() < term.size():
        places = folded(z3.ZeroExt(term.size() - places.size(), places))
    return folded(term << places if family == "SHL" else z3.LShR(term, places))
