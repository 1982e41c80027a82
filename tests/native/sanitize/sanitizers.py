"""Which sanitizers a compiler has, and the options that turn them on so that the first find ends the program."""

import functools
import shutil
import subprocess
import tempfile
from dataclasses import dataclass
from pathlib import Path

from tests.native.driver import lines, version

from structured_text.engines.matiec import MatiecEngine

FIRM = ("-fno-sanitize-recover=all", "-fno-omit-frame-pointer", "-fno-wrapv", "-g1", "-O1")
"""`-fno-wrapv`: the blocks' sums must not wrap, so the sanitizer may look for it, though matiec's C is compiled with it
otherwise. `-O1`: as fast as -O2 here, and frames stay readable."""

GCC = ("-fsanitize=address,undefined,bounds-strict,float-cast-overflow,float-divide-by-zero",)
"""An array of ST is the only member of a C structure, so `bounds` alone takes it for one of open length: hence
`bounds-strict`, which sees an index that reaches the next variable of the same instance, as AddressSanitizer cannot."""

CLANG = (
    "-fsanitize=address,undefined,float-cast-overflow,float-divide-by-zero,"
    "implicit-unsigned-integer-truncation,implicit-signed-integer-truncation",
)
"""The last two see a sum that leaves its 16 bits, which wraps on one compiler and not on another."""
STRICT_ARRAYS = "-fstrict-flex-arrays=3"
"""clang 16 and later: what `bounds-strict` is to gcc; clang 14 and 15 do so on their own."""
CLANGS = ((*CLANG, STRICT_ARRAYS), CLANG)
"""What clang is asked for, the first that it knows."""

_PROBE = '#include <stdio.h>\nint main(int c, char **v) { int a[4] = {0}; printf("%d", a[c & 3]); return v == 0; }\n'


@dataclass(frozen=True)
class Checked:
    """A compiler with its sanitizers: `name` for reports, the command (none: the engine's own) and the options."""

    name: str
    command: tuple[str, ...]
    options: tuple[str, ...]


def compilers(engine: MatiecEngine) -> list[Checked]:
    """The engine's compiler, and gcc or clang beside it: one of each kind, if its sanitizers run here."""
    beside = ((path,) for name in ("gcc", "clang") if (path := shutil.which(name)))
    found: dict[str, Checked] = {}
    for command in (engine.compiler.command, *beside):
        name = "clang" if _is_clang(command) else "gcc"
        if name not in found and (checked := _checked(name, command)):
            found[name] = checked
    return list(found.values())


def why_none(engine: MatiecEngine) -> str:
    """What a test says that cannot run."""
    return f"{engine.compiler.command[0]}, gcc and clang lack the sanitizers' libraries (gcc: libasan, libubsan)"


@functools.cache
def _checked(name: str, command: tuple[str, ...]) -> Checked | None:
    for options in CLANGS if name == "clang" else (GCC,):
        if runs(command, (*options, *FIRM)):
            return Checked(name, command, (*options, *FIRM))
    return None


def _is_clang(command: tuple[str, ...]) -> bool:
    return "clang" in version(command)


@functools.cache
def runs(command: tuple[str, ...], options: tuple[str, ...], text: str = _PROBE) -> bool:
    """Whether a program compiles with these options, and ends well (libFuzzer: without inputs, after none)."""
    with tempfile.TemporaryDirectory() as folder:
        Path(folder, "probe.c").write_text(text, encoding="utf-8")
        build = [*command, *options, "-o", "probe", "probe.c"]
        if subprocess.run(build, cwd=folder, capture_output=True, check=False).returncode:
            return False
        program = str(Path(folder, "probe"))
        return (
            subprocess.run(
                [program, *(["-runs=0"] if "LLVMFuzzer" in text else [])], cwd=folder, capture_output=True, check=False
            ).returncode
            == 0
        )


def found_lines() -> list[MatiecEngine]:
    """The lines of matiec on this computer."""
    return list(lines())
