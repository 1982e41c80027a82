"""The productions: operators, standard functions and conversions, with the types that they make."""

from __future__ import annotations

from tests.structured_text.engines.compare.expressions.grammar import (
    BITS,
    ELEMENTS,
    NUMBERS,
    REALS,
    SIGNED,
    TYPES,
    UNSIGNED,
    WHOLE,
    Grammar,
    Make,
    Production,
    elements,
    function,
    limits,
)
from tests.structured_text.engines.compare.expressions.terms import ATOM, UNARY, Term, atom, call, unary

INTEGRAL_SOURCES = {"conversion", "time-conversion"}
MAGNITUDES = (*BITS, *NUMBERS)  # what can be ordered and is no BOOL, TIME or STRING


def _leaf(g: Grammar, kind: str, depth: int) -> Term:
    return g.leaf(kind)


def _element(g: Grammar, kind: str, depth: int) -> Term:
    index = g.draws.one_of(list(UNSIGNED))
    last = atom(index, "literal", str(ELEMENTS))
    inner = g.typed(index, depth)
    # In C the difference of two UINTs can be negative, and so can what MOD leaves of it; a function's result cannot.
    whole = inner if inner.level == ATOM else call(index, "move", "MOVE", inner)
    position = g.join(index, "modulo", whole, "MOD", last)
    return Term(kind, "element", (f"{elements(kind)}[", position, "]"))


def _own_function(g: Grammar, kind: str, depth: int) -> Term:
    arguments = g.expression(kind, 0), g.expression(kind, depth)
    return call(kind, "own-function", function(kind), *arguments, formals=g.formals("First", "Second"))


# ------------------------------------------------------------ operators


def _arithmetic(g: Grammar, kind: str, depth: int) -> Term:
    left, right = g.pair(kind, depth)
    return g.join(kind, "arithmetic", left, g.draws.one_of("+-*"), right)


def _division(g: Grammar, kind: str, depth: int) -> Term:
    if kind in REALS:
        # matiec refuses a literal zero after the stroke; a variable may well be zero.
        return g.join(kind, "division", g.expression(kind, depth), "/", g.anchored(kind, depth))
    return g.join(kind, "division", g.anchored(kind, depth), "/", g.divisor(kind, depth))


def _modulo(g: Grammar, kind: str, depth: int) -> Term:
    right = g.anchored(kind, depth) if kind in UNSIGNED else g.divisor(kind, depth)
    return g.join(kind, "modulo", g.anchored(kind, depth), "MOD", right)


def _power(g: Grammar, kind: str, depth: int) -> Term:
    exponent = g.anchored(g.draws.one_of([kind, "SINT", "USINT"]), 0)
    if g.draws.chance(0.5):
        return call(kind, "power", "EXPT", g.anchored(kind, depth), exponent)
    return g.join(kind, "power", g.anchored(kind, depth), "**", exponent)


def _minus(g: Grammar, kind: str, depth: int) -> Term:
    return unary(kind, "minus", "-", g.anchored(kind, depth))


def _logic(g: Grammar, kind: str, depth: int) -> Term:
    left, right = g.pair(kind, depth)
    operators = ["AND", "OR", "XOR", "&"]
    return g.join(kind, "logic", left, g.draws.one_of(operators), right)


def _not(g: Grammar, kind: str, depth: int) -> Term:
    return unary(kind, "not", "NOT", g.anchored(kind, depth))


def _comparison_of(rule: str, kinds: tuple[str, ...], operators: tuple[str, ...]) -> Make:
    def make(g: Grammar, kind: str, depth: int) -> Term:
        left, right = g.pair(g.draws.one_of(kinds), depth)
        return g.join(kind, rule, left, g.draws.one_of(operators), right)

    return make


# ------------------------------------------------------------ functions


def _arithmetic_function(g: Grammar, kind: str, depth: int) -> Term:
    name = g.draws.one_of(["ADD", "MUL", "SUB"])
    if name == "SUB":
        return call(kind, "arithmetic-function", name, *g.pair(kind, depth))
    return call(kind, "arithmetic-function", name, *g.several(kind, depth))


def _division_function(g: Grammar, kind: str, depth: int) -> Term:
    name = g.draws.one_of(["DIV", "MOD"])
    return call(kind, "division-function", name, g.typed(kind, depth), g.divisor(kind, depth))


def _logic_function(g: Grammar, kind: str, depth: int) -> Term:
    return call(kind, "logic-function", g.draws.one_of(["AND", "OR"]), *g.several(kind, depth))


def _xor_function(g: Grammar, kind: str, depth: int) -> Term:
    rule = "xor-function" if kind in BITS else "xor-function-of-bool"
    return call(kind, rule, "XOR", *g.several(kind, depth))


