"""Both YAML parsers make the same of every text: texts that they once read otherwise, and texts near to YAML."""

from pathlib import Path

import pytest
import yaml
from hypothesis import given
from tests.maps.agreement import TEXTS, outcome

from driveblocks.maps import catalog, nodes

FOUND = (
    "![", "!,", "!!]\n", "a: !.!\n", "|#\n", "a: >#b\n", "[? ]", "{ .-?? }\n", "[a?b]\n", "0:", "- a:", "-", "?",
    "{a: }\n", "[b: ]\n", "{a: # b\n }\n", "\n\ufeffa: b\n", "\n---\n\ufeff", "|2\n\ufeff", "\r---\r", "%FOO\r--- a\r",
    'a: "\\uD800"\n', 'a: "\\UFFFFFFFF"\n', "%YAML 1." + "1" * 5000 + "\n--- a\n", "a: \ud800\n", "- y\n" * 1000,
    "- !x y\n" * 1000,
)  # fmt: skip
"""Told or placed otherwise without libyaml, or a traceback, before nodes.parse left such texts to PyYAML's parser."""
needs_libyaml = pytest.mark.skipif(not yaml.__with_libyaml__, reason="PyYAML came without libyaml")


@needs_libyaml
@pytest.mark.parametrize("text", FOUND, ids=lambda text: ascii(text[:20]))
def test_what_was_found_is_read_alike(text: str) -> None:
    assert outcome(text, libyaml=True) == outcome(text, libyaml=False)


@needs_libyaml
@given(TEXTS)
def test_what_is_nearly_yaml_is_read_alike(text: str) -> None:
    assert outcome(text, libyaml=True) == outcome(text, libyaml=False)


@needs_libyaml
@pytest.mark.parametrize("path", catalog.shipped(), ids=lambda path: path.stem)
def test_a_good_map_is_read_by_libyaml(path: Path) -> None:
    """The quick way is taken: the other is many times as slow."""
    assert nodes._quickly(path.read_text(encoding="utf-8")) is not None
