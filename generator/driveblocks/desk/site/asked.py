"""A line as the command line asks for it: a program or named drives, and what is to be other than they say."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from driveblocks.desk.run import probe, source
from driveblocks.desk.run.controller import LineEnd
from driveblocks.desk.run.drives import Named
from driveblocks.desk.run.drives import named as drives_of
from driveblocks.desk.run.drives import words as words_of
from driveblocks.desk.run.watchdog import FIRST_US
from driveblocks.desk.site.line import LEARNED_AFTER, PINS, SLOT, Line, Unit, number
from driveblocks.desk.words import time, wrong_speech
from driveblocks.maps import catalog
from driveblocks.maps.collection import Source
from driveblocks.maps.model import Drive
from driveblocks.maps.plan import writes_by
from driveblocks.maps.problem import Refused
from driveblocks.meaning.polls import Poll, polls
from driveblocks.meaning.serial import USUAL_BITS, USUAL_RATE, character, delivered, serial
from driveblocks.meaning.words import words as commands
from structured_text import files
from structured_text.visible import file_name

MOST_UNITS = 32
USUAL_REPLY_MS = 20
"""What a drive takes until its reply begins, where nobody and no map says more."""
TIMES = {
    "scan": ("--scan", 1, 1000), "max_scan": ("--max-scan", 1, 60_000), "port_late": ("--port-late", 0, 10_000),
    "reply": ("--reply", 1, 500), "watchdog": ("--watchdog", 1, 60_000), "within": ("--stop-within", 1, 60_000),
}  # fmt: skip
"""Times that may be given: the option, and how long in ms, from ... to."""


@dataclass(frozen=True, kw_only=True)
class Words:
    line: tuple[str, ...]
    maps: tuple[str, ...] = ()
    name: str | None = None
    device: tuple[int, ...] = ()
    rate: int | None = None
    form: str | None = None
    ascii: bool = False
    scan: str = "10ms"
    max_scan: str | None = None
    keeps_silence: bool = False
    port_late: str | None = None
    reply: str | None = None
    watchdog: str | None = None
    stop_within: str | None = None


@dataclass(frozen=True)
class Typed:
    """A drive without a program: the name of its block, and what is set of its `VFD_Settings`."""

    name: str
    drive: Drive
    unit: int
    settings: Mapping[str, object]


@dataclass(frozen=True)
class Device:
    """A meter or a sensor beside the drives: how many registers of it are read, and how often."""

    unit: int
    registers: int
    every_ms: int = 0


@dataclass(frozen=True, kw_only=True)
class Sketch:
    """A line without a program; `max_scan` in ms, 0: two scans."""

    drives: Sequence[Typed]
    devices: Sequence[Device]
    rate: int
    bits: int
    ascii: bool = False
    max_scan: int = 0


def line(words: Words) -> Line:
    """The line. Raises Refused with everything that is wrong with the words, or with the program."""
    wrong: list[str] = []
    times = {
        name: _ms(option, getattr(words, option.removeprefix("--").replace("-", "_")), least, most, wrong)
        for name, (option, least, most) in TIMES.items()
    }
    scan, most = times["scan"], times["max_scan"]
    if scan and most and most < scan:
        wrong.append(f"--max-scan {words.max_scan} is shorter than --scan {words.scan}")
    wrong += _wrong_words(words)
    name, text, maps = _program(words, times["watchdog"] or 0, wrong)
    if wrong:
        raise Refused("\n".join(wrong))
    found = _lines(words, probe.compiled(name, text, maps, words.name), times)
    if len(found) > 1:
        raise Refused(f"{len(found)} lines ({', '.join(found)}): the figures are those of one; keep one line in {name}")
    (made,) = found.values()
    if mistakes := list(_wrong_line(made, words)):
        raise Refused("\n".join(mistakes))
    return made


def of_text(name: str, text: str, maps: Sequence[Source], scan: int) -> dict[str, Line]:
    """The lines of a program by their instances, as it says them itself; `scan` in ms. Raises Refused."""
    return _lines(Words(line=(name,)), probe.compiled(name, text, maps), {**dict.fromkeys(TIMES), "scan": scan})


def _ms(option: str, text: str | None, least: int, most: int, wrong: list[str]) -> int | None:
    """A time in ms; None where it is not given, or wrong, which is added to `wrong`."""
    try:
        return None if text is None else time(option, text, 1000 * least, 1000 * most) // 1000
    except Refused as refused:
        wrong.append(str(refused))
        return None


def _wrong_words(words: Words) -> Iterator[str]:
    if not (words.line or words.device):
        yield "name a drive or a program; for example: driveblocks line chf@1 jscc@2"
    yield from wrong_speech(words.rate, words.form)
    for count in words.device:
        if not 1 <= count <= 16:
            yield f"--device {count} is out of range; write 1 to 16 registers"


def _program(words: Words, watchdog: int, wrong: list[str]) -> tuple[str, str, list[Source]]:
    """Name and text of the program, and the maps; what is wrong is added to `wrong`."""
    try:
        if any(each.lower().endswith(".st") for each in words.line):
            if len(words.line) > 1:
                wrong.append("name one program, or drives")
            for option, given in (("--device", words.device), ("--watchdog", words.watchdog)):
                if given:
                    wrong.append(f"{option} is for named drives; a program says so itself")
            path = Path(words.line[0])
            name = file_name(catalog.shown(path))
            return name, files.text(path), source.asked(words.maps, ())
        if words.name:
            wrong.append("--program is for a file with several PROGRAMs")
        asked = words_of(words.line)
        maps = source.asked(words.maps, [each.name for each in asked])
        drives = drives_of(asked, lambda each: source.meant(each, maps))
        if len(drives) + len(words.device) > MOST_UNITS:
            wrong.append(f"{len(drives) + len(words.device)} units; a line has 1 to {MOST_UNITS}")
        return "line.st", program({"Bus": _sketch(words, drives, watchdog)}), maps
    except (Refused, files.BadFile) as error:
        wrong.append(str(error))
        return "", "", []


def _sketch(words: Words, drives: Sequence[Named], watchdog: int) -> Sketch:
    """A line of drives and devices that are named; a device has the next free address."""
    taken = {each.unit for each in drives}
    free = (unit for unit in range(1, 248) if unit not in taken)
    rate, its = delivered(each.drive for each in drives)
    settings = {"WatchdogMs": watchdog}
    typed = [Typed(f"{each.drive.prefix}_{each.unit}", each.drive, each.unit, settings) for each in drives]
    devices = [Device(unit, count) for count, unit in zip(words.device, free, strict=False)]
    return Sketch(drives=typed, devices=devices, rate=rate, bits=its.bits)


def program(sketches: Mapping[str, Sketch]) -> str:
    """A program with lines of these names, for their figures alone."""
    declared, called = zip(*(_drawn(name, each) for name, each in sketches.items()), strict=True)
    return f"PROGRAM TypedLine\nVAR\n{''.join(declared)}END_VAR\n{''.join(called)}END_PROGRAM\n"


def _drawn(bus: str, one: Sketch) -> tuple[str, str]:
    """What a line declares, and what it calls."""
    size = 8 if len(one.drives) + len(one.devices) <= 8 else MOST_UNITS
    parts = {
        "": f"MB_ByteLine{size}", "_Slots": f"MB_Slots{size}", "_RxCount": "UINT", "_RxChars": "MB_Adu",
        "_TxChars": "MB_LineFrame", "_Words": "MB_Words16",
    }  # fmt: skip
    declared, called = [f"  {bus}{part} : {kind};\n" for part, kind in parts.items()], list[str]()
    for at, each in enumerate(one.drives):
        pins = f"Address := {each.unit}, MaximumHz := 50.0, StopWithinMs := 65534, Settings := {each.name}_Setting"
        declared.append(f"  {each.name} : {each.drive.prefix}_Drive;\n  {each.name}_Setting : VFD_Settings;\n")
        called += [f"  {each.name}_Setting.{name} := {value};\n" for name, value in each.settings.items()]
        called.append(f"  {each.name}({pins}, Slot := {bus}_Slots[{at}]);\n")
    for at, device in enumerate(one.devices, len(one.drives)):
        name = f"{bus}_Device_{device.unit}"
        pins = f"Address := {device.unit}, Quantity := {device.registers}, EveryMs := {device.every_ms}"
        declared.append(f"  {name} : MB_Device;\n")
        called.append(f"  {name}({pins}, Slot := {bus}_Slots[{at}], Words := {bus}_Words);\n")
    called.append(
        f"  {bus}(BitRate := {one.rate}, CharacterBits := {one.bits}, Ascii := {str(one.ascii).upper()}, "
        f"MaxScanMs := {one.max_scan},\n"
        f"    RxCount := {bus}_RxCount, RxChars := {bus}_RxChars, TxChars := {bus}_TxChars, Slots := {bus}_Slots);\n"
    )
    return "".join(declared), "".join(called)


# ------------------------------------------------------------ what the program says of it


def _lines(words: Words, loaded: source.Loaded, times: Mapping[str, int | None]) -> dict[str, Line]:
    """The lines of a program by their instances, after its first scan. Raises Refused."""
    scan = times["scan"] or 0
    seen = probe.probed(loaded, 1000 * scan, FIRST_US)
    unlearned = {end.wiring.line: _slots(end) for end in seen.lines}
    replies = {end.wiring.line: times["reply"] or _reply(end) for end in seen.lines}
    for end in seen.lines:
        for slot in (f"{end.wiring.line}.Slots[{at}]" for at in range(_size(end))):
            seen.instance[f"{slot}.Replies"] = LEARNED_AFTER
            # the call that sees it may come so much later
            seen.instance[f"{slot}.LongestReplyMs"] = replies[end.wiring.line] + scan
    seen.scan(2000 * scan)
    ends = {end.wiring.line: end for end in seen.lines}
    return {bus: _line(words, end, loaded, times, unlearned[bus], replies[bus]) for bus, end in ends.items()}


def _reply(end: LineEnd) -> int:
    """What the drives of a line take to begin their replies, as far as it is known."""
    return max([USUAL_REPLY_MS, *(serial(each.drive).delay_ms for each in _units(end) if each.drive)])


def _line(  # noqa: PLR0913, PLR0917 - what is asked, what is there, and what was so before the replies
    words: Words,
    end: LineEnd,
    loaded: source.Loaded,
    times: Mapping[str, int | None],
    unlearned: Mapping[str, int],
    reply: int,
) -> Line:
    """One line, once its drives have replied."""
    port = f"{end.wiring.port}.LateMs" if end.wiring.port else f"{end.wiring.line}.PortLateMs"
    keeps = f"{end.wiring.port}.KeepsSilence" if end.wiring.port else f"{end.wiring.line}.KeepsSilence"
    scan, late, block = times["scan"] or 0, times["port_late"], end.program.instance
    return Line(
        library=loaded.library, size=_size(end), slots=_slots(end) | _requests(end), unlearned=unlearned,
        units=_units(end),
        pins={name: end.number(name) for name in PINS}, within=times["within"],
        rate=words.rate or end.number("BitRate") or USUAL_RATE,
        bits=character(words.form).bits if words.form else end.number("CharacterBits") or USUAL_BITS,
        ascii=words.ascii or bool(end.number("Ascii")), scan=scan, reply=reply,
        max_scan=times["max_scan"] or end.number("MaxScanMs") or 2 * scan,
        keeps=words.keeps_silence or bool(number(block, keeps)),
        port_late=number(block, port) if late is None else late,
    )  # fmt: skip


def _size(end: LineEnd) -> int:
    """How many slots the line has."""
    for size in (2, 8):
        try:
            end.number(f"Slots[{size}].UnitAddress")
        except KeyError:
            return size
    return MOST_UNITS


def _slots(end: LineEnd) -> dict[str, int]:
    paths = [f"Slots[{at}].{name}" for at in range(_size(end)) for name in SLOT]
    return {path: end.number(path) for path in paths}


def _requests(end: LineEnd) -> dict[str, int]:
    """The longest read of each drive, and its stop, which its block may hold back until it knows what the drive is."""
    drives = {end.program.unit(each): end.program.drive(each) for each in end.wiring.drives}
    found = {}
    for at in range(_size(end)):
        drive = drives.get(end.number(f"Slots[{at}].UnitAddress"))
        if drive:
            found[f"Slots[{at}].Ask[0].FunctionCode"] = writes_by(drive, commands(drive).stop.last.register)
            found[f"Slots[{at}].Ask[3].Quantity"] = max(each.words for each in polls(drive))
    return found


def _units(end: LineEnd) -> tuple[Unit, ...]:
    """The units by their slots; a slot that no drive block has is a device's."""
    found, drives = list[Unit](), {end.program.unit(each): each for each in end.wiring.drives}
    for at in range(_size(end)):
        unit, slot = end.number(f"Slots[{at}].UnitAddress"), f"Slots[{at}]"
        every = end.number(f"{slot}.PollEveryMs")
        if unit in drives and unit:
            each, drive = drives[unit], end.program.drive(drives[unit])
            watchdog = end.program.number(f"{each.path}.Usual.WatchdogMs")
            found.append(Unit(each.path, unit, polls(drive), drive, every, watchdog))
        elif unit:
            read = Poll(end.number(f"{slot}.Ask[0].FunctionCode"), 0, end.number(f"{slot}.Ask[3].Quantity"), True)
            found.append(Unit("device", unit, (read,), None, every))
    return tuple(found)


def _wrong_line(made: Line, words: Words) -> Iterator[str]:
    if words.form and words.form[0] == "7" and not made.ascii:
        yield "7 data bits are for ASCII; add --ascii"
    if not any(each.drive for each in made.units):
        yield "there is no drive on the line; name one, such as chf@1"
    mode = "ascii" if made.ascii else "rtu"
    for name, has in [(each.name, serial(each.drive)) for each in made.units if each.drive]:
        if has.rates and made.rate not in has.rates:
            yield f"{name} has no {made.rate} bit/s; its manual names {', '.join(map(str, sorted(has.rates)))}"
        if mode not in has.modes:
            yield f"{name} speaks no {mode.upper()}"
        parities = {each.parity for each in has.characters}
        if words.form and parities and words.form[1].upper() not in parities:
            yield f"{name} has no parity {words.form[1].upper()}; its manual names {', '.join(sorted(parities))}"
