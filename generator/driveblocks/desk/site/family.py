"""Whether a unit is of a map's family: what speaks for it and against it, each with the frame that shows it."""

import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Literal

from driveblocks.bench.simulator.refusal import codes
from driveblocks.desk.master import Master, Reply
from driveblocks.desk.site.register import rows
from driveblocks.maps.form import Span, address_text
from driveblocks.maps.model import Drive
from driveblocks.maps.plan import dialect, plan, read_request
from driveblocks.meaning.polls import Poll, identity_read, polls
from driveblocks.meaning.status import status

SETTINGS = 5
"""Parameters that are tried."""
UNLISTED = 12
"""Registers that no table lists: a unit that answers all of these answers everything."""
SAYS = (b"\x11", b"\x2b\x0e\x01\0")
"""Requests by which a unit may say what it is: 17 and 43 (MODBUS Application Protocol V1.1b3, 6.13 and 6.21)."""
NAME = re.compile(rb"[ -~]{3,}")
WORD = re.compile(r"[a-z]{3,}")

Read = list[tuple[Poll, Reply]]
Ask = Callable[[Drive, bytes], Reply]
"""Puts a request, without checksum, in the dialect of a map until a reply is good, refused or silent."""


@dataclass
class Judgement:
    """What the replies of a unit show of its family."""

    family: Literal["identity", "fits", "unknown", "other"] = "fits"
    """`identity`: by the map's; `unknown`: it answers every address; `other`: it is not of the family."""
    why: str = ""
    """Of another family."""
    evidence: list[str] = field(default_factory=list)
    refused: str = ""
    """What the map lists and the unit does not give, where that does not decide."""

    def note(self, text: str, reply: Reply) -> None:
        """A reply, and what it shows."""
        self.evidence.append(f"{text}: {reply.frame or 'no reply'}")

    def against(self, why: str, reply: Reply) -> "Judgement":
        """The reply that decides against the family."""
        self.family, self.why = "other", f"{why}: {reply.frame or 'no reply'}"
        return self


def judge(ask: Ask, drive: Drive, unit: int, others: Mapping[str, Drive]) -> Judgement:
    """Weigh the replies of a unit that has answered. Raises what `ask` raises."""
    read, found = identity_read(drive), Judgement()
    if read is not None:
        return _identified(ask, drive, unit, read)
    every = [(each, _surely(ask, drive, _request(unit, drive, each))) for each in polls(drive)]
    for each, reply in every:
        if not reply.words and (each.fast or not any(one.words for _, one in every)):
            return found.against(f"unit {unit} does not give {_what(each)}, which {drive.prefix} has", reply)
        if strange := next(_strange(drive, each, reply), ""):
            return found.against(f"what unit {unit} gives is no {drive.prefix}: {strange}", reply)
        found.note(f"{'gives' if reply.words else 'does not give'} {_what(each)}", reply)
    settings = _settings(ask, drive, unit)
    lacking = [each for each in settings if not each.words]
    if settings and len(lacking) == len(settings):
        return found.against(f"unit {unit} gives none of the parameters that {drive.prefix} has", lacking[-1])
    found.refused = ", ".join(_what(each) for each, reply in every if not reply.words)
    if not found.refused and not _refuses_some(ask, drive, unit):
        found.family = "unknown"
    weak = bool(found.refused) or 2 * len(lacking) > len(settings) or not _listed(drive, every)
    if why := _rival(ask, (drive, unit), others, found, weak=weak):
        return found.against(*why)
    return _named(ask, drive, unit, others, found)


def stranger(master: Master, drive: Drive, unit: int, others: Mapping[str, Drive]) -> str:
    """Why a unit that answers is of another family; empty where nothing shows that, or where it is silent."""

    def ask(one: Drive, body: bytes) -> Reply:
        master.said.anyone = one
        return master.patient(body, codes(drive)["busy"])

    first = _request(unit, drive, identity_read(drive) or polls(drive)[0])
    if not ask(drive, first).answered:
        return ""
    judged = judge(ask, drive, unit, others)
    gone = judged.family == "other" and not ask(drive, first).answered
    master.said.anyone = drive
    return "" if gone else judged.why


