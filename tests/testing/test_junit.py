"""The JUnit XML: its shape, its counts, what a failure says, and that only times differ from run to run."""

import re
from xml.etree import ElementTree

import pytest

from driveblocks.bench import junit
from driveblocks.bench.outcome import Outcome, Result, Run
from driveblocks.bench.unit import Unit

from .conftest import changed, only, run

RUN = Run(
    [
        Result("embedded", "ex", "EX_TestA", (Outcome("1: right", path="a.st", line=3),), 0.5),
        Result(
            "embedded",
            "ex",
            "EX_TestB",
            (
                Outcome("1: a & b < c", "failed", "expected 1, found 2", "1", "2", "b.st", 7),
                Outcome("2: never", "error", "b.st:9: index 4", path="b.st", line=9),
                Outcome("3: text", "failed", "expected `x`, found `\x00\x1b`", "x", "\x00\x1b", "b.st", 11),
            ),
            0.25,
        ),
    ],
    1.5,
)


def assert_counted(root: ElementTree.Element) -> None:
    """Fail where a count differs from what is there."""
    for element in (root, *root.iter("testsuite")):
        assert int(element.attrib["tests"]) == len(list(element.iter("testcase")))
        assert int(element.attrib["failures"]) == len(list(element.iter("failure")))
        assert int(element.attrib["errors"]) == len(list(element.iter("error")))


@pytest.fixture(scope="module")
def real(example: Unit) -> Run:
    unit = only(
        changed(example, "EX100_FaultTextZh", "$E8$BF$87$E6$B5$81", "$E8$BF$87$E5$8E$8B"), "FaultText", "Scales"
    )
    return run(unit)


def test_counts_and_times_are_those_of_what_is_there(real: Run) -> None:
    for each in (RUN, real, Run()):
        root = ElementTree.fromstring(junit.text(each))  # noqa: S314  (our own text)
        assert_counted(root)
        for element in (root, *root.iter("testsuite"), *root.iter("testcase")):
            assert float(element.attrib["time"]) >= 0


def test_a_case_is_named_for_its_check_and_classed_by_drive_and_program() -> None:
    root = ElementTree.fromstring(junit.text(RUN))  # noqa: S314  (our own text)
    cases = [(case.attrib["classname"], case.attrib["name"]) for case in root.iter("testcase")]
    assert cases == [
        ("ex.EX_TestA", "1: right"),
        ("ex.EX_TestB", "1: a & b < c"),
        ("ex.EX_TestB", "2: never"),
        ("ex.EX_TestB", "3: text"),
    ]
    assert [suite.attrib["name"] for suite in root] == ["ex.EX_TestA on embedded", "ex.EX_TestB on embedded"]
    assert [each.attrib["value"] for each in root.iter("property")] == ["embedded", "embedded"]


def test_a_failure_has_place_expected_and_actual() -> None:
    root = ElementTree.fromstring(junit.text(RUN))  # noqa: S314  (our own text)
    first, second = root.iter("failure")
    assert first.attrib == {"message": "expected 1, found 2", "type": "failed"}
    assert first.text == "1: a & b < c\nat b.st:7\nexpected: 1\nactual: 2"
    assert second.text == "3: text\nat b.st:11\nexpected: x\nactual: \\u0000\\u001b"
    (error,) = root.iter("error")
    assert error.text == "2: never\nat b.st:9\nb.st:9: index 4"


def test_no_attribute_and_no_text_holds_what_xml_cannot() -> None:
    hostile = "a\x00\x1b[2J\r\x85\u202e\ud800\uffff\U000e0001z"
    outcomes = tuple(
        Outcome(hostile, status, message=hostile, expected=hostile, actual=hostile, path=hostile)
        for status in ("passed", "failed", "error")
    )
    text = junit.text(Run([Result(hostile, hostile, hostile, outcomes, properties=((hostile, hostile),))]))
    seen = r"a\u0000\u001b[2J\u000d\u0085\u202e\ud800\uffff\udb40\udc01z"
    root = ElementTree.fromstring(text)  # noqa: S314  (our own text)
    suite = root[0].attrib["name"]
    assert suite == f"{seen}.{seen} on {seen}"
    assert [(each.attrib["name"], each.attrib["value"]) for each in root.iter("property")] == [
        ("engine", seen),
        (seen, seen),
    ]
    assert all(sign.isprintable() or sign == "\n" for sign in text)


def test_chinese_stays_chinese(real: Run) -> None:
    (failure,) = ElementTree.fromstring(junit.text(real)).iter("failure")  # noqa: S314  (our own text)
    assert failure.attrib["message"] == "expected `OC 过流`, found `OC 过压`"


def test_only_times_differ_from_run_to_run(example: Unit) -> None:
    texts = {re.sub(r' time="[0-9.]+"', "", junit.text(run(only(example, "Scales", "Frames")))) for _ in range(2)}
    assert len(texts) == 1
