"""What is built from maps: the same text every time, in the languages asked for."""

import os
import posixpath
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from click.testing import CliRunner

from driveblocks.cli import app
from driveblocks.maps import catalog, collection, page
from driveblocks.output import build
from driveblocks.platforms import TARGETS
from driveblocks.render import text

ROOT = Path(__file__).parents[2]
EXAMPLE = ROOT / "tests/maps/example.yaml"
BOTH = text.languages(["en", "zh"], "utf-8")


@pytest.fixture(scope="module")
def wanted() -> dict[str, str]:
    return build.files(collection.read([EXAMPLE]), BOTH)


def test_two_builds_are_equal_wherever_the_map_is_and_tell_what_they_make(
    wanted: dict[str, str], tmp_path: Path
) -> None:
    elsewhere = tmp_path / "example.yaml"
    elsewhere.write_bytes(EXAMPLE.read_bytes())
    said: list[str] = []
    assert build.files(collection.read([elsewhere]), BOTH, tell=said.append) == wanted
    assert said == [build.BLOCKS, build.PAGES, "iec61131"]


def test_a_language_left_out_costs_nothing() -> None:
    english = build.files(collection.read([EXAMPLE]), text.languages(["en"], "utf-8"))
    assert not [name for name in english if name.endswith("Zh.st")]
    assert "TextZh" not in english["iec61131/order.txt"]


@pytest.mark.thorough
def test_english_alone_is_ascii_in_every_file_but_for_the_sign_of_a_degree() -> None:
    fourth = sorted((ROOT / "tests/blocks/fourth_drive").glob("*.yaml"))
    made = build.files(collection.read([*catalog.shipped(), *fourth, EXAMPLE]), text.languages(["en"], "utf-8"))
    assert [name for name, content in made.items() if not content.replace("°C", "").isascii()] == []


@pytest.mark.parametrize(
    ("lang", "files", "said"),
    [
        ("en,zh", 1, "ACME: the map has no Chinese texts: its texts are English alone"),
        ("zh", 0, "ACME: the map has no Chinese texts: it gets no text functions; --lang en makes them"),
        ("en", 1, ""),
        ("", 1, ""),
    ],
)
@pytest.mark.thorough
def test_a_map_without_chinese_gets_none_and_a_build_that_asked_says_so(
    tmp_path: Path, lang: str, files: int, said: str
) -> None:
    path = tmp_path / "acme.yaml"
    path.write_text(page.skeleton(), encoding="utf-8")
    asked = ["--lang", lang] if lang else []
    result = CliRunner().invoke(app, ["build", str(path), "-o", str(tmp_path / "out"), *asked])
    assert result.exit_code == 0
    assert "\n".join(result.stdout.splitlines()[1:]) == said
    assert len(list((tmp_path / "out").rglob("ACME_FaultText*.st"))) == files
    assert not list((tmp_path / "out").rglob("ACME_*TextZh.st"))


def test_chinese_can_be_gb18030() -> None:
    made = build.files(collection.read([EXAMPLE]), text.languages(["zh"], "gb18030"))
    shown = made["iec61131/modbus/MB_ResultTextZh.st"]
    assert "'" + "".join(f"${byte:02X}" for byte in "无应答".encode("gb18030")) + "'" in shown


@pytest.mark.thorough
def test_a_wheel_carries_all_that_a_build_of_all_targets_needs(tmp_path: Path) -> None:
    """The package as it is packed: without what .gitignore names, and nothing of the project beside it."""
    left_out = (ROOT / ".gitignore").read_text(encoding="utf-8").replace("/\n", "\n").split()
    for package in ("driveblocks", "structured_text"):
        source = ROOT / "generator" / package
        shutil.copytree(source, tmp_path / package, ignore=shutil.ignore_patterns(*left_out))
    code = "import driveblocks.__main__ as start; print(start.__file__); start.main()"
    words = ["build", str(EXAMPLE), "-o", "out", "--to", "all"]
    done = subprocess.run(
        [sys.executable, "-c", code, *words],
        cwd=tmp_path,
        env={**os.environ, "PYTHONPATH": str(tmp_path)},
        capture_output=True,
        text=True,
        timeout=600,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    assert done.stdout.startswith(str(tmp_path / "driveblocks" / "__main__.py"))
    made = {path.name for path in (tmp_path / "out").iterdir()}
    assert made >= {*TARGETS}


def test_no_page_leads_to_what_is_not_there_and_in_a_checkout_it_leads_to_the_guides(tmp_path: Path) -> None:
    link = re.compile(r"\]\((?!\w+:)([^)#]+)")
    guide = tmp_path / "checkout/docs/stop.md"
    guide.parent.mkdir(parents=True)
    guide.touch()
    for place, beside in (("alone/out", set[str]()), ("checkout/out", {"../docs/stop.md"})):
        made = build.plan(tmp_path / place, [EXAMPLE], build.Wanted(BOTH, ["siemens"])).texts
        led = {
            posixpath.normpath(posixpath.join(posixpath.dirname(name), target))
            for name, content in made.items()
            if name.endswith(".md")
            for target in link.findall(content)
        }
        assert led - made.keys() == beside
        assert {"siemens/README.md", "docs/Families.md"} <= led
