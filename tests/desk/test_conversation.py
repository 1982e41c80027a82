"""What is said of a drive over lines that delay, double, damage and mix up: no word and no verdict is another's."""

from collections.abc import Iterator
from pathlib import Path
from random import Random

import pytest
from click.testing import CliRunner
from tests.desk.peers import CHAR_US, FATES, TWINS, Fate, Line, Named, served
from tests.desk.run.desk import maps

from driveblocks.cli import app
from driveblocks.desk.master import Speech
from driveblocks.desk.site.reader import LostError, One, Reader
from driveblocks.desk.site.register import rows
from driveblocks.desk.site.saved import Word, read
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


def weighed(stem: str, line: str, seed: int) -> str:
    """What is said of a drive's family before it is read: another one, or why it cannot be judged."""
    peers, fate = units(stem, line, seed)
    wire = Line(peers, fate, seed)
    reader = Reader(wire, wire.clock, One(stem, MAPS[stem], 1), Speech("rtu", CHAR_US), 30_000_000)
    try:
        return reader.stranger({name: each for name, each in MAPS.items() if name != stem})
    except LostError as error:
        return type(error).__name__


@pytest.mark.parametrize("line", [each for each in LINES if each.startswith(("doubled", "twins"))])
def test_no_family_is_named_where_two_replies_come(line: str) -> None:
    assert weighed("rockwell_powerflex_525", line, 0) in ("", "StraysError")


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


def at_once(line: str, seed: int, path: Path) -> tuple[int, dict[int, Word], str]:
    """`parameters save` of a JSCC in real time: its exit status, the words of the file, what it said."""
    peers, fate = units("jscc", line, seed)
    for each in peers:
        each.given = {0x2000: 0, 0x2001: 4, 0x3000: 0}  # a status that its manual lists
        each.only = frozenset(each.address for each in rows(MAPS["jscc"]))
    with served(peers, fate, seed) as place:
        got = CliRunner().invoke(app, ["parameters", "save", "jscc", str(path), "--tcp", place, "--patience", "5s"])
    found = read(path).words if path.exists() else {}
    bad = list(wrong("jscc", peers[0], found, "partly"))
    assert not bad, (line, seed, got.exit_code, bad[:3], got.output[-500:])
    return got.exit_code, found, got.output


@pytest.mark.thorough
@pytest.mark.parametrize("line", ["late 35", "once 340", "flipped 5", "doubled 55", "twins 55"])
def test_the_command_keeps_no_word_under_a_wrong_name(line: str, tmp_path: Path) -> None:
    status, found, said = at_once(line, 0, tmp_path / "words.csv")
    whole = line.startswith(("late", "once", "flipped"))
    assert (status == 0, len(found) == len(rows(MAPS["jscc"]))) == (whole, whole), said
    assert ("the line: " in said) or ("two units with one address" in said)
