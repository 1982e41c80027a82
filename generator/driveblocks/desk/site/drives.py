"""`driveblocks parameters`: a drive's words into a file, and two of drives and files beside each other."""

import os
from collections.abc import Callable, Iterator
from contextlib import closing, contextmanager
from dataclasses import dataclass
from pathlib import Path

from rich.console import RenderableType

from driveblocks import console
from driveblocks.desk.clock import RealClock
from driveblocks.desk.exchange import quality
from driveblocks.desk.master import Speech
from driveblocks.desk.port import Port
from driveblocks.desk.run.drives import named, words
from driveblocks.desk.site import adapter
from driveblocks.desk.site.found import Way
from driveblocks.desk.site.reader import LostError, One, Reader, StraysError, heard
from driveblocks.desk.site.register import Row, rows, unread, value
from driveblocks.desk.site.saved import Saved, Word, read, write
from driveblocks.desk.site.session import troubles
from driveblocks.desk.words import opening, time
from driveblocks.maps import catalog
from driveblocks.maps.collection import read as maps_of
from driveblocks.maps.form import address_text
from driveblocks.maps.load import load
from driveblocks.maps.model import Drive
from driveblocks.maps.problem import MapError, Refused
from driveblocks.maps.revision import revision
from driveblocks.meaning.serial import character
from driveblocks.show.layout import table
from structured_text.visible import file_name

HIGHEST_PATIENCE_US = 3_600_000_000
MOST_NAMED, FEW_NAMED = 8, 4
"""Registers in one line."""


@dataclass(frozen=True, kw_only=True)
class Place:
    """Where drives are, in the words of the command line."""

    port: str | None = None
    tcp: str | None = None
    rate: int = 9600
    form: str = "8N1"
    ascii: bool = False
    patience: str = "30s"

    def wrong(self) -> Iterator[str]:
        """What does not go together."""
        yield from adapter.wrong(self.port, self.tcp, self.rate, self.form, who="the drive")
        try:
            time("--patience", self.patience, 0, HIGHEST_PATIENCE_US)
        except Refused as refused:
            yield str(refused)

    @contextmanager
    def _opened(self, clock: RealClock) -> Iterator[Port]:
        """The port, on which nobody speaks. Raises Refused."""
        with opening(str(self.port or self.tcp)):
            made = adapter.at(self.port, self.tcp, clock)(Way(self.rate, self.form.upper()))
        try:
            if heard(made, clock):
                raise Refused(f"{self.port or self.tcp}: somebody else speaks on this line; disconnect the PLC")
            yield made
        finally:
            made.close()

    def take(self, one: One, found: dict[int, Word], keep: Callable[[], None], name: str = "") -> str:
        """Read a drive; `name`: the file of what was found before; how the line was. Raises Refused, LostError."""
        clock, bar, total = RealClock(), console.Bar(console.terminal()), len(rows(one.drive))
        speech = Speech("ascii" if self.ascii else "rtu", 1_000_000 * character(self.form).bits / self.rate)

        def shown(why: str = "") -> None:
            bar.show(len(found), total, f"{one.name}: {why}" if why else one.name)

        def kept() -> None:
            keep()
            shown()

        with self._opened(clock) as opened, closing(bar):
            shown()
            reader = Reader(opened, clock, one, speech, time("--patience", self.patience, 0, HIGHEST_PATIENCE_US))
            others = {each.path.stem: each.drive for each in maps_of(catalog.chosen(())) if each.path.stem != one.stem}
            if why := reader.stranger(others):
                raise Refused(why)
            if why := reader.changed(found):
                raise Refused(f"{name} is of another drive, or it was changed since: {why}; name another file")
            try:
                reader.read(found, kept, shown)
            except StraysError as strays:
                raise StraysError(f"{strays}\n{_line(reader)}") from strays
        return _line(reader)


def _line(reader: Reader) -> str:
    """What the line was like, and what was read twice."""
    figures, again = quality(reader.master.said), sum(map(len, reader.again))
    twice = f"\n{again} registers were read again, since replies came that nobody had asked for" if again else ""
    faults = "".join(f"\n{each.kind.upper()}: {each.text}\n  look at: {each.look}" for each in troubles(figures))
    return f"the line: {figures}; {figures.verdict}{twice}{faults}"


def drive(word: str) -> One:
    """The drive that a word names. Raises Refused."""
    try:
        (one,) = named(words([word])[:1] or words(["?"]), _map)
    except (catalog.UnknownDrive, MapError) as error:
        raise Refused(str(error)) from None
    return One(one.path.stem, one.drive, one.unit)


def _map(name: str) -> tuple[Path, Drive]:
    path = catalog.resolve(name)
    return path, load(path)


def save(word: str, path: Path, place: Place) -> tuple[str, bool]:
    """Read a drive into a file, from where it ended before; what was done, and whether every register was read.

    Raises Refused, LostError, OSError.
    """
    wrong, ready = list(place.wrong()), list[tuple[One, dict[int, Word]]]()
    try:
        named_one = drive(word)
        ready.append((named_one, _begun(path, named_one)))
    except Refused as refused:
        wrong.append(str(refused))
    if wrong:
        raise Refused("\n".join(wrong))
    ((one, found),) = ready
    every = len(rows(one.drive))
    try:
        line = place.take(one, found, lambda: write(path, one.stem, one.drive, one.unit, found), file_name(path))
    except (LostError, KeyboardInterrupt) as error:
        kept = f"{file_name(path)} has {len(found)} of {every} registers; the same command reads the rest"
        raise LostError(f"{str(error) or 'Ctrl-C'}; {kept if found else 'nothing was written'}") from error
    silent = sum(isinstance(each, str) for each in found.values())
    without = f", {silent} of them not given by the drive" if silent else ""
    said = f"{one.name}: {every} registers{without}, in {file_name(path)}"
    return "\n".join((said, _listed(one.drive), *unread(one.drive), line)), not silent


