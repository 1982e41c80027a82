"""The C compiler that turns what iec2c wrote into a shared library."""

import os
import re
import shlex
import shutil
import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import lru_cache
from pathlib import Path

from structured_text.engines.engine import EngineError, Message
from structured_text.engines.matiec.c_lines import LineTable
from structured_text.engines.matiec.errors import BadCError, CompilerCrashError
from structured_text.engines.matiec.process import Outcome, run
from structured_text.engines.matiec.runtime import POUS_MOVED
from structured_text.engines.matiec.text import Listing

VERSION_SECONDS = 20.0

# iec2c writes C that leans on what compilers do, not on the C standard: signed sums wrap, a type is read as another.
# FMA is off and the language version fixed, so that every machine computes the same.
_FIXED_FLAGS = (
    "-std=gnu11", "-fPIC", "-shared", "-fwrapv", "-fno-strict-aliasing", "-ffp-contract=off", "-fcommon", "-pthread",
    "-Wno-parentheses-equality",  # clang, on every `IF` there is
)  # fmt: skip

_MESSAGE = re.compile(r"^(?P<path>[^\s:][^:\n]*):(?P<line>\d+)(?::(?P<column>\d+))?: (?P<kind>[a-z ]+): (?P<text>.*)$")
_LINKER = re.compile(r"undefined reference to|multiple definition of|Undefined symbols|duplicate symbol")


@dataclass(frozen=True)
class Flags:
    """How to compile: the -O level, more options, whether to count how often lines run.

    For `-fsanitize=address` Python must run with the sanitizer's library in LD_PRELOAD and with PYTHONMALLOC=malloc,
    so that the memory of every instance is the sanitizer's.
    """

    optimise: str = "1"
    extra: tuple[str, ...] = ()
    coverage: bool = False

    @property
    def sanitized(self) -> bool:
        """Whether a sanitizer is built in, which has signals and undefined symbols of its own."""
        return any(each.startswith("-fsanitize") for each in self.extra)

    @property
    def arguments(self) -> list[str]:
        """What to put on the command line."""
        whole = ["-Wl,-z,defs"] if sys.platform == "linux" and not self.sanitized else []
        return [*_FIXED_FLAGS, *whole, f"-O{self.optimise}", *self.extra]


@dataclass(frozen=True)
class CCompiler:
    """A C compiler: the command that runs it and the first line of its `--version`."""

    command: tuple[str, ...]
    version: str
    seconds: float = 300.0

    def compile(self, job: "Job") -> list[Message]:
        """Make the shared library; give the warnings back, those on the ST on lines of the joined text.

        Raises BadCError with the compiler's messages, CompilerCrashError, CompilerTimeoutError, EngineError.
        """
        includes = ["-I.", "-isystem", str(job.headers)]  # warnings about matiec's own headers help nobody here
        command = [*self.command, *job.flags.arguments, *includes, "-o", job.output, *job.files, "-lm"]
        outcome = run(command, job.directory, self.seconds)
        messages = _messages(outcome.output, job.lines)
        if outcome.status == 0 and (job.directory / job.output).is_file():
            return [message for kind, message in messages if kind == "warning"]
        errors = job.listing.locate(message for kind, message in messages if kind != "warning")
        raise self._failure(outcome, errors)

    def _failure(self, outcome: Outcome, errors: list[Message]) -> EngineError:
        if signal := outcome.signal_name:
            return CompilerCrashError(f"{self.command[0]} crashed ({signal}): {outcome.output.strip()[:2000]}")
        if outcome.status == 0:
            return EngineError(f"{self.command[0]} said that it was done but wrote no library")
        if errors:
            return BadCError(errors)
        return EngineError(f"{self.command[0]} failed with status {outcome.status}: {outcome.output.strip()[:2000]}")


@dataclass(frozen=True)
class Job:
    """What to compile: files of `directory` into `output`; `lines` and `listing` lead messages back to the ST."""

    directory: Path
    files: Sequence[str]
    output: str
    headers: Path
    flags: Flags
    listing: Listing = field(default_factory=lambda: Listing(()))
    lines: LineTable = field(default_factory=LineTable)


def _messages(output: str, lines: LineTable) -> list[tuple[str, Message]]:
    found = []
    for line in output.splitlines():
        if match := _MESSAGE.match(line):
            if match["kind"] != "note":
                found.append((match["kind"], _message(match, lines)))
        elif _LINKER.search(line):
            found.append(("error", Message("linker", 0, 0, line.strip())))
    return found


def _message(match: re.Match[str], lines: LineTable) -> Message:
    line = lines.line(int(match["line"])) if Path(match["path"]).name == POUS_MOVED else 0
    if line:  # the column is one of the C, and says nothing about the ST
        return Message(Listing.NAME, line, 0, f"in the C made from this line: {match['text']}")
    return Message(match["path"], int(match["line"]), int(match["column"] or 0), match["text"])


def find_c_compiler(environment: Mapping[str, str] = os.environ) -> CCompiler | None:
    """CC, else cc, gcc, clang on PATH; None if there is none that reports its version."""
    named = environment.get("CC", "").strip()
    for words in [shlex.split(named)] if named else [["cc"], ["gcc"], ["clang"]]:
        program = shutil.which(words[0], path=environment.get("PATH"))
        version = _version((program, *words[1:])) if program else None
        if program and version:
            return CCompiler((program, *words[1:]), version)
    return None


@lru_cache
def _version(command: tuple[str, ...]) -> str | None:
    try:
        outcome = run([*command, "--version"], Path.cwd(), VERSION_SECONDS)
    except EngineError:
        return None
    first = outcome.output.strip().partition("\n")[0]
    return f"{first} ({sys.platform})" if outcome.status == 0 and first else None
