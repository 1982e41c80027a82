"""The virtual line in C around the matiec build: translate, compile, run, read what it prints.

`python -m tests.line.cline random SEED 1 KIND` runs one random line again; `run KEY=VALUE ...` any line.
"""

import re
import subprocess
import sys
import tempfile
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from tests.blocks.library import BLOCKS
from tests.blocks.toolchains import COMPILER, FOUND, translate
from tests.line.drives import header

from structured_text.engines.matiec.installation import Installation

HERE = Path(__file__).parent
WHY_NOT = "" if FOUND and COMPILER else "the line in C needs iec2c and a C compiler; `driveblocks doctor` tells more"


@dataclass(frozen=True)
class Ran:
    """What a run has printed: figures by name, and a line for each failure."""

    figures: Mapping[str, float]
    failures: tuple[str, ...]

    def __getitem__(self, name: str) -> float:
        """One figure."""
        return self.figures[name]

    def told(self, words: str) -> str:
        """Words with figures in them, as in `{refresh_ms:.0f} ms`."""
        return words.format_map(self.figures)


@dataclass(frozen=True)
class CLine:
    """A compiled virtual line."""

    program: Path

    def run(self, mode: str, *words: str, **keys: int) -> Ran:
        """Run it. Raises ValueError for what it does not understand."""
        command = [str(self.program), mode, *words, *(f"{key}={int(value)}" for key, value in keys.items())]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        lines = done.stdout.splitlines()
        if done.returncode not in (0, 1):
            raise ValueError(done.stderr + done.stdout)
        failures = tuple(line for line in lines if line.startswith("failure seed"))
        rows = (line.split() for line in lines if line not in failures)
        return Ran({name: float(value) for name, value in rows}, failures)

    def random(self, first: int, count: int, kind: str) -> Ran:
        """So many random lines of a kind, by seeds that follow each other."""
        return self.run("random", str(first), str(count), kind)


def texts(slots: int = 8) -> list[str]:
    """The files of the library that a line of this many slots needs."""
    names = (BLOCKS / "order.txt").read_text(encoding="utf-8").split()
    own = [name for name in names if name.startswith(("types/", "modbus/MB_Hex", "line/")) and "ByteLine" not in name]
    sizes = {name: re.search(r"(?:Slots|Tracks|Line)(\d+)\.st$", name) for name in own}
    wanted = [name for name, size in sizes.items() if size is None or int(size[1]) == slots]
    return [(BLOCKS / name).read_text(encoding="utf-8") for name in wanted]


def build(
    folder: Path,
    slots: int = 8,
    tool: Installation | None = None,
    flags: tuple[str, ...] = ("-O2",),
) -> CLine:
    """Compile a line of this many slots in a folder. Raises AssertionError."""
    tool = tool or FOUND[0]
    translate(tool, texts(slots), folder)
    (folder / "drives.h").write_text(header(), encoding="utf-8")
    program = folder / f"vline{slots}"
    headers = ["-isystem", str(tool.library / "C"), "-I", "."]
    command = [
        str(COMPILER),
        *flags,
        "-w",
        f"-DSLOT_COUNT={slots}",
        *headers,
        str(HERE / "vline.c"),
        "-o",
        str(program),
    ]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr[:4000]
    return CLine(program)


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as temporary:
        sys.exit(subprocess.run([build(Path(temporary)).program, *sys.argv[1:]], check=False).returncode)
