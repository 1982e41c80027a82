"""The units of the example map, and ways to change a library and to run some of its programs."""

import re
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest
from tests.shipped import BOTH

from driveblocks.bench import harness, runner
from driveblocks.bench.outcome import Run
from driveblocks.bench.unit import Unit
from driveblocks.maps import collection
from driveblocks.output.units import units
from structured_text.engines.embedded import EmbeddedEngine
from structured_text.engines.engine import Source

ROOT = Path(__file__).parents[2]
EXAMPLE = ROOT / "tests/maps/example.yaml"

Change = Callable[[Unit, str, str, str], Unit]
Only = Callable[..., Unit]


@pytest.fixture(scope="session")
def made() -> dict[str, Unit]:
    """The units of the example map by name: `modbus` for the shared blocks, `example`."""
    return {unit.suite.name: unit for unit in units(collection.read([EXAMPLE]), BOTH)}


@pytest.fixture(scope="session")
def example(made: dict[str, Unit]) -> Unit:
    """The unit of the example map."""
    return made["example"]


@pytest.fixture(scope="session")
def shared(made: dict[str, Unit]) -> Unit:
    """The unit of the shared blocks."""
    return made["modbus"]


def only(unit: Unit, *programs: str) -> Unit:
    """The unit with some of its programs, by the beginning of what follows `_Test`, and the blocks they need."""
    chosen = [one for one in unit.suite.programs if one.name.partition("_Test")[2].startswith(programs)]
    assert chosen, programs
    parts = unit.suite.parts if any("_TestDrive;" in one.text for one in chosen) else {}
    blocks = needed(unit, [*parts.values(), *(one.text for one in chosen)])
    return replace(unit, blocks=blocks, suite=replace(unit.suite, programs=tuple(chosen), parts=parts))


def needed(unit: Unit, texts: list[str]) -> tuple[Source, ...]:
    """The blocks and types that are named in the texts and the harness, or in what is named there."""
    rest = {Path(source.path).stem: source for source in unit.blocks}
    texts = [*texts, *harness.texts().values()]
    for text in texts:
        texts += [rest.pop(name).text for name in set(re.findall(r"\w+", text)) if name in rest]
    return tuple(source for source in unit.blocks if Path(source.path).stem not in rest)


def changed(unit: Unit, block: str, old: str, new: str) -> Unit:
    """The unit with one change in one block."""
    found = [source for source in unit.blocks if source.path.endswith(f"/{block}.st") and old in source.text]
    assert found, f"{block} has no {old}"
    blocks = [
        Source(source.path, source.text.replace(old, new, 1)) if source is found[0] else source
        for source in unit.blocks
    ]
    return replace(unit, blocks=tuple(blocks))


def run(*given: Unit) -> Run:
    """All programs of the units on the embedded engine."""
    return runner.run(given, [EmbeddedEngine()])
