"""What is built and run together: a library of blocks and the programs that test it."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from driveblocks.host.engine import Source
from driveblocks.render import library
from driveblocks.render.build import PLATFORM
from driveblocks.render.build import Source as Map
from driveblocks.render.text import Language
from driveblocks.testing import harness
from driveblocks.testing.script import Suite
from driveblocks.testing.suite import ROOT, drive_suite, shared_suite


@dataclass(frozen=True)
class Unit:
    """A suite and the library that it tests, each behind what it uses."""

    suite: Suite
    blocks: tuple[Source, ...]

    @property
    def sources(self) -> list[Source]:
        """All texts: library, harness, programs."""
        tests = [Source(ROOT + path, text) for path, text in harness.texts().items()]
        tests += [Source(ROOT + program.path, program.text) for program in self.suite.programs]
        return [*self.blocks, *tests]


def units(sources: Sequence[Map], languages: list[Language]) -> list[Unit]:
    """The shared blocks, then each drive with the shared blocks that it needs. Raises ValueError, as rendering does."""
    generic = tuple(_sources(library.generic(languages)))
    made = [Unit(shared_suite(languages), generic)]
    for source in sources:
        own = _sources(library.drive(source.path.stem, source.drive, languages))
        made.append(Unit(drive_suite(source, languages), (*generic, *own)))
    return made


def _sources(files: Iterator[library.File]) -> Iterator[Source]:
    for file in files:
        yield Source(f"{PLATFORM}/{file.path}", file.text)
