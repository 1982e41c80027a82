"""OpenPLC, and every other compiler of plain text: each volume of the library as a file, and first motors beside them.

The canonical texts come in the order of their use, as they are. Nothing is left that the target could not say. What
is the user's, a program and its task, has a file of its own, and so has the port of Linux, which is C.
"""

from driveblocks.platforms.page import page
from driveblocks.platforms.part import YOURS, Own, Shelf, Volume
from driveblocks.render.environment import render
from driveblocks.render.motor import SCAN_MS, motor

PLATFORM, LINUX = "openplc", "linux"


def write(shelf: Shelf) -> dict[str, str]:
    """Every file: `yours/CHF_Motor.st` goes after shared, port and family, or `CHF_MotorBytes.st` without the port."""
    volumes, port = tuple(shelf.volumes()), shelf.port(LINUX)
    made = {f"{one.layer}/{one.name}.st": _joined(one) for one in (*volumes, *port)}
    for drive in shelf.drives.values():
        bytes_ = render(f"{PLATFORM}/Bytes.st.j2", **motor(drive))
        made[f"{YOURS}/{drive.prefix}_Motor.st"] = _tasked(shelf.motor(LINUX, drive).text, f"{drive.prefix}_Motor")
        made[f"{YOURS}/{drive.prefix}_MotorBytes.st"] = _tasked(bytes_, f"{drive.prefix}_MotorBytes")
    return made | page(PLATFORM, shelf, (*volumes, *port))


def own(_: Shelf, programs: Own) -> dict[str, str]:
    """A file of each program of a user's own, with its task."""
    return {f"{YOURS}/{one.name}.st": _tasked(one.text, one.name, programs.scan_ms) for one in programs.texts}


def library(shelf: Shelf) -> dict[str, str]:
    """The library alone, without a port."""
    return {f"{one.layer}/{one.name}.st": _joined(one) for one in shelf.volumes()}


def _tasked(text: str, program: str, scan_ms: int = SCAN_MS) -> str:
    return f"{text}\n{render(f'{PLATFORM}/Task.st.j2', program=program, scan=scan_ms)}"


def _joined(one: Volume) -> str:
    head = render(f"{PLATFORM}/head.st.j2", name=one.name, types=len(one.types), blocks=len(one.blocks))
    return "\n".join([head, *(part.text for part in one.parts)])
