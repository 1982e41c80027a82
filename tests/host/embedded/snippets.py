"""Small pieces of ST, built and run in one call."""

from __future__ import annotations

from collections.abc import Mapping

import pytest

from driveblocks.host.embedded import EmbeddedEngine, EmbeddedInstance, EmbeddedLibrary
from driveblocks.host.engine import Overflow, ScanError, Source, Value

# What a row says where a model raises ScanError; no ST value is equal to it.
FAULT = b"\0 fault"
# Expression, type of its result, VAR_INPUT, values of these; then the result by the standard, in C, and under `fail`.
Row = tuple[str, str, str, dict[str, Value], Value, Value, Value]

MODELS: tuple[Overflow, ...] = ("standard", "c", "fail")


def build(text: str, model: Overflow = "fail", *, line: str = "", **options: int) -> EmbeddedLibrary:
    """Build one source, named `test.st`."""
    engine = EmbeddedEngine(
        model,
        line=line,
        loop_limit=options.get("loop_limit", 1000),
        coverage=bool(options.get("coverage", 0)),
    )
    return engine.build([Source("test.st", text)])


def block(
    declarations: str, body: str, model: Overflow = "fail", *, types: str = "", line: str = ""
) -> EmbeddedInstance:
    """An instance of a function block `Test` whose declarations and body these are."""
    text = f"{types}\nFUNCTION_BLOCK Test\n{declarations}\n{body}\nEND_FUNCTION_BLOCK\n"
    return build(text, model, line=line).instance("Test")


def evaluate(expression: str, result: str, inputs: str = "", model: Overflow = "fail", **values: Value) -> Value:
    """The value of an expression stored in a variable of type `result`; `inputs` as in VAR_INPUT."""
    given = f"VAR_INPUT {inputs} END_VAR" if inputs else ""
    made = block(f"{given} VAR_OUTPUT Answer : {result}; END_VAR", f"Answer := {expression};", model)
    for name, value in values.items():
        made[name] = value
    made.scan(0)
    return made["Answer"]


def fault(expression: str, result: str, inputs: str = "", model: Overflow = "fail", **values: Value) -> str:
    """The text of the ScanError that an expression must raise."""
    with pytest.raises(ScanError) as caught:
        evaluate(expression, result, inputs, model, **values)
    return caught.value.message.text


def outcomes(expression: str, result: str, inputs: str, values: Mapping[str, Value]) -> dict[Overflow, Value]:
    """What each model makes of an expression; FAULT where it raises ScanError."""
    found: dict[Overflow, Value] = {}
    for model in MODELS:
        try:
            found[model] = evaluate(expression, result, inputs, model, **values)
        except ScanError:
            found[model] = FAULT
    return found
