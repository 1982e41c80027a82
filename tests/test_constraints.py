"""What is installed has bounds: each dependency below its next major version, and pins of what the suite ran with."""

import importlib.metadata
import importlib.util
import tomllib
from pathlib import Path
from types import ModuleType

import pytest
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name
from packaging.version import Version

ROOT = Path(__file__).parents[1]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
DIRECT = [
    Requirement(text)
    for text in (*PROJECT["project"]["dependencies"], *PROJECT["project"]["optional-dependencies"]["test"])
]
PINS = [
    Requirement(line)
    for line in (ROOT / "constraints.txt").read_text(encoding="utf-8").splitlines()
    if not line.startswith("#")
]


def pin(requirement: Requirement) -> Version:
    """The version that a package is pinned to."""
    (each,) = requirement.specifier
    assert each.operator == "=="
    return Version(each.version)


PINNED = {canonicalize_name(each.name): pin(each) for each in PINS}


@pytest.mark.parametrize("needed", DIRECT, ids=lambda needed: needed.name)
def test_a_dependency_has_an_upper_bound_and_a_pin_within(needed: Requirement) -> None:
    pinned = PINNED[canonicalize_name(needed.name)]
    assert needed.specifier.contains(pinned)
    assert not needed.specifier.contains(f"{pinned.major + 1}.0")


@pytest.mark.parametrize("name", PINNED)
def test_what_a_pinned_package_needs_is_pinned(name: str) -> None:
    for text in importlib.metadata.requires(name) or []:
        needed = Requirement(text)
        if needed.marker is None or needed.marker.evaluate({"extra": ""}):
            assert canonicalize_name(needed.name) in PINNED, text


@pytest.fixture
def bootstrap(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    """The program, with a checkout of its own that has a virtual environment."""
    spec = importlib.util.spec_from_file_location("bootstrap", ROOT / "generator/bootstrap.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    for name in ("pyproject.toml", "constraints.txt"):
        (tmp_path / name).write_bytes((ROOT / name).read_bytes())
    (tmp_path / "python").touch()
    for name, value in (("ROOT", tmp_path), ("VENV", tmp_path), ("BIN", tmp_path)):
        monkeypatch.setattr(module, name, value)
    return module


def test_the_pins_are_installed_and_installed_again_when_they_change(
    bootstrap: ModuleType, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    calls: list[list[str]] = []

    def installed(command: list[str]) -> int:
        calls.append(command)
        return 0

    monkeypatch.setattr(bootstrap, "is_whole", lambda: True)
    monkeypatch.setattr(bootstrap, "installed", installed)
    assert bootstrap.set_up("[test]")
    assert [call[-2:] for call in calls] == [["--constraint", "constraints.txt"]]
    assert bootstrap.set_up("[test]")
    assert len(calls) == 1
    (tmp_path / "constraints.txt").write_text("rich==14.0.0\n", encoding="utf-8")
    assert bootstrap.set_up("[test]")
    assert len(calls) == 2
