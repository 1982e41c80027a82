"""Distinguish the two lines of matiec by what they do: their versions are the same, and copies are patched.

The traits are those in which they were measured to differ; a copy that has some of each counts as the majority says.
"""

from dataclasses import dataclass
from typing import Literal

from structured_text.engines.engine import EngineError, Source
from structured_text.engines.matiec.engine import MatiecEngine

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
