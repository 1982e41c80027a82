"""From a fresh clone to a result in one command, with nothing but Python 3.11 or newer and git.

    python3 generator/bootstrap.py demo    set up, then run the main job on the drives of vendor_maps/
    python3 generator/bootstrap.py test    set up, then run the tests that continuous integration runs: six minutes
    python3 generator/bootstrap.py test --all    every test, and coverage: an hour
    python3 generator/bootstrap.py test --all --continue    ... from where it was stopped, or where a part failed

All make a virtual environment `.venv` in the checkout and install the project and what it needs into it.
"""

import difflib
import hashlib
import json
import os
import re
import subprocess
import sys
import tempfile
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
PYTEST = ("pytest", "-n", "auto", "--dist", "loadfile")
FORM = (("lint", "ruff", "check", "."), ("format", "ruff", "format", "--check", "."))
TYPES = ("types", "mypy")
TEST = ("tests", *PYTEST, "--scope", "default")
FLOOR = 90
"""Percent of the lines and branches of the generator that the tests of the default reach."""
NO_TESTS = 5
"""The exit status of pytest where a scope has none of the tests of a folder."""
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
    """Set up and run one of the jobs. Returns the exit status: 0 good, 1 a step failed, 2 wrong call or machine."""
    if {"-h", "--help"} & set(arguments):
        print(__doc__)
        return 0
    jobs = {"demo": demo, "test": test, "test --all": thorough, "test --all --continue": again}
    words = " ".join(arguments)
    if words not in jobs:
        print(wrong(arguments, ["demo", "test"]), file=sys.stderr)
        return 2
    return jobs[words]() if set_up("" if words == "demo" else "[test]") else 2


def demo() -> int:
    """Run the main job, and say what to do next."""
    status = run(DEMO)
    if status == 0:
        print(
            NEXT.format(blocks=ROOT / "blocks", sep=os.sep, driveblocks=BIN.relative_to(ROOT) / "driveblocks"), end=""
        )
    return status


def test() -> int:
    """Run what continuous integration runs: types beside the tests, and at the end what all took."""
    start = time.monotonic()
    with tempfile.TemporaryDirectory() as folder, beside(*TYPES[1:]) as types:
        tally = Path(folder) / "tally.json"
        status = run((*FORM, (*TEST, f"--tally={tally}")))
        say(TYPES[0])
        said, _ = types.communicate()
        print(said.decode(errors="replace"), end="", flush=True)
        status |= types.returncode != 0
        counts = json.loads(tally.read_text("utf-8")) if tally.exists() else {"ran": 0, "there": 0}
    print(
        f"\n{time.monotonic() - start:.0f} s, {cpu():.0f} CPU seconds with all children; "
        f"{counts['ran']:,} of the {counts['there']:,} tests of `test --all`"
    )
    print("FAILED" if status else "good")
    return int(status)


def beside(*command: str) -> "subprocess.Popen[bytes]":
    """Start a command of the virtual environment that goes on beside others; what it prints is kept."""
    words = [str(BIN / command[0]), *command[1:]]
    return subprocess.Popen(words, cwd=ROOT, env=kept(), stdout=subprocess.PIPE, stderr=subprocess.STDOUT)


def cpu() -> float:
    """CPU seconds of this process and of all that it has waited for; Windows does not count those."""
    used = os.times()
    return used.user + used.system + used.children_user + used.children_system


# ---------------------------------------------------------------- every test, in parts


def parts() -> dict[str, tuple[str, ...]]:
    """The command of each part of `test --all` by its name.

    Coverage is counted for the tests of the default, folder by folder; the rest of each runs without.
    """
    folders = sorted({path.relative_to(ROOT).parts[1] for path in ROOT.glob("tests/**/test_*.py")})
    counted = ("--scope", "default", "--cov", "--cov-append", "--cov-report=", "--cov-fail-under=0")
    found = {title: words for title, *words in (*FORM, TYPES)}
    for name in folders:
        found[f"{name}, counted"] = [*PYTEST, *counted, f"tests/{name}"]
    for name in folders:
        found[f"{name}, rest"] = [*PYTEST, "--scope", "rest", f"tests/{name}"]
    found["coverage"] = ["coverage", "report", f"--fail-under={FLOOR}"]
    return {name: tuple(words) for name, words in found.items()}


def again() -> int:
    """Go on with what has not passed yet on the text of today."""
    return thorough(True)


def thorough(goes_on: bool = False) -> int:
    """Run every part; with `goes_on` those that have not passed on the text of today. Returns the exit status."""
    kept_at, text = VENV / "thorough.json", digest()
    known = json.loads(kept_at.read_text("utf-8")) if goes_on and kept_at.exists() else {}
    done = known.get("parts", {}) if known.get("text") == text else {}
    if known and not done:
        print("the text has changed since: every part runs again")
    if not done:
        (ROOT / ".coverage").unlink(missing_ok=True)
    todo = {name: words for name, words in parts().items() if done.get(name, {}).get("status") != 0}
    start = time.monotonic()
    for number, (name, words) in enumerate(todo.items(), 1):
        say(f"{name}, {number} of {len(todo)}, {(time.monotonic() - start) / 60:.0f} min so far")
        done[name] = part(words)
        kept_at.write_text(json.dumps({"text": text, "parts": done}, indent=1), encoding="utf-8")
    return table(done)


def part(words: "tuple[str, ...]") -> "dict[str, float]":
    """Run one part; returns its exit status, 0 where a scope has no tests there, its seconds and CPU seconds."""
    start, before = time.monotonic(), cpu()
    status = step(*words)
    return {
        "status": 0 if status == NO_TESTS and words[0] == PYTEST[0] else status,
        "seconds": time.monotonic() - start,
        "cpu": cpu() - before,
    }


def table(done: "dict[str, dict[str, float]]") -> int:
    """Print what each part took. Returns the exit status."""
    say("result")
    for name, each in done.items():
        print(f"{'FAILED' if each['status'] else 'ok    '} {each['seconds']:6.0f} s {each['cpu']:6.0f} CPU s  {name}")
    seconds, used = (sum(each[key] for each in done.values()) for key in ("seconds", "cpu"))
    print(f"\n{seconds:.0f} s, {used:.0f} CPU seconds with all children")
    failed = [name for name, each in done.items() if each["status"]]
    print(f"FAILED: {'; '.join(failed)}" if failed else "good")
    return 1 if failed else 0


def digest() -> str:
    """A digest of what the tests look at: every file that git knows, as it is on the disk."""
    listed = subprocess.run(
        ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
        cwd=ROOT, stdout=subprocess.PIPE, check=True,
    )  # fmt: skip
    found = hashlib.sha256()
    for name in sorted(os.fsdecode(listed.stdout).split("\0")):
        path = ROOT / name
        if name and path.is_file():
            found.update(name.encode() + b"\0" + hashlib.sha256(path.read_bytes()).digest())
    return found.hexdigest()


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
