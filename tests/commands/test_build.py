"""`driveblocks build`: what happens to an output folder, and to what the user has in it."""

import json
import os
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from driveblocks.cli import app
from driveblocks.maps import collection
from driveblocks.maps.problem import Refused
from driveblocks.output import build, manifest
from driveblocks.render.text import Language

ROOT = Path(__file__).parents[2]
EXAMPLE = (ROOT / "tests/maps/example.yaml").read_text(encoding="utf-8")
CHECK = "one.yaml", "-o", "out", "--lang", "en", "--only", "--check"
FILES = {"README.md", "iec61131/order.txt", "tests/page.md"}


def few(sources: list[collection.Source], languages: list[Language], *_: object) -> dict[str, str]:
    """An output that is quick to make: a page of all drives, and a block of each."""
    names = ", ".join(source.drive.prefix for source in sources)
    blocks = {f"iec61131/{source.path.stem}/{source.drive.prefix}.st": f"{len(languages)}\n" for source in sources}
    return {"README.md": f"{names}\n", "iec61131/order.txt": f"{names}\n", "tests/page.md": "tests\n"} | blocks


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A user's folder with two maps, in which the user stands."""
    monkeypatch.chdir(tmp_path)
    put("one.yaml", EXAMPLE)
    put("two.yaml", EXAMPLE.replace("prefix: EX100", "prefix: EX200"))
    return tmp_path


def put(name: str, text: str) -> None:
    Path(name).parent.mkdir(parents=True, exist_ok=True)
    Path(name).write_text(text, encoding="utf-8")


def run(*arguments: str) -> Result:
    return CliRunner().invoke(app, ["build", *arguments], obj=few)


def good(*arguments: str) -> str:
    result = run(*arguments)
    assert result.exit_code == 0, result.output
    return result.output


def refused(*arguments: str) -> str:
    """What is said when a build is refused; nothing is changed then."""
    before = tree()
    result = run(*arguments)
    assert result.exit_code == 2
    assert tree() == before
    return result.stderr


def tree(folder: str = ".") -> dict[str, bytes | str | None]:
    """Files with their bytes, links with where they lead, folders."""
    found = {}
    for path in sorted(Path(folder).rglob("*")):
        what = str(path.readlink()) if path.is_symlink() else path.read_bytes() if path.is_file() else None
        found[path.relative_to(folder).as_posix()] = what
    return found


def files(folder: str) -> set[str]:
    return {name for name, content in tree(folder).items() if content is not None} - {manifest.NAME}


# ---------------------------------------------------------------- what is not the generator's


def test_a_project_folder_keeps_what_is_in_it() -> None:
    put("tests/mine.py", "mine")
    good("one.yaml", "-o", ".")
    good("two.yaml", "-o", ".", "--only")
    maps = {"one.yaml", "two.yaml", "tests/mine.py"}
    assert files(".") == maps | FILES | {"iec61131/two/EX200.st"}
    assert Path("tests/mine.py").read_text(encoding="utf-8") == "mine"


def test_a_foreign_file_in_the_way_is_named_before_anything_is_written() -> None:
    put("README.md", "my project")
    put("tests/page.md", "my tests")
    for force in ([], ["--force"]):
        said = refused("one.yaml", "-o", ".", *force)
        assert "README.md: in the way, and not written by DriveBlocks\ntests/page.md: in the way" in said
        assert said.endswith("nothing was written\n")


@pytest.mark.parametrize("barrier", ["file", "link", "link to nowhere", "folder"])
def test_what_is_no_folder_or_no_file_is_in_the_way(barrier: str) -> None:
    Path("out").mkdir()
    name = "out/README.md" if barrier == "folder" else "out/iec61131"
    if barrier == "file":
        put(name, "a file")
    elif barrier == "folder":
        Path(name).mkdir()
    else:
        Path(name).symlink_to(Path("elsewhere").absolute())
        if barrier == "link":
            Path("elsewhere").mkdir()
    for force in ([], ["--force"]):
        assert f"{name}: in the way" in refused("one.yaml", "-o", "out", *force)


