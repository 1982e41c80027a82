"""A copy of the checkout, in which a file is changed and a judge runs; the checkout itself is never touched."""

import os
import shlex
import shutil
import signal
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[2]
LEFT_OUT = (".git", ".venv", "dist", "__pycache__", ".hypothesis", ".mypy_cache", ".pytest_cache", ".ruff_cache")
END_S = 1200
"""After this long a judge is taken not to end."""


class Checkout:
    """The copy, in a folder that is not there yet."""

    def __init__(self, folder: Path) -> None:
        """Copy the tree."""
        self.folder = folder
        self.turn = 0
        shutil.copytree(ROOT, folder, ignore=shutil.ignore_patterns(*LEFT_OUT))

    def write(self, file: str, text: str) -> None:
        """Replace a file; its time moves on by seconds, so that no compiled module passes for it."""
        path = self.folder / file
        path.write_text(text, encoding="utf-8", newline="")
        self.turn += 2
        later = path.stat().st_mtime + self.turn
        os.utime(path, (later, later))

    def read(self, file: str) -> str:
        """The text of a file, with its own line ends."""
        return (self.folder / file).read_bytes().decode()

    def build(self, options: str = "") -> bool:
        """Build `blocks/` anew; whether it could be built."""
        return self.run(f"python -m driveblocks build --force {options}") == 0

    def restore(self) -> None:
        """Bring `blocks/` back as it is in the checkout."""
        shutil.rmtree(self.folder / "blocks")
        shutil.copytree(ROOT / "blocks", self.folder / "blocks")

    def run(self, command: str) -> int | None:
        """The exit status of a command in the copy; None: it does not end."""
        words = shlex.split(command)
        words[0] = sys.executable if words[0] == "python" else words[0]
        ways = {"PYTHONPATH": str(self.folder / "generator"), "PYTHONPYCACHEPREFIX": str(self.folder / ".pycache")}
        quiet = subprocess.DEVNULL
        done = subprocess.Popen(
            words, cwd=self.folder, env={**os.environ, **ways}, stdout=quiet, stderr=quiet, start_new_session=True
        )
        try:
            return done.wait(END_S)
        except subprocess.TimeoutExpired:
            os.killpg(done.pid, signal.SIGKILL)
            done.wait()
            return None
