"""A shared library in this process, and all that is known of how it was made."""

import ctypes
import hashlib
import json
import signal
import sys
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from importlib.resources import files
from pathlib import Path

from structured_text.engines.engine import EngineError, Message
from structured_text.engines.matiec.cache import Cache
from structured_text.engines.matiec.ccompiler import CCompiler, Flags, Job
from structured_text.engines.matiec.counters import Counters
from structured_text.engines.matiec.declarations import Declarations
from structured_text.engines.matiec.plan import Plan
from structured_text.files import put

_TRAPS = {
    signal.SIGFPE: "a division by zero, or of the least integer by -1",
    signal.SIGSEGV: "an access to memory that is not there, as by an array index far out of its bounds",
}


@dataclass
class Binary:
    """The shared library and the C functions in it, by name."""

    path: Path
    handle: ctypes.PyDLL = field(init=False)

    def __post_init__(self) -> None:
        """Load it. Raises EngineError."""
        try:
            self.handle = ctypes.PyDLL(str(self.path))
        except OSError as error:
            raise EngineError(f"cannot load the library that the C compiler made: {error}") from error

    def attach(self, guard: ctypes.c_void_p | None) -> None:
        """Let `guard` run the scans."""
        self.function("dbk_attach", ctypes.c_void_p)(guard)

    def function(self, name: str, *arguments: type[ctypes.c_void_p | ctypes.c_int64]) -> Callable[..., int]:
        """Give a C function that takes `arguments` and gives an int64."""
        found = self.handle[name]
        found.argtypes = arguments
        found.restype = ctypes.c_int64
        return found

    def sizes(self, count: int) -> list[int]:
        """Read the table of sizes and offsets."""
        return list((ctypes.c_int64 * max(count, 1)).in_dll(self.handle, "dbk_sizes"))

    def counts(self, table: str, size: int) -> list[int]:
        """Read the counters `dbk_hits` or `dbk_begun`."""
        return list((ctypes.c_uint64 * size).in_dll(self.handle, table))


@dataclass(frozen=True)
class Built:
    """All that is known of a build."""

    folder: Path
    binary: Binary
    plan: Plan
    declared: Declarations
    warnings: tuple[Message, ...]
    places: Mapping[str, tuple[str, int]]
    counters: Counters | None

    def place(self, name: str) -> tuple[str, int]:
        """File and line where a block or function is declared; line 0 if that is not in the sources."""
        return self.places.get(name, (name, 0))


def cause(number: int) -> str:
    """Say what ended a scan with this signal."""
    if number == getattr(signal, "SIGVTALRM", None):
        return "the watchdog: it took many seconds, so it holds a loop without end"
    name = signal.Signals(number).name
    return f"{name}: {_TRAPS[signal.Signals(number)]}" if number in _TRAPS else name


# A scan takes microseconds; one that takes so much processor time will never end.
SCAN_SECONDS = 10.0
_TICK_SECONDS = 0.25

_TEXT = (files("structured_text.engines.matiec") / "guard.c").read_text(encoding="utf-8")
_SOURCE, _LIBRARY = "guard.c", "guard.so"

# Whichever compiler made it: a second one would take the signals of the first.
_loaded: list[ctypes.PyDLL] = []


def load_guard(compiler: CCompiler, cache: Cache) -> ctypes.c_void_p | None:
    """Give the address of the C function that runs scans; None on Windows, where a trap ends the process.

    Raises EngineError if it cannot be built or loaded.
    """
    if sys.platform == "win32":
        return None
    if not _loaded:
        _loaded.append(_load(compiler, cache))
    start = _loaded[0].dbk_start
    start.argtypes = [ctypes.c_int64]
    start(int(SCAN_SECONDS / _TICK_SECONDS))
    return ctypes.cast(_loaded[0].dbk_guard, ctypes.c_void_p)


def _load(compiler: CCompiler, cache: Cache) -> ctypes.PyDLL:
    parts = json.dumps([_TEXT, *compiler.command, compiler.version, *Flags().arguments])

    def make(folder: Path) -> None:
        put(folder / _SOURCE, _TEXT, new=True, sync=False)
        compiler.compile(Job(folder, [_SOURCE], _LIBRARY, folder, Flags()))

    folder = cache.entry(hashlib.sha256(parts.encode()).hexdigest(), make)
    try:
        return ctypes.PyDLL(str(folder / _LIBRARY))
    except OSError as error:
        raise EngineError(f"cannot load the library that the C compiler made: {error}") from error
