"""Every program of the accept/reject corpus that the checker passes builds, runs, and shows its state."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress

from tests.structured_text.engines.accept.programs import load_programs

from structured_text.engines.embedded import EmbeddedEngine, EmbeddedLibrary
from structured_text.engines.engine import BuildError, ScanError, Source


def accepted() -> Iterator[EmbeddedLibrary]:
    """The libraries of all programs that build."""
    for name, text in load_programs().items():
        with suppress(BuildError):
            yield EmbeddedEngine().build([Source(name, text)])


def test_nothing_but_scan_errors() -> None:
    """No construct that is let through makes the engine itself stumble."""
    count = 0
    for library in accepted():
        count += 1
        for block in library.blocks():
            instance = library.instance(block)
            with suppress(ScanError):
                for scan in range(3):
                    instance.scan(scan * 10_000_000)
            instance.state()
    assert count > 300
