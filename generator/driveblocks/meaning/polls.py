"""The reads that keep the pins of a drive block fresh: which words, in which transactions, in which order."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace

from driveblocks.maps.form import Span, address_text, is_bit
from driveblocks.maps.model import Drive, kept
from driveblocks.maps.pair import whole
from driveblocks.maps.plan import most, plan, reads_by
from driveblocks.meaning.measure import measures, own_maximum
from driveblocks.meaning.quantity import quantity
from driveblocks.meaning.status import registers, status
from driveblocks.modbus.layout import bytes_of

MOST_POLLS = 12
MOST_WORDS = 16
"""What an answer of the line holds."""

REQUEST, REPLY, WORD = 8, 5, 2
"""Characters in RTU of a read request, of its reply without words, and of a word (MODBUS Application Protocol, 6.3)."""

NO_WAY = 1_000_000
"""The cost of what cannot be read so."""

PAUSES = 10
"""What turn-round and silence are worth, in characters: a transaction costs them, a longer one does not cost more."""


@dataclass(frozen=True)
class Poll:
    """One read that is sent again and again."""

    function: int
    address: int
    words: int
    """Registers; or coils, which are the bits of one word."""
    fast: bool
    """Whether it is sent every round; the slow ones take turns, one in a round."""

    @property
    def addresses(self) -> range:
        """What it reads."""
        return range(self.address, self.address + self.words)

    @property
    def data(self) -> int:
        """Data bytes of its reply."""
        return bytes_of(self.words) if is_bit(self.address) else WORD * self.words

    @property
    def looks(self) -> tuple[int, int]:
        """What distinguishes its reply from others: the function and the length."""
        return self.function, self.data

    def characters(self, *, ascii_mode: bool = False) -> int:
        """Characters on the wire, request and reply together."""
        rtu = REQUEST + REPLY + self.data
        # ASCII: two for a byte, ':' CR LF around each frame, and an LRC of one byte where RTU has two
        return 2 * (rtu - 2) + 6 if ascii_mode else rtu

    @property
    def cost(self) -> int:
        """What it costs beside other plans, in characters."""
        return self.characters() + PAUSES


def fast_words(drive: Drive) -> frozenset[int]:
    """What must be fresh: registers of status, standstill, states and who commands, and the output frequency."""
    shows = status(drive)
    shown = (each for one in (*shows.shown, shows.standstill, shows.by_bus) for each in one.patterns)
    words = registers((*shown, *(one.pattern for one in shows.states)))
    return _whole(drive, (*words, *_frequency(drive)))


def slow_words(drive: Drive) -> frozenset[int]:
    """What may be older: other measures, the present fault, and what gives the reference and the measures meaning.

    The drive's own maximum frequency is of that kind, too.
    """
    own = own_maximum(drive)
    scaled = (each.when for one in (*measures(drive), own) if one for each in quantity(drive, one.register).factors)
    words = (*registers(filter(None, scaled)), *(each.register for each in measures(drive)), *meaning_words(drive))
    return _whole(drive, (*words, *fault_words(drive), *drive.warned)) - fast_words(drive)


def young_words(drive: Drive) -> frozenset[int]:
    """What is shown while it is young: measures, what alone says their scale, and the code of a warning."""
    measured = [one.register for one in measures(drive)]
    scaled = (each.when for one in measured for each in quantity(drive, one).factors)
    return frozenset({*measured, *drive.warned, *{*registers(filter(None, scaled))} - meaning_words(drive)})


def fault_words(drive: Drive) -> frozenset[int]:
    """What says which fault is present."""
    faults = drive.faults
    if faults.present is not None:
        return frozenset({faults.present})
    return frozenset(range(faults.bits.first, faults.bits.last + 1)) if faults.bits else frozenset()


def speed_words(drive: Drive) -> frozenset[int]:
    """The output frequency where it is among what proves standstill; else all of the proof."""
    proof = frozenset(registers(status(drive).standstill.patterns))
    return proof.intersection(_frequency(drive)) or proof


def meaning_words(drive: Drive) -> frozenset[int]:
    """What gives the reference its meaning, settings and the drive's own maximum; and what forbids a start."""
    own, asked = own_maximum(drive), status(drive)
    forbids = registers(each for one in asked.forbids for each in one.patterns)
    return _whole(drive, (*registers(asked.verify), *forbids, *([own.register] if own else ())))


def _frequency(drive: Drive) -> Iterator[int]:
    return (each.register for each in measures(drive) if each.name == "output_frequency")


def _whole(drive: Drive, words: Iterable[int]) -> frozenset[int]:
    """All registers of the values of which these are some."""
    return frozenset(each for word in words for each in whole(drive, word))


@kept
def polls(drive: Drive) -> tuple[Poll, ...]:
    """The cheapest reads of all words, the fast ones first, each class by address, no two of one length if it can be.

    Of the fast ones the frequency comes last: standstill is proved once it was read after the others. Of the slow ones
    what says which fault it is comes first, so that it is known soon after a restart. A reply does not say what it
    answers: one that comes late, or twice, would pass for that to another read as long.

    Raises ValueError for a word that cannot be read, and where more than `MOST_POLLS` reads are needed.
    """
    found = sorted(
        _cheapest(drive, sorted(fast_words(drive) | slow_words(drive))), key=lambda poll: _place(drive, poll)
    )
    if len(found) > MOST_POLLS:
        raise ValueError(f"what its pins show takes {len(found)} reads; {MOST_POLLS} fit into the drive block's plan")
    return tuple(_apart(drive, found))


