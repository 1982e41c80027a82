"""What is said of a drive over lines that delay, double, damage and mix up: no word and no verdict is another's."""

from collections.abc import Iterator
from random import Random

import pytest
from tests.desk.peers import CHAR_US, FATES, TWINS, Fate, Line, Named
from tests.desk.run.desk import maps

from driveblocks.desk.master import Speech
from driveblocks.desk.site.reader import LostError, One, Reader
from driveblocks.desk.site.register import rows
from driveblocks.desk.site.saved import Word
from driveblocks.maps.form import is_bit
from driveblocks.maps.plan import dialect

MAPS = {each.path.stem: each.drive for each in maps()}
LINES = (*FATES, *TWINS)
TIMES = 7
"""Seeds of each family on each line; 2,233 runs in all."""


def units(stem: str, line: str, seed: int) -> tuple[list[Named], Fate]:
    """Who is on a line: a unit that gives all, or refuses or leaves out some registers; or two at one address."""
    chance, style = Random(f"{stem} {line} {seed}"), dialect(MAPS[stem])
    addresses = [each.address & 0xFFFF for each in rows(MAPS[stem])]
    some = frozenset(chance.sample(addresses, 2))
    form = None if style.address is None or style.function is None else (style.function, style.address)
    reply_us = chance.choice((2_000, 5_000, 12_000, 38_000)) if seed else 5_000
    one = Named(reply_us=reply_us, refusal=form)
    if line in TWINS:
        return [one, Named(reply_us=reply_us + TWINS[line], refusal=form, mark=0x8000)], Fate()
    one.refuses, one.silent = (some if seed % 3 == 1 else one.refuses), (some if seed % 6 == 5 else one.silent)
    return [one], FATES[line]


def saved(stem: str, line: str, seed: int) -> tuple[Line, Named, dict[int, Word], str]:
    """What is read of a drive, and why it ended, if it did."""
    peers, fate = units(stem, line, seed)
    wire, found, ended = Line(peers, fate, seed), dict[int, Word](), ""
    reader = Reader(wire, wire.clock, One(stem, MAPS[stem], 1), Speech("rtu", CHAR_US), 30_000_000)
    try:
        reader.read(found, lambda: None, lambda _: None)
    except LostError as error:
        ended = type(error).__name__
    assert wire.bodies <= {1, 2, 3, 4}
    return wire, peers[0], found, ended


def wrong(stem: str, peer: Named, found: dict[int, Word], ended: str) -> Iterator[str]:
    """Words that are not the drive's, refusals that it has not given, and words that are not there."""
    for address, word in found.items():
        at = address & 0xFFFF
        true = peer.coil(at) if is_bit(address) else peer.word(at)
        may = f"refused {peer.said[1]}" if at in peer.refuses else "no reply" if at in peer.silent else true
        if word != may:
            yield f"{address:04X}: {word} for {may}"
    if not ended and {*found} != {each.address for each in rows(MAPS[stem])}:
        yield "not all were read"


@pytest.mark.parametrize("line", LINES)
@pytest.mark.parametrize("stem", ["invt_chf", "rockwell_powerflex_525"])
def test_no_word_is_kept_under_a_wrong_name(stem: str, line: str) -> None:
    _, peer, found, ended = saved(stem, line, 0)
    assert list(wrong(stem, peer, found, ended)) == []
    assert bool(ended) <= line.startswith(("doubled", "twins"))


@pytest.mark.long
@pytest.mark.parametrize("line", LINES)
@pytest.mark.parametrize("stem", MAPS)
def test_no_word_is_ever_kept_under_a_wrong_name(stem: str, line: str) -> None:
    for seed in range(1, TIMES + 1):
        _, peer, found, ended = saved(stem, line, seed)
        assert (seed, list(wrong(stem, peer, found, ended))) == (seed, [])
