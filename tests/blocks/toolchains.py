"""The library and its test programs through iec2c of each line, and their C through -Wall -Wextra.

The headers of iec2c's own library count as the system's: what they do is not ours. Some minutes for the programs:

    python -m tests.blocks.toolchains
"""

import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from tests.blocks.library import BLOCKS

from structured_text.engines.matiec.installation import Installation, find_installations

PROGRAMS = BLOCKS.parent / "tests" / "iec61131"
FOUND = find_installations()
COMPILER = shutil.which("cc") or shutil.which("gcc")
UNIT = """
#include "iec_std_lib.h"
#include "accessor.h"
#include "POUS.h"
TIME __CURRENT_TIME;
BOOL __DEBUG;
#include "POUS.c"
"""
HARMLESS = ("-Wno-unused-function", "-Wno-unused-parameter")
"""iec2c writes the whole of each block, whether anybody calls it, and parameters that only some functions use."""


def texts(folder: Path) -> list[str]:
    """The files of a folder in the order that it states."""
    names = (folder / "order.txt").read_text(encoding="utf-8").split()
    assert {path.relative_to(folder).as_posix() for path in folder.rglob("*.st")} == set(names)
    return [(folder / name).read_text(encoding="utf-8") for name in names]


def run(command: list[str], folder: Path) -> str:
    """Run a tool that must be content; what it says."""
    done = subprocess.run(command, cwd=folder, capture_output=True, timeout=600, check=False)
    said = (done.stdout + done.stderr).decode("utf-8", "replace")
    assert done.returncode == 0, said[:4000]
    return said


def translate(tool: Installation, sources: list[str], folder: Path) -> None:
    """ST to C without a word."""
    (folder / "all.st").write_text("\n".join(sources), encoding="utf-8")
    command = [str(tool.iec2c), "-f", "-p", "-i", "-I", str(tool.library), "-T", ".", "all.st"]
    said = run(command, folder)
    assert "warning" not in said, said


def compile_c(tool: Installation, folder: Path) -> None:
    """C to an object without a warning."""
    (folder / "unit.c").write_text(UNIT, encoding="utf-8")
    headers = ["-isystem", str(tool.library / "C"), "-I", "."]
    said = run([str(COMPILER), "-c", "-O1", "-Wall", "-Wextra", *HARMLESS, *headers, "unit.c"], folder)
    assert said == ""


def main() -> int:
    """Compile library and test programs together with each line that is found. Exit status 1 without any."""
    if COMPILER is None or not FOUND:
        print("needs iec2c and a C compiler; `driveblocks doctor` says what is missing")
        return 1
    for tool in FOUND:
        with tempfile.TemporaryDirectory() as folder:
            translate(tool, [*texts(BLOCKS), *texts(PROGRAMS)], Path(folder))
            compile_c(tool, Path(folder))
        print(f"{tool.iec2c}: library and test programs compile without a warning")
    return 0


if __name__ == "__main__":
    sys.exit(main())
