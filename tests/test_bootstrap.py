"""`generator/bootstrap.py`: what it says to those who call it wrongly, and when it makes `.venv` anew."""

import ast
import os
import runpy
import subprocess
import sys
from pathlib import Path

import pytest

import bootstrap

FILE = Path(bootstrap.__file__)


@pytest.mark.parametrize("words", [["--help"], ["-h"], ["demo", "--help"]])
def test_help_is_no_error(words: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    assert bootstrap.main(words) == 0
    said = capsys.readouterr()
    assert "bootstrap.py demo" in said.out
    assert not said.err


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["tset"], "there is no job `tset`; did you mean test?\n"),
        (["demo", "dmeo"], "there is no job `dmeo`; did you mean demo?\n"),
        (["x"], "there is no job `x`; write demo or test\n"),
        (["demo", "test"], "one job at a time; write demo or test\n"),
        ([], f"{bootstrap.__doc__}\n"),
    ],
)
def test_a_wrong_word_is_named(words: list[str], said: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert bootstrap.main(words) == 2
    assert capsys.readouterr().err == said


def test_an_old_python_can_read_up_to_its_message(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """The whole file must parse; what would fail when it is run stands after the words."""
    tree = ast.parse(FILE.read_text(encoding="utf-8"), feature_version=(3, 6))
    before = tree.body[: next(number for number, each in enumerate(tree.body) if isinstance(each, ast.If))]
    assert {type(each) for each in before} == {ast.Expr, ast.Import, ast.ImportFrom}
    monkeypatch.setattr(sys, "version_info", (3, 8, 18, "final", 0))
    with pytest.raises(SystemExit) as end:
        runpy.run_path(str(FILE))
    assert end.value.code == 2
    assert capsys.readouterr().err.startswith("Python 3.11 or newer is needed; this is ")


# ---------------------------------------------------------------- the virtual environment


@pytest.fixture
def venv(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A virtual environment as far as it is looked at: its pip, a script that says where it is."""
    made = tmp_path / ".venv"
    monkeypatch.setattr(bootstrap, "VENV", made)
    monkeypatch.setattr(bootstrap, "BIN", made / "bin")
    pip(made, f"pip 25.0 from {made}/lib/site-packages/pip (python 3.11)")
    return made


def pip(venv: Path, says: str, python: str = sys.executable, status: int = 0) -> None:
    path = venv / "bin/pip"
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(f"#!{python}\nprint({says!r})\nraise SystemExit({status})\n", encoding="utf-8")
    path.chmod(0o755)


NOT_WINDOWS = pytest.mark.skipif(os.name == "nt", reason="Windows runs no scripts by their first line")


@NOT_WINDOWS
def test_a_venv_is_whole_where_it_was_made(venv: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    assert bootstrap.is_whole()
    (tmp_path / "link").symlink_to(tmp_path)
    monkeypatch.setattr(bootstrap, "VENV", tmp_path / "link/.venv")
    assert bootstrap.is_whole()


@NOT_WINDOWS
def test_a_venv_that_was_moved_or_has_no_pip_or_an_old_python_is_not_whole(venv: Path) -> None:
    good = f"pip 25.0 from {venv}/lib/site-packages/pip (python 3.11)"
    pip(venv, good.replace("3.11", "3.9"))
    assert not bootstrap.is_whole()
    pip(venv, good.replace(str(venv), "/elsewhere/.venv"))
    assert not bootstrap.is_whole()
    pip(venv, good, python="/elsewhere/.venv/bin/python")
    assert not bootstrap.is_whole()
    pip(venv, good, status=1)
    assert not bootstrap.is_whole()
    pip(venv, "")
    assert not bootstrap.is_whole()
    (venv / "bin/pip").unlink()
    assert not bootstrap.is_whole()


@pytest.mark.usefixtures("venv")
def test_what_is_needed_is_installed_when_it_changes_and_a_venv_that_is_not_whole_is_made_anew(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    done: list[list[str]] = []

    def run(words: list[str], **_options: object) -> "subprocess.CompletedProcess[bytes]":
        done.append(words)
        return subprocess.CompletedProcess(words, 0, b"", b"")

    for name in ("pyproject.toml", "constraints.txt"):
        (tmp_path / name).write_bytes((bootstrap.ROOT / name).read_bytes())
    monkeypatch.setattr(bootstrap, "ROOT", tmp_path)
    monkeypatch.setattr(bootstrap, "is_whole", lambda: True)
    monkeypatch.setattr(subprocess, "run", run)
    monkeypatch.setattr(bootstrap, "installed", lambda words: run(words).returncode)
    assert bootstrap.set_up("")
    assert [words[1:3] + words[-2:] for words in done] == [["-m", "pip", "--constraint", "constraints.txt"]]
    assert bootstrap.set_up("")
    assert len(done) == 1
    (tmp_path / "constraints.txt").write_text("rich==14.0.0\n", encoding="utf-8")
    assert bootstrap.set_up("")
    assert len(done) == 2
    monkeypatch.setattr(bootstrap, "is_whole", lambda: False)
    assert bootstrap.set_up("")
    assert [words[1:4] for words in done[2:]] == [["-m", "venv", "--clear"], ["-m", "pip", "install"]]


# ---------------------------------------------------------------- the demo


@pytest.fixture
def driveblocks(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Path:
    """A command that prints many rows, then a sum, in place of the real one."""
    path = tmp_path / "driveblocks"
    path.write_text(f"#!{sys.executable}\nprint('row\\n' * 130 + 'the sum')\n", encoding="utf-8")
    path.chmod(0o755)
    monkeypatch.setattr(bootstrap, "set_up", lambda _: True)
    monkeypatch.setattr(bootstrap, "ROOT", tmp_path)
    monkeypatch.setattr(bootstrap, "BIN", tmp_path)
    monkeypatch.setattr(bootstrap, "DEMO", (("the tests", *bootstrap.LAST_LINE),))
    return path


@NOT_WINDOWS
def test_the_demo_ends_with_what_was_made_and_what_to_do_next(
    driveblocks: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    assert bootstrap.main(["demo"]) == 0
    said = capfd.readouterr().out
    assert "row" not in said
    assert "the sum\n" in said
    _, end = said.split("\nmade\n")
    assert str(driveblocks.parent / "blocks") in end
    assert "\nnext\n" in end


@NOT_WINDOWS
def test_a_demo_that_fails_shows_all(driveblocks: Path, capfd: pytest.CaptureFixture[str]) -> None:
    with driveblocks.open("a", encoding="utf-8") as file:
        file.write("raise SystemExit(1)\n")
    assert bootstrap.main(["demo"]) == 1
    said = capfd.readouterr().out
    assert said.count("row") == 130
    assert "\nnext\n" not in said


def test_ctrl_c_ends_quietly(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    def interrupted(*_arguments: object, **_options: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(subprocess, "run", interrupted)
    monkeypatch.setattr(sys, "argv", [str(FILE), "demo"])
    with pytest.raises(SystemExit) as end:
        runpy.run_path(str(FILE), run_name="__main__")
    assert end.value.code == 130
    assert not capsys.readouterr().err


# ---------------------------------------------------------------- the tests


class Steps:
    """The steps that ran, and the exit status of those that shall fail, by their words."""

    def __init__(self) -> None:
        self.ran: list[str] = []
        self.status: dict[str, int] = {}

    def step(self, *command: str) -> int:
        """Take the place of a step."""
        self.ran.append(" ".join(command))
        return self.status.get(self.ran[-1], 0)


@pytest.fixture
def steps(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Steps:
    """What the jobs run, in a checkout with a folder of tests and a file."""
    (tmp_path / "tests/maps").mkdir(parents=True)
    (tmp_path / "tests/maps/test_a.py").touch()
    (tmp_path / "tests/test_b.py").touch()
    subprocess.run(["git", "init", "-q", str(tmp_path)], check=True)
    monkeypatch.setattr(bootstrap, "ROOT", tmp_path)
    monkeypatch.setattr(bootstrap, "VENV", tmp_path)
    monkeypatch.setattr(bootstrap, "set_up", lambda extra: extra == "[test]")
    done = Steps()
    monkeypatch.setattr(bootstrap, "step", done.step)
    monkeypatch.setattr(bootstrap, "beside", lambda *_: subprocess.Popen(["true"], stdout=subprocess.PIPE))
    return done


@NOT_WINDOWS
def test_the_default_says_at_its_end_what_it_took(steps: Steps, capsys: pytest.CaptureFixture[str]) -> None:
    assert bootstrap.main(["test"]) == 0
    *_, figures, last = capsys.readouterr().out.splitlines()
    assert "CPU seconds" in figures
    assert last == "good"
    steps.status["ruff check ."] = 1
    assert bootstrap.main(["test"]) == 1
    assert capsys.readouterr().out.endswith("\nFAILED\n")


@NOT_WINDOWS
def test_all_continues_where_a_part_failed_and_begins_anew_on_another_text(
    steps: Steps, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = " ".join(bootstrap.parts()["maps, rest"])
    (tmp_path / ".gitignore").write_text("thorough.json\n", encoding="utf-8")
    steps.status[words] = 1
    assert bootstrap.main(["test", "--all"]) == 1
    assert capsys.readouterr().out.endswith("FAILED: maps, rest\n")
    assert len(steps.ran) == len(bootstrap.parts())
    steps.ran.clear()
    steps.status[words] = bootstrap.NO_TESTS
    assert bootstrap.main(["test", "--all", "--continue"]) == 0
    assert steps.ran == [words]
    steps.ran.clear()
    (tmp_path / "tests/test_b.py").write_text("b = 1\n", encoding="utf-8")
    assert bootstrap.main(["test", "--all", "--continue"]) == 0
    assert len(steps.ran) == len(bootstrap.parts())
