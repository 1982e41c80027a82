"""The page of a drive block: values for its template, and the pictures beside it."""

from collections import ChainMap, Counter
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from math import ceil
from typing import Any

from driveblocks.docs import (
    brief,
    bus,
    chain,
    evidence,
    keypad,
    ladder,
    network,
    recipe,
    socket,
    states,
    sto,
    swap,
    timing,
)
from driveblocks.docs.members import members
from driveblocks.docs.pins import Pin, pins
from driveblocks.maps import inventory, references, rivals, trust
from driveblocks.maps.form import address_text
from driveblocks.maps.model import Absence, Drive, Erratum, Notice
from driveblocks.meaning import conduct
from driveblocks.meaning.advice import advice
from driveblocks.meaning.measure import PINS, measures, own_maximum
from driveblocks.meaning.plug import plug
from driveblocks.meaning.polls import Poll, polls, schedule, wire_ms
from driveblocks.meaning.quantity import quantity
from driveblocks.meaning.reference import reference
from driveblocks.meaning.serial import serial
from driveblocks.meaning.setting import setting, settings
from driveblocks.meaning.status import status
from driveblocks.meaning.watchdog import at_rest, counts_at_rest, feeds, watchdog
from driveblocks.meaning.words import words
from driveblocks.platforms import CANONICAL, EXPORTS, PLATFORMS, cost
from driveblocks.platforms.ladder import diagram
from driveblocks.platforms.part import Part
from driveblocks.platforms.port import adapter, first_motor
from driveblocks.platforms.record import Platform
from driveblocks.render import context
from driveblocks.render.drive import drive_block
from driveblocks.render.environment import render
from driveblocks.render.library import File
from driveblocks.render.motor import SCAN_MS, motor
from driveblocks.render.overview import overview
from driveblocks.render.reasons import REASONS
from driveblocks.render.reasons import STATES as NAMES
from driveblocks.render.text import ENGLISH
from structured_text.language.checker import check
from structured_text.language.parser import parse
from structured_text.language.tree import Checked, FunctionBlock, TypeDecl, Unit, VarKind

FOLDER = "docs"
STATES = "drive_states.svg"
HARD_STOP = "VFD_HardStop"
"""Block of the contact in the hard stop, which has a page, too."""
RATES = (9600, 19200)
DRIVES = (1, 3, 7)
TURN_ROUND_MS = 5
"""Under what the page's figures hold; no manual promises it."""
CONDUCT = ("identity", "watchdog", "commanded_by", "own_maximum", "trip_output")
"""What gaps about what a drive does by itself refer to."""
UNKNOWN = "not known"
UNSCALED = "with a scale that you find out"
WORDS = {"at_speed": "at speed", "ready": "ready", "warning": "in a warning state"}
Measured = tuple[str, Sequence[tuple[str, str]]]
"""What was found of one drive: its label, and what each fact is called and says."""


@dataclass(frozen=True)
class Own:
    """What a page says of a family that its map does not."""

    word: str = ""
    """What the map is called in a command, where that is not its prefix."""
    measured: Sequence[Measured] = ()


def documents(
    files: list[File],
    drives: list[Drive],
    own: Mapping[str, Own] | None = None,
    *,
    targets: Collection[str] = (CANONICAL,),
    units: Sequence[Unit] = (),
) -> dict[str, str]:
    """The overview, every page and every picture, path below the output folder -> text.

    `own`: prefix -> what is special about a family here; `targets` are those that are built, whose pages and files
    others lead to; `units` are the trees of the files, where those are there already.
    """
    checked = check(units or [parse("\n".join(file.text for file in files), "library")])
    platforms = [PLATFORMS[one] for one in EXPORTS if one in targets]
    return {
        "README.md": overview(
            files, drives, checked, [(one.name, one.title) for one in platforms], linked=CANONICAL in targets
        ),
        **({f"{FOLDER}/Families.md": families(files, drives, checked, platforms)} if drives else {}),
        **pages(drives, checked, own or {}, [one for one in EXPORTS if one in targets]),
    }


