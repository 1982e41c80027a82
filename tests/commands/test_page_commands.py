"""Every command line on a page is taken from there and run as a reader would, in the order of the pages, and each once.

The reader has two folders: one of his own, with files of the names on the pages, and a copy of the project. What does
not run here is in `ELSEWHERE` with its reason; `test_pages.py` holds that commands, options and targets on pages exist.
"""

import os
import re
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from tests.maps.bad import cases

from driveblocks.desk.site import kept, saved
from driveblocks.desk.site.found import Found, Way
from driveblocks.maps.load import load

ROOT = Path(__file__).parents[2]
TESTING = ROOT / "docs/testing.md"
OWN = [ROOT / "README.md", ROOT / "vendor_maps/README.md", *sorted({*ROOT.glob("docs/*.md")} - {TESTING})]
COPY = [TESTING, ROOT / "CONTRIBUTING.md", *sorted(ROOT.glob("docs/*/*.md"))]
ELSEWHERE = {
    r"pip ": "needs a package index",
    r"python3 generator/bootstrap.py ": "makes a virtual environment from an index, or runs this suite",
    r"pytest ": "a part of this suite",
    r"driveblocks build$": "`make blocks` runs it",
    r"make blocks$": "`rm -r blocks && make blocks` runs it, which must make all anew",
    r"driveblocks prove": "half a minute of proofs; tests/prove/test_prove.py takes these lines from their pages",
    r"driveblocks test( --|$)": "minutes for three families; tests/testing runs their programs",
    r"driveblocks test my_drive.yaml ": "tests/commands/test_test.py tests this map",
    r"driveblocks test acme.yaml$": "tests/blocks/test_promise.py tests what `driveblocks new` writes",
    r"driveblocks (test|run) plant.yaml": "half a minute, and no end; tests/plant/test_trial.py, test_run.py",
    r"driveblocks run my_line.st --(port|tcp 192)": "a real port",
    r"driveblocks commission .": "a real port; tests/desk/site/test_commission.py has it",
    r"driveblocks listen .": "a real port; tests/desk/site/test_listen.py has it",
    r"driveblocks parameters .*--port": "a real port; tests/desk/site/test_peer.py has one at a server of pymodbus",
    r"driveblocks run my_line.st --tcp 127.0.0.1:5020": "a simulator beside it; tests/commands/test_run.py has one",
    r"python -m structured_text ": "tests/structured_text/test_cli.py takes these lines from their page",
    r"make (?!blocks$)": "minutes to hours; tests/output/test_release.py has `make release`",
    r"python -m tests\.(blocks\.toolchains|drives\.seven|planted)": "minutes to hours",
    r"python -m tests\.(line\.cline|prove\.agreement)|xml2st ": "needs a compiler from elsewhere",
    r"copy |bash ": "for another shell, or its name alone",
}
"""How the command lines begin that do not run here, and why."""
BARE = {
    f"driveblocks {name}"
    for name in ("commission", "diff", "explain", "line", "lint", "listen", "parameters", "run", "show", "simulate")
}
"""What pages call by its name alone: run so, it asks for more, with status 2."""
MEANT = {
    "PREFIX": "MINE", "SEED": "1", '"CELL" --seed N': '"CHF, jog, a trip, at speed" --seed 1', "NAME": min(cases()),
    "make": "make PY=python DB=driveblocks", "OLD": "jscc", "NEW": "jscc",
    "driveblocks run --demo": "driveblocks run --demo --fast",
}  # fmt: skip
"""What a reader writes in the place of a word of the page, and what saves the test a wait."""
COMMAND = re.compile(r"(driveblocks|python3?|pip|pytest|make|cat|copy|grep|rm|bash|xml2st) \S")
TEXTS = re.compile(r"^```.*?^```$|^    \S.*?$|`([^`]+)`", re.MULTILINE | re.DOTALL)
BLOCK = "FUNCTION_BLOCK {}\nVAR\n  Count : INT;\nEND_VAR\n  Count := Count + 1;\nEND_FUNCTION_BLOCK\n"
BEFORE = [str(Path(sys.executable).parent), os.environ.get("PATH", os.defpath)]
SEEN = {name: value for name, value in os.environ.items() if name != "MATIEC_HOME"} | {"PATH": os.pathsep.join(BEFORE)}
"""The tools of this environment come first; matiec would take minutes."""
pytestmark = pytest.mark.skipif(
    any(shutil.which(each) is None for each in ("bash", "make", "grep")), reason="the pages write for a shell with make"
)


