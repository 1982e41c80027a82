"""What is read from a drive that was found: its settings, its times, and what a person says of its gaps."""

import re
from collections.abc import Callable, Collection, Iterator
from dataclasses import replace
from decimal import Decimal, InvalidOperation
from typing import get_args

from driveblocks.desk.exchange import LATE_US, Exchanges, quality
from driveblocks.desk.master import Reply
from driveblocks.desk.site.family import unlisted
from driveblocks.desk.site.found import Answer, Asker, Found, Measured, Set, Tens
from driveblocks.desk.site.hunt import first_read
from driveblocks.desk.site.register import rows, spans
from driveblocks.desk.site.talk import EndedError, Talk, ended
from driveblocks.maps.form import Span, address_text
from driveblocks.maps.model import Absence, Drive
from driveblocks.maps.plan import most, plan
from driveblocks.meaning.setting import Setting, in_order, settings
from driveblocks.show.layout import table

READS = 200
GAPS_MS = (2, 5, 10, 20)
"""Pauses after a reply that are tried; an adapter may lengthen each."""
GAP_READS = 10
LOST = 10
"""Reads in a row to which no byte comes."""
LEAST_COUNTS = 50
"""A word below it does not show its scale: a person's reading is too coarse."""
ASKED = 3
"""How often a question is put whose answer is not understood."""

# ------------------------------------------------------------ 3: keypad


def keypad(talk: Talk, asker: Asker, found: Found) -> None:
    """Read back what can be read of what must be set, and ask once for the rest. Raises EndedError."""
    allowed = plan(talk.drive).readable
    for each in in_order(talk.drive):
        if each.needed is None:
            continue
        readable = each.register is not None and any(each.register in span for span in allowed)
        words = _words(talk, Span(each.register, each.register)) if readable and each.register is not None else ()
        found.settings.append(Set(each.id, each.name, words[0] if words else None, each.needed.right, each.needed.why))
    made = table("id", "setting", "is", "must be", "why", wide=("setting", "why"))
    known = {each.id: each for each in settings(talk.drive)}
    for one in found.settings:
        is_, must = named(known[one.id], one.read) or "?", _right(known[one.id], one.must) or "as the PLC"
        made.add_row(one.id, one.name, is_, must, one.why)
    asker.say(made)
    for one in (each for each in found.settings if each.differs):
        is_, must = named(known[one.id], one.read), _right(known[one.id], one.must)
        asker.say(f"{known[one.id].keypad.code} is {is_} and must be {must}: set it at the keypad")
    if not any(each.read is None for each in found.settings):
        return
    differing = _differing(asker, {each.id for each in found.settings})
    if differing is None:
        found.skipped.append("keypad")
        return
    told = {True: "no", False: "yes"}
    found.settings = [
        one if one.read is not None else replace(one, told=told[one.id.lower() in differing]) for one in found.settings
    ]


def _differing(asker: Asker, ids: Collection[str]) -> set[str] | None:
    """Ids in lower case that differ at the keypad; None where a person does not say."""
    for _ in range(ASKED):
        said = "Compare the keypad with each `?`. Is all as it must be? yes, or the ids that differ:"
        answer = asker.ask("keypad", said).lower()
        words = set(re.split("[,; ]+", answer.strip(",;. ")))
        if words <= {each.lower() for each in ids}:
            return words
        if words == {"yes"}:
            return set()
        if not answer:
            break
        asker.say("That was not understood. Type yes, ids of the table, or nothing.")
    return None


def named(setting: Setting, number: int | None) -> str:
    """A value as the keypad has it, with its name."""
    return "" if number is None else setting.said_of(number)


def _right(setting: Setting, numbers: Collection[int]) -> str:
    return " or ".join(named(setting, each) for each in numbers)


def _words(talk: Talk, span: Span) -> tuple[int, ...]:
    """Words of a register, none where the drive refuses it or says nothing to it. Raises EndedError for a lost line."""
    try:
        return talk.steady(span).words
    except EndedError as end:
        if end.fault.kind != "lost":
            raise
    talk.steady(first_read(talk.drive))
    return ()


# ------------------------------------------------------------ 4: measure


