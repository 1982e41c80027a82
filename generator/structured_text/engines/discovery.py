"""Which engines run on this machine, which do not, and why."""

import os
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Literal

from structured_text.engines.engine import Engine, EngineError, Source
from structured_text.engines.matiec.cache import Cache, cache_folder
from structured_text.engines.matiec.ccompiler import CCompiler, find_c_compiler
from structured_text.engines.matiec.engine import MatiecEngine
from structured_text.engines.matiec.installation import Installation, Useless, look_everywhere

Line = Literal["beremiz", "openplc"]

_PROBE = Source(
    "probe.st",
    """FUNCTION_BLOCK LineProbe
  VAR_OUTPUT
    Turns : INT;
    Falling : BOOL;
    Same : BOOL;
  END_VAR
  VAR
    Turn : INT;
    Edge : F_TRIG;
    Nothing : STRING;
  END_VAR
  FOR Turn := 5 TO 5 DO
    Turns := Turns + 1;
  END_FOR;
  Edge(CLK := FALSE);
  Falling := Edge.Q;
  Same := Nothing = 'x';
END_FUNCTION_BLOCK
""",
)


@dataclass(frozen=True)
class Behaviour:
    """How often `FOR 5 TO 5` turns; whether F_TRIG fires on its first scan; whether '' = 'x'."""

    for_turns: int
    f_trig_fires_at_once: bool
    empty_equals_x: bool

    @property
    def line(self) -> Line:
        """The line that most traits belong to."""
        beremiz = [self.for_turns == 0, self.f_trig_fires_at_once, not self.empty_equals_x]
        return "beremiz" if sum(beremiz) > len(beremiz) // 2 else "openplc"

    @property
    def pure(self) -> bool:
        """Whether every trait is that of the line."""
        return len({self.for_turns == 0, self.f_trig_fires_at_once, not self.empty_equals_x}) == 1


def observe(engine: MatiecEngine) -> Behaviour:
    """Build and run a probe; the build cache remembers it by the content of the tools. Raises EngineError."""
    try:
        probe = engine.build([_PROBE]).instance("LineProbe")
        probe.scan(0)
        state = probe.state()
    except KeyError as error:
        raise EngineError(f"{engine.installation.iec2c} compiled a probe to something else: no {error}") from error
    turns = state["TURNS"]
    return Behaviour(turns if isinstance(turns, int) else 0, state["FALLING"] is True, state["SAME"] is True)


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
