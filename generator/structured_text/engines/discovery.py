"""Which engines run on this machine, which do not, and why."""

import os
from collections.abc import Mapping
from dataclasses import dataclass, field, replace

from structured_text.engines.engine import Engine, EngineError
from structured_text.engines.matiec.cache import Cache, cache_folder
from structured_text.engines.matiec.ccompiler import CCompiler, find_c_compiler
from structured_text.engines.matiec.engine import MatiecEngine
from structured_text.engines.matiec.installation import Installation, Useless, look_everywhere
from structured_text.engines.matiec.line import Behaviour, observe

EMBEDDED = "embedded"
LINES = ("beremiz", "openplc")
MATIEC_NAMES = tuple(f"matiec-{line}" for line in LINES)
NO_COMPILER = "there is no C compiler (CC, cc, gcc, clang)"


@dataclass(frozen=True)
class Examined:
    """One iec2c: its engine and behaviour if it works, else why not."""

    iec2c: str
    library: str | None = None
    engine: MatiecEngine | None = None
    behaviour: Behaviour | None = None
    problem: str | None = None


@dataclass(frozen=True)
class Candidate:
    """An engine by name: itself, or None and why."""

    name: str
    engine: Engine | None
    note: str


@dataclass(frozen=True)
class Survey:
    """What was looked for and what was found."""

    embedded: Candidate
    compiler: CCompiler | None
    cache: Cache
    examined: list[Examined] = field(default_factory=list)

    def candidates(self) -> list[Candidate]:
        """The embedded engine, then each line of matiec; the first installation of a line represents it."""
        return [self.embedded, *(self._line(name) for name in MATIEC_NAMES)]

    def _line(self, name: str) -> Candidate:
        for each in self.examined:
            if each.engine is not None and each.engine.name == name:
                return Candidate(name, each.engine, each.iec2c)
        problems = [f"{each.iec2c}: {each.problem}" for each in self.examined if each.problem]
        if problems:
            return Candidate(name, None, "; ".join(problems))
        others = [each.iec2c for each in self.examined]
        return Candidate(name, None, f"no iec2c of this line found (only {', '.join(others)})" if others else NO_IEC2C)


NO_IEC2C = "no iec2c found (looked on PATH and in MATIEC_HOME)"


def survey(environment: Mapping[str, str] = os.environ) -> Survey:
    compiler = find_c_compiler(environment)
    cache = Cache(cache_folder(environment))
    examined = [_examine(each, compiler, cache) for each in look_everywhere(environment)]
    return Survey(_embedded(), compiler, cache, examined)


def _examine(found: Installation | Useless, compiler: CCompiler | None, cache: Cache) -> Examined:
    if isinstance(found, Useless):
        return Examined(str(found.iec2c), problem=found.why)
    seen = Examined(str(found.iec2c), str(found.library))
    if compiler is None:
        return replace(seen, problem=NO_COMPILER)
    try:
        engine = MatiecEngine(found, compiler, cache=cache)
        behaviour = observe(engine)
    except EngineError as error:
        return replace(seen, problem=str(error))
    return replace(seen, engine=replace(engine, name=f"matiec-{behaviour.line}"), behaviour=behaviour)


def _embedded() -> Candidate:
    try:
        from structured_text.engines.embedded import EmbeddedEngine
    except (ImportError, SyntaxError) as error:
        return Candidate(EMBEDDED, None, f"cannot be imported: {error}")
    return Candidate(EMBEDDED, EmbeddedEngine(), "part of DriveBlocks")