def test_a_long_list_is_cut_short() -> None:
    names = [f"page{number}" for number in range(build.SHOWN + 1)]
    plan = build.Plan([], manifest.Manifest(), {}, dict.fromkeys(names, manifest.State.FOREIGN))
    with pytest.raises(Refused, match="\nand 1 more\n"):
        build.write(Path("out"), plan)


def test_an_older_output_is_explained() -> None:
    good("one.yaml", "-o", "out")
    Path("out", manifest.NAME).unlink()
    put("out/README.md", "of an older version")
    assert "if an older version built out, delete what it wrote there" in refused("one.yaml", "-o", "out")


def test_an_older_output_with_the_same_files_is_taken_over() -> None:
    good("one.yaml", "-o", "out")
    Path("out", manifest.NAME).unlink()
    assert run("one.yaml", "-o", "out", "--check").exit_code == 1
    assert "4 files for EX100, 0 changed" in good("one.yaml", "-o", "out")
    good("two.yaml", "-o", "out", "--only")
    assert files("out") == FILES | {"iec61131/two/EX200.st"}
    assert Path("out/iec61131/one").is_dir(), "a folder that was there before is not the generator's"


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="there are no named pipes here")
def test_a_pipe_is_no_manifest() -> None:
    Path("out").mkdir()
    os.mkfifo(Path("out", manifest.NAME))
    result = run("one.yaml", "-o", "out")
    assert (result.exit_code, "not the list that this version" in result.stderr) == (2, True)


@pytest.mark.parametrize(
    "text",
    [
        "", "[]", "<<<<<<<", '{"format": 2, "maps": [], "files": {}, "folders": []}',
        '{"format": 1, "maps": [], "files": {"../one.yaml": "0"}, "folders": []}',
        '{"format": 1, "maps": [], "files": {}, "folders": ["/"]}',
        '{"format": 1, "maps": [1], "files": {}, "folders": []}',
        '{"format": 1, "maps": ["/a\\u0000.yaml"], "files": {}, "folders": []}',
        '{"format": 1, "maps": [], "files": {}, "folders": ["a\\u0000b"]}',
        '{"format": 1, "maps": [], "files": {}, "folders": "iec61131"}', "[" * 100_000,
    ],
)  # fmt: skip
def test_a_manifest_that_is_none_is_refused(text: str) -> None:
    good("one.yaml", "-o", "out")
    put(f"out/{manifest.NAME}", text)
    assert f"out/{manifest.NAME}: not the list that this version" in refused("two.yaml", "-o", "out")


def test_an_empty_name_is_no_folder() -> None:
    result = run("one.yaml", "-o", "")
    assert result.exit_code == 2
    assert "an empty name is no folder" in result.stderr
    assert files(".") == {"one.yaml", "two.yaml"}


# ---------------------------------------------------------------- what is the generator's


def test_an_edited_file_is_named_and_replaced_only_by_force() -> None:
    good("one.yaml", "-o", "out")
    put("out/iec61131/one/EX100.st", "by hand")
    put("out/README.md", "by hand")
    said = refused("two.yaml", "-o", "out")
    assert "out/README.md: edited since it was built\nout/iec61131/one/EX100.st: edited since it was built" in said
    assert "--force" in said
    good("one.yaml", "-o", "out", "--force")
    assert Path("out/iec61131/one/EX100.st").read_text(encoding="utf-8") == "2\n"


def test_an_edited_file_that_is_left_over_is_removed_only_by_force() -> None:
    good("one.yaml", "-o", "out")
    put("out/iec61131/one/EX100.st", "by hand")
    assert "out/iec61131/one/EX100.st: edited" in refused("two.yaml", "-o", "out", "--only")
    good("two.yaml", "-o", "out", "--only", "--force")
    assert not Path("out/iec61131/one").exists()


