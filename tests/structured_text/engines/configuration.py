"""A whole CONFIGURATION on virtual time, on every engine: only tests run one."""

from typing import Protocol

from tests.structured_text.engines.embedded import schedule as on_embedded
from tests.structured_text.engines.matiec import schedule as on_matiec

from structured_text.engines.embedded import EmbeddedLibrary
from structured_text.engines.engine import Library, Value
from structured_text.engines.matiec.library import MatiecLibrary


class Configuration(Protocol):
    """A whole CONFIGURATION that runs its tasks on virtual time."""

    @property
    def tick_ns(self) -> int:
        """The common tick of all tasks in nanoseconds."""

    def __getitem__(self, path: str) -> Value:
        """Read `Resource.Program.Variable` or a global."""

    def __setitem__(self, path: str, value: Value) -> None:
        """Write `Resource.Program.Variable` or a global."""

    def run(self, ticks: int = 1) -> None:
        """Run this many ticks; each runs the tasks that are due, then advances the clock by `tick_ns`."""

    def state(self) -> dict[str, Value]:
        """Every scalar of the configuration, path in upper case -> value."""


def start(library: Library, name: str | None = None) -> Configuration:
    """Start the CONFIGURATION of that name, or the only one. KeyError; TypeError for another engine."""
    if isinstance(library, EmbeddedLibrary):
        return on_embedded.start(library, name)
    if isinstance(library, MatiecLibrary):
        return on_matiec.start(library, name)
    raise TypeError(f"{type(library).__name__} runs no CONFIGURATION")
