"""Drivers in C around the library as matiec translates it: programs, so that millions of scans cost no Python.

A driver is C text that is compiled after `prelude.h`, with the C of iec2c in the same unit. It prints what it found;
its exit status is 0 if all was well.
"""

import contextlib
import functools
import hashlib
import json
import os
import shutil
import subprocess
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from tests.blocks.library import alone

from structured_text.engines.discovery import MATIEC_NAMES, survey
from structured_text.engines.engine import EngineError, Source
from structured_text.engines.matiec import MatiecEngine
from structured_text.engines.matiec.cache import SEAL

PRELUDE = Path(__file__).with_name("prelude.h")
OPTIONS = ("-std=gnu11", "-fwrapv", "-fno-strict-aliasing", "-ffp-contract=off", "-w")
"""As the matiec engine compiles: iec2c writes C that leans on what compilers do. Its warnings are judged elsewhere."""
PROGRAM = "driver"


@dataclass(frozen=True)
class Driver:
    """C text and how to compile it; `compiler` is the engine's own unless another is named, such as clang."""

    text: str
    options: tuple[str, ...] = ("-O2",)
    compiler: tuple[str, ...] = ()
    prelude: bool = True

    def build(self, engine: MatiecEngine, texts: Sequence[Source] = ()) -> Path:
        """Compile it with the library (or other ST) as this line of matiec translates it, or take it from the cache.

        Gives the path of the program. Raises BuildError if the ST does not compile, EngineError with what the C
        compiler says if the C does not.
        """
        translated = engine.build(list(texts) or alone()).folder
        how = [self._command(engine), version(self.compiler)]
        key = json.dumps([self.text, PRELUDE.read_text("utf-8"), translated.name, *how])

        def make(folder: Path) -> None:
            self._compile(engine, translated, folder)

        return engine.cache.entry(hashlib.sha256(key.encode()).hexdigest(), make) / PROGRAM

    def _command(self, engine: MatiecEngine) -> list[str]:
        return [*(self.compiler or engine.compiler.command), *OPTIONS, *self.options]

    def _compile(self, engine: MatiecEngine, translated: Path, folder: Path) -> None:
        head = f'#include "{PRELUDE}"\n#line 1 "driver.c"\n' if self.prelude else ""
        (folder / "unit.c").write_text(head + self.text, encoding="utf-8")
        headers = ["-I", str(translated), "-isystem", str(engine.installation.headers)]
        command = [*self._command(engine), *headers, "-o", PROGRAM, "unit.c", "-lm"]
        done = subprocess.run(command, cwd=folder, capture_output=True, text=True, errors="replace", check=False)
        if done.returncode:
            raise EngineError(f"the driver does not compile: {done.stderr[:4000]}")


def run(program: Path, *arguments: object, seconds: float = 600.0) -> subprocess.CompletedProcess[str]:
    """Run a driver; its output as text. Raises subprocess.TimeoutExpired."""
    command = [str(program), *map(str, arguments)]
    with contextlib.suppress(OSError):
        os.utime(program.with_name(SEAL))  # used now: what is longest unused leaves the cache, also during a long run
    return subprocess.run(command, capture_output=True, text=True, errors="replace", timeout=seconds, check=False)


def lines() -> Iterator[MatiecEngine]:
    """The engine of each line of matiec that is found."""
    for each in survey().candidates():
        if each.name in MATIEC_NAMES and isinstance(each.engine, MatiecEngine):
            yield each.engine


def told_lines() -> str:
    """Which lines of matiec are found and which are not, and why: what a long run begins with."""
    found = [each for each in survey().candidates() if each.name in MATIEC_NAMES]
    return "\n".join(f"{each.name}: {'runs' if each.engine else 'does not run'}, {each.note}" for each in found)


@functools.cache
def version(compiler: tuple[str, ...]) -> str:
    """What a compiler says of its version, so that a new one makes new programs; nothing for the engine's own."""
    if not compiler:
        return ""
    done = subprocess.run([*compiler, "--version"], capture_output=True, text=True, errors="replace", check=False)
    return done.stdout


def clang() -> tuple[str, ...] | None:
    """The command of clang, if it is there."""
    found = shutil.which("clang")
    return (found,) if found else None