@pytest.mark.parametrize("own", ["siemens/yours/EX_Motor.scl", "beremiz/DriveBlocks/plc.xml"])
def test_what_is_the_users_is_kept_as_edited_whatever_is_asked(own: str) -> None:
    def with_own(sources: list[collection.Source], languages: list[Language], *_: object) -> dict[str, str]:
        return few(sources, languages) | {own: f"motor of {len(sources)}\n"}

    def built(*words: str) -> str:
        result = CliRunner().invoke(app, ["build", *words, "-o", "out", "--lang", "en"], obj=with_own)
        assert result.exit_code == 0, result.output
        return result.output

    built("one.yaml")
    put(f"out/{own}", "mine\n")
    for words in (["one.yaml"], ["one.yaml", "--force"], ["two.yaml"], ["two.yaml", "--only", "--check"]):
        if "--check" in words:
            built("two.yaml", "--only")
        assert f"out/{own}: yours, kept as you edited it" in built(*words)
        assert Path(f"out/{own}").read_text(encoding="utf-8") == "mine\n"
    put(f"out/{own}", "motor of 1\n")
    assert "kept" not in built("two.yaml")
    assert Path(f"out/{own}").read_text(encoding="utf-8") == "motor of 1\n"


def test_a_file_that_became_a_link_is_edited_and_never_written_through() -> None:
    good("one.yaml", "-o", "out")
    Path("out/README.md").unlink()
    Path("out/README.md").symlink_to(Path("mine").absolute())
    put("mine", "EX100\n")
    assert "out/README.md: edited" in refused("one.yaml", "-o", "out")
    good("one.yaml", "two.yaml", "-o", "out", "--force")
    assert Path("mine").read_text(encoding="utf-8") == "EX100\n"
    assert not Path("out/README.md").is_symlink()


def test_line_ends_of_a_checkout_are_no_edit() -> None:
    good("one.yaml", "-o", "out")
    for name in [*FILES, manifest.NAME]:
        path = Path("out", name)
        path.write_bytes(path.read_bytes().replace(b"\n", b"\r\n"))
    good("one.yaml", "-o", "out", "--check")
    good("two.yaml", "-o", "out")


def test_names_that_differ_in_case_only_are_one_file_where_case_does_not_count() -> None:
    """A hard link means the second name."""
    good("one.yaml", "-o", "out")
    put("One.yaml", EXAMPLE)
    Path("out/iec61131/One").mkdir()
    Path("out/iec61131/One/EX100.st").hardlink_to("out/iec61131/one/EX100.st")
    good("One.yaml", "-o", "out", "--only", "--lang", "en")
    assert files("out") == FILES | {"iec61131/One/EX100.st"}


def test_check_says_what_is_wrong_and_writes_nothing() -> None:
    good("one.yaml", "-o", "out", "--lang", "en")
    put("out/README.md", "by hand")
    put("out/mine", "mine")
    Path("out/iec61131/order.txt").unlink()
    put("two.yaml", "")
    before = tree()
    result = run("one.yaml", "-o", "out", "--check")
    assert result.exit_code == 1
    assert result.stderr.splitlines() == [
        "not current:",
        f"  out/{manifest.NAME}: out of date",
        "  out/README.md: edited since it was built",
        "  out/iec61131/one/EX100.st: out of date",
        "  out/iec61131/order.txt: missing",
        "run: driveblocks build one.yaml -o out",
    ]
    assert tree() == before


def test_check_names_the_command() -> None:
    assert "run: driveblocks build one.yaml -o out --lang en --only\n" in run(*CHECK).stderr
    assert not Path("out").exists()
    good(*CHECK[:-1])
    good(*CHECK)


def test_what_is_checked_in_is_current() -> None:
    result = CliRunner().invoke(app, ["build", "-o", str(ROOT / "blocks"), "--check"])
    assert (result.exit_code, result.stderr) == (0, "")
    assert "kept" not in result.stdout, "a file of the checkout was edited by hand"


