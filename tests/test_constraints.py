"""What is installed has bounds: each dependency below its next major version, and pins of what the suite ran with."""

import importlib.metadata
import tomllib
from pathlib import Path

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