def _not_function(g: Grammar, kind: str, depth: int) -> Term:
    # To a parser this is the operator with parentheses after it, so it must not follow a NOT either.
    return Term(kind, "not-function", ("NOT(", g.anchored(kind, depth), ")"), UNARY)


def _comparison_function_of(rule: str, kinds: tuple[str, ...]) -> Make:
    def make(g: Grammar, kind: str, depth: int) -> Term:
        operand = g.draws.one_of(kinds)
        name = g.draws.one_of(["EQ", "NE", "GT", "GE", "LT", "LE"])
        arguments = g.pair(operand, depth) if name == "NE" else g.several(operand, depth)
        return call(kind, rule, name, *arguments)

    return make


def _extreme(g: Grammar, kind: str, depth: int) -> Term:
    return call(kind, "extreme", g.draws.one_of(["MAX", "MIN"]), *g.several(kind, depth))


def _limit(g: Grammar, kind: str, depth: int) -> Term:
    low, high = g.expression(kind, depth), g.expression(kind, depth)
    formals = g.formals("MN", "IN", "MX")
    return call(kind, "limit", "LIMIT", low, g.typed(kind, depth), high, formals=formals)


def _select(g: Grammar, kind: str, depth: int) -> Term:
    formals = g.formals("G", "IN0", "IN1")
    return call(kind, "select", "SEL", g.anchored("BOOL", depth), *g.pair(kind, depth), formals=formals)


def _multiplex(g: Grammar, kind: str, depth: int) -> Term:
    selector = g.typed(g.draws.one_of(list(WHOLE)), depth - 1)
    return call(kind, "multiplex", "MUX", selector, *g.several(kind, depth))


def _move(g: Grammar, kind: str, depth: int) -> Term:
    return call(kind, "move", "MOVE", g.anchored(kind, depth))


def _absolute(g: Grammar, kind: str, depth: int) -> Term:
    return call(kind, "absolute", "ABS", g.anchored(kind, depth))


def _absolute_of_real(g: Grammar, kind: str, depth: int) -> Term:
    return call(kind, "absolute-of-real", "ABS", g.anchored(kind, depth))


def _mathematics(g: Grammar, kind: str, depth: int) -> Term:
    names = ["SQRT", "LN", "LOG", "EXP", "SIN", "COS", "TAN", "ASIN", "ACOS", "ATAN"]
    return call(kind, "mathematics", g.draws.one_of(names), g.anchored(kind, depth))


def _shift(g: Grammar, kind: str, depth: int) -> Term:
    if g.draws.chance(0.6):
        places = atom("SINT", "literal", str(g.draws.whole(0, 31)))
    else:
        places = g.anchored(g.draws.one_of(list(WHOLE)), 0)
    name = g.draws.one_of(["SHL", "SHR"])
    return call(kind, "shift", name, g.anchored(kind, depth), places, formals=g.formals("IN", "N"))


def _rotation(g: Grammar, kind: str, depth: int) -> Term:
    if g.draws.chance(0.6):
        places = atom("SINT", "literal", str(g.draws.whole(0, 31)))
    else:
        places = g.anchored(g.draws.one_of(list(UNSIGNED)), 0)
    name = g.draws.one_of(["ROL", "ROR"])
    return call(kind, "rotation", name, g.anchored(kind, depth), places, formals=g.formals("IN", "N"))


# ------------------------------------------------------------ conversions


def _conversion_from(rule: str, sources: tuple[str, ...]) -> Make:
    def make(g: Grammar, kind: str, depth: int) -> Term:
        source = g.draws.one_of([each for each in sources if each != kind])
        return call(kind, rule, f"{source}_TO_{kind}", g.anchored(source, depth), formals=g.formals("IN"))

    return make


def _from_real(g: Grammar, kind: str, depth: int) -> Term:
    source = g.draws.one_of([each for each in REALS if each != kind])
    operand = g.anchored(source, depth) if kind in REALS else _convertible(g, source, kind, depth)
    return call(kind, "real-conversion", f"{source}_TO_{kind}", operand, formals=g.formals("IN"))


def _truncation(g: Grammar, kind: str, depth: int) -> Term:
    return call(kind, "truncation", "TRUNC", _convertible(g, g.draws.one_of(REALS), kind, depth))


def _convertible(g: Grammar, source: str, target: str, depth: int) -> Term:
    """A REAL that may be anything, NaN included; limited to the target if a compiler could see its value.

    C does not define the conversion of what does not fit. Of a value unknown to it the processor's conversion comes
    out, but `TRUNC(DWORD_TO_LREAL(x))` is folded into a copy of the bits, and `TRUNC(-3.7)` as an UINT into 0.
    """
    term = g.anchored(source, depth)
    if not any(_foldable(part) for part in term.walk()):
        return term
    # A little inside the range of a wide type, whose bounds no six digits can name.
    inside = [bound * (0.999999 if abs(bound) > 1 << 20 else 1.0) for bound in limits(target)]
    first, last = (atom(source, "literal", f"{max(-9.0e18, min(bound, 9.0e18)):.6E}") for bound in inside)
    return call(source, "limit", "LIMIT", first, term, last)


