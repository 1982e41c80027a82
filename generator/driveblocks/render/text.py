"""Contexts of the text functions: faults, errors, bits and values of a drive, and the result codes, per language."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from driveblocks.maps.form import address_text, space_of
from driveblocks.maps.model import Bit, Drive, Fault, Faults, Returned, Warnings, Worded
from driveblocks.maps.revision import english
from driveblocks.maps.view import error_number
from driveblocks.render import reasons, results
from driveblocks.render.context import source_of
from structured_text.language.writing import string


@dataclass(frozen=True)
class Language:
    """A language of texts: its suffix in names, its bytes, and what to say of an unknown code."""

    suffix: str
    encoding: str
    unknown: str
    unread: str
    """The text of fault code 0, where that is no code of the drive."""

    def literal(self, text: str) -> str:
        """The text as a STRING literal, whole: a checked map has none that is too long."""
        return string(text.encode(self.encoding))

    def pick(self, entry: Returned | Bit) -> str:
        """The text of an entry in this language, in its short wording where it has one."""
        en = (entry.short and entry.short.en) or entry.name or ""
        return en if self.suffix == "En" else (entry.short and entry.short.zh) or entry.text_zh or en


ENGLISH = Language("En", "utf-8", "unknown code", "code not read yet")


def chinese(encoding: str = "utf-8") -> Language:
    """Chinese in UTF-8 or GB18030."""
    return Language("Zh", encoding, "未知代码", "代码尚未读取")


def exists(drive: Drive, kind: str, language: Language) -> bool:
    """Whether a map has texts of a kind in a language: always in English, and in Chinese if any has its Chinese."""
    return language.suffix == "En" or drive.manual.written_in == "zh" or any(one.zh for one in _shown(drive)[kind])


def missing(drive: Drive, languages: list[Language]) -> str:
    """What to say of a family without texts in a language that was asked for; empty where it has all."""
    if all(any(exists(drive, kind, language) for kind in _shown(drive)) for language in languages):
        return ""
    only = "its texts are English alone" if ENGLISH in languages else "it gets no text functions; --lang en makes them"
    return f"{drive.prefix}: the map has no Chinese texts: {only}"


def told(drive: Drive, languages: list[Language]) -> Drive:
    """The map as blocks in some languages show it: for English alone, without a word in another language."""
    if any(language.suffix != "En" for language in languages):
        return drive
    return english(drive)


def _shown(drive: Drive) -> dict[str, Sequence[Worded]]:
    """What has texts in blocks, by the kind of text function."""
    rows = [row for _, row in drive.registers()]
    return {
        "Fault": drive.faults.codes,
        "Warning": drive.warning_codes,
        "Error": drive.errors.codes,
        "Bit": [bit for row in rows for bit in row.bits],
        "Value": [value for row in rows for value in row.values],
    }


def languages(codes: list[str], encoding: str) -> list[Language]:
    """The languages of a list such as ["en", "zh"]."""
    return [ENGLISH if code == "en" else chinese(encoding) for code in codes]


@dataclass(frozen=True)
class Row:
    """The text of a code as a literal, and what to say beside it."""

    code: int
    text: str
    comment: str


Context = dict[str, object]
"""What a template of a text function prints."""


def result_texts(language: Language) -> Context:
    """The result codes of all blocks."""
    texts = [(result.code, result.en, result.zh) for result in results.RESULTS]
    return _own("MB_Result", texts, ("what an ErrorID means", "the result codes of DriveBlocks.", "ErrorID"), language)


def reason_texts(language: Language) -> Context:
    """Why a drive does not run."""
    texts = [(reason.code, reason.en, reason.zh) for reason in reasons.REASONS]
    return _own("VFD_Reason", texts, ("why a drive does not run", "the reasons of DriveBlocks.", "Reason"), language)


def state_texts(language: Language) -> Context:
    """What a drive block is at."""
    texts = [(code, en, zh) for code, (en, zh) in enumerate(reasons.STATES)]
    return _own("VFD_State", texts, ("what a drive block is at", "the states of DriveBlocks.", "State"), language)


def _own(name: str, texts: list[tuple[int, str, str]], head: tuple[str, str, str], language: Language) -> Context:
    """Texts of the library's own codes, each with its English and its Chinese."""
    chosen = [(code, en if language.suffix == "En" else zh) for code, en, zh in texts]
    return _coded(name, [_row(language, code, text, text) for code, text in chosen], head, language)


