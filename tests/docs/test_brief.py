"""Six questions of a technician at the top of each page: answers typed by hand, from what the maps say."""

import re

import pytest
from tests.docs.test_pages import FAMILIES, FOLDER, page
from tests.shipped import drives

from driveblocks.docs.brief import questions
from driveblocks.maps.view import markdown

TOP = 30
"""Lines of a page that are on its first screen."""
PINS = "pin 4, TxRxD+; - (D0, A of the standard) on pin 5, TxRxD-"
TRIPS = "(A105 0 = Fault) the drive trips after 5.0 s of silence (A106)"
RISING = "a rising FaultReset"
ANSWERS = {
    "ACS355": (
        "not known", "9802 = 1, 1001 = 10, 1003 = 3", "count on a motor that runs on",
        RISING, "23 codes", "10000 in 40002",
    ),
    "ATV312": (
        "pin 4, D1 Modbus signal; -", "LAC = L3, Fr1 = Mdb", "the motor coasts after 10.0 s",
        RISING, "31 codes", "250 in 2136H",
    ),
    "CHF": (
        "not known", "P0.04", "count on a motor that runs on",
        RISING, "no list", "5000 in 2000H, where P0.04 is 50 Hz",
    ),
    "GD200A": (
        "485+, A (+)", "P00.01 = 2", "(P14.04 0.0 s) the motor runs on",
        RISING, "31 codes", "2500 in 2001H",
    ),
    "JSCC": (
        "not known", "F0.04 = 4", "count on a motor that runs on",
        "no command for it over the bus", "12 codes", "not known for 1001H",
    ),
    "MX2": (
        "on SP; - (D0, A of the standard) on SN", "A001 = 03, A002 = 03", "C076",
        RISING, "51 codes", "2500 in 0001H",
    ),
    "PF4": (
        PINS, "P036 = 5, P038 = 5", TRIPS,
        RISING, "24 codes", "250 in 2001H",
    ),
    "PF400": (
        "not known", "P036 = 5, P038 = 5", "count on a motor that runs on",
        RISING, "27 codes", "2500 in 2001H",
    ),
    "PF40P": (
        PINS, "E249 = 0", TRIPS,
        RISING, "28 codes", "2500 in 2001H",
    ),
    "PF4M": (
        PINS, "P108 = 5", "C304",
        RISING, "24 codes", "250 in 2001H",
    ),
    "PF525": (
        "not known", "P046 = 3, P047 = 3", "(C125 0 = Fault) the drive trips after 5.0 s",
        RISING, "47 codes", "2500 in 2001H",
    ),
    "SN300G5": (
        "not known", "b1-01 = 2, b1-02 = 2", "(H5-04 1 = Emergency stop) the motor stops quickly",
        "no command", "42 codes", "2500 in 0001H",
    ),
    "V20": (
        "pin 6, P+; - (D0, A of the standard) on pin 7, N-", "P0700 = 5, P1000 = 5, P2023 = 2",
        "with 0 the motor runs on, otherwise the drive trips",
        RISING, "13 codes", "8192 in 40101",
    ),
}  # fmt: skip
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