def _foldable(part: Term) -> bool:
    return part.rule in INTEGRAL_SOURCES or (part.rule == "literal" and part.type in REALS)


def _from_bcd(g: Grammar, kind: str, depth: int) -> Term:
    source = g.draws.one_of(list(BITS))
    return call(kind, "bcd", f"{source}_BCD_TO_{kind}", g.anchored(source, depth))


def _to_bcd(g: Grammar, kind: str, depth: int) -> Term:
    source = g.draws.one_of(list(UNSIGNED))
    term = g.anchored(source, depth)
    if source == "ULINT":  # a digit beyond the sixteenth is shifted by 64 places or more, which C does not define
        ends = [atom(source, "literal", text) for text in ("0", "9999999999999999")]
        term = call(source, "limit", "LIMIT", ends[0], term, ends[1])
    return call(kind, "bcd", f"{source}_TO_BCD_{kind}", term)


# ------------------------------------------------------------ TIME and STRING


def _inexact_time(g: Grammar, kind: str, depth: int) -> Term:
    return atom(kind, "inexact-time-literal", g.draws.one_of(["T#1ms", "T#8ms", "T#63ms", "T#1s1ms", "T#0.3s"]))


def _time_sum(g: Grammar, kind: str, depth: int) -> Term:
    left, right = g.pair(kind, depth)
    if g.draws.chance(0.3):
        return call(kind, "time-sum", g.draws.one_of(["ADD_TIME", "SUB_TIME"]), left, right)
    return g.join(kind, "time-sum", left, g.draws.one_of("+-"), right)


def _time_product(g: Grammar, kind: str, depth: int) -> Term:
    factor = g.typed(g.draws.one_of(NUMBERS), depth)
    return g.join(kind, "time-product", g.anchored(kind, depth), g.draws.one_of("*/"), factor)


def _positions(g: Grammar, *least: int) -> list[Term]:
    """Numbers of characters or positions of one type; less than `least` makes matiec read beside the string."""
    kind = g.draws.one_of(["INT", "UINT", "USINT", "DINT"])
    if g.draws.chance(0.5):
        return [atom("INT", "literal", str(g.draws.whole(low, 12))) for low in least]
    high = atom(kind, "literal", "12")
    bounds = [(atom(kind, "literal", str(low)), g.variable(kind), high) for low in least]
    return [call(kind, "limit", "LIMIT", *each) for each in bounds]


def _string_from_real(g: Grammar, kind: str, depth: int) -> Term:
    """The text of a finite number: C says nothing about the sign of a NaN."""
    source = g.draws.one_of(REALS)
    bounds = [atom(source, "literal", text) for text in ("-1.0E30", "1.0E30")]
    finite = call(source, "limit", "LIMIT", bounds[0], g.anchored(source, depth), bounds[1])
    return call(kind, "string-from-real", f"{source}_TO_STRING", finite)


def _string_part(g: Grammar, kind: str, depth: int) -> Term:
    if g.draws.chance(0.5):
        name = g.draws.one_of(["LEFT", "RIGHT"])
        return call(kind, "string-part", name, g.anchored(kind, depth), *_positions(g, 0))
    return call(kind, "string-part", "MID", g.anchored(kind, depth), *_positions(g, 0, 1))


def _string_join(g: Grammar, kind: str, depth: int) -> Term:
    return call(kind, "string-join", "CONCAT", *g.several(kind, depth))


def _string_edit(g: Grammar, kind: str, depth: int) -> Term:
    name = g.draws.one_of(["INSERT", "DELETE", "REPLACE"])
    if name == "DELETE":
        return call(kind, "string-edit", name, g.anchored(kind, depth), *_positions(g, 0, 1))
    counts = _positions(g, 0) if name == "INSERT" else _positions(g, 0, 1)
    return call(kind, "string-edit", name, *g.pair(kind, depth), *counts)


def _string_extreme(g: Grammar, kind: str, depth: int) -> Term:
    name = g.draws.one_of(["MAX", "MIN", "LIMIT"])
    if name == "LIMIT":
        return call(kind, "string-extreme", name, *(g.anchored(kind, depth) for _ in range(3)))
    return call(kind, "string-extreme", name, *g.several(kind, depth))


def _string_length(g: Grammar, kind: str, depth: int) -> Term:
    return call(kind, "string-length", "LEN", g.anchored("STRING", depth))


