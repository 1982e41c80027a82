"""`driveblocks build`: the same text every time, the old output whole when something is wrong, stale output found."""

from pathlib import Path

import pytest
from typer.testing import CliRunner

from driveblocks.cli import app
from driveblocks.maps.problem import MapError
from driveblocks.render import build, text

ROOT = Path(__file__).parents[2]
EXAMPLE = ROOT / "tests/maps/example.yaml"
BOTH = text.languages(["en", "zh"], "utf-8")


@pytest.fixture(scope="module")
def wanted() -> dict[str, str]:
    return build.files(build.read([EXAMPLE]), BOTH)


def changed(tmp_path: Path, old: str, new: str) -> Path:
    path = tmp_path / "changed.yaml"
    source = EXAMPLE.read_text(encoding="utf-8")
    assert old in source
    path.write_text(source.replace(old, new, 1), encoding="utf-8")
    return path


def test_two_builds_are_equal(wanted: dict[str, str]) -> None:
    assert build.files(build.read([EXAMPLE]), BOTH) == wanted


def test_nothing_in_the_output_depends_on_the_machine(wanted: dict[str, str], tmp_path: Path) -> None:
    elsewhere = tmp_path / "example.yaml"
    elsewhere.write_bytes(EXAMPLE.read_bytes())
    assert build.files(build.read([elsewhere]), BOTH) == wanted


def test_what_is_written_is_current(wanted: dict[str, str], tmp_path: Path) -> None:
    build.write(tmp_path, wanted)
    assert build.stale(tmp_path, wanted) == []
    build.write(tmp_path, wanted)
    assert sorted(path.name for path in tmp_path.iterdir() if path.name.startswith(".")) == []


def test_a_changed_a_missing_and_a_left_over_file_are_stale(wanted: dict[str, str], tmp_path: Path) -> None:
    build.write(tmp_path, wanted)
    (tmp_path / "iec61131/modbus/MB_Lrc.st").write_text("(* by hand *)", encoding="utf-8")
    (tmp_path / "iec61131/modbus/MB_Crc16.st").unlink()
    (tmp_path / "iec61131/old.st").write_text("", encoding="utf-8")
    assert build.stale(tmp_path, wanted) == [
        "iec61131/modbus/MB_Crc16.st",
        "iec61131/modbus/MB_Lrc.st",
        "iec61131/old.st",
    ]


def test_a_bad_map_leaves_the_old_output_whole(wanted: dict[str, str], tmp_path: Path) -> None:
    out = tmp_path / "out"
    out.mkdir()
    build.write(out, wanted)
    bad = changed(tmp_path, "format: 1", "format: 2")
    result = CliRunner().invoke(app, ["build", str(EXAMPLE), str(bad), "-o", str(out)])
    assert result.exit_code == 2
    assert f"{bad}:" in result.output
    assert build.stale(out, wanted) == []


def test_an_unwritable_folder_is_said_plainly(tmp_path: Path) -> None:
    (tmp_path / "out").write_text("a file, not a folder", encoding="utf-8")
    result = CliRunner().invoke(app, ["build", str(EXAMPLE), "-o", str(tmp_path / "out")])
    assert result.exit_code == 2
    assert "Traceback" not in result.output
    assert (tmp_path / "out").read_text(encoding="utf-8") == "a file, not a folder"


def test_check_names_the_command(tmp_path: Path) -> None:
    result = CliRunner().invoke(app, ["build", str(EXAMPLE), "-o", str(tmp_path), "--check"])
    assert result.exit_code == 1
    assert f"run: driveblocks build {EXAMPLE} -o {tmp_path}" in result.output
    assert list(tmp_path.iterdir()) == []
    assert CliRunner().invoke(app, ["build", str(EXAMPLE), "-o", str(tmp_path)]).exit_code == 0
    assert CliRunner().invoke(app, ["build", str(EXAMPLE), "-o", str(tmp_path), "--check"]).exit_code == 0


def test_what_is_checked_in_is_current() -> None:
    result = CliRunner().invoke(app, ["build", "-o", str(ROOT / "blocks"), "--check"])
    assert result.exit_code == 0, result.output


@pytest.mark.parametrize("arguments", [["--lang", "fr"], ["--lang", ""], ["--encoding", "latin-1"], ["no_such_drive"]])
def test_wrong_words_are_refused(arguments: list[str], tmp_path: Path) -> None:
    result = CliRunner().invoke(app, ["build", *arguments, "-o", str(tmp_path)])
    assert result.exit_code == 2
    assert "Traceback" not in result.output
    assert list(tmp_path.iterdir()) == []


def test_a_language_left_out_costs_nothing() -> None:
    english = build.files(build.read([EXAMPLE]), text.languages(["en"], "utf-8"))
    assert not [name for name in english if name.endswith("Zh.st")]
    assert "TextZh" not in english["iec61131/order.txt"]


def test_chinese_can_be_gb18030() -> None:
    made = build.files(build.read([EXAMPLE]), text.languages(["zh"], "gb18030"))
    shown = made["iec61131/modbus/MB_ResultTextZh.st"]
    assert "'" + "".join(f"${byte:02X}" for byte in "无应答".encode("gb18030")) + "'" in shown


def test_two_maps_of_one_prefix_are_refused(tmp_path: Path) -> None:
    other = changed(tmp_path, "format: 1", "format: 1")
    with pytest.raises(MapError, match="prefix EX100 is taken"):
        build.read([EXAMPLE, other])


@pytest.mark.parametrize("names", [["modbus.yaml"], ["types.yaml"], ["a/one.yaml", "b/one.yaml"]])
def test_two_drives_in_one_folder_are_refused(tmp_path: Path, names: list[str]) -> None:
    paths = [tmp_path / name for name in names]
    for number, path in enumerate(paths):
        path.parent.mkdir(exist_ok=True)
        text = EXAMPLE.read_text(encoding="utf-8").replace("prefix: EX100", f"prefix: EX10{number}")
        path.write_text(text, encoding="utf-8")
    with pytest.raises(MapError, match=r"the folder .* is taken"):
        build.read(paths)


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("symbol: RampSelection", "symbol: Unknown", "the output name Unknown is taken"),
        ("            symbol: RampSelection\n", "", "the output name Ramp is the name of a standard function"),
    ],
)
def test_names_that_make_no_identifier_are_refused(tmp_path: Path, old: str, new: str, said: str) -> None:
    with pytest.raises(MapError) as caught:
        build.read([changed(tmp_path, old, new)])
    assert said in str(caught.value)
