"""A call that the solver found, run on the embedded engine: does the block do there what the terms say?

The conditions are run there, too, as the ST that they are; so a rule that a replay breaks is broken without any solver.
"""

import struct
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import z3

from driveblocks.prove import observer
from driveblocks.prove.example import Values
from driveblocks.prove.model import BEFORE, Model, in_outs
from driveblocks.prove.question import Question
from structured_text.engines.embedded.engine import EmbeddedEngine
from structured_text.engines.embedded.library import EmbeddedInstance, EmbeddedLibrary
from structured_text.engines.engine import ScanError, Source, Value
from structured_text.language.tree import FunctionBlock
from structured_text.language.types import Elementary, Kind


@dataclass(frozen=True)
class Call:
    """A call on the engine: what it found, its inputs, what it left; and whether the rule came to it and held."""

    before: dict[str, Value]
    inputs: dict[str, Value]
    after: dict[str, Value]
    when: bool
    then: bool


def python(term: z3.ExprRef, kind: Elementary) -> Value:
    """A value of the solver as the engines have it."""
    if kind.kind is Kind.BOOL:
        return bool(z3.is_true(term))
    if kind.kind is Kind.REAL:
        bits = z3.simplify(z3.fpToIEEEBV(term))
        number: float = struct.unpack("<f", struct.pack("<I", bits.as_long() if z3.is_bv_value(bits) else 0x7FC00000))[
            0
        ]
        return number
    return int(term.as_signed_long() if kind.signed else term.as_long())


class Replay:
    """The blocks and their observers on the embedded engine."""

    def __init__(self, sources: Sequence[Source], models: Sequence[Model]) -> None:
        texts = [
            Source(f"the rules of {each.pou.name}", observer.text(each.pou, each.checked, each.subject.conditions()))
            for each in models
        ]
        self.library: EmbeddedLibrary = EmbeddedEngine().build([*sources, *texts])
        self.models = {each.pou.name: each for each in models}

    def call(self, model: Model, question: Question, values: Values) -> Call | None:
        """Run a call; None for a function, or where not the memory but nothing is asked about."""
        if not isinstance(model.pou, FunctionBlock) or question.condition == "Restarts":
            return None
        known = _known(model, values)
        before = {path: known[BEFORE + path] for path in model.scalars}
        inputs = {name: value for name, value in known.items() if not name.startswith(BEFORE)}
        if not question.condition:
            return self._strict(model, before, inputs)
        after = self._run(model, before, inputs)
        when, then = self._judged(model, question.condition, before, after)
        return Call(before, inputs, after, when, then)

    def _strict(self, model: Model, before: dict[str, Value], inputs: dict[str, Value]) -> Call:
        """Whether a call stays within what all compilers agree on: the engine says so itself."""
        try:
            return Call(before, inputs, self._run(model, before, inputs), when=True, then=True)
        except ScanError:
            return Call(before, inputs, before | inputs, when=True, then=False)

    def _run(self, model: Model, before: Mapping[str, Value], inputs: Mapping[str, Value]) -> dict[str, Value]:
        instance = self._called(model.pou.name, {**before, **inputs})
        return {path: instance[path] for path in before}

    def _called(self, block: str, values: Mapping[str, Value]) -> EmbeddedInstance:
        """An instance after a call with these values; most are those of a fresh one, and writing takes time."""
        instance = self.library.instance(block)
        fresh = instance.state()
        for path, value in values.items():
            if isinstance(value, float) or fresh.get(path) != value:  # 0.0 equals -0.0
                instance[path] = value
        instance.scan()
        return instance

    def _judged(
        self, model: Model, condition: str, before: Mapping[str, Value], after: Mapping[str, Value]
    ) -> tuple[bool, bool]:
        """Whether the condition comes to it, and holds."""
        name, _, rest = condition.rpartition(".")
        if name:
            inner = self.models[model.subject.inside[name]]
            shared, prefix = in_outs(inner.pou), f"{name.upper()}."
            before, after = (_below(each, prefix, shared) for each in (before, after))
            model = inner
        word = rest.rstrip("0123456789")
        number = rest[len(word) :]
        was = {f"WAS.{path}": value for path, value in before.items()}
        instance = self._called(observer.name(model.pou), {**after, **was})
        return bool(instance[f"{word}When{number}"]), bool(instance[f"{word}Then{number}"])


def _below(store: Mapping[str, Value], prefix: str, shared: set[str]) -> dict[str, Value]:
    kept = {path: value for path, value in store.items() if path.split(".")[0] in shared}
    return kept | {path[len(prefix) :]: value for path, value in store.items() if path.startswith(prefix)}


def _known(model: Model, values: Values) -> dict[str, Value]:
    """Every scalar before the call, and every input of it; 0 where nothing depends on it."""
    found: dict[str, Value] = {}
    for path, (_, kind) in model.scalars.items():
        zero: Value = False if kind.kind is Kind.BOOL else 0.0 if kind.kind is Kind.REAL else 0
        for name in (BEFORE + path, path):
            if name in values:
                found[name] = python(values[name], kind)
            elif name != path or not model.inputs[path].eq(model.before[path]):
                found[name] = zero
    return found
