"""From a fresh clone to a result in one command, with nothing but Python 3.11 or newer and git.

    python3 generator/bootstrap.py demo    set up, then run the main job on the drives of vendor_maps/
    python3 generator/bootstrap.py test    set up, then run every test, as continuous integration does

Both make a virtual environment `.venv` in the checkout and install the project and what it needs into it.
"""

import hashlib
import os
import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
VENV = ROOT / ".venv"
CONSTRAINTS = "constraints.txt"
BIN = VENV / ("Scripts" if os.name == "nt" else "bin")

DEMO = (
    ("check the vendor maps", "driveblocks", "check"),
    ("build their function blocks", "driveblocks", "build"),
    ("test the blocks against the manuals", "driveblocks", "test"),
    ("look for other ST compilers", "driveblocks", "doctor"),
)
TEST = (
    ("lint", "ruff", "check", "."),
    ("format", "ruff", "format", "--check", "."),
    ("types", "mypy"),
    ("tests", "pytest", "-n", "auto", "--cov", "--cov-report=term", "--cov-fail-under=90"),
)


def main(arguments: list[str]) -> int:
    """Set up and run one of the two jobs. Returns the exit status: 0 good, 1 a step failed, 2 wrong call or machine."""
    jobs = {"demo": (DEMO, ""), "test": (TEST, "[test]")}
    if len(arguments) != 1 or arguments[0] not in jobs:
        print(__doc__, file=sys.stderr)
        return 2
    if sys.version_info < (3, 11):  # noqa: UP036  (this file runs before pip can refuse an old Python)
        print(f"Python 3.11 or newer is needed; this is {sys.version.split()[0]}", file=sys.stderr)
        return 2
    steps, extra = jobs[arguments[0]]
    if not set_up(extra):
        return 2
    return run(steps)


def set_up(extra: str) -> bool:
    """Make `.venv` and install the project with an extra ("" or "[test]") into it, unless that was done before."""
    needs = b"".join((ROOT / name).read_bytes() for name in ("pyproject.toml", CONSTRAINTS))
    wanted = hashlib.sha256(needs + extra.encode()).hexdigest()
    stamp = VENV / f"driveblocks{extra.strip('[]')}.stamp"
    if stamp.exists() and stamp.read_text(encoding="utf-8") == wanted:
        return True
    say(f"set up {VENV.name}/ (a minute or two)")
    if not (BIN / "python").exists() and not (BIN / "python.exe").exists() and not make_venv():
        return False
    install = [str(BIN / "python"), "-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--editable"]
    if subprocess.run([*install, f".{extra}", "--constraint", CONSTRAINTS], cwd=ROOT, check=False).returncode:
        print("pip could not install the packages; is a package index reachable?", file=sys.stderr)
        return False
    stamp.write_text(wanted, encoding="utf-8")
    return True


def make_venv() -> bool:
    """Make the virtual environment; say what is missing where Python came without its venv module."""
    if subprocess.run([sys.executable, "-m", "venv", str(VENV)], check=False).returncode:
        print(
            "Python cannot make a virtual environment; on Debian and Ubuntu: apt install python3-venv", file=sys.stderr
        )
        return False
    return True


def run(steps: tuple[tuple[str, ...], ...]) -> int:
    """Run every step, also after one failed, and say at the end what happened. Returns 0 or 1."""
    results = []
    for title, command, *arguments in steps:
        say(title)
        start = time.monotonic()
        status = subprocess.run([str(BIN / command), *arguments], cwd=ROOT, check=False).returncode
        results.append((command, arguments, status, time.monotonic() - start))
    say("result")
    for command, arguments, status, seconds in results:
        print(f"{'ok    ' if status == 0 else 'FAILED'} {seconds:6.1f} s  {command} {' '.join(arguments)}")
    return 1 if any(status for _, _, status, _ in results) else 0


def say(title: str) -> None:
    """Print a heading at once, before what the step itself prints."""
    if title:
        print(f"\n== {title}", flush=True)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
