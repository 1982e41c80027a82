"""What the compiler leaves out because a range proves it unnecessary, was unnecessary."""

from __future__ import annotations

from contextlib import suppress
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.structured_text.engines.embedded.interpreter import COMPARISONS, TABLE, VARIABLES, Interpreter, lines_of
from tests.structured_text.engines.embedded.snippets import build

from structured_text.engines.engine import ScanError

COUNTERS = ("i", "j", "k")
TYPES = [kind for kind, _, _ in VARIABLES.values()]


def literals(name: str) -> st.SearchStrategy[int]:
    """Literals of a variable's type: small ones, edges, anything."""
    _, bits, signed = VARIABLES[name]
    high = (1 << (bits - signed)) - 1
    low = -high if signed else 0
    return st.one_of(st.integers(0, 5), st.sampled_from([high, high - 1, low, high // 2]), st.integers(low, high))


@st.composite
def expressions(draw: st.DrawFn, name: str, depth: int = 3) -> Any:
    """An expression of the type of variable `name`."""
    same = [each for each, (kind, _, _) in VARIABLES.items() if kind == VARIABLES[name][0]]
    operands = same + [each for each in COUNTERS if VARIABLES[name][0] == "UINT"]
    shape = draw(st.integers(0, 9)) if depth else draw(st.integers(0, 3))
    if shape < 2:
        return draw(st.sampled_from(operands))
    if shape < 4:
        return draw(literals(name))
    inner = expressions(name=name, depth=depth - 1)
    if shape == 4 and not VARIABLES[name][2]:
        # A variable in it, since the front end looks at constant indices itself.
        return ("row", (draw(st.sampled_from("+-*")), draw(st.sampled_from(same)), draw(inner)), 0)
    if shape == 5:
        return (draw(st.sampled_from(["/", "MOD"])), draw(inner), draw(st.integers(1, 100)))
    return (draw(st.sampled_from("+-*")), draw(inner), draw(inner))


@st.composite
def conditions(draw: st.DrawFn, depth: int = 1) -> Any:
    """A comparison of a variable with an expression, or two of them joined."""
    if depth and draw(st.booleans()):
        return (draw(st.sampled_from(["AND", "OR"])), draw(conditions(depth=0)), draw(conditions(depth=0)))
    name = draw(st.sampled_from(list(VARIABLES)))
    return (draw(st.sampled_from(COMPARISONS)), name, draw(expressions(name=name, depth=1)))


@st.composite
def programs(draw: st.DrawFn, depth: int = 3, loop: int = 0) -> list[Any]:
    """Some statements."""
    return [draw(statements(depth=depth, loop=loop)) for _ in range(draw(st.integers(1, 3)))]


@st.composite
def statements(draw: st.DrawFn, depth: int, loop: int) -> Any:
    """A statement; loops are nested at most as deep as there are counters."""
    shape = draw(st.integers(0, 9))
    if shape == 9 and loop:
        return ("if", draw(conditions()), [("exit",)], [])
    if shape >= 7 and depth and loop < len(COUNTERS):
        body = draw(programs(depth=depth - 1, loop=loop + 1))
        return ("while", COUNTERS[loop], draw(st.integers(0, 6)), draw(st.integers(1, 3)), body)
    if shape >= 5 and depth:
        then, otherwise = (draw(programs(depth=depth - 1, loop=loop)) for _ in range(2))
        return ("if", draw(conditions()), then, otherwise if draw(st.booleans()) else [])
    name = draw(st.sampled_from(list(VARIABLES)))
    return ("set", name, draw(expressions(name=name)))


def source(program: list[Any]) -> str:
    """The block of a program."""
    table = ", ".join(map(str, TABLE))
    rows = "".join(f"rows_{kind} : Row_{kind} := [{table}];\n" for kind in ("UINT", "USINT", "UDINT"))
    types = "".join(f"TYPE Row_{kind} : ARRAY[0..15] OF {kind}; END_TYPE\n" for kind in ("UINT", "USINT", "UDINT"))
    variables = "".join(f"{name} : {kind};\n" for name, (kind, _, _) in VARIABLES.items())
    body = "\n".join(lines_of(program))
    return f"{types}FUNCTION_BLOCK Test\nVAR\n{variables}i, j, k : UINT;\n{rows}END_VAR\n{body}\nEND_FUNCTION_BLOCK"


VALUES = st.fixed_dictionaries({name: literals(name) for name in VARIABLES})


@settings(max_examples=120)
@given(programs(), VALUES)
@pytest.mark.thorough
def test_random_programs(program: list[Any], values: dict[str, int]) -> None:
    """A scan fails or gives the same as an interpreter that wraps after every operation; twice, for what is kept."""
    reference = Interpreter({**values, "i": 0, "j": 0, "k": 0})
    made = build(source(program), loop_limit=100_000).instance("Test")
    for name, value in values.items():
        made[name] = value
    with suppress(ScanError):
        for _ in range(2):
            made.scan()
            reference.run(program)
            assert {name: made[name] for name in reference.values} == reference.values
