"""Chinese texts as WSTRING: the same words as the STRING functions have in bytes, for each text."""

import re
from functools import cache

from tests.platforms.stock import canon, made

from driveblocks.platforms.part import Part
from driveblocks.platforms.wide import widened
from driveblocks.render.reasons import REASONS, STATES
from structured_text.language.fingerprint import fingerprint, stream
from structured_text.language.writing import string

GIVEN = re.compile(r':= "((?:\$.|[^"$])*)";')


@cache
def parts() -> dict[str, Part]:
    """The functions of WSTRING of what ships, by name."""
    return {part.name: part for part in widened(made()).parts if part.name.endswith("ZhW")}


def said(name: str) -> list[str]:
    """The texts of a function of WSTRING, without escapes."""
    return [re.sub(r"\$(.)", r"\1", text) for text in GIVEN.findall(parts()[name].body)]


def test_each_function_of_chinese_bytes_has_one_of_characters() -> None:
    assert set(parts()) == {f"{name}W" for name in canon() if name.endswith("Zh")}
    assert "VFD_ReasonTextZhW" in parts()


def test_each_text_is_the_one_of_its_bytes() -> None:
    for name, part in parts().items():
        bytes_ = [string(text.encode()) for text in said(name)]
        given = re.findall(r":= ('(?:\$.|[^'$])*');", canon()[name.removesuffix("W")].body)
        assert bytes_ == given, name
        assert "STRING;" not in part.declaration
        assert part.declaration.startswith(f"FUNCTION {name} : WSTRING\n")


def test_the_words_are_those_of_the_reasons_and_states() -> None:
    assert said("VFD_ReasonTextZhW")[:-1] == [reason.zh for reason in REASONS]
    assert said("VFD_StateTextZhW")[:-1] == [zh for _, zh in STATES]


def test_the_hash_in_the_head_is_that_of_the_body() -> None:
    for part in parts().values():
        assert f" {fingerprint(stream(part.body))}, a hash" in part.head, part.name