def _settings(ask: Ask, drive: Drive, unit: int) -> list[Reply]:
    """The replies to some parameters that the map lists, the first and the last among them."""
    listed = [each.address for each in rows(drive) if each.set]
    every = [listed[(len(listed) - 1) * at // (SETTINGS - 1)] for at in range(SETTINGS)] if listed else []
    return [ask(drive, _request(unit, drive, Poll(3, each, 1, fast=False))) for each in dict.fromkeys(every)]


def _what(poll: Poll) -> str:
    count = "1 word" if poll.words == 1 else f"{poll.words} words"
    return f"{count} from {address_text(poll.address)}"


def _identified(ask: Ask, drive: Drive, unit: int, read: Poll) -> Judgement:
    found, reply = Judgement("identity"), ask(drive, _request(unit, drive, read))
    if not reply.words:
        return found.against(f"unit {unit} does not give the identity of {drive.prefix}", reply)
    for pattern in status(drive).identity.patterns:
        word = reply.words[pattern.register - read.address]
        if not pattern.holds(word):
            return found.against(
                f"unit {unit} is no {drive.prefix}: {address_text(pattern.register)} is {word:04X}H", reply
            )
    found.note(f"has the identity of {drive.prefix}", reply)
    return found


def _strange(drive: Drive, poll: Poll, reply: Reply) -> Iterator[str]:
    """Words of the status, and a fault code, that the manual does not list."""
    codes = {each.code for each in drive.faults.codes}
    for address, word in zip(span_of(poll), reply.words, strict=False):
        row = drive.register_at(address)
        if poll.fast and row and row.values and not row.masks and word not in {each.value for each in row.values}:
            yield f"{address_text(address)} is {word}, which its manual does not list"
        code = drive.faults.code_in(address, word) if address == drive.faults.present else 0
        if code and codes and code not in codes:
            yield f"{address_text(address)} has the fault {code}, which its manual does not list"


def _listed(drive: Drive, every: Read) -> bool:
    """Whether there is a word of which the manual lists all values."""
    rows = (drive.register_at(address) for poll, reply in every if reply.words for address in span_of(poll))
    return any(row and row.values and not row.masks for row in rows)


def _as_rival(ask: Ask, drive: Drive, unit: int, other: Drive) -> Read:
    """What another family's block reads beside what the own map lists; nothing where the unit does not give it all."""
    own, found = plan(drive).readable, list[tuple[Poll, Reply]]()
    for each in polls(other):
        if any(span.overlaps(span_of(each)) for span in own):
            continue
        reply = ask(other, _request(unit, other, each))
        if not reply.words or next(_strange(other, each, reply), ""):
            return []
        found.append((each, reply))
    return found


def _surely(ask: Ask, drive: Drive, request: bytes) -> Reply:
    """A reply; silence twice, since a line may lose the request."""
    reply = ask(drive, request)
    return reply if reply.answered else ask(drive, request)


def _rival(
    ask: Ask, one: tuple[Drive, int], others: Mapping[str, Drive], found: Judgement, *, weak: bool
) -> tuple[str, Reply] | None:
    """Another family as which the unit answers, where its own evidence is `weak`; every other rival is noted."""
    drive, unit = one
    own = {*map(span_of, polls(drive))}
    for name, other in others.items():
        if {*map(span_of, polls(other))} <= own:
            found.evidence.append(f"{name} reads the same registers: compare the plate")
        elif rival := _as_rival(ask, drive, unit, other):
            if weak and found.family == "fits" and (found.refused or _listed(other, rival)):
                return f"unit {unit} answers as {name} does, and not as {drive.prefix}", rival[-1][1]
            found.note(f"answers what {name} reads, too", rival[-1][1])
    return None


def _refuses_some(ask: Ask, drive: Drive, unit: int) -> bool:
    """Whether a unit refuses any register that its map does not list: one that answers all has no family to be seen."""
    free = unlisted(drive)
    step = max(1, len(free) // UNLISTED)
    spans = (Poll(3, each, 1, fast=True) for each in free[step // 2 :: step][:UNLISTED])
    return any(not ask(drive, _request(unit, drive, each)).words for each in spans)


def _named(ask: Ask, drive: Drive, unit: int, others: Mapping[str, Drive], found: Judgement) -> Judgement:
    """What the unit says of itself, where it does."""
    for asked in SAYS if dialect(drive).add == 0x80 else ():
        reply = ask(drive, bytes([unit]) + asked)
        names = (
            [each.decode() for each in NAME.findall(reply.layout.body[2:])]
            if reply.kind == "good" and reply.layout
            else []
        )
        if not names:
            continue
        says = " ".join(names)
        found.note(f'says that it is "{says}"', reply)
        makers = {each.vendor.en for each in others.values() if _is_of(each, says)}
        if makers and not _is_of(drive, says):
            return found.against(f"unit {unit} says that it is of {', '.join(sorted(makers))}", reply)
    return found


def _is_of(drive: Drive, says: str) -> bool:
    """Whether a text names the maker of a family."""
    return bool({*WORD.findall(drive.vendor.en.lower())} & {*WORD.findall(says.lower())})


def unlisted(drive: Drive) -> list[int]:
    """Registers that are in none of a map's tables and areas: those after a table first, then some all over."""
    taken = [*plan(drive).readable, *plan(drive).writable, *(each.addresses for each in drive.areas)]
    after = (each.last + 1 for each in plan(drive).readable)
    every = dict.fromkeys((*after, *range(0x0777, 0xFFFF, 0x1111)))
    return [each for each in every if each < 0xFFFF and not any(each in span for span in taken)]


def span_of(poll: Poll) -> Span:
    """The registers of a read."""
    return Span(poll.address, poll.address + poll.words - 1)


def _request(unit: int, drive: Drive, poll: Poll) -> bytes:
    return read_request(unit, drive, span_of(poll))
