"""Every broken map of `bad/` gives exactly its messages."""

import re
from collections.abc import Iterable
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest
from tests.maps import bad
from tests.maps.agreement import outcome

from driveblocks.maps import load, syntax, trap
from driveblocks.maps.problem import MapError

YAML_TROUBLE = re.compile(r"trap_|anchor|alias|tag_|directive|text_starts|.*_closed|list_|key_|escape|indented|colon")
"""Maps whose message comes from the YAML parser, which is the same with libyaml and without."""


def messages(text: str) -> list[str]:
    """The messages that the loader gives for a map, without the name of the file."""
    with TemporaryDirectory() as folder:
        path = Path(folder) / "map.yaml"
        path.write_bytes(text.encode("utf-8"))
        try:
            load.load(path)
        except MapError as error:
            return [str(problem).removeprefix(f"{path}:") for problem in error.problems]
    return []


def wrong(names: Iterable[str]) -> dict[str, tuple[list[str], list[str]]]:
    """The broken maps that get other messages than theirs: what they get, and what they should."""
    cases = bad.cases()
    said = {name: messages(cases[name].text) for name in names}
    return {name: (each, cases[name].messages) for name, each in said.items() if each != cases[name].messages}


@pytest.mark.parametrize("topic", bad.topics())
def test_every_bad_map_gets_its_messages(topic: str) -> None:
    assert wrong(bad.topics()[topic]) == {}


def test_what_the_parser_says_is_the_same_without_libyaml() -> None:
    texts = [case.text for name, case in bad.cases().items() if YAML_TROUBLE.match(name)]
    assert texts
    assert [each for each in texts if outcome(each, libyaml=False) != outcome(each, libyaml=True)] == []


def test_a_text_too_long() -> None:
    text = (bad.FOLDER / "small.yaml").read_text(encoding="utf-8").replace("both say so", "x" * 4001)
    assert messages(text) == ["56:113: a value of 4001 characters; one value has at most 4000"]


def test_every_trap_has_a_bad_map() -> None:
    said = "\n".join(message for case in bad.cases().values() for message in case.messages)
    assert [reading for _, reading, _ in trap._TRAPS if reading not in said] == []


def test_every_complaint_of_the_parser_has_a_bad_map() -> None:
    said = "\n".join(message for case in bad.cases().values() for message in case.messages)
    patterns = (re.escape(words.wrong.format("@", "@")).replace("@", ".+") for words in syntax._WORDS)
    assert [pattern for pattern in patterns if not re.search(pattern, said)] == []
