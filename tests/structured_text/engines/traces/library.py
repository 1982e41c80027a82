"""Recorded states of the library's blocks: what each scan changed, as compressed JSON lines, one file per folder.

A block begins with a line that names it, the digest of its text, the digest of its inputs, and how many scans follow.
The inputs are not stored: they follow from the block and the seed (tests/blocks/compare/stimulus.py). Each further line
holds what one scan made other than it was with its inputs set. A scalar is written as in the traces of the corpus, an
array as [first index that changed, its elements in hexadecimal], one inside an instance that equals one of the block's
own as the path of that.
"""

from __future__ import annotations

import gzip
import hashlib
import json
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import islice
from pathlib import Path

from tests.blocks.compare.pou import Pou, shipped
from tests.blocks.compare.stimulus import landmarks, stimuli
from tests.blocks.library import alone
from tests.structured_text.engines.compare.lockstep import alike
from tests.structured_text.engines.compare.scenarios import Inputs
from tests.structured_text.engines.traces.trace import SEED, decode, encode

from structured_text.engines.engine import Instance, Library, Value

FOLDER = Path(__file__).parent / "library"
BY_CHANCE = 60
BY_CHANCE_WITH_ARRAYS = 24
AGAIN = "run `make long WHAT=traces` where both lines of matiec are: "

State = dict[str, Value]
"""Every leaf of a block by path; an array is a list."""


@dataclass(frozen=True)
class Head:
    """What a record was made from."""

    pou: str
    text: str
    inputs: str
    scans: int


@dataclass(frozen=True)
class Record:
    """The changes of every scan of one block."""

    head: Head
    changes: tuple[dict[str, object], ...]


def folders() -> list[str]:
    """The folders of the library, each with a file of its own."""
    return sorted({each.path.partition("/")[0] for each in alone()} - {"types"})


def path_of(folder: str) -> Path:
    """Where the records of a folder are kept."""
    return FOLDER / f"{folder}.jsonl.gz"


def scans(pou: Pou) -> int:
    """How many scans are recorded: all landmarks, then some at random."""
    return 1 + landmarks(pou) + (BY_CHANCE_WITH_ARRAYS if pou.arrays else BY_CHANCE)


def head_of(pou: Pou) -> Head:
    """What a record of the block as it is would be made from."""
    given = [*islice(stimuli(pou, SEED), scans(pou))]
    return Head(pou.name, pou.digest, hashlib.sha256(repr(given).encode()).hexdigest()[:16], len(given))


# ------------------------------------------------------------ files


def write(folder: str, library: Library) -> bool:
    """Record the blocks of a folder; say whether that changed what was kept."""
    records = [_record(pou, library) for pou in shipped().pous.values() if pou.folder == folder]
    lines = [json.dumps(line, separators=(",", ":")) for each in records for line in (vars(each.head), *each.changes)]
    text, path = "\n".join(lines).encode(), path_of(folder)
    if path.exists() and gzip.decompress(path.read_bytes()) == text:
        return False
    path.parent.mkdir(exist_ok=True)
    path.write_bytes(gzip.compress(text, mtime=0))
    return True


def read(folder: str) -> dict[str, Record]:
    """The records of a folder by block."""
    lines = iter(gzip.decompress(path_of(folder).read_bytes()).decode().splitlines())
    heads = ((head, islice(lines, head.scans)) for head in (Head(**json.loads(line)) for line in lines))
    return {head.pou: Record(head, tuple(map(json.loads, rest))) for head, rest in heads}


# ------------------------------------------------------------ scans


def states(pou: Pou, library: Library, count: int) -> Iterator[tuple[State, State]]:
    """The state with the inputs set, and after the scan, for each of this many scans."""
    instance = library.instance(pou.block)
    for inputs in islice(stimuli(pou, SEED), count):
        set_inputs(instance, inputs)
        before = state_of(pou, instance)
        instance.scan(0)
        yield before, state_of(pou, instance)


def set_inputs(instance: Instance, inputs: Inputs) -> None:
    """Set what is set before a scan."""
    for path, value in inputs.items():
        instance[path] = value


def state_of(pou: Pou, instance: Instance) -> State:
    """Every leaf of a block."""
    return {leaf.path: instance[leaf.path] for leaf in pou.leaves}


def _record(pou: Pou, library: Library) -> Record:
    pairs = states(pou, library, scans(pou))
    return Record(head_of(pou), tuple(_changes(before, after) for before, after in pairs))


def _changes(before: State, after: State) -> dict[str, object]:
    return {path: _change(before[path], after, path) for path in after if not same(before[path], after[path])}


def same(left: Value, right: Value) -> bool:
    """Whether two leaves are the same to the bit."""
    return left == right if isinstance(left, list) else alike(left, right)


def _change(before: Value, after: State, path: str) -> object:
    value = after[path]
    if not isinstance(value, list) or not isinstance(before, list):
        return encode(value)
    twins = [other for other in after if "." in path and "." not in other and after[other] == value]
    if twins:
        return twins[0]
    differing = [at for at in range(len(value)) if value[at] != before[at]]
    return [differing[0], "".join(_digits(each) for each in value[differing[0] : differing[-1] + 1])]


def _digits(element: Value) -> str:
    assert isinstance(element, int)
    return f"{element:04X}"


def replayed(before: State, changes: dict[str, object]) -> State:
    """The state after a scan, from that with its inputs set and what was recorded."""
    after = {**before}
    twins = {path: change for path, change in changes.items() if isinstance(before.get(path), list)}
    after |= {path: decode(change) for path, change in changes.items() if path not in twins}
    after |= {path: _spliced(before[path], change) for path, change in twins.items() if isinstance(change, list)}
    return after | {path: after[change] for path, change in twins.items() if isinstance(change, str)}


def _spliced(before: Value, change: list[object]) -> Value:
    first, text = change
    assert isinstance(before, list)
    assert isinstance(first, int)
    assert isinstance(text, str)
    new: list[Value] = [int(text[at : at + 4], 16) for at in range(0, len(text), 4)]
    return [*before[:first], *new, *before[first + len(new) :]]
