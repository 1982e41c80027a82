"""A manual in one language is a manual: which words of its own a map needs, and what is made of them."""

import re

import pytest

from driveblocks.bench import text as testing
from driveblocks.maps import load, page
from driveblocks.maps.model import Drive
from driveblocks.maps.problem import MapError
from driveblocks.render import library, text
from driveblocks.render.text import languages

BOTH = languages(["en", "zh"], "utf-8")
NAMED = re.compile(r"\b(?:name: |title: \{en: |interface: \{en: )([^,}\n]+)")


def mapped(old: str = "", new: str = "") -> Drive:
    """The smallest map with an edit."""
    made = page.skeleton().replace(old, new)
    assert not old or made != page.skeleton()
    return load.loads(made, "map.yaml")


def chinese(drive: Drive) -> set[str]:
    """The functions of a drive that tell texts in Chinese, which are also those that its programs test."""
    made = {file.name for file in library.drive("acme", drive, BOTH) if file.name.endswith("Zh")}
    tested = {script.name for script in testing.scripts(drive, "acme", BOTH) if script.name.endswith("Zh")}
    assert {name.replace("ACME_", "ACME_Test") for name in made} == tested
    return made


def said(made: str) -> list[str]:
    """The messages for a map, without their places."""
    with pytest.raises(MapError) as caught:
        load.loads(made, "map.yaml")
    return [f"{problem.wrong}; {problem.right}" for problem in caught.value.problems]


def in_words(made: str, key: str) -> str:
    """A map whose every name has the manual's own words beside it."""

    def both(found: re.Match[str]) -> str:
        end = found.string[found.end() : found.end() + 1]
        between = "\n        " if end == "\n" else ", "
        return f"{found[0]}{between}{key}: «{found[1]}»"

    return NAMED.sub(both, made)


def test_an_english_manual_needs_english_alone() -> None:
    drive = mapped()
    assert drive.manual.written_in == "en"
    assert page.skeleton().isascii()
    assert chinese(drive) == set()


def test_without_a_language_the_title_shows_it() -> None:
    assert mapped("  language: en", "  covers: all of it").manual.written_in == "en"
    wrong = said(page.skeleton().replace("language: en", "covers: all").replace("manual}", "manual, zh: 手册}"))
    assert "`Overcurrent` has no `zh`: the manual's wording is missing; add `zh` as the manual prints it, " in wrong[-2]
    assert all(message.endswith(", or `language: en` under `manual`") for message in wrong)


@pytest.mark.parametrize(("language", "key", "names"), [("zh", "zh", 3), ("de", "wording", 0), ("ja", "wording", 0)])
def test_another_manual_has_its_own_words_beside_each_name(language: str, key: str, names: int) -> None:
    made = page.skeleton().replace("language: en", f"language: {language}")
    wrong = said(made)
    assert all(f"has no `{key}`: the manual's wording is missing; add `{key}`" in message for message in wrong)
    assert len(wrong) == len(NAMED.findall(made)) + names  # those of maker, family and publisher in another script
    if not names:
        drive = load.loads(in_words(made, key), "map.yaml")
        assert drive.faults.codes[0].own == "«Overcurrent»"
        assert chinese(drive) == set()


def test_a_misprint_of_an_english_manual_is_beside_the_name() -> None:
    drive = mapped("name: Overcurrent", "name: Overcurrent, wording: Overcurent")
    assert (drive.faults.codes[0].name, drive.faults.codes[0].own) == ("Overcurrent", "Overcurent")


def test_a_second_language_is_asked_for_where_it_exists() -> None:
    drive = mapped("name: Overcurrent", "name: Overcurrent, zh: 过流")
    assert chinese(drive) == {"ACME_FaultTextZh"}
    assert "'$4F$43$20$E8$BF$87$E6$B5$81'" in str(text.fault_texts(drive, BOTH[1])["rows"])
    assert chinese(mapped("{value: 3, name: Stop,", "{value: 3, name: Stop, zh: 停机,")) == {"ACME_ValueTextZh"}
    assert chinese(mapped("{en: Acme Drives}", "{en: Acme Drives, zh: 顶点}")) == set()
