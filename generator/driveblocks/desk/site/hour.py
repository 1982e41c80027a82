"""`driveblocks commission` and `driveblocks site`: from the words of the command line to what is kept and shown."""

import datetime
import sys
from collections.abc import Callable, Collection, Iterator, Mapping
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path

from driveblocks import console
from driveblocks.desk.clock import RealClock
from driveblocks.desk.port import reason
from driveblocks.desk.site import adapter, asked, kept, report, steps
from driveblocks.desk.site.found import Asker, Found, Line
from driveblocks.desk.site.line import figures
from driveblocks.desk.site.session import SKIPPABLE, Wish, commission
from driveblocks.desk.words import opening
from driveblocks.maps import catalog
from driveblocks.maps.collection import read as maps_of
from driveblocks.maps.load import named
from driveblocks.maps.model import Drive
from driveblocks.maps.problem import MapError, Refused
from driveblocks.maps.revision import revision

Steps = Callable[[Line, Asker, Wish, Callable[[Found], None]], Found]
"""How a drive is commissioned on a line."""


@dataclass(frozen=True, kw_only=True)
class Words:
    map: str
    port: str | None = None
    tcp: str | None = None
    rate: int | None = None
    form: str | None = None
    mode: str | None = None
    unit: int | None = None
    label: str = "Drive1"
    who: str = ""
    skip: Collection[str] = ()
    file: Path = Path("site.yaml")
    replace: bool = False

    def wrong(self) -> Iterator[str]:
        yield from adapter.wrong(self.port, self.tcp, self.rate, self.form, who="the drive")
        if self.unit is not None and not 1 <= self.unit <= 255:
            yield f"--unit {self.unit} is out of range; write 1 to 255"
        if not kept.LABEL.fullmatch(self.label):
            yield f"--label {self.label} is no label; write up to 24 letters and digits, a letter first"
        if self.label in kept.PLANT:
            yield f"--label {self.label} is a key of a plant; write another"
        for each in self.skip:
            if each not in SKIPPABLE:
                yield f"--skip {each} cannot be; write one of {', '.join(SKIPPABLE)}"


@dataclass
class Shelf:
    """The file that findings are kept in; `wrong`: why the last of them could not be.

    `replaces`: it has older ones of this label, which are copied before the first are written; `copy`: where to.
    """

    file: Path
    about: kept.About
    wrong: str = ""
    replaces: bool = False
    copy: Path | None = None

    def keep(self, found: Found) -> None:
        """Write them; where that is impossible, the hour goes on."""
        try:
            if self.replaces and self.copy is None:
                self.copy = kept.copied(self.file)
            kept.write(self.file, self.about, found)
            self.wrong = ""
        except (OSError, MapError) as error:
            self.wrong = reason(error)


def run(words: Words, read: Callable[[str], str], steps_at: Steps = commission) -> Found:
    """Go through the steps at a real port. Raises Refused."""
    wrong, stem, drive = list(words.wrong()), "", None
    try:
        path, drive = named(words.map)
        stem = path.stem
    except Refused as error:
        wrong.append(str(error))
    try:
        before = kept.read(words.file) if words.file.exists() else {}
        kept.try_out(words.file)
    except MapError as error:
        wrong, before = [*wrong, str(error)], {}
    except OSError as error:
        wrong, before = [*wrong, f"{words.file}: {reason(error)}"], {}
    wrong += [f"{words.file}: {each}" for each in _taken(before, words)]
    if wrong or drive is None:
        raise Refused("\n".join(wrong))
    date = f"{datetime.datetime.now():%Y-%m-%d %H:%M}"
    about = kept.About(words.label, stem, f"{revision(drive):08X}", date, words.who)
    shelf = Shelf(words.file, about, replaces=words.label in before)
    form = words.form.upper() if words.form else None
    # a server in between has a rate and a format of its own
    fixed = (words.rate or 9600, form or "8N1") if words.tcp else (words.rate, form)
    with closing(console.Bar(console.terminal())) as bar:
        bar.show(0, 1, "the maps")
        others = {each.path.stem: each.drive for each in maps_of(catalog.chosen(())) if each.path.stem != stem}
    wish = Wish(drive, others, *fixed, words.mode, words.unit, frozenset(words.skip))
    clock = RealClock()
    line = adapter.PortLine(adapter.at(words.port, words.tcp, clock), clock)
    person = adapter.Person(read)
    try:
        with opening(str(words.port or words.tcp)):
            line.tune(wish.ways()[0])  # where it cannot, another way may be the port's
        found = steps_at(line, person, wish, shelf.keep)
    finally:
        line.close()
    told(person, words, drive, found, shelf)
    return found


def _taken(before: Mapping[str, kept.Kept], words: Words) -> Iterator[str]:
    """Why a label cannot be that of these findings."""
    for label, one in before.items():
        if label == words.label and not words.replace:
            yield f"{label} is kept there, of {one.date}; name another --label, or add --replace"
        if label != words.label and label.lower() == words.label.lower():
            yield f"{words.label} and {label} are one name in a PLC; name another --label"


def _weighed(person: Asker, found: Found) -> None:
    """What was wrong, and what the line and the drive have shown."""
    for fault in found.faults:
        person.say(f"{fault.kind.upper()}: {fault.text}\n  look at: {fault.look}")
    if found.quality is not None:
        person.say(f"The line: {found.quality}; {found.quality.verdict}")
    if found.evidence:
        person.say("\n".join(("What speaks for the family, or against it:", *(f"- {each}" for each in found.evidence))))


def told(person: Asker, words: Words, drive: Drive, found: Found, shelf: Shelf) -> None:
    """The end: what was wrong, what was kept, and what is next."""
    _weighed(person, found)
    if found.measured is not None and found.way is not None:
        person.say(f"Longest reply {found.measured.longest_ms} ms; on a line with this drive alone:")
        name = f"{words.map}@{found.unit}"
        rate, reply = found.way.rate, f"{min(500, max(1, found.measured.longest_ms))}ms"
        typed = asked.Words(line=(name,), rate=rate, form=found.way.form, ascii=found.way.mode == "ascii", reply=reply)
        line = asked.line(typed)
        for each in report.tables([figures(line, rate)]):
            person.say(each)
    if found.family:
        person.say("\nOnly a run by the bus shows the rest: `driveblocks run --allow-run`, motor uncoupled,")
        person.say("hard stop in hand, low speed:")
        for what, do in steps.script(drive):
            person.say(f"- {what}: {do}")
        person.say("")
    if found.skipped:
        person.say(f"Skipped: {', '.join(found.skipped)}")
    if shelf.copy is not None:
        person.say(f"What {words.file} had before, {words.label} among it, is in {shelf.copy}")
    where = f"{words.file}, label {words.label}" if found.family and not shelf.wrong else "nothing was kept"
    if shelf.wrong:
        found.ended = found.ended or f"{words.file} could not be written: {shelf.wrong}"
        person.say("This would be in the file:")
        sys.stdout.write(kept.text(shelf.about, found))  # YAML is not wrapped
    person.say(f"{'Ended early: ' + found.ended if found.ended else 'Finished'}; {where}")
