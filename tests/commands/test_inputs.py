"""What is no file, as input of every command: refused at once, with its name; what is long is cut, and counted."""

import os
from pathlib import Path

import pytest
from click.testing import CliRunner
from tests.desk.run.desk import ONE

from driveblocks.cli import app
from driveblocks.desk.site import kept, saved
from driveblocks.desk.site.found import Found, Way
from driveblocks.maps.catalog import resolve
from driveblocks.maps.load import load

WORDS = (
    "check P.yaml", "show P.yaml", "list P.yaml", "explain 0103 --drive P.yaml", "diff P.yaml jscc", "diff jscc P.yaml",
    "build P.yaml", "build jscc --site P.yaml", "test P.yaml", "listen P.yaml --port x",
    "line P.st", "line P.yaml", "line jscc --map P.yaml", "line my.st --map P.yaml", "lint P.st", "lint folder",
    "lint my.st --map P.yaml", "run P.st", "run my.st --map P.yaml", "run my.st --script P.txt",
    "run my.st --scenario P.yaml", "simulate P.yaml", "simulate jscc --scenario P.yaml", "import-csv P.csv",
    "parameters save P.yaml out.csv --port x", "parameters save jscc P.csv --port x", "parameters compare P.csv P.csv",
    "commission P.yaml --port x", "commission jscc --port x --file P.yaml", "site P.yaml",
    "site site.yaml --html out.html --map P.yaml", "counts P.md", "schema folder",
)  # fmt: skip
KINDS = {"pipe": os.mkfifo, "device": lambda path: path.symlink_to("/dev/zero")} if os.name == "posix" else {}


@pytest.fixture(autouse=True)
def _here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    kept.write(
        Path("site.yaml"), kept.About("Pump", "P", "12345678", "2026-11-23 10:30", ""), Found(Way(9600), 1, "fits")
    )
    Path("my.st").write_text(ONE, encoding="utf-8")


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("words", WORDS)
def test_what_is_no_file_is_refused_at_once(kind: str, words: str) -> None:
    Path("folder").mkdir()
    for name in ("P.yaml", "P.st", "P.csv", "P.txt", "P.md", "folder/README.md", "folder/a.st"):
        KINDS[kind](Path(name))
    got = CliRunner().invoke(app, words.split())
    name = {"lint folder": "folder/a.st", "schema folder": "folder/README.md"}.get(words) or next(
        each for each in words.split() if each.startswith("P.")
    )
    assert got.exit_code == 2
    assert name in got.stderr
    assert "it is a pipe or device" in got.stderr


# ------------------------------------------------------------ what is long


@pytest.mark.parametrize(
    "words",
    [
        "line jscc@", "run my.st --simulate jscc@", "simulate jscc@", "parameters save jscc --port x a.csv jscc@",
        "parameters compare my.st jscc@", "listen --port x jscc@", "simulate jscc --tcp :", "line jscc@1:",
        "simulate jscc@1:", "commission jscc --tcp :", "listen --tcp :", "run my.st --tcp :", "explain ",
        "show jscc ", "run my.st --fast --for ", "line jscc --scan ",
    ],
)  # fmt: skip
def test_a_number_of_5000_digits_is_refused(words: str) -> None:
    got = CliRunner().invoke(app, f"{words}{'1' * 5000}".split())
    assert isinstance(got.exception, SystemExit)
    assert got.exit_code in {1, 2}


@pytest.mark.parametrize("cell", ["x" * 131_073, f'"{"x" * 131_073}"'])
def test_a_cell_that_is_too_long_is_refused(cell: str) -> None:
    saved.write(Path("a.csv"), "jscc", load(resolve("jscc")), 1, {0x2103: 5})
    text = Path("a.csv").read_text("utf-8")
    Path("a.csv").write_text(f"{text}0000H,{cell},,1,,,\n", encoding="utf-8")
    line = text.count("\n") + 1
    for words in ("parameters compare a.csv a.csv", "import-csv a.csv"):
        got = CliRunner().invoke(app, words.split())
        assert (got.exit_code, isinstance(got.exception, SystemExit)) == (2, True)
    got = CliRunner().invoke(app, ["parameters", "save", "jscc", "a.csv", "--port", "x"])
    assert got.stderr.startswith(f"a.csv:{line}:1: is no row; write address, id")


def test_many_mistakes_are_cut_and_counted() -> None:
    saved.write(Path("a.csv"), "jscc", load(resolve("jscc")), 1, {0x2103: 5})
    text = Path("a.csv").read_text("utf-8")
    Path("a.csv").write_text(text + "?\n" * 3000, encoding="utf-8")
    got = CliRunner().invoke(app, ["parameters", "compare", "a.csv", "a.csv"])
    assert got.exit_code == 2
    assert len(got.stderr.splitlines()) < 250
    assert "more like these" in got.stderr


@pytest.mark.parametrize(
    "words",
    [
        "new ACME -o P.yaml", "import-csv t.csv -o P.yaml", "line jscc --picture P.svg", "site --html P.html",
        "run my.st --fast --for 1s --trace P.csv", "run my.st --fast --for 1s --picture P.svg", "build jscc -o P",
        "listen --port x --log P.txt", "listen --port x --csv P.csv", "parameters save jscc P.csv --port x",
        "parameters compare P.csv P.csv", "commission jscc --port x --file P.yaml", "schema P", "diff P jscc",
    ],
)  # fmt: skip
def test_a_name_that_is_too_long_is_refused(words: str) -> None:
    Path("t.csv").write_text("address,name\n2000H,Speed\n", encoding="utf-8")
    got = CliRunner().invoke(app, words.replace("P", "P" * 5000).split())
    assert isinstance(got.exception, SystemExit)
    assert got.exit_code == 2
