"""The embedded engine replays what matiec was recorded to do with the library's blocks."""

import functools
from collections.abc import Iterator

import pytest
from tests.blocks.compare.pou import Pou, shipped
from tests.structured_text.engines.traces.library import (
    AGAIN,
    Record,
    folders,
    head_of,
    read,
    replayed,
    same,
    states,
)

from structured_text.engines.embedded import EmbeddedEngine
from structured_text.engines.engine import Library


@functools.cache
def _compiled() -> Library:
    return EmbeddedEngine().build(shipped().sources)


def _pous(folder: str) -> list[Pou]:
    return [pou for pou in shipped().pous.values() if pou.folder == folder]


def _stale(folder: str, pous: list[Pou]) -> list[str]:
    """The blocks whose record is not of them, and the records of blocks that are gone."""
    records = read(folder)
    changed = [pou.name for pou in pous if pou.name not in records or records[pou.name].head != head_of(pou)]
    return changed + sorted(records.keys() - {pou.name for pou in pous})


@pytest.mark.thorough
@pytest.mark.parametrize("folder", folders())
def test_the_record_is_of_the_blocks_as_they_are(folder: str) -> None:
    """A changed block, or other inputs: what was recorded says nothing about it."""
    stale = _stale(folder, _pous(folder))
    assert stale == [], AGAIN + ", ".join(stale)


@pytest.mark.thorough
@pytest.mark.parametrize("folder", folders())
def test_the_embedded_engine_replays_the_library(folder: str) -> None:
    """Every variable after every scan, but the copies of in-outs that only matiec keeps."""
    records, compiled = read(folder), _compiled()
    fresh = [pou for pou in _pous(folder) if pou.name in records and records[pou.name].head == head_of(pou)]
    assert [text for pou in fresh for text in _unlike(pou, records[pou.name], compiled)] == []


def _unlike(pou: Pou, record: Record, compiled: Library) -> Iterator[str]:
    """What differs first, with its scan."""
    kept = [leaf.path for leaf in pou.leaves if not leaf.handed_on]
    pairs = zip(states(pou, compiled, record.head.scans), record.changes, strict=True)
    for number, ((before, after), changes) in enumerate(pairs):
        wanted = replayed(before, changes)
        paths = [path for path in kept if not same(after[path], wanted[path])]
        if paths:
            yield f"{pou.name}, scan {number}: {[(path, after[path], wanted[path]) for path in paths]}"
            return