def pages(drives: list[Drive], checked: Checked, own: Mapping[str, Own], platforms: list[str]) -> dict[str, str]:
    """Every page and picture, path below the output folder -> text."""
    found = _shared(drives, checked.blocks) if drives else {}
    blocks = {block.name: block for block in checked.blocks.values()}
    declared = [one for unit in checked.units for one in unit.elements if isinstance(one, TypeDecl)]
    types = {one.name: one for one in declared}
    for drive in drives:
        name, mine = f"{drive.prefix}_Drive", own.get(drive.prefix, Own())
        block = blocks[name]
        inputs, in_outs, outputs = _pins(drive, block)
        values: dict[str, Any] = {"inputs": inputs, "in_outs": in_outs, "outputs": outputs}
        values["settable"], values["diagnosis"] = (
            members(types[one], drive) for one in ("VFD_Settings", "VFD_Diagnosis")
        )
        found[f"{FOLDER}/{name}.md"] = _page(drive, checked, values, mine, platforms)
        found[f"{FOLDER}/{drive.prefix}_Master.md"] = recipe.page(drive, mine.word or drive.prefix.lower(), page=name)
        found[f"{FOLDER}/{name}.svg"] = ladder.picture(name, "Motor", inputs, in_outs, outputs)
        found[f"{FOLDER}/{name}_timing.svg"] = timing.picture(drive, name)
        if plug(drive).drawn:
            found[f"{FOLDER}/{name}_socket.svg"] = socket.picture(f"The socket of {drive.prefix}", plug(drive))
        drawn = [one for one in platforms if PLATFORMS[one].drawn]
        found |= {f"{FOLDER}/{name}_ladder_{one}.svg": _network(one, drive, blocks) for one in drawn}
        if not drawn or drawn != platforms:
            found[f"{FOLDER}/{name}_ladder.svg"] = _network(CANONICAL, drive, blocks)
    return found


def _shared(drives: list[Drive], blocks: Mapping[str, FunctionBlock]) -> dict[str, str]:
    """The states of all drive blocks, and the page of the contact in the hard stop."""
    block = blocks[HARD_STOP.upper()]
    inputs, outputs = (pins(block, kind, {}) for kind in (VarKind.INPUT, VarKind.OUTPUT))
    text = render("docs/HardStop.md.j2", name=HARD_STOP, inputs=inputs, outputs=outputs, drives=drives)
    return {
        f"{FOLDER}/{STATES}": states.picture(),
        f"{FOLDER}/{HARD_STOP}.md": text,
        f"{FOLDER}/{HARD_STOP}.svg": chain.picture(HARD_STOP),
        f"{FOLDER}/Wiring.md": render("docs/Wiring.md.j2", families=[_wires(drive) for drive in drives]),
        f"{FOLDER}/FirstMotor.md": render("docs/FirstMotor.md.j2"),
        f"{FOLDER}/bus.svg": bus.picture(),
        f"{FOLDER}/sto.svg": sto.picture(),
        f"{FOLDER}/Swapping.md": render(
            "docs/Swapping.md.j2",
            drives=[swap.pins(drive) | {"word": drive.prefix.lower()} for drive in drives],
            mistaken=list(_mistaken(drives)),
            unknown=_unknown(drives),
        ),
    }


def families(files: list[File], drives: list[Drive], checked: Checked, platforms: list[Platform]) -> str:
    """The catalogue: every family with its maker, what it can do, how far it can be trusted, what its files hold."""
    folders = {file.folder: drive for drive in drives for file in files if file.name == f"{drive.prefix}_Drive"}
    counted: dict[str, dict[str, Counter[str]]] = {drive.prefix: {} for drive in drives}
    for file in (one for one in files if one.folder in folders):
        prefix = folders[file.folder].prefix
        kind = "functions" if file.name.upper() in checked.functions else "blocks"
        counted[prefix].setdefault(f"X_{file.extra}" if file.extra else "X", Counter())[kind] += 1
    rows = [
        {
            "prefix": drive.prefix,
            "maker": drive.vendor.en,
            "title": drive.family.en,
            "able": inventory.abilities(drive)[0],
            "turns_on": _turns_on(drive),
            "trust": trust.shown(drive),
            "checked": "yes" if trust.second_hand(drive) else "",
            "reports": ", ".join(_reported(drive)),
            "shows": ", ".join(_shown(drive, "yes")),
            "unscaled": ", ".join(_shown(drive, UNSCALED)),
            "data": cost.data(checked.blocks[f"{drive.prefix}_Drive".upper()]),
            "counts": {file: f"{one['functions']} + {one['blocks']}" for file, one in counted[drive.prefix].items()},
        }
        for drive in drives
    ]
    names = list(dict.fromkeys(file for found in counted.values() for file in found))
    return render(
        "docs/Families.md.j2",
        families=rows,
        plates=_plates(drives),
        trusted=list(trust.SHOWN),
        platforms=platforms,
        files=names,
        wide=any("Chinese" in name for name in names),
    )


