"""The matiec engine: ST compiled by `iec2c` and a C compiler into a shared library that runs in this process.

    engine = MatiecEngine(find_installations()[0], find_c_compiler())
    block = engine.build([Source.read(path)]).instance("CrcTable")

Nothing of matiec is part of this package: `iec2c` and its library are looked for on the machine (`installation`).
A build runs: `translate` (iec2c, ST -> C), `header` and `declarations` (what the C and the ST declare), `runtime` (a
small C file of our own around it), `ccompiler` (-> shared library), `cache`, `layout` (bytes -> Python values).
"""

from structured_text.engines.matiec.ccompiler import CCompiler, Flags, find_c_compiler
from structured_text.engines.matiec.engine import MatiecEngine
from structured_text.engines.matiec.errors import (
    BadCError,
    CompilerCrashError,
    CompilerTimeoutError,
    RefusedWithCrashError,
)
from structured_text.engines.matiec.installation import Installation, find_installations

__all__ = [
    "BadCError", "CCompiler", "CompilerCrashError", "CompilerTimeoutError", "Flags", "Installation", "MatiecEngine",
    "RefusedWithCrashError", "find_c_compiler", "find_installations",
]  # fmt: skip
