"""The jobs that the pages show to users, and their lines run as a shell script from a fresh clone.

With `pip`, a new virtual environment and a package index, in two minutes:

    python -m tests.commands.ci_jobs
"""

import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

import yaml

ROOT = Path(__file__).parents[2]
PAGE = ROOT / "docs" / "ci.md"
EXAMPLE = ROOT / "tests" / "maps" / "example.yaml"
INSTALL = 'pip install "$DRIVEBLOCKS"'
LIMIT = 300
"""Seconds that a command may hang before it is ended."""

Job = dict[str, Any]


def jobs(page: Path) -> dict[str, Job]:
    """The files for `github` and `gitlab` that a page shows between fences of YAML, parsed."""
    found = {}
    for text in re.findall(r"^```yaml\n(.*?)^```$", page.read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL):
        file = yaml.safe_load(text)
        if "jobs" in file:
            found["github"] = file
        elif any("script" in job for job in file.values()):
            found["gitlab"] = file
    return found


def lines(file: Job) -> list[str]:
    """The shell lines of the one job of a file, in order."""
    if "jobs" in file:
        (job,) = file["jobs"].values()
        return [step["run"] for step in job["steps"] if "run" in step]
    (job,) = file.values()
    script: list[str] = job["script"]
    return script


def clone(folder: Path, *options: str) -> Path:
    """A fresh clone of what is committed, with options for git. Raises CalledProcessError."""
    made = folder / "clone"
    subprocess.run(["git", "clone", "--quiet", *options, ROOT.as_uri(), str(made)], check=True, timeout=LIMIT)
    return made


def environment(venv: Path, source: str) -> dict[str, str]:
    """What the script sees: the tools of a virtual environment before all others, and where DriveBlocks is."""
    kept = {name: value for name, value in os.environ.items() if not name.startswith(("PYTHON", "COV_"))}
    path = os.pathsep.join([str(venv / "bin"), os.environ.get("PATH", os.defpath)])
    return kept | {"PATH": path, "VIRTUAL_ENV": str(venv), "DRIVEBLOCKS": source}


def run(script: list[str], folder: Path, seen: dict[str, str]) -> "subprocess.CompletedProcess[str]":
    """Run lines as a job does: in one folder, until one fails."""
    command = ["bash", "-e", "-o", "pipefail", "-c", "\n".join(script)]
    return subprocess.run(
        command, cwd=folder, env=seen, capture_output=True, encoding="utf-8", timeout=LIMIT, check=False
    )


def main() -> int:
    """Run every line of both jobs, `pip` among them, in environments of their own. Returns 0, or 1 if one fails."""
    if shallow():
        print("needs a whole clone, `git fetch --unshallow`: pip's partial clone of a shallow one never ends")
        return 1
    for name, file in jobs(PAGE).items():
        with tempfile.TemporaryDirectory() as folder:
            done = from_nothing(Path(folder), lines(file))
        print(f"== {name}\n{done.stdout}{done.stderr}{name}: {'FAILED' if done.returncode else 'passed'}", flush=True)
        if done.returncode:
            return 1
    return 0


def shallow() -> bool:
    """Whether this checkout has only the end of its history."""
    command = ["git", "rev-parse", "--is-shallow-repository"]
    return subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True).stdout.strip() == "true"


def from_nothing(folder: Path, script: list[str]) -> "subprocess.CompletedProcess[str]":
    """Clone, make a virtual environment and a user's folder with a good map, and run the script there.

    After it, the built blocks and the report are looked for, so that the status is 0 only if both are there.
    """
    source, venv, mine = clone(folder), folder / "venv", folder / "mine"
    subprocess.run([sys.executable, "-m", "venv", str(venv)], check=True, timeout=LIMIT)
    mine.mkdir()
    shutil.copy(EXAMPLE, mine / "my_drive.yaml")
    there = ["test -d blocks/iec61131/my_drive", "test -s report.xml"]
    return run(script + there, mine, environment(venv, f"git+{source.as_uri()}"))


if __name__ == "__main__":
    sys.exit(main())
