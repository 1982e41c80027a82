"""What is built and run together: a library of blocks and the programs that test it."""

from dataclasses import dataclass

from driveblocks.bench import harness
from driveblocks.bench.script import Suite
from driveblocks.bench.suite import ROOT
from structured_text.engines.engine import Source


@dataclass(frozen=True)
class Unit:
    """A suite and the library that it tests, each after what it uses."""

    suite: Suite
    blocks: tuple[Source, ...]

    @property
    def sources(self) -> list[Source]:
        """All texts: library, harness, programs."""
        tests = [Source(ROOT + path, text) for path, text in harness.texts().items()]
        tests += [Source(ROOT + path, text) for path, text in self.suite.parts.items()]
        tests += [Source(ROOT + program.path, program.text) for program in self.suite.programs]
        return [*self.blocks, *tests]
