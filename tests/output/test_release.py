"""What a user downloads: an archive per platform and family, whole, and the same bytes whenever it is made."""

import posixpath
import re
from pathlib import Path
from zipfile import ZipFile

import pytest
from click.testing import CliRunner
from tests.shipped import sources

from driveblocks.cli import app
from driveblocks.output.release import DATE, release
from driveblocks.platforms import EXPORTS, TARGETS

ROOT = Path(__file__).parents[2]
TWO = ("CHF", "SN300G5")
LIMIT = 300 * 1024


def made(out: Path, targets: tuple[str, ...]) -> dict[str, Path]:
    """The archives of two families, by name."""
    some = [one for one in sources() if one.drive.prefix in TWO]
    return {path.stem: path for path in release(ROOT, out, some, targets)}


@pytest.fixture(scope="module", params=[("siemens",), pytest.param(TARGETS, marks=pytest.mark.thorough)], ids=len)
def archives(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    """Those of one platform, and of all."""
    return made(tmp_path_factory.mktemp("release"), request.param)


def texts(path: Path) -> dict[str, str]:
    """What is in an archive, without its outer folder."""
    with ZipFile(path) as archive:
        return {name.removeprefix("driveblocks/"): archive.read(name).decode() for name in archive.namelist()}


def test_each_has_its_library_a_first_motor_wiring_and_licence(archives: dict[str, Path]) -> None:
    for name, path in archives.items():
        there, (target, _, family) = texts(path), name.removeprefix("driveblocks-0.1.0-").partition("-")
        assert {"LICENSE", "blocks/docs/Wiring.md", f"blocks/docs/{family or TWO[0]}_Drive.md"} <= there.keys()
        own = "".join(text for each, text in there.items() if each.startswith(f"blocks/{target}/"))
        assert f"{family or TWO[0]}_Drive" in own
        if target in EXPORTS:
            assert f"{family or TWO[0]}_Motor" in own
        others = {each.split("/")[1] for each in there if each.startswith("blocks/")} & {*TARGETS}
        assert others <= {target}


def test_the_page_of_one_family_names_that_and_no_other(archives: dict[str, Path]) -> None:
    for name, path in archives.items():
        target, _, family = name.removeprefix("driveblocks-0.1.0-").partition("-")
        if family and target in EXPORTS:
            page = texts(path)[f"blocks/{target}/README.md"]
            assert f"{family}_Version" in page
            assert not re.search(r"\bX(_|\b)", page)
            assert not re.search("|".join(one for one in TWO if one != family), page)


def test_no_link_in_it_is_dead(archives: dict[str, Path]) -> None:
    for path in archives.values():
        there = texts(path)
        for name in (each for each in there if each.endswith(".md")):
            links = re.findall(r"\]\((?!\w+:)([^)#\s]+)", there[name])
            led = {posixpath.normpath(posixpath.join(posixpath.dirname(name), link)) for link in links}
            assert led <= there.keys(), name


def test_one_family_takes_300_kilobytes_at_most(archives: dict[str, Path]) -> None:
    for name, path in archives.items():
        if name.endswith(TWO):
            assert path.stat().st_size <= LIMIT, name


def test_made_twice_they_are_the_same_bytes_with_a_fixed_date(archives: dict[str, Path], tmp_path: Path) -> None:
    targets = tuple(each for each in TARGETS if f"driveblocks-0.1.0-{each}" in archives)
    again = {name: path.read_bytes() for name, path in made(tmp_path, targets).items()}
    assert {name: path.read_bytes() for name, path in archives.items()} == again
    for path in archives.values():
        with ZipFile(path) as archive:
            assert {entry.date_time for entry in archive.infolist()} == {DATE}
            assert archive.namelist() == sorted(archive.namelist())


def test_the_command_writes_those_that_are_asked_for(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(ROOT)
    result = CliRunner().invoke(app, ["release", "chf", "--to", "openplc", "-o", str(tmp_path / "out")])
    assert result.exit_code == 0, result.output
    names = {f"driveblocks-0.1.0-openplc{each}.zip" for each in ("", "-CHF")}
    assert {path.name for path in (tmp_path / "out").iterdir()} == names
    monkeypatch.chdir(tmp_path)
    result = CliRunner().invoke(app, ["release", "chf"])
    assert (result.exit_code, "run it in a checkout" in result.stderr) == (2, True)
