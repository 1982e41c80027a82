"""Nodes become the model: every key and shape, what is left of a map with mistakes, and words that help."""

import dataclasses
from collections.abc import Iterator
from decimal import Decimal
from pathlib import Path
from typing import Any

import pytest

from driveblocks.maps import nodes
from driveblocks.maps.decode import decode
from driveblocks.maps.form import Span
from driveblocks.maps.model import Bit, Drive, Limit, Named, Range, Register, Scale, Section, Text
from driveblocks.maps.problem import Report
from driveblocks.maps.shape import EntryOf, Key, ListOf, keys_of

EXAMPLE = Path(__file__).parent / "example.yaml"


def decoded(cls: type, text: str) -> tuple[Any, list[str]]:
    report = Report("map.yaml")
    root = nodes.parse(text, report)
    assert root is not None
    return decode(cls, root, report), [f"{p.line}:{p.column}: {p.wrong}; {p.right}" for p in report.problems]


def good(cls: type, text: str) -> Any:
    value, wrong = decoded(cls, text)
    assert wrong == []
    return value


def classes() -> Iterator[type]:
    """Every class of the model that a map can hold."""
    seen: list[type] = [Drive]
    for cls in seen:
        yield cls
        for key in keys_of(cls).values():
            shape = key.shape.item if isinstance(key.shape, ListOf) else key.shape
            if isinstance(shape, EntryOf) and shape.cls not in seen:
                seen.append(shape.cls)


def test_values_arrive_as_what_they_mean() -> None:
    text = """{address: 0106H-0125H, id: A2-01..A2-32, name: Voltage, zh: 电压, unit: V, signed: true,
  scale: {factor: 0.10, source: here, when: {register: 000FH, bit: 8-F, equals: 1EH}}, range: {min: -5, max: 5}}"""
    row = good(Register, text)
    assert row.address == Span(0x106, 0x125)
    assert row.signed is True
    assert row.scale == Scale(factor=Decimal("0.1"), source="here", when=row.scale.when)
    assert (row.scale.when.register, row.scale.when.bit, row.scale.when.equals) == (0xF, Span(8, 15), 0x1E)
    assert row.range == Range(min=-5, max=5)
    assert (row.values, row.bits, row.printed, row.note) == ((), (), None, None)


def test_an_entry_knows_the_places_of_its_keys() -> None:
    limit = good(Limit, "value: 16\nsource: here\n")
    assert limit.at == (1, 1)
    assert limit.place("value") == (1, 8)
    assert limit.place("source") == (2, 9)
    assert limit.place("other") == (1, 1)


def test_the_corrected_wording_is_what_is_shown() -> None:
    assert good(Named, "{name: Overspeed, zh: 起速, zh_used: 超速}").text_zh == "超速"
    assert good(Named, "{name: Overspeed, zh: 超速}").text_zh == "超速"


def test_entries_are_frozen() -> None:
    with pytest.raises(dataclasses.FrozenInstanceError):
        good(Limit, "{value: 16, source: here}").value = 5


@pytest.mark.parametrize("cls", list(classes()), ids=lambda cls: cls.__name__)
def test_a_list_is_no_entry(cls: type) -> None:
    value, wrong = decoded(cls, "[]")
    assert value is None
    assert len(wrong) == 1
    assert "is a list; it must be a mapping with the keys " in wrong[0]
    assert not wrong[0].endswith("keys ")


@pytest.mark.parametrize("cls", list(classes()), ids=lambda cls: cls.__name__)
def test_every_required_key_is_asked_for(cls: type) -> None:
    required = [key for key in keys_of(cls).values() if key.required]
    value, wrong = decoded(cls, "{}")
    assert (value is None) == bool(required)
    assert len(wrong) == len(required)
    assert all(f"has no `{key.name}`; add `{key.name}`: " in line for key, line in zip(required, wrong, strict=True))


@pytest.mark.parametrize(
    ("cls", "key"),
    [(cls, key) for cls in classes() for key in keys_of(cls).values()],
    ids=lambda part: part.name if isinstance(part, Key) else part.__name__,
)
def test_a_misspelt_key_is_matched_to_the_one_that_was_meant(cls: type, key: Key) -> None:
    _, wrong = decoded(cls, f"{{{key.name}x: 1}}")
    assert f"1:2: unknown key `{key.name}x` in `the map`; did you mean `{key.name}`?" in wrong
    assert not any(f"has no `{key.name}`" in line for line in wrong)


def test_a_list_goes_on_without_its_bad_entries() -> None:
    rows = "[{address: 0001H}, {address: 1H}, {address: 0003H}]"
    text = f"{{id: a, title: {{en: A, zh: 表}}, source: s, access: r, registers: {rows}}}"
    section, wrong = decoded(Section, text)
    assert [row.address.first for row in section.registers] == [1, 3]
    assert len(wrong) == 1


def test_a_list_of_values_is_not_closed_up() -> None:
    """Words without one of them would move up; the whole list is left out, and what needs it too."""
    assert decoded(Drive, "{id_forms: [A9, h5]}")[0] is None


def test_an_entry_goes_on_without_a_bad_optional_key() -> None:
    bit, wrong = decoded(Bit, "{bit: 0, name: Running, zh: 运行中, unused: maybe}")
    assert (bit.name, bit.unused) == ("Running", False)
    assert wrong == ["1:42: `unused: maybe` is not allowed; write one of true, false"]


def test_an_entry_without_a_required_key_is_not_built() -> None:
    assert decoded(Text, "{en: , zh: 监测}")[0] is None


@pytest.mark.parametrize(
    ("text", "wrong"),
    [
        ("{value: , source: s}", "`value` has no value; write a decimal number from 1 to 999999"),
        ("{value: [1], source: s}", "`value` is a list; it must be one value: write a decimal number from 1 to 999999"),
        ("{value: {a: 1}, source: s}", "`value` is a mapping; it must be one value: "),
        ("{value: 1, source: 5}", '`source` is a text, but 5 without quotes is a number; write "5"'),
        ("{value: 1, source: 频率}", "`source` holds Chinese: the translation is missing; write it in English"),
        ("{value: 1, source: s, note: n}", "unknown key `note` in `the map`; known keys: value, source"),
        ("{value: a\n b\n c, source: s}", "`value: a b c` is not a count; "),
        (f"{{value: {'x' * 60}, source: s}}", f"`value: {'x' * 37}...` is not a count; "),
    ],
)
def test_words_that_help(text: str, wrong: str) -> None:
    assert wrong in "\n".join(decoded(Limit, text)[1])


def test_a_number_in_quotes_is_a_text() -> None:
    assert good(Limit, '{value: 1, source: "5"}').source == "5"


def test_a_trap_is_named_once() -> None:
    report = Report("map.yaml")
    root = nodes.parse("{value: 010, source: yes}", report)
    assert root is not None
    assert decode(Limit, root, report) is None
    assert [problem.column for problem in report.problems] == [9, 22]
