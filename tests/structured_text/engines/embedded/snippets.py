"""Small pieces of ST, built and run in one call."""

from __future__ import annotations

from collections.abc import Mapping

import pytest

from structured_text.engines.embedded import EmbeddedEngine, EmbeddedInstance, EmbeddedLibrary
from structured_text.engines.engine import ScanError, Source, Value

# What a row says where the engine raises ScanError; no ST value is equal to it.
FAULT = b"\0 fault"
# Expression, type of its result, VAR_INPUT, values of these; then the result in C, and here.
Row = tuple[str, str, str, dict[str, Value], Value, Value]


def build(text: str, *, loop_limit: int = 1000, coverage: bool = False) -> EmbeddedLibrary:
    """Build one source, named `test.st`."""
    return EmbeddedEngine(loop_limit=loop_limit, coverage=coverage).build([Source("test.st", text)])


def block(declarations: str, body: str, *, types: str = "") -> EmbeddedInstance:
    """An instance of a function block `Test` whose declarations and body these are."""
    text = f"{types}\nFUNCTION_BLOCK Test\n{declarations}\n{body}\nEND_FUNCTION_BLOCK\n"
    return build(text).instance("Test")


def evaluate(expression: str, result: str, inputs: str = "", **values: Value) -> Value:
    """The value of an expression stored in a variable of type `result`; `inputs` as in VAR_INPUT."""
    given = f"VAR_INPUT {inputs} END_VAR" if inputs else ""
    made = block(f"{given} VAR_OUTPUT Answer : {result}; END_VAR", f"Answer := {expression};")
    for name, value in values.items():
        made[name] = value
    made.scan(0)
    return made["Answer"]


def fault(expression: str, result: str, inputs: str = "", **values: Value) -> str:
    """The text of the ScanError that an expression must raise."""
    with pytest.raises(ScanError) as caught:
        evaluate(expression, result, inputs, **values)
    return caught.value.message.text


def outcome(expression: str, result: str, inputs: str, values: Mapping[str, Value]) -> Value:
    """What an expression gives; FAULT where it raises ScanError."""
    try:
        return evaluate(expression, result, inputs, **values)
    except ScanError:
        return FAULT


def assert_row(row: Row) -> None:
    """The engine gives what the row says: what C gives, or a fault."""
    expression, result, inputs, values, c, here = row
    assert outcome(expression, result, inputs, values) == here
    assert here in (c, FAULT)
