"""Build ST with one installation of matiec."""

import hashlib
import json
import shutil
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

from structured_text.engines.engine import EngineError, Message, Source
from structured_text.engines.matiec import runtime
from structured_text.engines.matiec.binary import Binary, Built, load_guard
from structured_text.engines.matiec.c_lines import LineTable, counted, directives, take_lines
from structured_text.engines.matiec.cache import Cache, cache_folder
from structured_text.engines.matiec.ccompiler import CCompiler, Flags, Job
from structured_text.engines.matiec.counters import Counters
from structured_text.engines.matiec.declarations import Declarations, read_declarations
from structured_text.engines.matiec.header import (
    Block,
    ConfigurationC,
    Header,
    read_configuration,
    read_header,
    read_locations,
    read_standard_blocks,
)
from structured_text.engines.matiec.installation import Installation
from structured_text.engines.matiec.library import MatiecLibrary
from structured_text.engines.matiec.plan import Expressions, Measure, Planner
from structured_text.engines.matiec.text import Listing
from structured_text.engines.matiec.translate import Translator
from structured_text.files import data, put

LIBRARY = "library.so"
WARNINGS = "warnings.json"
# What the table of sizes in the library is about.
EXPRESSIONS = "expressions.json"
# Part of every key: a change of what this package makes of the same C must not meet old entries.
FORMAT = "1"
# Below this a compiler that fails has failed for want of room.
_ROOM_BYTES = 1 << 20


@dataclass
class MatiecEngine:
    """An engine. `name` says the line: `matiec-beremiz`, `matiec-openplc`, or `matiec` where that is not known."""

    installation: Installation
    compiler: CCompiler
    name: str = "matiec"
    flags: Flags = field(default_factory=Flags)
    cache: Cache = field(default_factory=lambda: Cache(cache_folder()))
    seconds: float = 60.0

    def build(self, sources: Sequence[Source]) -> MatiecLibrary:
        """Compile the sources, or take them from the cache.

        Raises BuildError with the messages of iec2c, or (BadCError) of the C compiler; EngineError if either is
        missing, crashes, hangs or prints what nobody understands, or if the cache cannot be written.
        """
        listing = Listing(sources)
        folder = self.cache.entry(self.key(listing.text), lambda making: self._make(listing, making))
        return MatiecLibrary(self._load(listing, folder))

    def key(self, text: str) -> str:
        """SHA-256 over all that a build is made of."""
        try:
            tools = self.installation.digest
        except OSError as error:
            raise EngineError(f"{self.installation.iec2c} is no longer there: {error.strerror}") from error
        compiler = [*self.compiler.command, self.compiler.version, *self.flags.arguments]
        parts = json.dumps([FORMAT, runtime.UNIT_TEXT, tools, compiler, self.flags.coverage, text])
        return hashlib.sha256(parts.encode("utf-8", "surrogatepass")).hexdigest()

    def _make(self, listing: Listing, folder: Path) -> None:
        try:
            warnings = Translator(self.installation, self.seconds).run(listing, folder)
            warnings += self._compile(listing, folder)
        except EngineError as error:
            if shutil.disk_usage(folder).free < _ROOM_BYTES:
                raise EngineError(f"the disk of the build cache {folder} is full") from error
            raise
        rows = [[each.path, each.line, each.column, each.text] for each in warnings]
        put(folder / WARNINGS, json.dumps(rows), sync=False)

    def _compile(self, listing: Listing, folder: Path) -> list[Message]:
        c_sources = _CSources.read(folder, self.installation, listing)
        expressions = Expressions()
        planner = c_sources.plan(expressions)
        functions = c_sources.header.functions.values()
        outside = (c_sources.configuration, read_locations(folder))
        text = runtime.unit(planner.plan.blocks, functions, expressions.found, *outside)
        put(folder / EXPRESSIONS, json.dumps(list(expressions.found)), sync=False)
        lines, counters = self._move_pous(folder, listing, c_sources.declared)
        if counters is not None:
            text = f"#define DBK_COVERAGE {max(len(counters.lines), 1)}\n{text}"
        put(folder / runtime.UNIT, text, sync=False)
        files = [runtime.UNIT, *c_sources.configuration.files]
        return self.compiler.compile(Job(folder, files, LIBRARY, self.installation.headers, self.flags, listing, lines))

    def _move_pous(self, folder: Path, listing: Listing, declared: Declarations) -> tuple[LineTable, Counters | None]:
        old = folder / "POUS.c"
        c_text = data(old).decode(errors="replace")
        counters = Counters(listing, directives(c_text)) if self.flags.coverage else None
        starts = {name: unit.line for name, unit in declared.units.items()}
        text, lines = take_lines(c_text, starts, counters.mark if counters else None)
        put(folder / runtime.POUS_MOVED, text, sync=False)
        put(old, "", sync=False)
        return lines, counters

    def _load(self, listing: Listing, folder: Path) -> Built:
        c_sources = _CSources.read(folder, self.installation, listing)
        binary = Binary(folder / LIBRARY)
        if not self.flags.sanitized:
            binary.attach(load_guard(self.compiler, self.cache))
        expressions = json.loads(data(folder / EXPRESSIONS))
        sizes = dict(zip(expressions, binary.sizes(len(expressions)), strict=False))
        plan = c_sources.plan(sizes.__getitem__).plan
        rows = json.loads(data(folder / WARNINGS))
        warnings = tuple(listing.locate(Message(path, line, column, text) for path, line, column, text in rows))
        places = {name: listing.place(unit.line) for name, unit in c_sources.declared.units.items()}
        moved = data(folder / runtime.POUS_MOVED).decode()
        counters = Counters(listing, counted(moved)) if self.flags.coverage else None
        return Built(folder, binary, plan, c_sources.declared, warnings, places, counters)


@dataclass(frozen=True)
class _CSources:
    """What iec2c wrote, and what the ST declares."""

    header: Header
    installation: Installation
    configuration: ConfigurationC
    declared: Declarations

    @classmethod
    def read(cls, folder: Path, installation: Installation, listing: Listing) -> "_CSources":
        """Read the files. Raises EngineError if they are not what iec2c writes."""
        text = data(folder / "POUS.h").decode(errors="replace")
        if not text.rstrip().endswith("#endif //__POUS_H"):
            raise EngineError(f"{installation.iec2c} wrote a POUS.h that is cut short or unknown")
        return cls(read_header(text), installation, read_configuration(folder), read_declarations(listing.text))

    def plan(self, measure: Measure) -> Planner:
        """Plan all nodes with sizes from `measure`."""
        planner = Planner(self.header, self._standard, self.declared, measure)
        planner.blocks()
        return planner

    def _standard(self) -> dict[str, Block]:
        try:
            return read_standard_blocks(self.installation.headers)
        except OSError as error:
            raise EngineError(f"cannot read {self.installation.headers}: {error.strerror}") from error
