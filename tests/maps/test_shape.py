"""The shape of the model's classes, read from their type hints."""

from dataclasses import dataclass
from decimal import Decimal
from typing import Annotated, Any, Literal

import pytest

from driveblocks.maps import form
from driveblocks.maps.model import Entry, Text, fact, option
from driveblocks.maps.shape import EntryOf, Key, ListOf, OneOf, keys_of, required_of, shape_of


@dataclass(frozen=True, kw_only=True)
class Sample(Entry):
    """A class with a key of each shape."""

    word: Annotated[str, form.WORD] = fact("a word", "x")
    many: tuple[Annotated[int, form.NUMBER], ...] = option("numbers", "[1]", default=())
    truth: bool = option("a truth", "true", default=False)
    kind: Literal["a", "b"] | None = option("a kind", "a")
    text: Text | None = option("a text", "{en: a, zh: 一}")


def test_keys_come_in_order_with_their_words() -> None:
    keys = keys_of(Sample)
    assert list(keys) == ["word", "many", "truth", "kind", "text"]
    assert keys["word"] == Key("word", form.WORD, True, "a word", "x")
    assert [key.name for key in required_of(Sample)] == ["word"]


def test_what_is_no_fact_is_no_key() -> None:
    assert "at" not in keys_of(Sample)
    assert "keys" not in keys_of(Sample)


@pytest.mark.parametrize(
    ("hint", "shape"),
    [
        (str, form.TEXT),
        (bool, OneOf({"true": True, "false": False})),
        (Annotated[Decimal, form.DECIMAL], form.DECIMAL),
        (Annotated[int, form.NUMBER] | None, form.NUMBER),
        (Literal["r", "w"], OneOf({"r": "r", "w": "w"})),
        (Literal[8, 16], OneOf({"8": 8, "16": 16})),
        (tuple[Literal["a"], ...], ListOf(OneOf({"a": "a"}))),
        (tuple[Text, ...], ListOf(EntryOf(Text))),
        (Text | None, EntryOf(Text)),
    ],
)
def test_the_shape_of_a_type(hint: Any, shape: object) -> None:
    assert shape_of(hint) == shape


@pytest.mark.parametrize("hint", [int, float, dict[str, int], Decimal, object])
def test_a_type_that_a_map_cannot_hold(hint: Any) -> None:
    with pytest.raises(TypeError, match="a map cannot hold"):
        shape_of(hint)
