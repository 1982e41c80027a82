"""`python -m structured_text` on plain files, as its README shows."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

from structured_text.cli import main

COUNTER = """FUNCTION_BLOCK Counter
VAR_INPUT Amount : INT; END_VAR
VAR_OUTPUT Count : INT; END_VAR
  IF Amount > 0 THEN
    Count := Count + Amount;
  ELSE
    Count := 0;
  END_IF;
END_FUNCTION_BLOCK
"""
MAIN = """PROGRAM Counting
VAR_OUTPUT Count : INT; Odd : BOOL; END_VAR
VAR Counts : Counter; Amount : INT; END_VAR
  Counts(Amount := Amount);
  Count := Counts.Count;
  Odd := Count MOD 2 = 1;
END_PROGRAM
"""
TEST = """PROGRAM CountsUp
VAR_OUTPUT Done : BOOL; Failures : UINT; END_VAR
VAR Counts : Counter; Scan : INT; END_VAR
  Scan := Scan + 1;
  Counts(Amount := 3);
  IF Counts.Count <> 3 * Scan THEN
    Failures := Failures + 1;
  END_IF;
  Done := Scan = 4;
END_PROGRAM
"""


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with a block, a program and a test, in which the commands run."""
    for name, text in (("counter.st", COUNTER), ("main.st", MAIN), ("counter_test.st", TEST)):
        (tmp_path / name).write_text(text, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_a_program_runs_and_its_changes_are_printed(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["run", "counter.st", "main.st", "--scans", "3", "--set", "Amount=5"]) == 0
    assert capsys.readouterr().out.split("\n")[:3] == [
        "       0 ms  Count=5  Odd=TRUE",
        "      10 ms  Count=10  Odd=FALSE",
        "      20 ms  Count=15  Odd=TRUE",
    ]
    assert main(["run", "counter.st", "main.st", "--show", "Counts.Count"]) == 0
    assert capsys.readouterr().out == "       0 ms  Counts.Count=0\n"


def test_tests_pass_and_what_they_do_not_reach_is_listed(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["test", "counter.st", "counter_test.st", "--coverage"]) == 0
    said = capsys.readouterr().out.split("\n")
    assert said[:4] == [
        "passed  CountsUp",
        "1 tested, 0 failed",
        "counter.st:4:6: not reached: IF FALSE",
        "counter.st:7:1: not reached: line",
    ]


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("Count + Amount", "Count - Amount", "FAILED  CountsUp: 4 failures"),
        ("Count + Amount", "Count / (Amount - 3)", "FAILED  CountsUp: counter.st:5:"),
    ],
)
def test_a_mistake_fails(folder: Path, capsys: pytest.CaptureFixture[str], old: str, new: str, said: str) -> None:
    (folder / "counter.st").write_text(COUNTER.replace(old, new), encoding="utf-8")
    assert main(["test", "counter.st", "counter_test.st"]) == 1
    assert capsys.readouterr().out.startswith(said)


def test_a_test_that_never_ends_fails(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["test", "counter.st", "counter_test.st", "--scans", "3"]) == 1
    assert capsys.readouterr().out.startswith("FAILED  CountsUp: not Done after 3 scans")


def test_lint_prints_its_findings(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (folder / "main.st").write_text(MAIN.replace("Odd := Count", "Odd := Missing"), encoding="utf-8")
    assert main(["lint", ".", "--select", "undeclared-name"]) == 1
    assert capsys.readouterr().out.startswith("main.st:6:10: ST")
    assert main(["lint", ".", "--select", "syntax"]) == 0


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["run", "counter.st"], "name one program by --program: there is none"),
        (["run", "counter.st", "main.st", "--set", "Speed=1"], "--set Speed=1: there is no such variable"),
        (["run", "counter.st", "main.st", "--set", "Amount"], "--set Amount: write NAME=VALUE"),
        (["run", "counter.st", "main.st", "--show", "Speed"], "--show Speed: there is no such variable"),
        (["test", "counter.st", "main.st"], "no PROGRAM has outputs Done : BOOL and Failures"),
        (["test", "nowhere.st"], "nowhere.st:1:1: cannot be read: No such file or directory"),
        (["lint"], "name at least one file"),
        (["lint", "counter.st", "--select", "beauty"], "no rule is called beauty"),
    ],
    ids=lambda value: value if isinstance(value, str) else " ".join(value),
)
def test_bad_input_is_refused(folder: Path, capsys: pytest.CaptureFixture[str], words: list[str], said: str) -> None:
    assert main(words) == 2
    assert capsys.readouterr().err.startswith(said)


def test_all_syntax_errors_are_reported_at_once(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for name in ("counter.st", "main.st"):
        (folder / name).write_text("PROGRAM Bad\n  IF THEN;\nEND_PROGRAM\n", encoding="utf-8")
    assert main(["run", "counter.st", "main.st"]) == 2
    assert [line.partition(":")[0] for line in capsys.readouterr().err.splitlines()] == ["counter.st", "main.st"]


def test_the_shipped_test_programs_run_by_it(capsys: pytest.CaptureFixture[str]) -> None:
    blocks = Path(__file__).parents[2] / "blocks"
    order = (blocks / "iec61131/order.txt").read_text(encoding="utf-8").split()
    named = [str(blocks / "iec61131" / each) for each in order if each.startswith(("types", "modbus"))]
    tests = blocks / "tests/iec61131"
    assert main(["test", *named, str(tests / "harness"), str(tests / "modbus/MB_TestChecksums.st")]) == 0
    assert "passed  MB_TestChecksums" in capsys.readouterr().out


def test_what_the_readme_shows_runs(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    readme = (Path(__file__).parents[2] / "generator/structured_text/README.md").read_text(encoding="utf-8")
    commands = re.findall(r"^python -m structured_text (.*)$", readme, re.MULTILINE)
    assert [command.split()[0] for command in commands] == ["lint", "run", "test"]
    assert [main(each.split()) for each in commands] == [0, 0, 0]
    (program,) = re.findall(r"^```python\n(.*?)^```$", readme, re.MULTILINE | re.DOTALL)
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=False)
    assert done.stdout == "{'AMOUNT': 2, 'COUNT': 2}\n", done.stderr


def test_it_starts_as_a_module(folder: Path) -> None:
    words = [sys.executable, "-m", "structured_text", "test", "counter.st", "counter_test.st"]
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout) == (0, "passed  CountsUp\n1 tested, 0 failed\n")