def _plates(drives: list[Drive]) -> list[dict[str, str]]:
    """The patterns of model numbers, each with a printed one that fits."""
    rows = [
        {"plate": one.plate, "prefix": drive.prefix, "example": next(filter(one.plate.fits, one.printed))}
        for drive in drives
        for one in drive.models
    ]
    return sorted(rows, key=lambda row: row["plate"])


def _turns_on(drive: Drive) -> str:
    """How long a motor turns on without the line, by the drive's own watchdog."""
    own = watchdog(drive)
    time = own.time if own else None
    by = setting(drive, time.setting) if time else None
    if time is None or by is None:
        return "its watchdog, of unknown time" if own else "not known"
    if time.least_ms is None or time.most_ms is None:
        return f"as `{by.keypad.code}` says"
    least, most = (each / 1000 for each in (time.least_ms, time.most_ms))
    return f"{least.normalize():f} to {most.normalize():f} s, `{by.keypad.code}`"


def _wires(drive: Drive) -> dict[str, str]:
    """Which wire of the line goes where, and what no text says of it."""
    line, own = serial(drive), plug(drive)
    milliseconds = f"more than {line.silence_ms} ms" if line.silence_ms else ""
    characters = f"{line.silence_characters} characters" if line.silence_characters else ""
    return {
        "name": f"[{drive.prefix}]({drive.prefix}_Drive.md)",
        "port": own.connector or UNKNOWN,
        "positive": own.at("positive") or UNKNOWN,
        "negative": own.at("negative") or UNKNOWN,
        "common": own.at("common") or UNKNOWN,
        "termination": own.termination or UNKNOWN,
        "silence": milliseconds or characters or UNKNOWN,
        "find_out": "; ".join(find_out for _, find_out in own.gaps),
    }


def _mistaken(drives: list[Drive]) -> Iterator[dict[str, str]]:
    """The families whose stop does harm at a drive of another, those together of which the same is so.

    One of the two is built here; the other may be any that ships.
    """
    found: dict[tuple[str, str, str], dict[str, None]] = {}
    built = {drive.prefix: drive for drive in drives}
    every = {drive.prefix: drive for drive in rivals.shipped()} | built
    for pair in rivals.pairs(every.values()):
        if built.keys().isdisjoint((pair.block.prefix, pair.drive.prefix)):
            continue
        stop = f"{address_text(pair.worst.register)} = {pair.worst.word:04X}H, there {pair.worst.says}"
        told = f"by {pair.told}" if pair.told else "**nothing**"
        what = "**motion**" if pair.worst.means == "motion" else "another register"
        found.setdefault((pair.drive.prefix, f"{what}: {stop}", told), {})[pair.block.prefix] = None
    rows: dict[tuple[str, str, str], list[str]] = {}
    for (drive, stop, told), blocks in found.items():
        rows.setdefault((", ".join(blocks), stop, told), []).append(drive)
    for (names, stop, told), others in rows.items():
        yield {"blocks": names, "drives": ", ".join(others), "stop": stop, "told": told}


def _unknown(drives: list[Drive]) -> str:
    """The families of whose stop the map of another says nothing."""
    found: dict[str, list[str]] = {}
    for one, other in rivals.unknown(drives):
        found.setdefault(one.prefix, []).append(other.prefix)
    rows: dict[str, list[str]] = {}
    for block, others in found.items():
        rows.setdefault(", ".join(others), []).append(block)
    return "; ".join(f"{', '.join(blocks)} at {others}" for others, blocks in rows.items())


def _network(platform: str, drive: Drive, blocks: Mapping[str, FunctionBlock]) -> str:
    """The first motor of a platform as a ladder; that for any port is the one that PLCopen XML has."""
    file = first_motor(platform, drive)
    port = (parse(one.text, one.path).elements for one in adapter(platform, [ENGLISH]))
    ports = {one.name: one for elements in port for one in elements if isinstance(one, FunctionBlock)}
    program = Part(file.folder, parse(file.text, file.path))
    return network.picture(f"{file.name} as a ladder", diagram(program, ChainMap(ports, dict(blocks))))


def _pins(drive: Drive, block: FunctionBlock) -> tuple[list[Pin], list[Pin], list[Pin]]:
    ranges = {"Address": f"{serial(drive).lowest} to {serial(drive).highest}"}
    inputs, in_outs, outputs = (pins(block, kind, ranges) for kind in (VarKind.INPUT, VarKind.IN_OUT, VarKind.OUTPUT))
    return inputs, in_outs, outputs


