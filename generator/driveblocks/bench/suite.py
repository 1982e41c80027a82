"""All programs: of the blocks that every drive shares, and of each drive; and the files that ship them."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import replace

from driveblocks.bench import (
    access,
    command,
    harness,
    page,
    parameter,
    register,
    reply,
    request,
    shared,
    speed,
    standstill,
    text,
    vector,
    version,
)
from driveblocks.bench.kit import GENERIC
from driveblocks.bench.scenes import (
    again,
    count,
    device,
    exact,
    line,
    manual,
    motor,
    others,
    pace,
    part,
    several,
    told,
)
from driveblocks.bench.scenes import drive as simulated
from driveblocks.bench.scenes import parameter as parameters
from driveblocks.bench.scenes.ability import Ability
from driveblocks.bench.scenes.reason import unreached
from driveblocks.bench.script import Program, Script, Suite
from driveblocks.maps.collection import Source
from driveblocks.maps.model import Drive

ROOT = "tests/iec61131/"
"""Where the programs are shipped, below the folder of all blocks."""

GROUPS: dict[str, Callable[[Drive, str], Iterator[Script]]] = {
    "Motor": motor.scripts, "Slot": told.scripts, "Line": line.scripts, "Figures": count.scripts,
    "What else is heard": others.scripts, "Pace": pace.scripts, "Restart": again.scripts,
    "To the millisecond": exact.scripts, "Parts": part.scripts, "Parameters": parameters.scripts,
    "Several parameters": several.scripts, "A meter beside it": device.scripts,
    "The manual's frames on the line": manual.scripts, "The manual's frames": vector.scripts,
    "What may be read": access.scripts, "What may be written": parameter.scripts, "Requests": request.scripts,
    "Replies": reply.scripts, "Registers": register.scripts, "Commands": command.scripts, "Speed": speed.scripts,
    "Standstill and faults": standstill.scripts, "Version": version.scripts,
}  # fmt: skip
"""What is tested of a drive, in the words of a user."""

PAGE = "tests/README.md"
"""The page that lists them."""


def shared_suite(languages: Sequence[text.Language]) -> Suite:
    made = tuple(_finished("Frames, requests, replies and texts", shared.scripts(languages)))
    return Suite(GENERIC, made, len(made))


def drive_suite(source: Source, languages: Sequence[text.Language]) -> Suite:
    drive, stem = source.drive, source.path.stem
    made = [program for group, subject in GROUPS.items() for program in _finished(group, subject(drive, stem))]
    made += _finished("Texts", text.scripts(drive, stem, languages))
    parts = harness.simulation() | {f"{stem}/{simulated.name(drive)}.st": simulated.text(drive, Ability(drive).codes)}
    return Suite(
        stem,
        tuple(made),
        len(drive.frames),
        parts,
        unreached(Ability(drive), writes=parameters.place_of(drive) is not None),
    )


def _finished(group: str, scripts: Iterable[Script]) -> Iterator[Program]:
    for script in scripts:
        yield from (replace(program, group=group) for program in script.programs())


def programs(sources: Sequence[Source], languages: Sequence[text.Language]) -> dict[str, str]:
    """Every file of the tests, path below the folder of all blocks -> text, with the order that compilers take."""
    texts, tables = dict(harness.texts()), list[str]()
    for suite in (shared_suite(languages), *(drive_suite(source, languages) for source in sources)):
        texts |= {**suite.parts, **{program.path: program.text for program in suite.programs}}
        tables.append(page.table(suite))
    order = "".join(f"{path}\n" for path in texts)
    files = {ROOT + path: content for path, content in (texts | {"order.txt": order}).items()}
    return files | {PAGE: page.page(tables)}
