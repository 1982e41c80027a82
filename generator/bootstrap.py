"""From a fresh clone to a result in one command, with nothing but Python 3.11 or newer and git.

    python3 generator/bootstrap.py demo    set up, then run the main job on the drives of vendor_maps/
    python3 generator/bootstrap.py test    set up, then run every test, as continuous integration does
    python3 generator/bootstrap.py test --quick    a part of them in under two minutes, and what it left out

All make a virtual environment `.venv` in the checkout and install the project and what it needs into it.
"""

import difflib
import hashlib
import os
import re
import subprocess
import sys
import time
from pathlib import Path

if sys.version_info < (3, 11):  # noqa: UP036  (this file runs before pip can refuse an old Python, and before `list[str]`)
    sys.stderr.write(f"Python 3.11 or newer is needed; this is {sys.version.split()[0]}, {sys.executable}\n")
    sys.exit(2)

ROOT = Path(__file__).resolve().parent.parent
VENV = ROOT / ".venv"
CONSTRAINTS = "constraints.txt"
BIN = VENV / ("Scripts" if os.name == "nt" else "bin")

DEMO = (
    ("check the vendor maps", "driveblocks", "check"),
    ("build their function blocks", "driveblocks", "build"),
    ("let three simulated motors turn (fifteen seconds)", "driveblocks", "run", "--demo"),
    ("test the blocks against the manuals (some seconds)", "driveblocks", "test"),
    ("look for other ST compilers", "driveblocks", "doctor"),
)
TEST = (
    ("lint", "ruff", "check", "."),
    ("format", "ruff", "format", "--check", "."),
    ("types", "mypy"),
    ("tests", "pytest", "-n", "auto", "--dist", "loadfile", "--cov", "--cov-report=term", "--cov-fail-under=90"),
)
QUICK = (
    "docs", "drives/test_start.py", "explain", "maps", "modbus", "reference", "render", "simulator",
    "structured_text/language",
)  # fmt: skip
"""Tests that answer soon: maps, their blocks as text and at the start of a motor, and the pages."""
SLOW = ("maps/test_fuzz.py", "maps/test_hostile.py")
"""Files of these that look for what hardly anybody breaks, and take a third of the time of all."""
LAST_LINE = ("driveblocks", "test")
"""A step that says all in its last line when nothing is wrong."""

NEXT = """
made
  {blocks}: the function blocks, their page README.md, and their test programs in tests{sep}
next
  read vendor_maps/README.md for how the manual of your own drive becomes a map, or try
  {driveblocks} show jscc     a drive with its commands, registers and faults
  {driveblocks} run --demo    the three motors again; your own program in the place of --demo
  {driveblocks} test          the test programs of all drives, one by one
  {driveblocks} --help        everything else
"""


def main(arguments: list[str]) -> int:
    """Set up and run one of the two jobs. Returns the exit status: 0 good, 1 a step failed, 2 wrong call or machine."""
    jobs = {"demo": (DEMO, ""), "test": (TEST, "[test]")}
    if {"-h", "--help"} & set(arguments):
        print(__doc__)
        return 0
    if arguments == ["test", "--quick"]:
        return quick()
    if len(arguments) != 1 or arguments[0] not in jobs:
        print(wrong(arguments, list(jobs)), file=sys.stderr)
        return 2
    steps, extra = jobs[arguments[0]]
    if not set_up(extra):
        return 2
    status = run(steps)
    if steps is DEMO and status == 0:
        print(
            NEXT.format(blocks=ROOT / "blocks", sep=os.sep, driveblocks=BIN.relative_to(ROOT) / "driveblocks"), end=""
        )
    return status


def quick() -> int:
    """Set up, run what answers soon, and say what was left out. Returns the exit status."""
    if not set_up("[test]"):
        return 2
    words = [f"tests/{name}" for name in QUICK] + [f"--ignore=tests/{name}" for name in SLOW]
    status = run((*TEST[:-1], ("tests", "pytest", "-n", "auto", "--dist", "loadfile", *words)))
    print(f"left out: {', '.join(not_quick())}; `python3 generator/bootstrap.py test` runs them, too")
    return status


def not_quick() -> list[str]:
    """The folders of which the quick test runs nothing, and the files that it leaves out of others."""
    files = [path.relative_to(ROOT / "tests") for path in ROOT.glob("tests/**/test_*.py")]
    chosen = {each for each in files if each.as_posix().startswith(QUICK) and each.as_posix() not in SLOW}
    begun = {each.parent for each in chosen}
    left = {each if each.parent in begun else each.parent for each in files if each not in chosen}
    return sorted(("tests" / each).as_posix() for each in left)


def wrong(arguments: list[str], jobs: list[str]) -> str:
    """What is wrong with the words of the command line, or all about it where there are none."""
    if not arguments:
        return str(__doc__)
    unknown = [word for word in arguments if word not in jobs]
    if unknown:
        near = difflib.get_close_matches(unknown[0], jobs, 1)
        return f"there is no job `{unknown[0]}`; " + (
            f"did you mean {near[0]}?" if near else f"write {' or '.join(jobs)}"
        )
    return f"one job at a time; write {' or '.join(jobs)}"


