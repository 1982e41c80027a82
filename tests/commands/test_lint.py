"""`driveblocks lint`: what it prints and how it ends."""

import json
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from driveblocks.cli import app
from structured_text.language.rules import RULES

CLEAN = "FUNCTION_BLOCK Example\nVAR\n  Count : INT;\nEND_VAR\n  Count := Count + 1;\nEND_FUNCTION_BLOCK\n"
LOOP = CLEAN.replace("  Count := Count + 1;", "  FOR Count := 1 TO 3 DO\n    Count := Count + 0;\n  END_FOR;;")


def run(*words: str | Path) -> Result:
    """Run the command."""
    return CliRunner().invoke(app, ["lint", *map(str, words)])


@pytest.fixture
def loop(tmp_path: Path) -> Path:
    """A file with two findings."""
    path = tmp_path / "loop.st"
    path.write_text(LOOP, encoding="utf-8")
    return path


def test_clean_text_ends_with_0_and_says_nothing(tmp_path: Path) -> None:
    path = tmp_path / "clean.st"
    path.write_text(CLEAN, encoding="utf-8")
    result = run(path)
    assert (result.exit_code, result.output) == (0, "")


def test_json_holds_the_same(loop: Path) -> None:
    result = run("--format", "json", loop)
    assert result.exit_code == 1
    rows = json.loads(result.output)
    assert [(row["line"], row["column"], row["code"], row["rule"]) for row in rows] == [
        (5, 3, "ST301", "for-zero-trips"),
        (7, 11, "ST111", "empty-statement"),
    ]
    assert all(row["path"] == str(loop) and row["message"] for row in rows)


@pytest.mark.parametrize(
    ("words", "rules"),
    [
        (["--select", "for-zero-trips"], ["ST301"]),
        (["--select", "ST1"], ["ST111"]),
        (["--select", "st111,ST301"], ["ST301", "ST111"]),
        (["--ignore", "ST3"], ["ST111"]),
        (["--ignore", "ST3", "--ignore", "empty-statement"], []),
        (["--select", "ST3", "--ignore", "for-zero-trips"], []),
    ],
)
def test_select_and_ignore(loop: Path, words: list[str], rules: list[str]) -> None:
    result = run(*words, loop)
    assert [line.split(": ")[1].split()[0] for line in result.output.splitlines()] == rules
    assert result.exit_code == (1 if rules else 0)


def test_names_are_reported_for_the_targets_of_for(tmp_path: Path) -> None:
    path = tmp_path / "names.st"
    path.write_text(CLEAN.replace("Count", "Label"), encoding="utf-8")
    assert run(path).exit_code == run("--for", "twincat", path).exit_code == 0
    told = f"{path}:3:3: ST130 target-name: Label is a word of siemens: choose another name\n"
    for words in (["--for", "twincat,siemens"], ["--for", "codesys", "--for", "siemens"], ["--for", "all"]):
        result = run(*words, path)
        assert (result.exit_code, result.output) == (1, told)


def test_a_block_with_the_name_of_a_variable_of_the_library_is_reported(tmp_path: Path) -> None:
    """By matiec: Beremiz and OpenPLC Runtime v3 then refuse the library."""
    path = tmp_path / "own.st"
    path.write_text(
        "PROGRAM Port\nVAR\n  Bus : MB_ByteLine8;\n  Rx : MB_Adu;\n  Count : UINT;  (* sent *)\n"
        "END_VAR\n\n  Count := Bus.TxCount;\nEND_PROGRAM\n",
        encoding="utf-8",
    )
    told = "Port is also the name of a variable of the library, which matiec refuses: choose another name"
    result = run("--select", "name-clash", path)
    assert (result.exit_code, result.output) == (1, f"{path}:1:9: ST109 name-clash: {told}\n")
    path.write_text(path.read_text(encoding="utf-8").replace("PROGRAM Port", "PROGRAM Pumps"), encoding="utf-8")
    assert run("--select", "name-clash", path).exit_code == 0


def test_a_target_that_is_none_is_reported(loop: Path) -> None:
    result = run("--for", "step7", loop)
    assert result.exit_code == 2
    assert result.stderr == "--for knows no target step7; write openplc, beremiz, codesys, twincat, siemens or all\n"


@pytest.mark.parametrize(
    ("word", "hint"), [("for-zero-trip", "for-zero-trips"), ("ST31X", "ST31"), ("comment", "--list"), ("S", "--list")]
)
def test_an_unknown_rule_is_reported_with_the_nearest(loop: Path, word: str, hint: str) -> None:
    result = run("--select", word, loop)
    assert result.exit_code == 2
    assert f"no rule is called {word}" in result.output
    assert hint in result.output


def test_syntax_errors_end_with_2(tmp_path: Path) -> None:
    path = tmp_path / "broken.st"
    path.write_text(CLEAN.replace(":= Count", "= Count"), encoding="utf-8")
    result = run("--ignore", "ST0", path)
    assert result.exit_code == 2
    assert result.stdout == f"{path}:5:9: ST001 syntax: expected `:=` or `(`, found =\n"
    assert result.stderr == f"{path}: not checked beyond its syntax\n"


