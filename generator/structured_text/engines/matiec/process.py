"""Run a compiler as a child process that can neither hang us nor flood us."""

import contextlib
import os
import signal
import subprocess
import sys
import threading
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from structured_text.engines.engine import EngineError
from structured_text.engines.matiec.errors import CompilerTimeoutError

# A compiler that prints more than this says nothing that a person would read.
OUTPUT_LIMIT = 1 << 20
# iec2c can go on allocating after a syntax error until the machine has no memory left.
MEMORY_LIMIT = 4 << 30


@dataclass(frozen=True)
class Outcome:
    """How a child ended: its exit status (negative: the signal that killed it) and all that it printed."""

    status: int
    output: str

    @property
    def signal_name(self) -> str | None:
        """The signal that ended it (also as a shell reports it, 128 + number), or None."""
        number = -self.status if self.status < 0 else self.status - 128
        with contextlib.suppress(ValueError):
            return signal.Signals(number).name
        return f"signal {number}" if self.status < 0 else None


class _Reader(threading.Thread):
    """Drains the child's output, so that a full pipe never blocks it; keeps the first OUTPUT_LIMIT bytes."""

    def __init__(self, child: subprocess.Popen[bytes]) -> None:
        super().__init__(daemon=True)
        self.data = bytearray()
        self.flooded = False
        self._child = child

    def run(self) -> None:
        assert self._child.stdout is not None  # noqa: S101 - Popen got PIPE
        with contextlib.suppress(OSError, ValueError):
            while chunk := os.read(self._child.stdout.fileno(), 65536):
                self.data += chunk
                if len(self.data) > OUTPUT_LIMIT:
                    self.flooded = True
                    _kill(self._child)
                    return


def _kill(child: subprocess.Popen[bytes]) -> None:
    """Kill the child and whatever it started: a grandchild would keep the pipe open."""
    with contextlib.suppress(OSError):
        if sys.platform == "win32":
            child.kill()
        else:
            os.killpg(child.pid, signal.SIGKILL)


def _start(command: Sequence[str], directory: Path) -> subprocess.Popen[bytes]:
    try:
        child = subprocess.Popen(
            command,
            cwd=directory,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            env=_environment(),
            start_new_session=True,
        )
    except OSError as error:
        raise EngineError(f"cannot run {command[0]}: {error.strerror or error}") from error
    _limit_memory(child.pid)
    return child


def _environment() -> dict[str, str]:
    """Messages are parsed, so they must not be translated; what is preloaded into Python is meant for Python."""
    kept = {name: value for name, value in os.environ.items() if name != "LD_PRELOAD"}
    return kept | {"LC_ALL": "C"}


def _limit_memory(pid: int) -> None:
    if sys.platform == "linux":
        import resource

        with contextlib.suppress(OSError, ValueError):
            resource.prlimit(pid, resource.RLIMIT_AS, (MEMORY_LIMIT, MEMORY_LIMIT))


def run(command: Sequence[str], directory: Path, seconds: float) -> Outcome:
    """Run `command` in `directory` for at most `seconds`.

    Raises EngineError if it cannot be started or floods its output, CompilerTimeoutError if it does not end in time.
    """
    child = _start(command, directory)
    reader = _Reader(child)
    reader.start()
    try:
        status = child.wait(seconds)
    except subprocess.TimeoutExpired as error:
        raise CompilerTimeoutError(f"{command[0]} did not end within {seconds:g} s and was stopped") from error
    finally:
        _kill(child)
        child.wait()
        reader.join(5.0)
        if child.stdout:
            child.stdout.close()
    if reader.flooded:
        raise EngineError(f"{command[0]} printed more than {OUTPUT_LIMIT} bytes and was stopped")
    return Outcome(status, reader.data.decode("utf-8", "replace"))
