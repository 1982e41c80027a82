"""The READMEs' tables of drives, as Markdown: what each drive can do, and how much each shipped map holds."""

import os
from collections.abc import Iterator, Mapping
from pathlib import Path

from driveblocks.maps import counts, trust, view
from driveblocks.maps.counts import Counts, Tally
from driveblocks.maps.model import Drive

BEGIN, END = "<!-- drives:begin -->", "<!-- drives:end -->"
FRONT_BEGIN, FRONT_END = "<!-- front:begin -->", "<!-- front:end -->"
TRUST_BEGIN, TRUST_END = "<!-- trust:begin -->", "<!-- trust:end -->"

_FRONT = ("maker", "drives, each with its page", "misprints found", "left open by the manuals")
_WORDS = {
    "run_forward": "run", "run_reverse": "run in reverse", "jog_forward": "jog", "stop": "stop",
    "quick_stop": "quick stop", "coast_stop": "coast", "fault_reset": "reset a fault", "parameters": "set parameters",
}  # fmt: skip
"""What a drive can be asked to do, as the front table lists it."""

_COLUMNS = (
    "drive and its register tables", "registers", "bits", "enums", "enum values",
    "settings", "faults", "errors", "frames", "errata", "absent",
)  # fmt: skip


def update(text: str, maps: Mapping[Path, Drive], folder: Path) -> str:
    """A page's text with each part between its markers made again; `folder` is that of the page, for its links.

    Raises ValueError without markers.
    """
    whole, known = text, False
    for begin, end, made in ((BEGIN, END, table), (FRONT_BEGIN, FRONT_END, front), (TRUST_BEGIN, TRUST_END, trusted)):
        before, found, rest = whole.partition(begin)
        _, closed, after = rest.partition(end)
        if found and closed:
            whole, known = f"{before}{begin}\n{made(maps, folder)}{end}{after}", True
    if not known:
        raise ValueError(f"the page lacks the markers {BEGIN} and {END}")
    return whole


def front(maps: Mapping[Path, Drive], folder: Path) -> str:
    """One line for each maker: its drives with their pages, misprints found and gaps of the manuals."""
    makers: dict[str, list[tuple[Path, Drive]]] = {}
    for path, drive in sorted(maps.items(), key=lambda each: view.title(each[1]).casefold()):
        makers.setdefault(drive.vendor.en, []).append((path, drive))
    rows: list[tuple[str, ...]] = [_FRONT, ("---",) * 2 + ("---:",) * 2]
    for maker, drives in makers.items():
        held = [counts.of_drive(drive) for _, drive in drives]
        links = ", ".join(_link(path, drive, folder) for path, drive in drives)
        errata, absent = (str(sum(getattr(one, key) for one in held)) for key in ("errata", "absent"))
        rows.append((view.markdown(maker), links, errata, absent))
    return "".join(f"| {' | '.join(row)} |\n" for row in rows)


def trusted(maps: Mapping[Path, Drive], folder: Path) -> str:
    """One line for each drive: how far its map can be trusted, and whether its block wants `ManualChecked`."""
    rows: list[tuple[str, ...]] = [("drive", *trust.SHOWN, "wants `ManualChecked`"), ("---",) * (len(trust.SHOWN) + 2)]
    for path, drive in maps.items():
        rows.append((_link(path, drive, folder), *trust.shown(drive).values(), "yes" * trust.second_hand(drive)))
    return "".join(f"| {' | '.join(row)} |\n" for row in rows)


def _link(path: Path, drive: Drive, folder: Path) -> str:
    page = (
        Path(os.path.relpath(path.resolve().parents[1], folder.resolve())) / "blocks/docs" / f"{drive.prefix}_Drive.md"
    )
    return f"[{view.markdown(drive.family.en)}]({page.as_posix()})"


def abilities(drive: Drive) -> tuple[str, str]:
    """What a drive can be asked to do over the bus, and what it cannot."""
    able = set(_able(drive))
    can, cannot = ([word for name, word in _WORDS.items() if (name in able) == wanted] for wanted in (True, False))
    return ", ".join(can), ", ".join(cannot)


def _able(drive: Drive) -> Iterator[str]:
    """What a drive can be asked to do, by the names of commands; `parameters` where there are some to be set."""
    moving = {drive.operation.reference.register}
    for command in drive.operation.commands:
        yield command.does
        moving |= {command.register, *(step.register for step in command.first)}
    written = {
        address
        for section, row in drive.registers()
        if "w" in (row.access or section.access) and not row.unused
        for address in row.address
    }
    kept = {each.register for each in drive.settings if not drive.adjusts(each)}
    if any("w" in area.access for area in drive.areas) or written - moving - kept:
        yield "parameters"


def table(maps: Mapping[Path, Drive], folder: Path) -> str:
    """One line for each drive with its totals, and below it one for each of its register tables."""
    rows = [_COLUMNS, ("---",) + ("---:",) * (len(_COLUMNS) - 1)]
    for path, drive in maps.items():
        rows += _drive(drive, Path(os.path.relpath(path.resolve(), folder.resolve())))
    return "".join(f"| {' | '.join(row)} |\n" for row in rows)


def _drive(drive: Drive, link: Path) -> Iterator[tuple[str, ...]]:
    held = counts.of_drive(drive)
    name = f"[**{drive.prefix}**]({link.as_posix()}) {view.markdown(view.title(drive))}"
    yield name, *_numbers(held.total), *_kinds(held)
    blank = ("",) * len(_kinds(held))
    for section in drive.sections:
        yield f"· {view.markdown(section.title.en)}", *_numbers(held.sections[section.id]), *blank
    lists = str(held.setting_values.enums), str(held.setting_values.enum_values)
    yield "· keypad settings", "", "", *lists, str(held.settings), *blank[1:]


def _numbers(tally: Tally) -> tuple[str, ...]:
    return str(tally.registers), str(tally.bits), str(tally.enums), str(tally.enum_values)


def _kinds(held: Counts) -> tuple[str, ...]:
    return tuple(map(str, (held.settings, held.faults, held.errors, held.frames, held.errata, held.absent)))
