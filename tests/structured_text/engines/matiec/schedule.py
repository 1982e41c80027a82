"""A whole CONFIGURATION on matiec."""

import ctypes
import shutil
import tempfile
from collections.abc import Iterator
from pathlib import Path

from structured_text.engines.engine import EngineError, Message, ScanError, Value
from structured_text.engines.matiec.binary import Binary, Built, cause
from structured_text.engines.matiec.header import ConfigurationC
from structured_text.engines.matiec.layout import Memory
from structured_text.engines.matiec.library import MatiecLibrary
from structured_text.engines.matiec.paths import Paths
from structured_text.engines.matiec.plan import Plan


class MatiecConfiguration:
    """A CONFIGURATION on virtual time. Its variables are static in the C, so each has its own library, `binary`."""

    def __init__(self, built: Built, configuration: ConfigurationC) -> None:
        """Load a copy of the library and let the C initialise it."""
        self.binary = _private(built.binary)
        self._name = configuration.name
        self._place = built.place(configuration.name)
        self._run = self.binary.function("dbk_config_run", ctypes.c_int64, ctypes.c_int64)
        self._now = 0
        self._tick = self.binary.function("dbk_config_tick")()
        self._roots = dict(self._find(built.plan, configuration))
        self.binary.function("dbk_config_init")()

    def _find(self, plan: Plan, configuration: ConfigurationC) -> Iterator[tuple[str, tuple[Memory, Paths]]]:
        """Path -> memory of every global and program; those of a resource carry its name."""
        nodes = [(each.owner, each.name, plan.globals[each.owner, each.name]) for each in configuration.globals]
        nodes += [(owner, name, plan.blocks[type_name]) for owner, name, type_name in configuration.programs]
        addresses = self.binary.places(len(nodes))
        for (owner, name, node), address in zip(nodes, addresses, strict=False):
            path = name if owner == configuration.name else f"{owner}.{name}"
            yield path, ((ctypes.c_char * node.size).from_address(address or 0), Paths(node))

    @property
    def tick_ns(self) -> int:
        """The common tick."""
        return self._tick

    def _split(self, path: str) -> tuple[Memory, Paths, str]:
        """The root that a path starts with, and what is left of the path."""
        upper = path.upper()
        for root, (memory, paths) in self._roots.items():
            if upper == root or (upper.startswith(root) and upper[len(root)] in ".["):
                rest = path[len(root) :]
                return memory, paths, rest.removeprefix(".")
        raise KeyError(path)

    def __getitem__(self, path: str) -> Value:
        """Read a variable."""
        memory, paths, rest = self._split(path)
        return paths.read(memory, rest)

    def __setitem__(self, path: str, value: Value) -> None:
        """Write a variable."""
        memory, paths, rest = self._split(path)
        paths.write(memory, rest, value)

    def run(self, ticks: int = 1) -> None:
        """Run this many ticks."""
        trap = self._run(self._now, ticks)
        self._now += ticks * self._tick
        if trap:
            raise ScanError(Message(*self._place, 0, f"{self._name}: the run was stopped by {cause(trap)}"))

    def state(self) -> dict[str, Value]:
        """Read every variable."""
        found: dict[str, Value] = {}
        for root, (memory, paths) in self._roots.items():
            found.update((path, leaf.read(memory, offset)) for path, offset, leaf in paths.root.leaves(root, 0))
        return found


def _private(binary: Binary) -> Binary:
    """Load a copy of a library; the same file would give the same variables again."""
    folder = Path(tempfile.mkdtemp(prefix="driveblocks-"))
    try:
        copy = Binary(Path(shutil.copy(binary.path, folder)))
    except OSError as error:
        raise EngineError(f"cannot copy the library of the configuration: {error.strerror}") from error
    finally:  # what is loaded stays loaded; Windows keeps the file until the process ends
        shutil.rmtree(folder, ignore_errors=True)
    copy.attach(binary.guard)
    return copy


def start(library: MatiecLibrary, name: str | None = None) -> MatiecConfiguration:
    """Start the CONFIGURATION with variables of its own. KeyError."""
    found = library.built.configuration
    if found is None or (name is not None and name.upper() != found.name):
        raise KeyError(f"there is no configuration {name}" if name else "there is no configuration")
    made = MatiecConfiguration(library.built, found)
    library.counting.append(made.binary)
    return made