def _string_find(g: Grammar, kind: str, depth: int) -> Term:
    return call(kind, "string-find", "FIND", *g.pair("STRING", depth))


_EQUALITY = ("=", "<>")
_ORDER = ("<", ">", "<=", ">=", "=", "<>")
_BOOL = ("BOOL",)
_INTO_WHOLE = (*BITS, *WHOLE)

# Rule name, the types that it makes, how. A rule that is there twice comes up twice as often.
_ROWS: list[tuple[str, tuple[str, ...], Make]] = [
    ("leaf", TYPES, _leaf),
    ("element", TYPES, _element),
    ("own-function", TYPES, _own_function),
    ("arithmetic", NUMBERS, _arithmetic),
    ("arithmetic", NUMBERS, _arithmetic),
    ("division", NUMBERS, _division),
    ("modulo", tuple(WHOLE), _modulo),
    ("power", REALS, _power),
    ("minus", (*SIGNED, *REALS), _minus),
    ("logic", ("BOOL", *BITS), _logic),
    ("logic", ("BOOL", *BITS), _logic),
    ("not", ("BOOL", *BITS), _not),
    ("comparison", _BOOL, _comparison_of("comparison", MAGNITUDES, _ORDER)),
    ("comparison", _BOOL, _comparison_of("comparison", MAGNITUDES, _ORDER)),
    ("comparison", _BOOL, _comparison_of("comparison", _BOOL, _ORDER)),
    ("time-comparison", _BOOL, _comparison_of("time-comparison", ("TIME",), _ORDER)),
    ("string-comparison", _BOOL, _comparison_of("string-comparison", ("STRING",), _ORDER)),
    ("arithmetic-function", NUMBERS, _arithmetic_function),
    ("division-function", tuple(WHOLE), _division_function),
    ("logic-function", ("BOOL", *BITS), _logic_function),
    ("xor-function", tuple(BITS), _xor_function),
    ("xor-function-of-bool", _BOOL, _xor_function),
    ("not-function", ("BOOL", *BITS), _not_function),
    ("comparison-function", _BOOL, _comparison_function_of("comparison-function", MAGNITUDES)),
    ("time-comparison", _BOOL, _comparison_function_of("time-comparison", ("TIME",))),
    ("string-comparison", _BOOL, _comparison_function_of("string-comparison", ("STRING",))),
    ("extreme", (*MAGNITUDES, "TIME"), _extreme),
    ("limit", (*MAGNITUDES, "TIME"), _limit),
    ("select", TYPES, _select),
    ("multiplex", TYPES, _multiplex),
    ("move", TYPES, _move),
    ("absolute", tuple(WHOLE), _absolute),
    ("absolute-of-real", REALS, _absolute_of_real),
    ("mathematics", REALS, _mathematics),
    ("shift", tuple(BITS), _shift),
    ("rotation", tuple(BITS), _rotation),
    ("conversion", (*_INTO_WHOLE, *REALS), _conversion_from("conversion", (*_INTO_WHOLE, "BOOL"))),
    ("conversion", (*_INTO_WHOLE, *REALS), _conversion_from("conversion", (*_INTO_WHOLE, "BOOL"))),
    ("conversion", _BOOL, _conversion_from("conversion", _INTO_WHOLE)),
    ("real-conversion", (*_INTO_WHOLE, *REALS), _from_real),
    ("time-conversion", (*_INTO_WHOLE, *REALS), _conversion_from("time-conversion", ("TIME",))),
    ("time-conversion", ("TIME",), _conversion_from("time-conversion", (*_INTO_WHOLE, *REALS, "BOOL"))),
    ("string-from", ("STRING",), _conversion_from("string-from", (*_INTO_WHOLE, "BOOL"))),
    ("string-from-real", ("STRING",), _string_from_real),
    ("string-from-time", ("STRING",), _conversion_from("string-from-time", ("TIME",))),
    ("string-to", (*_INTO_WHOLE, "BOOL"), _conversion_from("string-to", ("STRING",))),
    ("string-to-real", REALS, _conversion_from("string-to-real", ("STRING",))),
    ("string-extreme", ("STRING",), _string_extreme),
    ("truncation", tuple(WHOLE), _truncation),
    ("bcd", tuple(UNSIGNED), _from_bcd),
    ("bcd", tuple(BITS), _to_bcd),
    ("inexact-time-literal", ("TIME",), _inexact_time),
    ("time-sum", ("TIME",), _time_sum),
    ("time-product", ("TIME",), _time_product),
    ("string-part", ("STRING",), _string_part),
    ("string-join", ("STRING",), _string_join),
    ("string-edit", ("STRING",), _string_edit),
    ("string-length", tuple(WHOLE), _string_length),
    ("string-find", tuple(WHOLE), _string_find),
]

PRODUCTIONS = [Production(*row) for row in _ROWS]
