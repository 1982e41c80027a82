"""All programs: of the blocks that every drive shares, and of each drive; and the files that ship them."""

import multiprocessing
import os
import signal
import sys
import threading
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import partial
from multiprocessing.connection import Connection
from pathlib import Path
from types import MappingProxyType

from driveblocks.maps.collection import Source
from driveblocks.maps.model import Drive
from driveblocks.testing import (
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
from driveblocks.testing.bench import GENERIC
from driveblocks.testing.scenes import (
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
from driveblocks.testing.scenes import drive as simulated
from driveblocks.testing.scenes import parameter as parameters
from driveblocks.testing.scenes.ability import Ability
from driveblocks.testing.scenes.reason import unreached
from driveblocks.testing.script import Program, Script, Suite

ROOT = "tests/iec61131/"
"""Where the programs are shipped, below the folder of all blocks."""

GROUPS: dict[str, Callable[[Drive, str], Iterator[Script]]] = {
    "Motor": motor.scripts,
    "Slot": told.scripts,
    "Line": line.scripts,
    "Figures": count.scripts,
    "What else is heard": others.scripts,
    "Pace": pace.scripts,
    "Restart": again.scripts,
    "To the millisecond": exact.scripts,
    "Parts": part.scripts,
    "Parameters": parameters.scripts,
    "Several parameters": several.scripts,
    "A meter beside it": device.scripts,
    "The manual's frames on the line": manual.scripts,
    "The manual's frames": vector.scripts,
    "What may be read": access.scripts,
    "What may be written": parameter.scripts,
    "Requests": request.scripts,
    "Replies": reply.scripts,
    "Registers": register.scripts,
    "Commands": command.scripts,
    "Speed": speed.scripts,
    "Standstill and faults": standstill.scripts,
    "Version": version.scripts,
}
"""What is tested of a drive, in the words of a user."""

PAGE = "tests/README.md"
"""The page that lists them."""
FEW = 32
"""Most maps of whose drives another process makes the tests: both keep them in memory for a moment."""


def shared_suite(languages: Sequence[text.Language]) -> Suite:
    """The programs of the blocks that every drive shares."""
    made = tuple(_finished("Frames, requests, replies and texts", shared.scripts(languages)))
    return Suite(GENERIC, made, len(made))


def drive_suite(source: Source, languages: Sequence[text.Language]) -> Suite:
    """The programs of one drive."""
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


@dataclass(frozen=True)
class Shipped:
    """What is shipped of a suite: the texts of its programs and their parts by path, and its table on the page."""

    texts: dict[str, str]
    table: str


Tests = Callable[[], dict[str, str]]
"""Gives what `programs` does."""


def tests(sources: Sequence[Source], languages: Sequence[text.Language]) -> Tests:
    """Begin with the test programs: another process makes those of two drives in three, where one can be split off.

    That is on Linux, for a few maps, while this process has but one thread. The others are made when asked for.
    """
    theirs = [source for at, source in enumerate(sources) if at % 3 < 2]
    if sys.platform != "linux" or len(sources) > FEW or threading.active_count() > 1:
        return partial(programs, sources, languages)
    made, end = multiprocessing.Pipe(duplex=False)
    process = multiprocessing.get_context("fork").Process(target=_send, args=(theirs, languages, end), daemon=True)
    try:
        process.start()
    except OSError:  # there may be no more processes
        return partial(programs, sources, languages)
    end.close()

    def asked() -> dict[str, str]:
        there = {source.path: _shipped(drive_suite(source, languages)) for source in sources[2::3]}
        with suppress(EOFError, OSError):  # it was killed, or cannot make one: this process makes it, or says why
            there |= zip((source.path for source in theirs), made.recv(), strict=True)
        process.join()
        return programs(sources, languages, there)

    return asked


def _send(sources: Sequence[Source], languages: Sequence[text.Language], end: Connection) -> None:
    """Make the suites of some drives; nothing is sent where one cannot be made."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is for the process that waits
    os.closerange(3, end.fileno())  # what dies with that process: the lock of the folder, and whom it is sent to
    os.closerange(end.fileno() + 1, os.sysconf("SC_OPEN_MAX"))
    with suppress(Exception):
        end.send([_shipped(drive_suite(source, languages)) for source in sources])


def _shipped(suite: Suite) -> Shipped:
    return Shipped({**suite.parts, **{program.path: program.text for program in suite.programs}}, page.table(suite))


def programs(
    sources: Sequence[Source], languages: Sequence[text.Language], there: Mapping[Path, Shipped] = MappingProxyType({})
) -> dict[str, str]:
    """Every file of the tests, path below the folder of all blocks -> text, with the order that compilers take.

    `there` are suites of drives that are made already, by the map.
    """
    made = [_shipped(shared_suite(languages))]
    made += [there.get(source.path) or _shipped(drive_suite(source, languages)) for source in sources]
    texts = dict(harness.texts())
    for suite in made:
        texts |= suite.texts
    order = "".join(f"{path}\n" for path in texts)
    files = {ROOT + path: content for path, content in (texts | {"order.txt": order}).items()}
    return files | {PAGE: page.page(suite.table for suite in made)}
