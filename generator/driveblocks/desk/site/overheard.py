"""What was heard on a line, as tables, sentences and JSON, in the words of maps where units have one."""

from collections.abc import Iterator
from typing import Any

from rich.console import RenderableType
from rich.text import Text

from driveblocks.desk.exchange import ECHOED, Exchanges, Key, Poll, Role, Said, Unit, quality
from driveblocks.desk.explain.meaning import held
from driveblocks.desk.explain.page import means
from driveblocks.desk.site.ear import FORMS
from driveblocks.desk.site.found import Way
from driveblocks.maps.form import Span, address_text, span_text
from driveblocks.maps.model import Drive
from driveblocks.maps.numbering import at
from driveblocks.modbus.envelope import mode_of
from driveblocks.modbus.request import WRITES
from driveblocks.show.layout import facts, table

MANY = 2
"""Requests too soon after another, from which on there is more to it than one late byte."""
ODD: dict[Role, str] = {
    "late": "unit {} answered {} after the master had given up: its timeout is too short, or the drive slow",
    "twice": "two replies came to one request to unit {}, {}: two units with this address, or a repeater",
    "late or twice": "replies of unit {} came late or twice, {}: nobody can say which",
    "unasked": "unit {} answered {} to what was not heard: a request was damaged, or came before",
}
UNSURE = ("silent", "unanswered", "late", "twice", "late or twice", "unasked", "unclear")
"""What nobody can say where two masters speak at once."""
UNKNOWN = (
    "which of two frames of the same bytes is the request and which its echo, as of 06H: the first is taken for it; "
    "drives that nobody asks; times finer than the adapter hands bytes over, up to 16 ms; what was said while nothing "
    "decoded"
)


def tables(way: Way, traffic: Exchanges) -> Iterator[RenderableType]:
    """All that a person reads: the line, a table per unit, what is odd, and what nobody can know."""
    yield facts(*_line(way, traffic))
    for number, unit in sorted(traffic.units.items()):
        yield Text()
        drive = traffic.drive(number)
        yield Text(f"Unit {number}{f', taken for {drive.prefix}' if drive else ''}", style="bold")
        yield _unit(number, unit, traffic)
    found = [each for _, each in odd(traffic)]
    yield Text()
    yield "\n".join(f"- {each}" for each in found) if found else "Nothing odd was heard."
    yield Text(f"Cannot be known: {UNKNOWN}.", style="dim")


def odd(traffic: Exchanges) -> Iterator[tuple[str, str]]:
    """What does not happen as it should: what it is called, and a sentence."""
    for number, unit in sorted(traffic.units.items()):
        found = _odd(number, unit, traffic)
        yield from (each for each in found if traffic.hasty < MANY or each[0] not in UNSURE)
    if traffic.hasty >= MANY:
        says = "requests were sent right after another that had no reply: two masters, or one that does not wait"
        yield "masters", f"{traffic.hasty} {says} for replies"
    if traffic.echoes:
        says = "a repeater or an adapter that echoes, or a master that does not wait for replies"
        yield "echo", f"a request was heard again at once, {_times(traffic.echoes)}: {says}"
    if traffic.damaged:
        share = 100 * traffic.damaged_bytes / traffic.bytes
        yield "damaged", f"{share:.1f} % of all bytes made no good frame, {_times(traffic.damaged)}"


def _odd(number: int, unit: Unit, traffic: Exchanges) -> Iterator[tuple[str, str]]:
    polls = unit.polls.values()
    # a late reply to a write of one register looks like a request without a reply
    blurred = ECHOED if unit.odd.total() or unit.unclear else ()
    asked = sum(each.count for each in polls)
    silent = sum(each.unanswered for (function, *_), each in unit.polls.items() if function not in blurred)
    answers = sum(each.replies + each.refusals for each in polls) + unit.odd.total()
    if damaged := sum(each.damaged for each in polls):
        yield "damaged", f"damaged bytes came after {damaged} of {asked} requests to unit {number}"
    silent -= unit.unclear + (traffic.waiting(number) if unit.odd["late"] or unit.unclear else 0)
    if silent > 0 and not answers and not traffic.damaged:
        yield "silent", f"unit {number} never answers; it was asked {_times(asked)}"
    elif silent > 0:
        yield "unanswered", f"unit {number} left {silent} of {asked} requests without a reply"
    for role, says in ODD.items():
        if count := unit.odd[role]:
            yield role, says.format(number, _times(count))
    if unit.unclear:
        yield (
            "unclear",
            f"unit {number}: {_times(unit.unclear)} a write without a reply, or a second reply: they look the same",
        )
    for key, poll in unit.polls.items():
        if poll.refusals:
            what = f"{key[0]:02X}H at {_where(key, traffic.drive(number))}"
            yield "refused", f"unit {number} refused {what} {poll.refusals} of {poll.count} times"


