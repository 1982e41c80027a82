"""Recorded states of a corpus block: what changed after each scan, as compressed JSON lines.

The inputs are not stored: they follow from the case and the seed (compare/cases.py). The first line names case, seed
and who agreed on the record; each further line holds the variables that changed in one scan. A REAL is
written as "f:" and its hexadecimal notation, a STRING as "s:" and its characters.
"""

from __future__ import annotations

import gzip
import json
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

from tests.structured_text.engines.compare.lockstep import State, alike, first_unlike

from structured_text.engines.engine import Value

FOLDER = Path(__file__).parent
SEED = 1


@dataclass(frozen=True)
class Trace:
    """The states of one case after every scan, and the engines that gave them."""

    case: str
    seed: int
    engines: tuple[str, ...]
    states: tuple[State, ...]


def path_of(case: str) -> Path:
    """Where the trace of a case is kept."""
    return FOLDER / f"{case}.jsonl.gz"


def write(trace: Trace) -> bool:
    """Keep a trace; say whether that changed what was kept (an equal one is left alone, byte for byte)."""
    path = path_of(trace.case)
    if path.exists() and _same(read(path), trace):
        return False
    header = {"case": trace.case, "seed": trace.seed, "engines": trace.engines}
    lines = [json.dumps(header), *(json.dumps(change, separators=(",", ":")) for change in _changes(trace.states))]
    path.write_bytes(gzip.compress("\n".join(lines).encode(), mtime=0))
    return True


def _same(left: Trace, right: Trace) -> bool:
    """Whether two traces hold the same to the bit; `==` would take NaN for another value than itself."""
    heads = [(each.case, each.seed, each.engines, len(each.states)) for each in (left, right)]
    pairs = zip(left.states, right.states, strict=False)
    return heads[0] == heads[1] and all(first_unlike(one, other) is None for one, other in pairs)


def read(path: Path) -> Trace:
    """Read a trace back."""
    first, *rest = gzip.decompress(path.read_bytes()).decode().splitlines()
    header = json.loads(first)
    return Trace(header["case"], header["seed"], tuple(header["engines"]), tuple(_states(map(json.loads, rest))))


def _changes(states: Iterable[State]) -> Iterator[dict[str, object]]:
    before: State = {}
    for state in states:
        yield {
            name: encode(value) for name, value in state.items() if name not in before or not alike(value, before[name])
        }
        before = state


def _states(changes: Iterable[dict[str, object]]) -> Iterator[State]:
    state: State = {}
    for change in changes:
        state = {**state, **{name: decode(value) for name, value in change.items()}}
        yield state


def encode(value: Value) -> bool | int | str:
    """A scalar as JSON has it."""
    if isinstance(value, float):
        return f"f:{value.hex()}"
    if isinstance(value, bytes):
        return "s:" + value.decode("latin-1")
    assert isinstance(value, bool | int), value
    return value


def decode(value: object) -> Value:
    """The scalar that was encoded."""
    if isinstance(value, str):
        return float.fromhex(value[2:]) if value.startswith("f:") else value[2:].encode("latin-1")
    assert isinstance(value, bool | int), value
    return value
