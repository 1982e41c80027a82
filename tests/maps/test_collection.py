"""Maps that do not go together in one library, and names that make no identifier."""

from pathlib import Path

import pytest

from driveblocks.maps import collection
from driveblocks.maps.problem import MapError

EXAMPLE = Path(__file__).parent / "example.yaml"


def changed(tmp_path: Path, old: str, new: str) -> Path:
    path = tmp_path / "changed.yaml"
    source = EXAMPLE.read_text(encoding="utf-8")
    assert old in source
    path.write_text(source.replace(old, new, 1), encoding="utf-8")
    return path


def test_two_maps_of_one_prefix_are_refused(tmp_path: Path) -> None:
    other = changed(tmp_path, "format: 2", "format: 2")
    with pytest.raises(MapError, match="prefix EX100 is taken"):
        collection.read([EXAMPLE, other])


@pytest.mark.parametrize("names", [["modbus.yaml"], ["types.yaml"], ["a/one.yaml", "b/one.yaml"]])
def test_two_drives_in_one_folder_are_refused(tmp_path: Path, names: list[str]) -> None:
    paths = [tmp_path / name for name in names]
    for number, path in enumerate(paths):
        path.parent.mkdir(exist_ok=True)
        text = EXAMPLE.read_text(encoding="utf-8").replace("prefix: EX100", f"prefix: EX10{number}")
        path.write_text(text, encoding="utf-8")
    with pytest.raises(MapError, match=r"the folder .* is taken"):
        collection.read(paths)


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("symbol: RampSelection", "symbol: Unknown", "the output name Unknown is taken"),
        ("            symbol: RampSelection\n", "", "the output name Ramp is the name of a standard function"),
    ],
)
def test_names_that_make_no_identifier_are_refused(tmp_path: Path, old: str, new: str, said: str) -> None:
    with pytest.raises(MapError) as caught:
        collection.read([changed(tmp_path, old, new)])
    assert said in str(caught.value)


def test_two_maps_of_one_nameplate_are_refused(tmp_path: Path) -> None:
    text = EXAMPLE.read_text(encoding="utf-8")
    for prefix, plate in (("ONE", "EX1-*"), ("TWO", "EX1-Dx4*"), ("THREE", "EX2-*")):
        models = f"models: [{{plate: {plate}, printed: [EX1-D14, EX2-7], source: page 4}}]\nmanual:"
        made = text.replace("prefix: EX100", f"prefix: {prefix}").replace("\nmanual:", f"\n{models}", 1)
        (tmp_path / f"{prefix.lower()}.yaml").write_text(made, encoding="utf-8")
    with pytest.raises(MapError) as caught:
        collection.read(sorted(tmp_path.glob("*.yaml")))
    (problem,) = caught.value.problems
    assert str(problem).startswith(f"{tmp_path / 'two.yaml'}:8:18: a model number that fits EX1-Dx4* may fit EX1-* of ")