def test_a_broken_file_silences_no_other(tmp_path: Path, loop: Path) -> None:
    types = "TYPE\n  T_Row : ARRAY[0..9] OF INT;\nEND_TYPE\nTYPE\n  T_Odd : ARRAY[0..] OF INT;\nEND_TYPE\n"
    user = CLEAN.replace("Example", "User").replace("INT;", "T_Row; Odd : T_Odd; Even : T_Even;")
    broken, block = tmp_path / "broken.st", tmp_path / "user.st"
    broken.write_text(types, encoding="utf-8")
    block.write_text(user.replace("Count := Count + 1", "Count[10] := 1"), encoding="utf-8")
    result = run("--select", "ST0", broken, block, tmp_path / "missing.st", loop)
    assert result.exit_code == 2
    assert [line.split(": ")[0] + " " + line.split(": ")[1] for line in result.stdout.splitlines()] == [
        f"{broken}:5:20 ST001 syntax",
        f"{block}:3:38 ST003 unknown-type",
        f"{block}:5:9 ST009 index-range",
    ]
    assert result.stderr.splitlines() == [
        f"{tmp_path / 'missing.st'}:1:1: cannot be read: No such file or directory",
        f"{broken}: not checked beyond its syntax",
    ]


def test_a_folder_means_the_sources_in_it(tmp_path: Path) -> None:
    for name in ("b/z.ST", "a.st", "b/a/x.st", ".hidden/y.st", "notes.txt"):
        path = tmp_path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(LOOP.replace("Example", f"Example_{path.stem}"), encoding="utf-8")
    result = run("--select", "ST301", tmp_path, tmp_path / "a.st")
    assert result.exit_code == 1
    assert [line.split(":")[0] for line in result.output.splitlines()] == [
        str(tmp_path / name) for name in ("a.st", "b/a/x.st", "b/z.ST")
    ]


@pytest.mark.parametrize(
    ("content", "said"),
    [
        (b"\x7fELF\x00\x01", "1:5: cannot be read: it is no text: byte 00H; name a file of text"),
        (b"(* ok *)\n(* Gr\xf6\xdfe *)", "2:6: cannot be read: it is not UTF-8: byte F6H; save it as UTF-8"),
        (b"(" * (8 * 1024 * 1024 + 1), "1:1: cannot be read: it is larger than 8 MiB"),
    ],
)
def test_what_is_no_source_is_reported(tmp_path: Path, content: bytes, said: str) -> None:
    path = tmp_path / "odd.st"
    path.write_bytes(content)
    result = run(path)
    assert (result.exit_code, result.output) == (2, f"{path}:{said}\n")


def test_all_files_that_cannot_be_read_are_reported(tmp_path: Path) -> None:
    odd = tmp_path / "a\n\x1b.st"
    result = run(tmp_path / "missing.st", tmp_path, odd)
    assert result.exit_code == 2
    assert result.stderr.splitlines() == [
        f"{tmp_path}:1:1: expected .st files in this folder, found none",
        f"{tmp_path / 'missing.st'}:1:1: cannot be read: No such file or directory",
        rf"{tmp_path}/a\u000a\u001b.st:1:1: cannot be read: No such file or directory",
    ]


def test_the_list_names_every_rule() -> None:
    result = run("--list")
    assert result.exit_code == 0
    assert [line.split()[1] for line in result.output.splitlines()] == list(RULES)
    rows = json.loads(run("--list", "--format", "json").output)
    assert [row["rule"] for row in rows] == list(RULES)


# ------------------------------------------------------------ the installed library

ROOT = Path(__file__).parents[2]


@pytest.mark.parametrize("name", ["one_motor.st", "three_makes.st"])
def test_a_program_that_uses_the_library_is_judged_as_it_would_run(name: str) -> None:
    result = run(ROOT / "examples" / name)
    assert (result.exit_code, result.output) == (0, "")


def test_only_the_named_files_are_reported_and_what_they_declare_themselves_is_theirs(tmp_path: Path) -> None:
    path = tmp_path / "mine.st"
    text = (ROOT / "examples/one_motor.st").read_text(encoding="utf-8").replace("CHF_Drive", "CHF_Drivve")
    path.write_text("TYPE\n  MB_Adu : ARRAY[0..255] OF BYTE;\nEND_TYPE\n" + text, encoding="utf-8")
    lines = run(path).output.splitlines()
    assert {line.split(":")[0] for line in lines} == {str(path)}
    assert next(line for line in lines if "ST003" in line).endswith("found CHF_Drivve")
    assert not any("duplicate-name" in line for line in lines)


def test_blocks_of_a_map_that_is_named_are_known(tmp_path: Path) -> None:
    own, path = tmp_path / "mine.yaml", tmp_path / "mine.st"
    text = (ROOT / "vendor_maps/invt_chf.yaml").read_text(encoding="utf-8")
    own.write_text(text.replace("prefix: CHF", "prefix: MY1"), encoding="utf-8")
    program = (ROOT / "examples/one_motor.st").read_text(encoding="utf-8")
    path.write_text(program.replace("CHF_Drive", "MY1_Drive"), encoding="utf-8")
    assert "ST003" in run(path).output
    result = run("--map", own, path)
    assert (result.exit_code, result.output) == (0, "")
    assert run("--map", tmp_path / "no.yaml", path).exit_code == 2
