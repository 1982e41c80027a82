"""The strict YAML: places of nodes, what is refused, and agreement with PyYAML on what is not."""

from typing import Any

import pytest
import yaml
from hypothesis import example, given
from hypothesis import strategies as st
from tests.maps.agreement import outcome

from driveblocks.maps import nodes, trap
from driveblocks.maps.nodes import Entries, Items, Node, Scalar
from driveblocks.maps.problem import Report

NUMBER_LIKE = r"[-+]?[0-9][0-9_]*(\.[0-9_]*)?([eE][-+]?[0-9]+)?|[0-9:]{1,6}|0[xob]?[0-9a-fA-F_]{1,6}"
DOCUMENTS = st.recursive(
    st.text("ab:,#[]{}'\" \n", max_size=8),
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(st.text("abc", min_size=1), inner, max_size=4),
    max_leaves=12,
)


def parsed(text: str) -> Node:
    """What both parsers that PyYAML has make of a good text."""
    root, problems = outcome(text, libyaml=True)
    assert problems == ()
    assert root is not None
    assert outcome(text, libyaml=False) == (root, ())
    return root


def wrong(text: str) -> list[str]:
    """What both say of a bad one."""
    _, problems = outcome(text, libyaml=True)
    assert outcome(text, libyaml=False)[1] == problems
    return [f"{problem.line}:{problem.column}: {problem.wrong}" for problem in problems]


def plain(node: Node) -> Any:
    if isinstance(node, Entries):
        return {key: plain(value) for key, (_, value) in node.entries.items()}
    return [plain(item) for item in node.items] if isinstance(node, Items) else node.text


def test_every_node_knows_its_place() -> None:
    root = parsed("# head\na: x\nb:\n  - 'y'\n  - {c: [z]}\n")
    assert isinstance(root, Entries)
    assert root.at == (2, 1)
    assert root.entries["a"] == (Scalar("a", True, (2, 1)), Scalar("x", True, (2, 4)))
    items = root.entries["b"][1]
    assert isinstance(items, Items)
    assert items.at == (4, 3)
    assert items.items[0] == Scalar("y", False, (4, 5))
    assert items.items[1].at == (5, 5)


def test_columns_count_characters_and_not_bytes() -> None:
    root = parsed("a: {zh: 频率给定, b: x}\n")
    assert isinstance(root, Entries)
    inner = root.entries["a"][1]
    assert isinstance(inner, Entries)
    assert inner.entries["b"][1].at == (1, 18)


@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
def test_line_ends_of_every_system(end: str) -> None:
    root = parsed(f"a: x{end}b: z{end}")
    assert isinstance(root, Entries)
    assert root.entries["b"][1].at == (2, 4)


def test_texts_over_several_lines() -> None:
    assert plain(parsed("a: >-\n  one\n  two\nb: |-\n  one\n  two\nc: one\n  two\n")) == {
        "a": "one two",
        "b": "one\ntwo",
        "c": "one two",
    }


@pytest.mark.parametrize("text", ["yes", "~", "null", "0x1F", "1e3", "2016-04-18", "<<", "=", "010", "5:4", ".inf"])
def test_a_trap_in_quotes_is_a_text(text: str) -> None:
    root = parsed(f"a: '{text}'\nb: \"{text}\"\n")
    assert plain(root) == {"a": text, "b": text}


@pytest.mark.parametrize("text", ["yes", "Off", "~", "0x1F", "0b1", "0o7", "1_000", "5:4", "1e3", ".5", "+1", "<<"])
def test_a_trap_without_quotes_is_refused_and_marked(text: str) -> None:
    report = Report("map.yaml")
    root = nodes.parse(f"[{text}]", report)
    assert isinstance(root, Items)
    assert root.items[0] == Scalar(text, True, (1, 2), refused=True)
    assert report.problems[0].wrong.startswith(f"`{text}` without quotes is a trap: ")


@pytest.mark.parametrize(
    "text",
    [
        *("0", "1", "-5", "0.1", "-0.5", "10", "3.5", "100000", "true", "false", "nothing", "yes_no", "on/off"),
        *("0026H", "01H", "8-F", "0106H-0125H", "A2-01..A2-32", "T1", "1.2.3", "9.2 (3)", "00nnH", "12:", "e5"),
    ],
)
def test_what_is_no_trap_passes(text: str) -> None:
    assert trap.find(text) is None


@given(st.from_regex(NUMBER_LIKE, fullmatch=True))
@example("10000000000000001")
def test_a_number_that_yaml_reads_otherwise_is_a_trap(text: str) -> None:
    """Whatever PyYAML's safe loader makes of plain text, it is the same number in decimal, or a trap."""
    try:
        read = yaml.safe_load(text)
    except (yaml.YAMLError, ValueError):
        return
    if trap.find(text) is None and not isinstance(read, dict):
        assert isinstance(read, str) or (isinstance(read, (int, float)) and type(read)(text) == read)


@given(DOCUMENTS)
def test_what_pyyaml_writes_in_quotes_is_read_back(value: Any) -> None:
    text = yaml.safe_dump(value, default_style='"', allow_unicode=True)
    assert plain(parsed(text)) == value


@given(st.text(max_size=60))
def test_no_text_makes_the_parser_fail(text: str) -> None:
    """Any text ends in nodes or in problems."""
    root, problems = outcome(text.encode("utf-8", "replace").decode(), libyaml=True)
    assert root is not None or problems


def test_depth_has_an_end() -> None:
    fits, deeper = nodes.MAX_DEPTH, nodes.MAX_DEPTH + 1
    parsed("[" * fits + "]" * fits)
    assert wrong("[" * (deeper + 1) + "]" * (deeper + 1)) == ["1:18: nested deeper than 16 levels"]


def test_number_of_values_has_an_end() -> None:
    for quick in (False, True):
        report = Report("map.yaml")
        assert nodes.parse("[a, b, c]", report, quick=quick, most=4) is not None
        assert report.problems == []
        nodes.parse("[a, b, c, d]", report, quick=quick, most=4)
        assert [str(each).partition(";")[0] for each in report.problems] == [
            "map.yaml:1:11: more than 4 values in one file"
        ]


def test_length_of_a_value_has_an_end() -> None:
    parsed("a: " + "x" * nodes.MAX_TEXT)
    assert wrong("a: " + "x" * (nodes.MAX_TEXT + 1)) == ["1:4: a value of 4001 characters"]


def test_all_traps_of_a_file_come_at_once() -> None:
    lines = [line.partition(":")[0] for line in wrong("a: yes\nb: 010\nc: 1e3\na: &x !!str z\n")]
    assert lines == ["1", "2", "3", "4", "4", "4"]