def set_up(extra: str) -> bool:
    """Make `.venv` and install the project with an extra ("" or "[test]") into it, unless that was done before."""
    needs = b"".join((ROOT / name).read_bytes() for name in ("pyproject.toml", CONSTRAINTS))
    wanted = hashlib.sha256(needs + extra.encode()).hexdigest()
    stamp = VENV / f"driveblocks{extra.strip('[]')}.stamp"
    whole = is_whole()
    if whole and stamp.exists() and stamp.read_text(encoding="utf-8") == wanted:
        return True
    say(f"set up {VENV.name}/ (a minute or two, on a slow machine several)")
    if not whole:
        print("  makes the virtual environment", flush=True)
        if not make_venv():
            return False
    words = [str(BIN / "python"), "-m", "pip", "install", "--disable-pip-version-check", "--editable", f".{extra}"]
    if installed([*words, "--constraint", CONSTRAINTS]):
        print("pip could not install the packages; is a package index reachable?", file=sys.stderr)
        return False
    stamp.write_text(wanted, encoding="utf-8")
    return True


def installed(words: list[str]) -> int:
    """Run pip, say what it is at and for how long, and return its exit status."""
    start, collected = time.monotonic(), 0
    environment = {**os.environ, "PYTHONUNBUFFERED": "1"}
    with subprocess.Popen(words, cwd=ROOT, env=environment, stdout=subprocess.PIPE, text=True, errors="replace") as pip:
        for line in pip.stdout or ():
            found = re.match(
                r"\s*(Collecting|Downloading|Building|Installing collected packages:) ?([^\s(]*)(.*)", line
            )
            if found is None:
                continue
            collected += found[1] == "Collecting"
            number = f" ({collected})" if found[1] == "Collecting" else ""
            name = f"{collected} packages and driveblocks" if found[1].startswith("Installing") else found[2]
            print(f"  {time.monotonic() - start:4.0f} s  {found[1].split()[0].lower()} {name}{number}", flush=True)
    return pip.returncode


def is_whole() -> bool:
    """Whether `.venv` has a pip that runs, on a Python that is new enough, and is where it was made.

    The commands of one that was moved or copied run nothing, or what is in its first place.
    """
    try:
        done = subprocess.run(
            [str(BIN / "pip"), "--version"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, check=False
        )
    except OSError:
        return False
    said = re.match(r"pip \S+ from (.+) \(python (\d+)\.(\d+)", os.fsdecode(done.stdout))
    if done.returncode or said is None:
        return False
    return VENV.resolve() in Path(said[1]).resolve().parents and (int(said[2]), int(said[3])) >= (3, 11)


def make_venv() -> bool:
    """Make the virtual environment anew; say what is missing where Python came without its venv module."""
    if subprocess.run([sys.executable, "-m", "venv", "--clear", str(VENV)], check=False).returncode:
        print(
            "Python cannot make a virtual environment; on Debian and Ubuntu: apt install python3-venv", file=sys.stderr
        )
        return False
    return True


def run(steps: tuple[tuple[str, ...], ...]) -> int:
    """Run every step, also after one failed, and say at the end what happened. Returns 0 or 1."""
    results = []
    for number, (title, command, *arguments) in enumerate(steps, 1):
        say(f"{title}, {number} of {len(steps)}")
        start = time.monotonic()
        status = step(command, *arguments)
        results.append((command, arguments, status, time.monotonic() - start))
    say("result")
    for command, arguments, status, seconds in results:
        print(f"{'ok    ' if status == 0 else 'FAILED'} {seconds:6.1f} s  {command} {' '.join(arguments)}")
    return 1 if any(status for _, _, status, _ in results) else 0


def step(*command: str) -> int:
    """Run a command of the virtual environment; returns its exit status."""
    words = [str(BIN / command[0]), *command[1:]]
    if command != LAST_LINE:
        return subprocess.run(words, cwd=ROOT, env=kept(), check=False).returncode
    done = subprocess.run(words, cwd=ROOT, env=kept(), stdout=subprocess.PIPE, check=False)
    lines = done.stdout.splitlines(keepends=True)
    sys.stdout.buffer.write(b"".join(lines if done.returncode else lines[-1:]))
    sys.stdout.flush()
    return done.returncode


def kept() -> dict[str, str]:
    """The environment, in which compiled Python is kept below `.venv`: the tests start Python hundreds of times."""
    others = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
    return others | {"PYTHONPYCACHEPREFIX": str(VENV / "pycache")}


def say(title: str) -> None:
    """Print a heading at once, before what the step itself prints."""
    if title:
        print(f"\n== {title}", flush=True)


if __name__ == "__main__":
    try:
        sys.exit(main(sys.argv[1:]))
    except KeyboardInterrupt:
        sys.exit(130)