def commands(page: Path) -> Iterator[str]:
    """The command lines of a page in their order: between fences, indented, or between backticks."""
    for found in TEXTS.finditer(page.read_text(encoding="utf-8")):
        for line in [" ".join(found[1].split())] if found[1] else found[0].splitlines():
            text = re.split(r"   +", re.sub(r"^[ -]*(run: )?", "", line))[0]
            if COMMAND.match(text):
                yield text


def runnable(pages: list[Path]) -> list[str]:
    """What runs here, each line once."""
    texts = dict.fromkeys(text for page in pages for text in commands(page))
    return [text for text in texts if not any(re.match(each, text) for each in ELSEWHERE)]


def ran(text: str, folder: Path) -> tuple[int, str]:
    """The exit status of a line and what it printed; a run without an end gets one."""
    for word, meant in MEANT.items():
        text = re.sub(rf"(?<!\w){re.escape(word)}(?!\w)", meant, text)
    if re.match(r"driveblocks (run|simulate) (?!.*--(schema|demo|for))", text):
        text += " --for 1s" + (" --tcp 127.0.0.1:0" if " simulate " in text else "")
    done = subprocess.run(
        ["bash", "-c", text], cwd=folder, env=SEEN, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT, encoding="utf-8", check=False,
    )  # fmt: skip
    return done.returncode, done.stdout


def faults(pages: list[Path], folder: Path) -> list[str]:
    """The command lines that end with another status than their page promises, and what they printed."""
    ended = {text: ran(text, folder) for text in runnable(pages)}
    assert ended
    return [f"{text}: {code}\n{said}" for text, (code, said) in ended.items() if code != (2 if text in BARE else 0)]


@pytest.fixture
def own(tmp_path: Path) -> Path:
    """A reader's folder with files that pages name, in the place of his own."""
    for name in ("types", "blocks", "my_block", "my_project/one"):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / f"{name}.st").write_text(BLOCK.format(Path(name).name.title()), encoding="utf-8")
    shutil.copy(ROOT / "examples/three_makes.st", tmp_path / "my_line.st")
    for name in ("my_drive", "my_old_drive"):
        shutil.copy(ROOT / "tests/maps/example.yaml", tmp_path / f"{name}.yaml")
    (tmp_path / "registers.csv").write_text("Register,Name\n1AH,Speed\n", encoding="utf-8")
    for name in ("old_release", "blocks"):
        shutil.copytree(ROOT / "blocks/iec61131/device", tmp_path / name / "iec61131", dirs_exist_ok=True)
    for name in ("pump", "pump_last_year"):
        saved.write(
            tmp_path / f"{name}.csv", "jscc", load(ROOT / "vendor_maps/jscc.yaml"), 2, dict.fromkeys(range(256), 1)
        )
    kept.write(tmp_path / "site.yaml", kept.About("Pump", "jscc", "1", "2026-11-23", ""), Found(Way(9600), 1, "fits"))
    return tmp_path


@pytest.mark.thorough
def test_the_lines_for_a_folder_of_ones_own_run(own: Path) -> None:
    assert faults(OWN, own) == []


@pytest.mark.thorough
def test_the_lines_for_the_project_run_and_change_nothing_that_is_current(tmp_path: Path) -> None:
    for name in ("blocks", "vendor_maps"):
        shutil.copytree(ROOT / name, tmp_path / name)
    for name in ("README.md", "Makefile", "LICENSE"):
        shutil.copy(ROOT / name, tmp_path / name)
    for name in ("tests", "generator"):
        (tmp_path / name).symlink_to(ROOT / name)
    assert faults(COPY, tmp_path) == []
    kept = [ROOT / "vendor_maps" / name for name in ("keys.md", "schema.json")]
    assert [path for path in kept if path.read_bytes() != (tmp_path / path.relative_to(ROOT)).read_bytes()] == []