def _listed(drive: Drive) -> str:
    """How many parameters there are in the map."""
    count = sum(each.set for each in rows(drive))
    return f"the map lists {count} parameters of this drive; what else it may have is neither read nor compared"


def _begun(path: Path, one: One) -> dict[int, Word]:
    """What a file has already. Raises Refused where it is complete, or another drive's."""
    if not os.path.lexists(path):
        return {}
    there = read(path)
    if (there.stem, there.unit) != (one.stem, one.unit):
        raise Refused(f"{there.where} is of {there.stem} at unit {there.unit}; name another file")
    if there.revision != f"{revision(one.drive):08X}":
        raise Refused(f"{there.where} is of another revision of the map; name another file")
    if len(there.words) == len(rows(one.drive)):
        raise Refused(f"{there.where} is complete; name another file")
    return there.words


def compare(
    sides: tuple[str, str], place: Place, own: str | None, *, everything: bool
) -> tuple[list[RenderableType], bool]:
    """The differences of two sides, each a file or a drive, and whether there may be any. Raises Refused, LostError.

    `own` is the map of two files, where it is not shipped.
    """
    files = [_is_file(each) for each in sides]
    wrong = [] if all(files) else list(place.wrong())
    found: list[Saved | One] = []
    for word, is_file in zip(sides, files, strict=True):
        try:
            found.append(read(Path(word)) if is_file else drive(word))
        except Refused as refused:
            wrong.append(str(refused))
    if len(found) == 2 and found[0].stem != found[1].stem:
        wrong.append(f"{sides[0]} is of {found[0].stem}, {sides[1]} of {found[1].stem}: compare drives of one family")
    if wrong:
        raise Refused("\n".join(wrong))
    model = next((each.drive for each in found if isinstance(each, One)), None) or drive(own or found[0].stem).drive
    if not everything and not any(each.set for each in rows(model)):
        raise Refused(f"the map of {model.prefix} names no parameter that may be read; write --all")
    both = [each if isinstance(each, Saved) else _taken(each, place) for each in found]
    return _differences(model, both[0], both[1], everything=everything)


def _is_file(word: str) -> bool:
    return word.lower().endswith(".csv") or (os.path.isfile(word) and not catalog.is_path(word))  # noqa: PTH113 - Path.is_file raises for long names


def _taken(one: One, place: Place) -> Saved:
    found: dict[int, Word] = {}
    console.write(place.take(one, found, lambda: None))
    return Saved(one.name, one.stem, one.unit, found, f"{revision(one.drive):08X}")


def _differences(model: Drive, left: Saved, right: Saved, *, everything: bool) -> tuple[list[RenderableType], bool]:
    """The rows that differ, in the order of the manual; what was not read on both sides is counted."""
    compared = [each for each in rows(model) if everything or each.set]
    both = [each for each in compared if each.address in left.words and each.address in right.words]
    both = [each for each in both if any(isinstance(one.words[each.address], int) for one in (left, right))]
    differing = [each for each in both if left.words[each.address] != right.words[each.address]]
    heads = [Path(each.where).name for each in (left, right)]
    heads = [left.where, right.where] if heads[0] == heads[1] else heads
    made = table("id", "register", "name", *heads, "default", wide=("name", *heads))
    for row in differing:
        shown = [_shown(row, each) for each in (left, right)]
        made.add_row(row.id, address_text(row.address), row.name, *shown, row.default)
    what = "registers" if everything else "parameters"
    lines = [f"{len(differing)} of {len(both)} {what} differ" if differing else f"{len(both)} {what} are equal"]
    lines[0] += f", of {len(compared)} in the map"
    if missing := len(both) < len(compared):
        left_out = [address_text(each.address) for each in compared if each not in both]
        which = ", ".join(left_out[:FEW_NAMED]) + (", ..." if len(left_out) > FEW_NAMED else "")
        lines.append(f"{len(left_out)} not compared, for want of a word: {which}")
    if {left.revision, right.revision} != {f"{revision(model):08X}"}:
        lines.append("the revisions of the maps differ: names and units are those of the map as it is now")
    if strange := sorted(_unlisted(model, left.words, right.words)):
        which = ", ".join(map(address_text, strange[:MOST_NAMED])) + (", ..." if len(strange) > MOST_NAMED else "")
        lines.append(f"{len(strange)} that the map does not list now differ, or were not read on both sides: {which}")
    return [*([made] if differing else []), "\n".join(lines)], missing or bool(differing or strange)


def _unlisted(model: Drive, left: dict[int, Word], right: dict[int, Word]) -> Iterator[int]:
    """What only another version of the map lists, and is not known to be equal."""
    for address in (left.keys() | right.keys()) - {each.address for each in rows(model)}:
        if left.get(address) != right.get(address) or not isinstance(left[address], int):
            yield address


def _shown(row: Row, side: Saved) -> str:
    word = side.words[row.address]
    known = {address: each for address, each in side.words.items() if isinstance(each, int)}
    return " ".join(filter(None, value(row, word, known))) if isinstance(word, int) else word