def _line(way: Way, traffic: Exchanges) -> Iterator[tuple[str, object]]:
    heard_us = traffic.end_us - traffic.begin_us
    yield "line", f"{way.rate} bit/s, {FORMS.get(way.form, way.form)}, {way.mode.upper()}"
    yield "heard", f"{traffic.frames} frames, {traffic.requests} of them requests, in {heard_us / 1e6:.1f} s"
    if heard_us:
        yield "busy", f"{min(100, 100 * traffic.bytes * way.character_us / heard_us):.0f} % of the time"
    yield "asked", str(quality(traffic))
    yield "silence", f"{traffic.silence_us // 1000} ms at most"
    for (function, address), count in sorted(traffic.broadcasts.items()):
        yield "broadcast", f"{count} x {function:02X}H at {address_text(address)}"


def _unit(number: int, unit: Unit, traffic: Exchanges) -> RenderableType:
    numbers = "every ms", "requests", "replies", "reply ms"
    made = table("does", "registers", *numbers, "last", numbers=numbers, wide=("last",))
    for key, poll in sorted(unit.polls.items()):
        took = dict.fromkeys((poll.shortest_us // 1000, poll.longest_us // 1000))
        replies = "-".join(map(str, took)) if poll.replies + poll.refusals else "-"
        every = str(poll.every_us // 1000) if poll.count > 1 else "-"
        texts = list(_words(number, key, poll, traffic)) or ["-"]
        row = f"{key[0]:02X}H", _where(key, traffic.drive(number)), every, str(poll.count), str(poll.replies), replies
        made.add_row(*row, "\n".join(texts))
    return made


def _words(number: int, key: Key, poll: Poll, traffic: Exchanges) -> Iterator[str]:
    """The last words; with a map, a line for each register that it knows."""
    drive = traffic.drive(number)
    for place, word in enumerate(poll.words):
        one = held(drive, key[1] + place, word, writing=key[0] in WRITES)
        name = " ".join(filter(None, (one.id, one.name)))
        yield f"{name or address_text(one.address or 0)}: {means(one) if drive else f'{word:04X}H'}"


def _times(count: int) -> str:
    return "once" if count == 1 else f"{count} times"


def _where(key: Key, drive: Drive | None) -> str:
    span = Span(key[1], min(key[1] + max(key[2], 1) - 1, 0xFFFF))
    return span_text(Span(at(drive, span.first), span.last) if drive else span)


def line(said: Said, clock: str) -> str:
    """A frame in a log: `driveblocks explain` reads what follows the time."""
    asks = said.role in ("request", "broadcast")
    mark = ">" if asks else "-" if said.role == "damaged" else "<"
    data = said.frame.data
    plain = mode_of(data) == "ascii" and said.frame.good
    return f"{clock} {mark} {data.decode('ascii').rstrip() if plain else data.hex(' ').upper()}\n"


COLUMNS = ("seconds", "what", "unit", "function", "address", "quantity", "words", "bytes")


def row(said: Said, begin_us: int) -> list[str]:
    """A frame in a CSV file, by `COLUMNS`."""
    layout, asked = said.layout, said.asked
    words = " ".join(f"{word:04X}" for word in layout.words) if layout else ""
    known = [asked.function, asked.address, asked.quantity] if asked else [layout.function if layout else "", "", ""]
    unit = layout.body[0] if layout else ""
    seconds = f"{(said.frame.begin_us - begin_us) / 1e6:.4f}"
    return [seconds, said.role, str(unit), *map(str, known), words, said.frame.data.hex(" ").upper()]


def plain(way: Way | None, traffic: Exchanges) -> dict[str, Any]:
    """The same for scripts: times in ms."""
    return {
        "rate": way and way.rate, "format": way and FORMS.get(way.form, way.form), "mode": way and way.mode,
        "frames": traffic.frames, "requests": traffic.requests, "damaged": traffic.damaged,
        "longest_silence": traffic.silence_us // 1000,
        "odd": [{"what": what, "says": says} for what, says in odd(traffic)],
        "broadcasts": [
            {"function": function, "address": address, "count": count}
            for (function, address), count in sorted(traffic.broadcasts.items())
        ],
        "units": [
            {"unit": number, **unit.odd, "polls": [_plain(key, poll) for key, poll in sorted(unit.polls.items())]}
            for number, unit in sorted(traffic.units.items())
        ],
    }  # fmt: skip


def _plain(key: Key, poll: Poll) -> dict[str, Any]:
    return {
        "function": key[0], "address": key[1], "quantity": key[2], "requests": poll.count,
        "every": poll.every_us // 1000,
        "replies": poll.replies, "refusals": poll.refusals, "unanswered": poll.unanswered, "damaged": poll.damaged,
        "reply": [poll.shortest_us // 1000, poll.longest_us // 1000], "words": list(poll.words),
    }  # fmt: skip