def _page(drive: Drive, checked: Checked, values: Mapping[str, Any], own: Own, platforms: list[str]) -> str:
    block = checked.blocks[f"{drive.prefix}_Drive".upper()]
    listed = serial(drive).rates
    open_ = [each for each in drive.absent if _open(drive, each)]
    return render(
        "docs/Drive.md.j2",
        manual=context.title(drive),
        questions=brief.questions(drive, own.word or drive.prefix.lower()),
        speeds=list(brief.speeds(drive)),
        unset=list(brief.unset(drive)),
        unreset=list(brief.unreset(open_)),
        heard=trust.heard(drive),
        places=evidence.places(drive),
        documents=evidence.documents(drive),
        word=own.word or drive.prefix.lower(),
        measured=own.measured,
        edition=drive.manual.edition,
        platforms=[(one, PLATFORMS[one].title, PLATFORMS[one].drawn) for one in platforms],
        first=[
            each.what
            for each in open_
            if not {"serial", "pins"}.isdisjoint(each.about) or any("setting" in one for one in each.about)
        ],
        plug=plug(drive),
        errata=list(_errata(drive)),
        faults=sorted(advice(drive), key=lambda one: one.code),
        helped=drive.faults.help,
        help_from=next(
            (one.title for one in drive.documents if drive.faults.help and one.id == drive.faults.help.document),
            "its manual",
        ),
        cannot=[said for does, said in swap.ABILITIES.items() if does not in words(drive).named],
        hides=[pin.name for pin in values["outputs"] if pin.idle],
        settings=settings(drive),
        keypad=keypad.rows(drive),
        run_sources=[each for each in settings(drive) if each.needed and each.needed.by_terminals is not None],
        hazards=[each for each in drive.notices if _matters(each)],
        nevers=list(conduct.nevers(drive)),
        open=open_,
        reasons=REASONS,
        reads=list(_reads(drive)),
        refresh=list(_refresh(drive)),
        rates=RATES,
        drives=DRIVES,
        unlisted=[rate for rate in RATES if listed and rate not in listed],
        bytes=block.type.size if block.type else 0,
        data=cost.data(block),
        slot=checked.types["MB_SLOT"].size,
        states_said=[(name, states.SAYS[number]) for number, (name, _) in enumerate(NAMES)],
        hard_stop=HARD_STOP,
        derived=_guessed(drive),
        status=status(drive),
        conduct=_conduct(drive),
        feeds=feeds(drive),
        fed_at_rest=at_rest(drive),
        counts_at_rest=counts_at_rest(drive),
        proved_tripped=timing.proves_while_tripped(drive),
        states=STATES,
        turn_round=_turn_round(drive),
        delayed=serial(drive).delay_ms == _turn_round(drive) and serial(drive).delay,
        **motor(drive),
        **values,
    )


# ---------------------------------------------------------------- what a family can


def _reported(drive: Drive) -> list[str]:
    """What a drive tells by itself over the bus, in words."""
    shows = status(drive)
    told = [f"that it is {words}" for one, words in WORDS.items() if shows.shows(one)]
    told += ["what it is"] if shows.identity.patterns else []
    told += ["whether the bus is in command"] if shows.by_bus.patterns else []
    return told + (["its own maximum frequency"] if own_maximum(drive) else [])


def _shown(drive: Drive, cell: str) -> list[str]:
    """The pins that show a value, as it is or once its scale is found out."""
    return [f"`{PINS[shows].pin}`" for shows in PINS if _shows(drive, shows) == cell]


def _conduct(drive: Drive) -> list[tuple[str, str]]:
    """What happens, and what the drive then does by itself, or says."""
    silenced = conduct.silenced(drive)
    return [
        ("The cable is cut", conduct.silent_line(drive)),
        ("The drive trips", conduct.trip(drive)),
        *([("A fault is reset", silenced)] if silenced else []),
        ("The bus is in command", conduct.in_command(drive)),
        ("The drive is of this family", conduct.recognised(drive)),
        ("Its own maximum frequency", conduct.own_maximum(drive)),
        ("The speed asked for is below its lower limit", conduct.lower_limit(drive)),
    ]


def _shows(drive: Drive, shows: str) -> str:
    measure = drive_block(drive).showing.measures.get(shows)
    if measure is None:
        return "no"
    return "yes" if measure.scale else UNSCALED