# ---------------------------------------------------------------- families that join


def test_a_second_family_keeps_the_first_in_files_and_pages() -> None:
    good("one.yaml", "two.yaml", "-o", "both")
    good("two.yaml", "-o", "out")
    assert "5 files for EX100, EX200, 3 changed" in good("one.yaml", "-o", "out")
    assert tree("out") == tree("both")
    assert json.loads(Path("out", manifest.NAME).read_text(encoding="utf-8"))["maps"] == ["../one.yaml", "../two.yaml"]
    good("two.yaml", "-o", "out", "--check")


def test_a_map_of_the_folder_that_has_changed_is_built_anew() -> None:
    good("one.yaml", "-o", "out")
    put("one.yaml", EXAMPLE.replace("prefix: EX100", "prefix: EX300"))
    good("two.yaml", "-o", "out")
    assert files("out") == FILES | {"iec61131/one/EX300.st", "iec61131/two/EX200.st"}


def test_a_map_of_the_folder_that_is_bad_is_reported() -> None:
    good("one.yaml", "-o", "out")
    put("one.yaml", EXAMPLE.replace("format: 2", "format: 3"))
    said = refused("two.yaml", "-o", "out")
    assert said.startswith("one.yaml:")
    assert said.endswith("out was built from one.yaml as well; --only builds without\n")


def test_a_map_of_the_folder_that_is_gone_is_reported() -> None:
    good("one.yaml", "-o", "out")
    Path("one.yaml").unlink()
    said = refused("two.yaml", "-o", "out")
    assert said.startswith("one.yaml: not there; out was built from it as well\nname the map where it is now")
    good("two.yaml", "-o", "out", "--only")


def test_a_map_that_was_moved_is_the_same_family() -> None:
    good("one.yaml", "-o", "out")
    Path("maps").mkdir()
    Path("one.yaml").rename("maps/one.yaml")
    assert "for EX100," in good("maps/one.yaml", "-o", "out")


def test_shipped_maps_go_by_their_names() -> None:
    good("jscc", "-o", "out")
    assert "for CHF, JSCC," in good("chf", "-o", "out")
    assert json.loads(Path("out", manifest.NAME).read_text(encoding="utf-8"))["maps"] == ["invt_chf", "jscc"]
    put("out/../far/one.yaml", EXAMPLE)
    good("far/one.yaml", "-o", "out")
    os.chdir("far")
    assert "for CHF, JSCC, EX100," in good("one.yaml", "-o", "../out")


# ---------------------------------------------------------------- what goes wrong


def test_a_bad_map_leaves_the_old_output_whole() -> None:
    good("one.yaml", "-o", "out")
    put("two.yaml", EXAMPLE.replace("format: 2", "format: 3"))
    assert "two.yaml:" in refused("one.yaml", "two.yaml", "-o", "out")
    assert "two.yaml:" in refused("two.yaml", "-o", "new/out")


def test_an_output_that_is_no_folder_is_said_plainly() -> None:
    put("out", "a file, not a folder")
    assert refused("one.yaml", "-o", "out").startswith("out: ")
    assert refused("one.yaml", "-o", "out/deeper").startswith("out/deeper: ")


@pytest.mark.parametrize("arguments", [["--lang", "fr"], ["--lang", ""], ["--encoding", "latin-1"], ["no_such_drive"]])
def test_wrong_words_are_refused(arguments: list[str]) -> None:
    assert "Traceback" not in refused(*arguments, "-o", "out")


def test_a_named_map_takes_the_place_of_the_shipped_one_that_a_folder_was_built_from() -> None:
    good("chf", "-o", "out")
    put("invt_chf.yaml", (ROOT / "vendor_maps/invt_chf.yaml").read_text(encoding="utf-8"))
    good("invt_chf.yaml", "one.yaml", "-o", "out")
    assert manifest.read(Path("out")).maps == ("../invt_chf.yaml", "../one.yaml")