def _coded(name: str, rows: list[Row], head: tuple[str, str, str], language: Language) -> Context:
    """For CodeText; its head says the title, the source, and what the code is."""
    title, source, comment = head
    return {"rows": rows, "title": title, "source": source, "code_comment": comment} | _language(name, language)


def led(fault: Fault, text: str) -> str:
    """The text of a fault after the name that the drive shows: `OH1 Heatsink overtemperature`."""
    return f"{fault.id} {text}" if fault.id else text


def fault_texts(drive: Drive, language: Language) -> Context:
    """Fault codes."""
    return _displayed(drive, language, "fault", drive.faults)


def warning_texts(drive: Drive, language: Language) -> Context | None:
    """Warning codes; None where the drive reports none."""
    return _displayed(drive, language, "warning", drive.warnings) if drive.warnings else None


def _displayed(drive: Drive, language: Language, kind: str, told: Faults | Warnings) -> Context:
    rows = [_row(language, one.code, led(one, language.pick(one)), one.text_zh) for one in told.codes]
    if kind == "fault" and all(one.code for one in told.codes):
        rows.insert(0, _row(language, 0, language.unread, None))
    head = f"{kind} codes", source_of(drive, told.source), f"{kind} code"
    return _coded(f"{drive.prefix}_{kind.capitalize()}", rows, head, language)


def error_texts(drive: Drive, language: Language) -> Context:
    """Error codes; those without a printed code have the number that another document gives."""
    numbered = ((error_number(error), error) for error in drive.errors.codes)
    rows = [_entry(language, code, error) for code, error in numbered if code is not None]
    head = "refusal codes", source_of(drive, drive.errors.source), "Reason of the reply"
    return _coded(f"{drive.prefix}_Error", rows, head, language)


def _entry(language: Language, code: int, entry: Returned | Bit) -> Row:
    return _row(language, code, language.pick(entry), entry.text_zh)


def _row(language: Language, code: int, text: str, zh: str | None) -> Row:
    return Row(code, language.literal(text), (zh or "") if language.suffix == "Zh" else "")


def _language(name: str, language: Language) -> Context:
    """The name of a function, what it gives for an unknown code, whether bytes are escaped, and in which encoding."""
    return {
        "name": f"{name}Text{language.suffix}",
        "otherwise": language.literal(language.unknown),
        "escaped": language.suffix == "Zh",
        "encoding": language.encoding.upper(),
    }


@dataclass(frozen=True)
class Group:
    """The texts of a register."""

    address: int
    address_text: str
    title: str
    rows: list[Row]


def place_texts(drive: Drive, language: Language) -> Iterator[Context]:
    """For PlaceText: texts of bits and of values, for the kinds that the drive has."""
    bits = [_group(drive, address, "bits", language) for address in _addresses(drive)]
    values = [_group(drive, address, "values", language) for address in _addresses(drive)]
    kinds = (("Bit", "BitNumber", "bit of the word, 0 to 15", bits), ("Value", "Value", "value of the word", values))
    for kind, pin, comment, groups in kinds:
        if any(group.rows for group in groups) and exists(drive, kind, language):
            some = [group for group in groups if group.rows]
            told = {"title": f"{kind.lower()}s", "pin": pin, "pin_comment": comment, "groups": some}
            yield told | _language(f"{drive.prefix}_{kind}", language)


def _addresses(drive: Drive) -> list[int]:
    firsts = (row.address.first for _, row in drive.registers() if space_of(row.address.first) == "holding")
    return [*dict.fromkeys(firsts)]


def _group(drive: Drive, address: int, kind: str, language: Language) -> Group:
    row = drive.register_at(address)
    assert row is not None  # noqa: S101  (the address was taken from the tables)
    if kind == "bits":
        rows = [_entry(language, bit.bit.first, bit) for bit in row.bits if bit.name]
    else:
        rows = [_entry(language, value.value, value) for value in row.values]
    return Group(address, address_text(address), row.name or "", rows)
