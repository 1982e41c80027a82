"""A first plant file: with comments that say what to replace, or made of what a person answers."""

import json
from collections.abc import Callable, Iterator
from importlib.resources import files

from driveblocks.desk.run.drives import open_scales
from driveblocks.desk.site.kept import LABEL
from driveblocks.maps.load import named
from driveblocks.maps.model import Drive
from driveblocks.maps.problem import Refused
from driveblocks.maps.revision import checked
from driveblocks.maps.trust import second_hand
from driveblocks.meaning.reference import reference
from driveblocks.meaning.serial import serial

Ask = Callable[[str, str], str]
"""A question and what Enter means, to the answer."""
Say = Callable[[str], None]
_HINT = "up to 22 letters and digits, a letter first"
NAME = "Pumping station  # the program is called after it: PumpingStation"
"""What the commented file calls its plant."""


def skeleton(name: str) -> str:
    """The commented file, with another name."""
    return example().replace(NAME, json.dumps(name, ensure_ascii=False), 1)


def example() -> str:
    """The commented file as it is."""
    return (files(__package__) / "skeleton.yaml").read_text(encoding="utf-8")


def asked(name: str, ask: Ask, say: Say) -> str:
    """The file of what a person answers: lines with their drives, one group of all, and its buttons."""
    drives: list[str] = []
    lines: list[str] = []
    while True:
        line = _name("Line, Enter when there is no other", ask, say, "A" if not lines else "")
        if not line:
            break
        port = ask(f"  Port of the PLC for {line}", str(len(lines) + 1))
        rate, form = ask("  Bit rate; 0: as delivered", "0"), ask("  Format, as 8N1; 0: as delivered", "0")
        ways = "".join(f", {key}: {_quoted(each)}" for key, each in (("rate", rate), ("form", form)) if each != "0")
        lines.append(f"  {line}: {{port: {json.dumps(port)}{ways}}}\n")
        drives += _drives(line, ask, say)
    tags = [each.split(":", 1)[0].strip() for each in drives]
    return (
        f"plant: {_quoted(name)}\nscan_ms: {ask('Time between two scans, ms', '10')}\nlines:\n{''.join(lines)}"
        f"drives:\n{''.join(drives)}{_group(tags, ask)}"
    )


def _drives(line: str, ask: Ask, say: Say) -> Iterator[str]:
    unit = 1
    while tag := _name(f"  Drive on line {line}: its tag, Enter when there is no other", ask, say, ""):
        word, drive = _family(ask, say)
        number = ask("    Unit address", str(unit))
        unit = int(number) + 1 if number.isdecimal() else unit
        facts = [f"drive: {_quoted(word)}", f"line: {line}", f"unit: {number}", *_limits(drive, ask)]
        yield f"  {tag}:\n" + "".join(f"    {each}\n" for each in facts)


def _limits(drive: Drive, ask: Ask) -> Iterator[str]:
    """What a start of the drive needs."""
    if text := ask("    What it is, for people", ""):
        yield f"text: {_quoted(text)}"
    yield f"maximum_hz: {ask('    Highest speed that the machine takes, Hz', '50')}"
    if reference(drive).percent:
        yield f"full_scale_hz: {ask(f'    {reference(drive).maximum} of the drive, Hz', '50')}"
    ramp = ask("    Ramp down, s", "10")
    yield f"ramp_down_s: {ramp}"
    usual = str(int(ramp) * 1000 + 5000) if ramp.isdecimal() else "15000"
    yield f"stop_within_ms: {ask('    A stop is overdue after, ms', usual)}"
    if "ReferenceScale" in open_scales(drive) and (scale := ask("    Counts per Hz; Enter: not known yet", "")):
        yield f"settings: {{ReferenceScale: {scale}}}"
    if reference(drive).in_rpm:
        yield f"settings: {{PolePairs: {ask('    Pole pairs of the motor', '2')}}}"
    if second_hand(drive) and ask("    Has somebody checked its map with the manual? yes or no", "no") == "yes":
        yield f"manual_checked: {checked(drive)}"


def _family(ask: Ask, say: Say) -> tuple[str, Drive]:
    while True:
        word = ask("    Family, a part of its name, or the path of a map", "")
        try:
            path, drive = named(word)
        except Refused as refused:
            say(f"    {refused}")
            continue
        line = serial(drive)
        say(f"    {path.stem}: {drive.family.en}, {line.rate} bit/s {line.character.form} as delivered")
        return word, drive


def _group(tags: list[str], ask: Ask) -> str:
    """One group of all drives, where there are several."""
    if len(tags) < 2:
        return "".join(f"buttons:\n  Start: {{start: {tag}}}\n  Stop: {{stop: {tag}}}\n" for tag in tags)
    kind = ask(f"{', '.join(tags)}: alone, together, sequence or duty_standby", "alone")
    if kind not in ("together", "sequence", "duty_standby"):
        return ""
    return (
        f"groups:\n  Group: {{kind: {kind}, drives: [{', '.join(tags)}]}}\n"
        "buttons:\n  StartGroup: {start: Group}\n  StopGroup: {stop: Group}\n  ResetGroup: {reset: Group}\n"
    )


def _name(question: str, ask: Ask, say: Say, usual: str) -> str:
    while (name := ask(question, usual)) and not LABEL.fullmatch(name):
        say(f"  {name} is no name; write {_HINT}")
    return name


def _quoted(text: str) -> str:
    """A text as YAML, in quotes; a number without."""
    return text if text.isdecimal() and text.isascii() else json.dumps(text, ensure_ascii=False)
