"""What ends a scan that traps or never ends: a small C library, one for the whole process since it takes signals."""

import ctypes
import hashlib
import json
import sys
from importlib.resources import files
from pathlib import Path

from structured_text.engines.engine import EngineError
from structured_text.engines.matiec.cache import Cache
from structured_text.engines.matiec.ccompiler import CCompiler, Flags, Job
from structured_text.files import put

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