def measure(talk: Talk, asker: Asker, reads: int = READS) -> Measured:
    """Times and lengths, by reads alone. Raises EndedError where the drive falls silent."""
    span, longest, lost = first_read(talk.drive), 0, 0
    for at in range(reads):
        asker.progress(at, reads, "reply time")
        reply = talk.read(span)
        lost = 0 if reply.data else lost + 1
        if lost == LOST:
            raise ended("lost", f"unit {talk.unit} does not answer any more, after {at} of {reads} reads")
        longest = max(longest, reply.after_us if reply.kind == "good" else 0)
    gap = next((ms for ms in GAPS_MS if _holds(talk, ms)), None)
    return Measured(reads, -(-longest // 1000), gap, _longest_read(talk), _unlisted(talk))


def _holds(talk: Talk, gap_ms: int) -> bool:
    """Whether the drive answers each of some reads that begin so soon after its reply; they say nothing of the line."""
    span, master = first_read(talk.drive), talk.line.master
    kept, master.said = master.said, Exchanges({}, talk.drive, own=True)
    try:
        return all(talk.read(span, None, 1000 * gap_ms).answered for _ in range(GAP_READS))
    except EndedError:  # an adapter was still handing over the reply
        return False
    finally:
        if quality(master.said).silent:
            master.rest(LATE_US)
        master.said = kept


def _longest_read(talk: Talk) -> int:
    """Words of the longest read that is answered, over registers that the map lists."""
    every = spans(talk.drive, [each.address for each in rows(talk.drive)], most(talk.drive, talk.way.mode).read)
    span = max([first_read(talk.drive), *every], key=len)
    while len(span) > 1 and not _words(talk, span):
        span = Span(span.first, span.first + len(span) // 2 - 1)
    return len(span)


def _unlisted(talk: Talk) -> str:
    address = next(iter(unlisted(talk.drive)), None)
    if address is None:
        return "not tried"
    try:
        reply = talk.steady(Span(address, address))
    except EndedError:
        reply = Reply("silent")
    return f"{address_text(address)}: {'words' if reply.words else 'refused' if reply.answered else 'no reply'}"


# ------------------------------------------------------------ 5: gaps


def asked(drive: Drive) -> list[Absence]:
    """The gaps that a person is asked about."""
    return [each for each in drive.absent if each.on_site and not each.on_site.by_run]


def script(drive: Drive) -> Iterator[tuple[str, str]]:
    """What only a run by the bus can show: the gap, and what to do."""
    for each in drive.absent:
        if each.on_site and each.on_site.by_run:
            yield each.what, f"{each.on_site.do}; {each.on_site.ask}?"


def gaps(talk: Talk, asker: Asker, found: Found, keep: Callable[[], None]) -> None:
    """Ask about each gap; where a register answers, read it at that moment. Raises EndedError."""
    for gap in asked(talk.drive):
        one = gap.on_site
        if one is None:
            continue
        asker.say(f"\nNot in the manual: {gap.what}.\nDo: {one.do}.")
        answer = asker.ask(gap.what, f"{one.ask[0].upper()}{one.ask[1:]}?")
        if not answer:
            found.skipped.append(gap.what)
            continue
        words = _words(talk, Span(one.read, one.read)) if one.read is not None else ()
        word = words[0] if words else None
        value = scale(answer, word) if one.gives else ""
        found.answers.append(Answer(gap.what, answer, word, one.gives or "", value))
        keep()
        if one.read is not None:
            said = f": {one.gives} is {value}" if value else ": that shows no scale" if one.gives else ""
            asker.say(f"{address_text(one.read)} is {'not given' if word is None else word}{said}")


def scale(answer: str, word: int | None) -> str:
    """The power of ten that makes the number of a keypad of a word; empty where none does, to 2 % and a count."""
    try:
        number = Decimal(answer.split(maxsplit=1)[0].replace(",", "."))
    except InvalidOperation:
        return ""
    if word is None or not LEAST_COUNTS <= word < 0x8000 or not number.is_finite():
        return ""
    tens = ((each, Decimal(each)) for each in get_args(Tens))
    return next((text for text, each in tens if abs(word * each - number) <= each + number / 50), "")
