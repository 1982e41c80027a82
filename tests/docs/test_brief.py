"""Six questions of a technician at the top of each page: answers typed by hand, from what the maps say."""

import re

import pytest
from tests import families
from tests.docs.test_pages import FAMILIES, FOLDER, page
from tests.shipped import drives

from driveblocks.docs.brief import questions
from driveblocks.maps.view import markdown

TOP = 30
"""Lines of a page that are on its first screen."""
ANSWERS = families.own("BRIEF")
"""Words of each answer: wire, keypad, cable, reset, fault, speed."""
every_family = pytest.mark.parametrize("family", FAMILIES)


@every_family
def test_the_first_screen_answers_six_questions(family: str) -> None:
    lines = page(family).splitlines()[:TOP]
    asked = [line for line in lines if re.search(r"\? \| .+ \| \[.+\]\(#.+\) \|$", line)]
    assert len(asked) == len(ANSWERS[family])
    for line, answer in zip(asked, ANSWERS[family], strict=True):
        assert markdown(answer).upper() in line.upper()


@every_family
def test_each_answer_leads_to_a_section_of_the_page(family: str) -> None:
    headings = re.findall(r"^##+ (.*)$", page(family), re.MULTILINE)
    assert [each.section for each in questions(drives()[family], "x") if each.section not in headings] == []


@every_family
def test_the_page_of_a_drive_and_the_catalogue_lead_to_the_requests(family: str) -> None:
    text = (FOLDER / f"{family}_Master.md").read_text("utf-8")
    assert f"]({family}_Master.md)" in page(family)
    assert f"]({family}_Master.md)" in (FOLDER / "Families.md").read_text("utf-8")
    assert f"]({family}_Drive.md)" in text
    assert re.search(r"\| stops the motor[^|]* \| (05|06|10) \|", text)


@every_family
def test_what_is_not_known_of_the_line_and_the_settings_is_beside_them_with_a_way_to_find_out(family: str) -> None:
    keypad = page(family).partition("\n### Keypad\n")[2].partition("\n## ")[0]
    for each in drives()[family].absent:
        if "pins" not in each.about and any(one.startswith("setting ") for one in each.about):
            assert f"{markdown(each.what)[1:]}. To find out: {markdown(each.find_out)}." in keypad
