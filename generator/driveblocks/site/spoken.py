"""What was overheard, for a person, a spreadsheet and a script."""

import csv
import io
from collections.abc import Iterator
from dataclasses import asdict
from typing import Any

from rich.console import RenderableType
from rich.text import Text

from driveblocks.explain import page
from driveblocks.explain.guess import guesses
from driveblocks.explain.meaning import Held, held
from driveblocks.maps.form import Span, address_text, span_text
from driveblocks.maps.view import plain as number
from driveblocks.modbus.envelope import open_
from driveblocks.modbus.layout import Dialect
from driveblocks.show.layout import facts, table
from driveblocks.site.findings import Ask, Findings, said
from driveblocks.site.found import Way

HEAD = ("unit", "function", "address", "id", "name", "does", "times", "every_ms", "word", "value", "measure", "means")
GUESSED = 5
"""Damaged frames that are looked at."""
UNKNOWN = (
    "Not known: drives that nobody asks; requests that were lost before they came here; times finer than the "
    "adapter's, which may be 16 ms late; which side a frame came from where request and reply look alike."
)
"""What nobody can know who only listens."""
FORMAT = "Even and odd parity, one stop bit and two, and 8N1 and 7E1 in ASCII may sound the same to an adapter."


def tables(found: Findings, way: Way, *, brief: bool = False) -> Iterator[RenderableType]:
    """The line, each unit's requests, what is unusual; and, unless `brief`, the last words of the registers."""
    yield facts(*_line(found, way))
    yield Text()
    yield _asks(found)
    for one in said(found):
        who = "line" if one.unit is None else f"unit {one.unit}"
        yield Text(f"{who}: {one.text}" + (f" ({one.perhaps})" if one.perhaps else ""), style="bold")
    if brief:
        return
    for guess in dict.fromkeys(_guessed(found)):
        yield Text(f"a damaged one: {guess}")
    if any(row[1].word is not None for row in _words(found)):
        yield Text()
        yield _registers(found)
    yield Text()
    yield Text(UNKNOWN)
    yield Text(FORMAT)


def _line(found: Findings, way: Way) -> Iterator[tuple[str, str]]:
    heard_s = (found.last_us - found.first_us) / 1e6
    yield "line", f"{way}"
    yield "heard", f"{found.good} good frames, {found.damaged} damaged, in {heard_s:.1f} s"
    yield "silence", f"{found.silence_us / 1000:.0f} ms at most between two frames"
    if found.broadcasts:
        yield "broadcasts", str(sum(each.times for each in found.broadcasts.values()))


def _every(found: Findings) -> Iterator[tuple[int, Ask]]:
    """Unit and request, broadcasts first."""
    for ask in found.broadcasts.values():
        yield 0, ask
    for unit, one in sorted(found.units.items()):
        for _, ask in sorted(one.asks.items()):
            yield unit, ask


def _asks(found: Findings) -> RenderableType:
    numbers = ("unit", "f", "times", "every ms", "gap ms", "reply ms", "none", "bad")
    made = table("unit", "f", "registers", *numbers[2:], wide=("registers",), numbers=numbers)
    before = None
    for unit, ask in _every(found):
        times = found.units[unit].reply_us if unit and unit != before else None
        made.add_row(
            str(unit) if unit != before else "", f"{ask.function:02X}", _registers_of(found, unit, ask),
            str(ask.times), _ms(ask.every_us), _ms(ask.gap_us or None),
            f"{times[0] // 1000} - {times[1] // 1000}" if times else "", *map(_some, (ask.unanswered, ask.spoilt)),
        )  # fmt: skip
        before = unit
    for unit, one in sorted(found.units.items()):
        for function, many in sorted(one.others.items()):
            made.add_row(str(unit), f"{function:02X}", "not taken apart", str(many), "", "", "", "", "")
    return made


def _some(many: int) -> str:
    return str(many) if many else ""


def _ms(us: int | None) -> str:
    return "" if us is None else str(us // 1000)


def _registers_of(found: Findings, unit: int, ask: Ask) -> str:
    span = Span(ask.address, min(0xFFFF, ask.address + max(1, ask.quantity) - 1))
    name = _held(found, unit, ask, 0, None).name if ask.function in (3, 4, 6, 16) else ""
    return f"{span_text(span)} {name}".strip()


def _held(found: Findings, unit: int, ask: Ask, place: int, word: int | None) -> Held:
    return held(found.drive(unit), ask.address + place, word, writing=ask.writes)


def _words(found: Findings) -> Iterator[tuple[int, Held, Ask]]:
    """Every register that was asked for, with its last word."""
    for unit, ask in _every(found):
        if ask.function in (3, 4, 6, 16):
            for place in range(ask.quantity):
                word = ask.words[place] if place < len(ask.words) else None
                yield unit, _held(found, unit, ask, place, word), ask


def _registers(found: Findings) -> RenderableType:
    made = table("unit", "register", "does", "word", "name", "is", wide=("name", "is"), numbers=("unit",))
    for unit, one, ask in _words(found):
        if one.word is not None and one.address is not None:
            does = "write" if ask.writes else "read"
            name = " ".join(filter(None, (one.id, one.name)))
            made.add_row(str(unit), address_text(one.address), does, f"{one.word:04X}H", name, _means(one))
    return made


def _means(one: Held) -> str:
    """Value with unit, or what the bits say."""
    value = f"{number(one.value)} {one.unit or ''}".strip() if one.value is not None else ""
    return ", ".join(filter(None, (value, *(each.name for each in one.lines)))) or str(one.number)


def _guessed(found: Findings) -> Iterator[str]:
    for data in found.samples[:GUESSED]:
        wire = open_(data)
        guess = next(iter(guesses(wire, Dialect())), None)
        yield f"{page.written(wire)}: {guess.says if guess else 'noise, or a part of a frame'}"


def rows(found: Findings) -> str:
    """Registers as CSV, each with how often it was asked for, and its last word."""
    text = io.StringIO()
    made = csv.writer(text, lineterminator="\n")
    made.writerow(HEAD)
    for unit, one, ask in _words(found):
        value = "" if one.value is None else number(one.value)
        means = ", ".join(each.name for each in one.lines)
        made.writerow([
            unit, ask.function, address_text(one.address or 0), one.id, one.name, "write" if ask.writes else "read",
            ask.times, _ms(ask.every_us), "" if one.word is None else one.word, value, one.unit or "", means,
        ])  # fmt: skip
    return text.getvalue()


def plain(found: Findings, way: Way) -> dict[str, Any]:
    """Everything for scripts, times in microseconds."""
    return {
        "rate": way.rate, "format": way.form, "mode": way.mode, "good": found.good, "damaged": found.damaged,
        "damaged_bytes": found.damaged_bytes, "heard_us": found.last_us - found.first_us,
        "silence_us": found.silence_us, "findings": [asdict(each) for each in said(found)],
        "requests": [{"unit": unit, **asdict(ask), "every_us": ask.every_us} for unit, ask in _every(found)],
        "reply_us": {str(unit): one.reply_us for unit, one in sorted(found.units.items())},
    }  # fmt: skip