def _guessed(drive: Drive) -> bool:
    """Whether AtSpeed rests on an output frequency without a scale."""
    return not status(drive).shows("at_speed") and _shows(drive, "output_frequency") not in ("yes", "no")


# ---------------------------------------------------------------- what a person sets, and has to find out


def _matters(notice: Notice) -> bool:
    return notice.kind == "hazard" or (notice.kind == "prohibition" and not notice.about)


def _open(drive: Drive, one: Absence) -> bool:
    """Whether a gap of the manual is about the line, commands, reference, a scale that a pin needs, or conduct."""
    told = {each.last.register for each in words(drive).commands} | {reference(drive).register}
    told |= {each.register for each in measures(drive) if not quantity(drive, each.register).factors}
    about = {"serial", "pins", "operation", *CONDUCT, *map(references.of, told)}
    about |= {f"setting {each.id}" for each in settings(drive)}
    return not about.isdisjoint(one.about)


def _errata(drive: Drive) -> Iterator[dict[str, str]]:
    """The misprints that bear on a block: where, what is printed and used, why; those of words only with the words."""
    plain = not drive.manual.title.own
    for one in (each for each in drive.errata if _bears(drive, each)):
        if not plain or (one.where + one.used + one.why).isascii():
            printed = one.printed if one.printed.isascii() or not plain else "(not in English)"
            yield {"where": one.where, "printed": printed, "used": one.used, "why": one.why}


def _bears(drive: Drive, one: Erratum) -> bool:
    """Whether a misprint is about a word that the block reads or writes, or about a keypad setting."""
    told = {each.last.register for each in words(drive).commands} | {each.register for each in measures(drive)}
    told.add(reference(drive).register)
    about = {*map(references.of, told)} | {f"setting {each.id}" for each in settings(drive)}
    return not about.isdisjoint(one.about)


# ---------------------------------------------------------------- what is read


@dataclass(frozen=True)
class Read:
    """A read with its registers: how often it is sent, and how long it takes at each rate, in ms."""

    poll: Poll
    often: str
    first: str
    titles: list[str]
    ms: list[str]


def _reads(drive: Drive) -> Iterator[Read]:
    """Each read with its registers and what it takes on the wire, turn-round and silences included."""
    found, bits = drive_block(drive).reading.reads, serial(drive).character.bits
    fast = [one for one in found if one.read.fast]
    # see `schedule`: a status that one read brings comes twice before what is slow
    often = "twice a round" if len(fast) == 1 < len(found) else "once a round"
    for one in found:
        poll = one.read
        yield Read(
            poll,
            often if poll.fast else "one slow read a round",
            address_text(poll.address),
            [f"{word.address_text} {context.inside_a_sentence(word.title)}" for word in one.words],
            [f"{wire_ms(poll, rate, bits, _turn_round(drive), _silence(drive)):.0f}" for rate in RATES],
        )


def _turn_round(drive: Drive) -> int:
    """What a drive as delivered takes to answer, ms, as far as it is known."""
    return max(TURN_ROUND_MS, serial(drive).delay_ms)


def _silence(drive: Drive) -> float | None:
    """The silence that a drive asks for, ms; None for one that speaks ASCII alone, which needs none."""
    if serial(drive).ascii:
        return None
    return float(serial(drive).silence_ms)


@dataclass(frozen=True)
class Refresh:
    """How long it takes, in ms by the number of drives, at a rate, with a port that keeps the silence or not."""

    rate: int
    keeps: bool
    ms: list[int]


def _refresh(drive: Drive) -> Iterator[Refresh]:
    """By the formula of the line: the time in which every word of every drive is read once."""
    found = polls(drive)
    turns = [found[index] for index in schedule(found)]
    for rate in RATES:
        for keeps in (True, False):
            scans = sum(_scans(drive, poll, rate, keeps=keeps) for poll in turns)
            yield Refresh(rate, keeps, [count * scans * SCAN_MS for count in DRIVES])


def _scans(drive: Drive, poll: Poll, rate: int, *, keeps: bool) -> int:
    character = 1000 * serial(drive).character.bits / rate
    own = _silence(drive)
    silence = 0.0 if own is None else max(3.5 * character, own)
    wire = poll.characters(ascii_mode=own is None) * character + _turn_round(drive)
    if keeps:
        return ceil((wire + silence) / SCAN_MS)
    return ceil(wire / SCAN_MS) + int((silence + 1) // SCAN_MS) + 1
