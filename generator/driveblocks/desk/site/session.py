"""The first hour on site, step by step: what is skipped is said, and what was found is kept after each step."""

from collections.abc import Callable, Collection, Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass, field, replace

from driveblocks.desk.exchange import Quality, quality
from driveblocks.desk.master import Reply
from driveblocks.desk.site import hunt, steps
from driveblocks.desk.site.family import judge
from driveblocks.desk.site.found import Asker, Fault, Found, Line, Trouble, Way
from driveblocks.desk.site.talk import LOOK, EndedError, Talk, ended
from driveblocks.maps.model import Drive
from driveblocks.meaning.serial import serial
from driveblocks.meaning.status import status

STEPS = ("quiet", "find", "keypad", "measure", "gaps")
SKIPPABLE = ("plate", "keypad", "measure", "gaps")
WORD = "alone"
"""What a person types when the PLC is disconnected and the drive is alone."""


LINE: dict[str, tuple[Trouble, str]] = {
    "damaged": ("damaged", "the line spoils {}"),
    "late": ("slow", "replies came late to {}"),
    "doubled": ("two", "replies came twice, or to what nobody had asked, in {}"),
    "silent": ("silent", "no reply came to {}"),
}
"""What each figure of a line is called where it is too large."""


@dataclass(frozen=True)
class Wish:
    """What is looked for, and what a person has named or passed over on the command line."""

    drive: Drive
    others: Mapping[str, Drive] = field(default_factory=dict)
    """Maps that a drive of another family might be of, by name."""
    rate: int | None = None
    form: str | None = None
    mode: str | None = None
    unit: int | None = None
    skip: Collection[str] = field(default_factory=frozenset)
    quiet_us: int = hunt.QUIET_US
    reads: int = steps.READS
    """From which the reply time comes."""

    def ways(self) -> list[Way]:
        """How the line is tried."""
        return hunt.ways(self.drive, self.rate, self.form, self.mode)


def commission(line: Line, asker: Asker, wish: Wish, keep: Callable[[Found], None]) -> Found:
    """All steps. It ends with what was found, and why if it ended early.

    `keep` is called as soon as a drive was recognised, after each step and each answer, and at the end.
    """
    found = Found(skipped=[each for each in SKIPPABLE if each in wish.skip])
    known, talk, before = False, None, None
    try:
        talk = _found(line, asker, wish, found)
        before = quality(talk.line.master.said)
        _recognise(talk, found, wish.others)
        known = True
        found.done.append("find")
        _rest(talk, asker, wish, found, lambda: keep(_weighed(talk, found, before)))
    except EndedError as end:
        found.faults.append(end.fault)
        found.ended = end.fault.text
    except KeyboardInterrupt:
        found.ended = "Ctrl-C"
    except EOFError:
        found.ended = "the terminal was closed"
    except OSError as error:
        found.faults.append(Fault("lost", f"the port does not work any more: {error.strerror or error}", LOOK["lost"]))
        found.ended = found.faults[-1].text
    if known and before is not None and talk is not None:
        _weighed(talk, found, before).faults.extend(troubles(found.quality or Quality()))
        keep(found)
    return found


def _weighed(talk: Talk, found: Found, before: Quality) -> Found:
    """With the line's quality since the drive was found."""
    with suppress(OSError):
        found.quality = quality(talk.line.master.said) - before
    return found


def troubles(figures: Quality) -> Iterator[Fault]:
    """What the figures of a line say is wrong with it, and what to look at."""
    for name in figures.troubles:
        share = f"{getattr(figures, name)} of {figures.exchanges} exchanges ({100 * figures.share(name):.1f} %)"
        kind, text = LINE[name]
        yield Fault(kind, f"{text.format(share)}", LOOK[kind])


def _recognise(talk: Talk, found: Found, others: Mapping[str, Drive]) -> None:
    """Whether the drive is of the map's family. Raises EndedError where it is not."""

    def ask(drive: Drive, body: bytes) -> Reply:
        try:
            return replace(talk, drive=drive).patient(body)
        except EndedError as end:
            if end.fault.kind == "lost":
                return Reply("silent")
            raise

    judged = judge(ask, talk.drive, talk.unit, others)
    found.evidence = judged.evidence
    if judged.family == "other":
        talk.steady(hunt.first_read(talk.drive))  # a unit that has gone is of no other family
        raise ended("identity" if status(talk.drive).identity.patterns else "family", judged.why)
    if judged.refused:
        said = f"unit {talk.unit} refuses what the map lists: {judged.refused}"
        found.faults.append(Fault("refused", said, LOOK["refused"]))
    found.family = judged.family


def _found(line: Line, asker: Asker, wish: Wish, found: Found) -> Talk:
    """Steps 1 and 2. Raises EndedError."""
    every, unit = wish.ways(), serial(wish.drive)
    if unit.silent:
        asker.say(f"As delivered this drive answers nobody: set {unit.setting} to an address first.")
    asker.say("Step 1: listening for 60 s; nothing is sent.")
    if fault := hunt.quiet(line, every, asker, wish.quiet_us):
        raise EndedError(fault)
    asker.say("No byte came. A master may be silent for longer.")
    if asker.ask("alone", f"PLC disconnected, and this drive alone on the line? Type {WORD}:").lower() != WORD:
        raise EndedError(Fault("bound", f"`{WORD}` was not typed; nothing was sent", "start again when it is so"))
    if fault := hunt.while_typed(line, every):
        raise EndedError(fault)
    found.done.append("quiet")
    asker.say("Step 2: looking for the drive, by reads alone.")
    return hunt.find(Talk(line, wish.drive, every[0]), every, hunt.units(wish.drive, wish.unit), asker, found)


def _rest(talk: Talk, asker: Asker, wish: Wish, found: Found, keep: Callable[[], None]) -> None:
    """What is asked and read of a drive that was recognised. Raises EndedError."""
    asker.say(f"Found: unit {talk.unit} at {talk.way}.")
    if found.family == "fits":
        asker.say(f"It answers as {talk.drive.prefix} would. Its map has no identity: compare the plate yourself.")
    if found.family == "unknown":
        asker.say("It answers every address, so its family could not be found out: compare the plate yourself.")
    keep()
    if "plate" not in wish.skip:
        found.plate = asker.ask("plate", "Type, rating and firmware, from the plate and the keypad (Enter skips):")
        if not found.plate:
            found.skipped.append("plate")
    if "keypad" not in wish.skip:
        asker.say("Step 3: the keypad.")
        steps.keypad(talk, asker, found)
        found.done.append("keypad")
        keep()
    if "measure" not in wish.skip:
        asker.say("Step 4: measuring, by reads alone.")
        found.measured = steps.measure(talk, asker, wish.reads)
        found.done.append("measure")
        keep()
    if "gaps" not in wish.skip:
        asker.say(
            "Step 5: what the manual does not say. Enter skips a question; nothing here runs the motor by the bus."
        )
        steps.gaps(talk, asker, found, keep)
        found.done.append("gaps")
