"""Contexts of the text functions: faults, errors, bits and values of a drive, and the result codes, per language."""

from collections.abc import Iterator
from dataclasses import dataclass

from driveblocks.maps.form import address_text
from driveblocks.maps.model import Drive
from driveblocks.render import results
from driveblocks.render.context import Context, identity, source_of
from driveblocks.render.literal import string

MAX_BYTES = 80
"""Longest text: what an unsized STRING holds on every target."""


@dataclass(frozen=True)
class Language:
    """A language of texts: its suffix in names, its bytes, and what to say of an unknown code."""

    suffix: str
    encoding: str
    unknown: str

    def literal(self, text: str) -> str:
        """The text as a STRING literal, shortened to MAX_BYTES at a character's end."""
        while len(text.encode(self.encoding, "replace")) > MAX_BYTES:
            text = text[:-1]
        return string(text, self.encoding)

    def pick(self, en: str, zh: str | None) -> str:
        """The text of this language."""
        return en if self.suffix == "En" else (zh or en)


ENGLISH = Language("En", "utf-8", "unknown code")


def chinese(encoding: str = "utf-8") -> Language:
    """Chinese in UTF-8 or GB18030."""
    return Language("Zh", encoding, "未知代码")


def languages(codes: list[str], encoding: str) -> list[Language]:
    """The languages of a list such as ["en", "zh"]."""
    return [ENGLISH if code == "en" else chinese(encoding) for code in codes]


def result_texts(language: Language) -> Context:
    """For CodeText: the result codes of all blocks."""
    rows = [_row(language, result.code, result.en, result.zh) for result in results.RESULTS]
    head = {"title": "what an ErrorID means", "source": "the result codes of DriveBlocks.", "code_comment": "ErrorID"}
    return {"name": f"MB_ResultText{language.suffix}", "rows": rows, **head, **_language(language)}


def fault_texts(drive: Drive, language: Language) -> Context:
    """For CodeText: fault codes."""
    rows = [_row(language, fault.code, fault.name, fault.text_zh) for fault in drive.faults.codes]
    head = {
        "title": f"fault codes of {identity(drive).family}",
        "source": source_of(drive, drive.faults.source),
        "code_comment": "fault code",
    }
    return {"name": f"{drive.prefix}_FaultText{language.suffix}", "rows": rows, **head, **_language(language)}


def error_texts(drive: Drive, language: Language) -> Context:
    """For CodeText: error codes; those without a printed code have the number that another document gives."""
    rows = []
    for error in drive.errors.codes:
        code = error.code if error.code is not None else next((c.value for c in error.corroborated if c.value), None)
        if code is not None:
            rows.append(_row(language, code, error.name, error.text_zh))
    head = {
        "title": f"refusal codes of {identity(drive).family}",
        "source": source_of(drive, drive.errors.source),
        "code_comment": "Reason of the reply",
    }
    return {"name": f"{drive.prefix}_ErrorText{language.suffix}", "rows": rows, **head, **_language(language)}


def _row(language: Language, code: int, en: str, zh: str | None) -> Context:
    text = language.literal(language.pick(en, zh))
    return {"code": code, "text": text, "comment": zh if language.suffix == "Zh" else ""}


def _language(language: Language) -> Context:
    return {
        "otherwise": language.literal(language.unknown),
        "escaped": language.suffix == "Zh",
        "encoding": language.encoding.upper(),
    }


def place_texts(drive: Drive, language: Language) -> Iterator[Context]:
    """For PlaceText: texts of bits and of values, for the kinds that the drive has."""
    bits = [_group(drive, address, "bits", language) for address in _addresses(drive)]
    values = [_group(drive, address, "values", language) for address in _addresses(drive)]
    kinds = (("Bit", "bit of the word, 0 to 15", bits), ("Value", "value of the word", values))
    for pin, comment, groups in kinds:
        if any(group["rows"] for group in groups):
            yield {
                "name": f"{drive.prefix}_{pin}Text{language.suffix}",
                "title": f"{pin.lower()}s of {identity(drive).family}",
                "source": identity(drive).manual,
                "pin": pin,
                "pin_comment": comment,
                "groups": [group for group in groups if group["rows"]],
                **_language(language),
            }


def _addresses(drive: Drive) -> list[int]:
    return [row.address.first for _, row in drive.registers()]


def _group(drive: Drive, address: int, kind: str, language: Language) -> Context:
    row = drive.register_at(address)
    assert row is not None  # noqa: S101  (the address was taken from the tables)
    if kind == "bits":
        rows = [_row(language, bit.bit.first, bit.name, bit.text_zh) for bit in row.bits if bit.name]
    else:
        rows = [_row(language, value.value, value.name, value.text_zh) for value in row.values]
    return {
        "address": address,
        "address_text": address_text(address),
        "title": row.name or "",
        "rows": rows,
    }