def _place(drive: Drive, poll: Poll) -> tuple[bool, bool]:
    if poll.fast:
        return False, not speed_words(drive).isdisjoint(poll.addresses)
    return True, fault_words(drive).isdisjoint(poll.addresses)


def identity_read(drive: Drive) -> Poll | None:
    """The one read of all words of the identity; None where the map has none. Raises ValueError if it takes more."""
    if drive.identity is None:
        return None
    words = sorted({each.register for each in drive.identity.all})
    found = _cheapest(drive, words)
    if len(found) > 1:
        raise ValueError(f"the identity takes {len(found)} reads, and a stop waits for it")
    return found[0]


def beyond(drive: Drive, poll: Poll, taken: set[tuple[int, int]]) -> int:
    """A length from the poll's own on that no other read has, over listed registers that may be read; else 0."""
    allowed, most = plan(drive).readable, _most(drive, poll.address)
    words = poll.words
    while replace(poll, words=words).looks in taken:
        last = Span(poll.address, poll.address + words)
        words += 1
        if words > most or not _used(drive, last.last) or not _together(drive, allowed, last):
            return 0
    return words


def other_words(drive: Drive, poll: Poll, reads: tuple[Poll, ...]) -> int:
    """Registers of a poll after a timeout, 0 where there is no other length; its own where another read is as long."""
    lengths = [each.looks for each in reads]
    return beyond(drive, poll, set(lengths)) or (poll.words if lengths.count(poll.looks) > 1 else 0)


def _apart(drive: Drive, found: list[Poll]) -> Iterator[Poll]:
    """The reads, each as long as none before it; none runs into another."""
    taken: set[tuple[int, int]] = set()
    for poll in found:
        longer = replace(poll, words=beyond(drive, poll, taken) or poll.words)
        others = {address for each in found if each is not poll for address in each.addresses}
        if not others.isdisjoint(longer.addresses):
            longer = poll
        taken.add(longer.looks)
        yield longer


def most_words(drive: Drive) -> int:
    """Most registers of one read, in each mode of the drive and in an answer of the line."""
    return min([MOST_WORDS, *(most(drive, mode).read for mode in drive.serial.mode.modes)])


def _most(drive: Drive, address: int) -> int:
    """The same of coils: a word of them."""
    return MOST_WORDS if is_bit(address) else most_words(drive)


def _cheapest(drive: Drive, words: list[int]) -> tuple[Poll, ...]:
    """The cheapest way to read the words, by address; of ways that cost the same, the one with fewest fast words.

    The words of a pair are in one read.
    """
    allowed = plan(drive)
    fast = fast_words(drive)
    best: list[tuple[int, int, tuple[Poll, ...]]] = [(0, 0, ())]
    for end, word in enumerate(words, 1):
        if not any(word in span for span in allowed.readable):
            raise ValueError(f"the drive block needs {address_text(word)}, which the map does not let it read")
        ways = []
        most = _most(drive, word)
        for start, first in enumerate(words[:end]):
            halves = first != min(whole(drive, first)) or word != max(whole(drive, word))
            if not halves and word - first < most and _together(drive, allowed.readable, Span(first, word)):
                poll = Poll(reads_by(drive, first), first, word - first + 1, not fast.isdisjoint(words[start:end]))
                cost, hurried, before = best[start]
                ways.append((cost + poll.cost, hurried + poll.words * poll.fast, (*before, poll)))
        best.append(min(ways, key=lambda way: way[:2], default=(NO_WAY, 0, ())))
    if best[-1][0] >= NO_WAY:
        raise ValueError("a value of 32 bits takes both its registers in one read, which the map does not allow")
    return best[-1][2]


def _together(drive: Drive, readable: tuple[Span, ...], span: Span) -> bool:
    """Whether one read may run from the first to the last of these: an area's rule does not say that all are there.

    A drive may refuse a read over an address that its manual lists as unused, and could not be run then.
    """
    listed = all(_used(drive, address) for address in range(span.first + 1, span.last))
    return listed and any(span.first in other and span.last in other for other in readable)


def _used(drive: Drive, address: int) -> bool:
    row = drive.register_at(address)
    return row is not None and not row.unused


def schedule(polls: tuple[Poll, ...]) -> tuple[int, ...]:
    """The order in which the standing poll takes the reads, as indices.

    All fast ones, twice if there is but one, then the next slow one: at most every third request is slow.
    """
    fast = tuple(index for index, poll in enumerate(polls) if poll.fast)
    slow = [index for index, poll in enumerate(polls) if not poll.fast]
    rounds = fast * 2 if len(fast) == 1 else fast
    return tuple(index for last in slow for index in (*rounds, last)) or fast


def wire_ms(poll: Poll, bit_rate: int, bits: int, turn_round_ms: float, silence_ms: float | None = 0.0) -> float:
    """How long a read holds the line, with its turn-round and, in RTU, the silence after each of both frames.

    `bits` are those of a character, 10 or 11. The silence is that of MODBUS over Serial Line V1.02, 2.5.1.1, or the
    drive's own `silence_ms` where that is longer; None for ASCII, which needs none.
    """
    character = 1000 * bits / bit_rate
    if silence_ms is None:
        return poll.characters(ascii_mode=True) * character + turn_round_ms
    silence = max(3.5 * character if bit_rate <= 19200 else 1.75, silence_ms)
    return poll.characters() * character + turn_round_ms + 2 * silence
