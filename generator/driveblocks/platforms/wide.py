"""Chinese texts as WSTRING, for systems whose STRING has no Chinese: `VFD_ReasonTextZhW` beside `VFD_ReasonTextZh`."""

import re
from collections.abc import Iterator
from dataclasses import replace

from driveblocks.platforms.part import Part, Shelf
from structured_text.language.fingerprint import body, fingerprint, stream
from structured_text.language.parser import parse
from structured_text.language.tree import Function, StringSpec

SUFFIX = "W"
_GIVEN = re.compile(r":= '((?:\$[0-9A-F]{2}|[^'$])*)';")
_BYTE = re.compile(r"\$([0-9A-F]{2})|(.)", re.DOTALL)
_ESCAPED = {"$": "$$", '"': '$"'}


def widened(shelf: Shelf) -> Shelf:
    """A shelf with each text function in another language than English a second time, as a function of WSTRING.

    These are parsed, not typed.
    """
    return replace(shelf, parts=(*shelf.parts, *_made(shelf)))


def _made(shelf: Shelf) -> Iterator[Part]:
    encodings = {language.suffix: language.encoding for language in shelf.languages if language.suffix != "En"}
    for part in shelf.parts:
        suffix = next((each for each in encodings if part.name.endswith(each)), None)
        if suffix and isinstance(part.element, Function) and isinstance(part.element.returns, StringSpec):
            yield _widened(part, encodings[suffix])


def _widened(part: Part, encoding: str) -> Part:
    name = part.name
    text = re.sub(rf"\b{name}\b", f"{name}{SUFFIX}", part.text)
    text = text.replace(f"FUNCTION {name}{SUFFIX} : STRING", f"FUNCTION {name}{SUFFIX} : WSTRING")
    text = text.replace(f"Escaped bytes are {encoding.upper()}.", "Characters of two bytes.")
    text = _GIVEN.sub(lambda found: f':= "{_characters(found[1], encoding)}";', text)
    old, new = (fingerprint(stream(body(each))) for each in (part.text, text))
    unit = parse(text.replace(f" {old},", f" {new},"), part.unit.path.replace(name, name + SUFFIX))
    return Part(part.folder, unit, part.extra)


def _characters(literal: str, encoding: str) -> str:
    """What the bytes of a STRING literal say, as a WSTRING literal without its quotes."""
    octets = b"".join(bytes.fromhex(code) if code else one.encode("ascii") for code, one in _BYTE.findall(literal))
    return "".join(_ESCAPED.get(one, one) for one in octets.decode(encoding))
