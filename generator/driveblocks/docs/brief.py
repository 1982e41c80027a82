"""What a technician asks first: the answer in a few words, and the section of the page that has all of it."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from driveblocks.docs import recipe
from driveblocks.maps import references
from driveblocks.maps.form import address_text
from driveblocks.maps.model import Absence, Drive
from driveblocks.meaning import conduct
from driveblocks.meaning.advice import advice
from driveblocks.meaning.measure import PINS, Measure, measures
from driveblocks.meaning.plug import plug
from driveblocks.meaning.reference import reference
from driveblocks.meaning.setting import Setting, in_order
from driveblocks.meaning.status import status
from driveblocks.meaning.words import words


@dataclass(frozen=True)
class Question:
    """One of them; texts of the map are not yet Markdown."""

    asks: str
    answer: str
    section: str

    @property
    def anchor(self) -> str:
        """Of its section, as the pages' readers make them of a heading."""
        return self.section.lower().replace(",", "").replace(" ", "-")


def questions(drive: Drive, word: str) -> tuple[Question, ...]:
    """All six. `word` is what the map is called in a command."""
    return (
        Question("Which wire goes on A, which on B?", _wires(drive), "Wiring"),
        Question("What do I set at the keypad?", _set(drive), "Keypad"),
        Question("What happens when the cable is cut?", conduct.delivered(drive), "What the drive does by itself"),
        Question("How do I reset a fault?", _reset(drive), "Start, stop, reset"),
        Question("What does a fault mean, and what helps?", _faults(drive, word), "What a fault means"),
        Question("How is a speed scaled?", _scaled(drive), "How a speed is scaled"),
    )


def _wires(drive: Drive) -> str:
    own = plug(drive)
    plus, minus = own.at("positive"), own.at("negative")
    if not plus and not minus:
        return "not known: " + ("; ".join(find_out for _, find_out in own.gaps) or "look at the drive's terminals")
    return f"+ (D1, B of the standard) on {plus or 'not known'}; - (D0, A of the standard) on {minus or 'not known'}"


def _set(drive: Drive) -> str:
    """What has to be one value, then what has to fit the line."""
    asked = [one for one in in_order(drive) if one.needed]
    fixed = [f"{one.keypad.code} = {_shown(one)}" for one in asked if one.needed and one.needed.right]
    chosen = [one.keypad.code for one in asked if one.needed and not one.needed.right]
    said = [", ".join(fixed)] if fixed else []
    said += [f"to choose: {', '.join(chosen)}"] if chosen else []
    return "; ".join(said) or "the map names no setting"


def _shown(one: Setting) -> str:
    right = one.needed.right if one.needed else ()
    return " or ".join(one.keypad.shown(each) for each in right)


def _reset(drive: Drive) -> str:
    if "fault_reset" not in words(drive).named:
        how = next((find_out for _, find_out in unreset(drive.absent)), "see the drive's own manual")
        return f"no command for it over the bus is known: {how}"
    off = any(one.power_cycle for one in drive.faults.codes)
    return "remove the cause, then a rising FaultReset" + ("; some only by switching it off and on" if off else "")


def _faults(drive: Drive, word: str) -> str:
    known = advice(drive)
    if not known:
        return "the map has no list of faults: see the drive's own manual"
    told = sum(bool(one.remedies) for one in known)
    return f"{len(known)} codes, {told or 'none'} with what to do; of one: driveblocks fault {word} CODE"


def _scaled(drive: Drive) -> str:
    known = reference(drive)
    if not known.scaled:
        return f"not known for {address_text(known.register)}: find it out, then set Settings.ReferenceScale"
    asked = recipe.speed(drive)
    return f"{recipe.HERTZ} Hz is {asked.value} in {address_text(asked.register)}{_with(drive)}"


def _with(drive: Drive) -> str:
    """What the example holds under."""
    known = reference(drive)
    if known.part:
        return f", where {known.maximum} is {recipe.FULL_HZ:g} Hz"
    return ", with one pair of poles" if known.in_rpm else ""


def speeds(drive: Drive) -> Iterator[tuple[str, str]]:
    """How a speed is scaled, line by line."""
    known, asked = reference(drive), recipe.speed(drive)
    name = next((row.name for _, row in drive.registers() if known.register in row.address), "")
    place = f"{address_text(known.register)}{f' ({name})' if name else ''}"
    yield "written to", place + (", in two words" if known.pair else "")
    yield "counts", _counts(drive)
    if known.scaled:
        yield f"{recipe.HERTZ} Hz", f"is written as {asked.value}{_with(drive)}"
    for each in status(drive).verify:
        yield "only while", str(each)
    if known.ranged:
        yield "highest that the drive takes", f"{known.highest}"
    for one in measures(drive):
        if one.name == "output_frequency":
            yield "read back", f"{address_text(one.register)}, {_back(one)}"


def _back(one: Measure) -> str:
    """What a count is that shows the speed."""
    factors = one.quantity.factors
    held = (f"{each.value} Hz for each count" + (f" while {each.when}" if each.when else "") for each in factors)
    return " or ".join(held) or f"whose scale the manual does not give: set Settings.{PINS[one.name].setting}"


def _counts(drive: Drive) -> str:
    known = reference(drive)
    if not known.scaled:
        told = references.of(known.register)
        gaps = [one.find_out for one in drive.absent if told in one.about and "scale" in one.what]
        return ". To find out: ".join(("the manual gives no scale, so Settings.ReferenceScale has to be set", *gaps))
    if known.part:
        return f"{float(known.ratio):g} for 100 %, which is {known.maximum} of the drive: set FullScaleHz to it"
    if known.in_rpm:
        return f"r/min: {float(known.ratio):g} for each hertz, divided by PolePairs"
    return f"{float(known.ratio):g} for each hertz"


def unset(drive: Drive) -> Iterator[tuple[str, str]]:
    """What the map does not know of the line and of the settings, pins aside, and how a person finds it out."""
    for each in (one for one in drive.absent if "pins" not in one.about):
        if any(one == "serial" or one.startswith("setting ") for one in each.about):
            yield each.what, each.find_out


def unreset(gaps: Iterable[Absence]) -> Iterator[tuple[str, str]]:
    """What of some gaps is about a reset, and how a person finds it out."""
    for each in gaps:
        if "reset" in each.what:
            yield each.what, each.find_out
