"""What was proved, in words: a line per rule, a counterexample as a table, and the results as they are written down."""

import re
from collections.abc import Iterator

from driveblocks.bench.outcome import ERROR, FAILED, PASSED, Outcome, Result
from driveblocks.prove.model import BEFORE
from driveblocks.prove.prover import Proof, Proved
from driveblocks.prove.question import CALLS, Verdict
from driveblocks.prove.replay import Call
from structured_text.engines.engine import Value
from structured_text.language.tree import VarKind

ENGINE = "z3"
REPLAYED, NOT_REPLAYED = "replayed on the embedded engine", "not replayed: it rests on values that were left free"
PREMISES, LEFT_FREE = "premises run on the embedded engine", "of which rest on values that were left free"
"""Properties of a result."""
AGREE = "every result stays within its width, every index within its bounds, and no divisor is 0"
"""What is said of all that compilers have to agree on."""


def sentences(proved: Proved) -> dict[str, list[Proof]]:
    """The proofs of a block by what they say; what all compilers have to agree on is one sentence."""
    found: dict[str, list[Proof]] = {}
    for each in proved.proofs:
        words = each.answer.question.words if each.answer.question.condition else AGREE
        found.setdefault(words, []).append(each)
    return found


def told(proof: Proof) -> str:
    """What became of a question, in words."""
    answer = proof.answer
    about = answer.question.about if answer.question.condition else answer.question.words
    words = f"{about or CALLS}: {answer.verdict.value}"
    if answer.verdict is Verdict.BROKEN:
        return f"{words}, {REPLAYED if proof.replayed else NOT_REPLAYED}"
    return words if proof.good or proof.call is None else f"{words}, but the embedded engine does something else"


def table(proved: Proved, proof: Proof) -> list[str]:
    """A call: inputs, the memory that matters before it, and what pins, slot and memory are after it.

    What is 0, FALSE or of no effect is left out.
    """
    call = proof.call
    if call is None:
        return []
    rows = [("", "before", "after")]
    for path, (name, _) in proved.model.scalars.items():
        if path in call.inputs:
            rows += [(f"{name} (input)", "", _shown(call.inputs[path]))] if call.inputs[path] else []
        elif _matters(proved, proof, path, call):
            rows.append((name, _shown(call.before[path]), _shown(call.after[path])))
    wide = [max(len(row[column]) for row in rows) for column in range(3)]
    return ["  ".join(cell.ljust(size) for cell, size in zip(row, wide, strict=True)).rstrip() for row in rows]


def _matters(proved: Proved, proof: Proof, path: str, call: Call) -> bool:
    """Whether the condition depends on a scalar that is not 0; or it is a pin or of the slot, and has changed."""
    if BEFORE + path in proof.values and call.before[path]:
        return True
    symbol = proved.model.pou.symbols[re.split(r"[.\[]", path)[0]]
    return symbol.kind in (VarKind.OUTPUT, VarKind.IN_OUT) and call.before[path] != call.after[path]


def _shown(value: Value) -> str:
    return str(value).upper() if isinstance(value, bool) else str(value)


def result(proved: Proved) -> Result:
    """A block's proofs as tests write theirs: a scene per rule, a check per question; premises are its properties."""
    calls = [each for each in proved.proofs if each.call is not None]
    free = sum(not each.replayed for each in calls if each.good)
    premises = ((PREMISES, str(len(calls))), (LEFT_FREE, str(free)))
    return Result(ENGINE, proved.unit, proved.model.pou.name, tuple(_outcomes(proved)), proved.seconds, premises)


def _outcomes(proved: Proved) -> Iterator[Outcome]:
    for words, proofs in sentences(proved).items():
        of = proofs[0].answer.question.of
        for each in proofs:
            status = PASSED if each.good else FAILED if each.answer.verdict is Verdict.BROKEN else ERROR
            message = "" if each.good else "\n".join([told(each), *table(proved, each)])
            about = each.answer.question.about or CALLS
            yield Outcome(about, status, message, scene=f"{words} ({of})" if of else words)
