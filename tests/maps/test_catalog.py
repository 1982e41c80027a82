"""Finding maps: shipped ones by name, others by path."""

from pathlib import Path

import pytest

from driveblocks.maps import catalog
from driveblocks.maps.catalog import UnknownDrive
from driveblocks.maps.load import load

MAPS = {"acme_turbo100": "TURBO1", "acme_eco": "ECO", "bravo_eco2": "BRAVO"}

PLATES = {"acme_turbo100": "TB1-*", "bravo_eco2": '"BE2-x4*"'}


@pytest.fixture
def shelf(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder of three maps that means the shipped ones; the user is in another."""
    folder = tmp_path / "shelf"
    folder.mkdir()
    for stem, prefix in MAPS.items():
        models = f"models:\n  - {{plate: {PLATES[stem]}, source: page 4}}\n" if stem in PLATES else ""
        text = f"# plate: ECO-*\nformat: 2\nprefix: {prefix}\n{models}manual: {{plate: ECO-*}}\n"
        (folder / f"{stem}.yaml").write_text(text, encoding="utf-8")
    monkeypatch.setattr(catalog, "folder", lambda: folder)
    here = tmp_path / "here"
    here.mkdir()
    monkeypatch.chdir(here)
    return folder


@pytest.mark.parametrize(
    ("name", "stem"),
    [
        ("acme_turbo100", "acme_turbo100"),
        ("ACME_Turbo100", "acme_turbo100"),
        ("TURBO1", "acme_turbo100"),
        ("turbo1", "acme_turbo100"),
        ("turbo", "acme_turbo100"),
        ("eco", "acme_eco"),
        ("eco2", "bravo_eco2"),
        ("bravo", "bravo_eco2"),
    ],
)
def test_a_shipped_map_is_found_by_file_prefix_or_part(shelf: Path, name: str, stem: str) -> None:
    assert catalog.resolve(name) == shelf / f"{stem}.yaml"


def test_an_ambiguous_part_names_the_drives_that_it_fits(shelf: Path) -> None:
    with pytest.raises(UnknownDrive, match="`acme` fits several drives; write one of acme_eco, acme_turbo100"):
        catalog.resolve("acme")


@pytest.mark.parametrize(("name", "near"), [("acme_ecco", "acme_eco"), ("turbo2", "acme_turbo100")])
def test_a_mistyped_name_is_answered_with_the_nearest(shelf: Path, name: str, near: str) -> None:
    with pytest.raises(UnknownDrive) as refusal:
        catalog.resolve(name)
    told = str(refusal.value)
    assert told.startswith(f"there is no drive `{name}`; did you mean {near}")
    assert "known drives are acme_eco, acme_turbo100, bravo_eco2" in told


@pytest.mark.parametrize("name", ["", "zzz"])
def test_a_name_like_nothing_is_answered_with_all(shelf: Path, name: str) -> None:
    with pytest.raises(UnknownDrive, match="known drives are acme_eco, acme_turbo100, bravo_eco2"):
        catalog.resolve(name)


@pytest.mark.parametrize(
    ("name", "stem"),
    [
        ("BE2-D4P0", "bravo_eco2"),
        ("be2 d4", "bravo_eco2"),
        ("BE2-A4P0/5P5-4", "bravo_eco2"),
        ("TB1-5", "acme_turbo100"),
    ],
)
def test_a_shipped_map_is_found_by_a_nameplate(shelf: Path, name: str, stem: str) -> None:
    assert catalog.resolve(name) == shelf / f"{stem}.yaml"


def test_a_name_wins_over_a_nameplate_and_a_file_over_one_with_a_stroke(shelf: Path) -> None:
    (shelf / "tb1-5.yaml").write_text("prefix: OTHER\n", encoding="utf-8")
    assert catalog.resolve("TB1-5") == shelf / "tb1-5.yaml"
    Path("TB1-5").mkdir()
    Path("TB1-5/eco").touch()
    assert catalog.resolve("TB1-5/eco") == Path("TB1-5/eco")
    assert catalog.resolve("TB1-5/eco2") == shelf / "acme_turbo100.yaml"


def test_a_nameplate_of_two_maps_names_both(shelf: Path) -> None:
    (shelf / "third.yaml").write_text("prefix: THIRD\nmodels: [{plate: TB1-5*}]\nmanual: {}\n", encoding="utf-8")
    with pytest.raises(UnknownDrive, match="`TB1-55` fits several drives; write one of acme_turbo100, third"):
        catalog.resolve("TB1-55")


@pytest.mark.parametrize("path", catalog.shipped(), ids=lambda path: path.stem)
def test_every_printed_nameplate_finds_its_shipped_map(path: Path) -> None:
    models = load(path).models
    assert catalog.plates(path) == tuple(one.plate for one in models)
    assert {catalog.resolve(number) for one in models for number in one.printed if one.plate.fits(number)} <= {path}


@pytest.mark.parametrize("name", ["./eco.yaml", "eco.yaml", "eco.YML", "folder/eco"])
def test_a_path_stays_a_path(shelf: Path, name: str) -> None:
    assert catalog.resolve(name) == Path(name)


def test_a_shipped_name_wins_over_a_folder_of_that_name(shelf: Path) -> None:
    Path("eco").mkdir()
    Path("plain").mkdir()
    assert catalog.resolve("eco") == shelf / "acme_eco.yaml"
    assert catalog.resolve("plain") == Path("plain")


def test_a_map_that_cannot_be_read_keeps_its_file_name(shelf: Path) -> None:
    (shelf / "broken.yaml").write_bytes(b"\xff\xfe\x00")
    (shelf / "lost.yaml").symlink_to(shelf / "nowhere")
    assert catalog.resolve("broken") == shelf / "broken.yaml"
    assert catalog.resolve("lost") == shelf / "lost.yaml"


def test_the_shipped_maps_are_those_of_the_checkout() -> None:
    beside = Path(__file__).parents[2] / "vendor_maps"
    assert [path.name for path in catalog.shipped()] == sorted(path.name for path in beside.glob("*.yaml"))
    assert catalog.shipped()


def test_a_wheel_carries_its_own_maps(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    packed = tmp_path / "driveblocks" / "vendor_maps"
    packed.mkdir(parents=True)
    monkeypatch.setattr("driveblocks.__file__", str(tmp_path / "driveblocks" / "__init__.py"))
    assert catalog.folder() == packed.resolve()


def test_a_path_is_shown_from_the_folder_of_the_user(shelf: Path) -> None:
    assert catalog.shown(Path.cwd() / "a" / "b.yaml") == str(Path("a/b.yaml"))
    assert catalog.shown(shelf / "acme_eco.yaml") == str(shelf / "acme_eco.yaml")
