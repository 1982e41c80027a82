"""OpenPLC, and every other compiler of plain text: the library of each family as one file, and first motors beside it.

The canonical texts come in the order of their use, as they are. Nothing is left that the target could not say. What
is the user's, a program and its task, has a file of its own, and so has the port of Linux, which is C.
"""

from driveblocks.export.part import Library, Shelf
from driveblocks.render import library
from driveblocks.render.environment import render
from driveblocks.render.motor import SCAN_MS, motor
from structured_text.language.tree import TypeDecl

TARGET = "openplc"
LINUX = "LX_Line8"
"""The file of the port of Linux, with the line on top of it."""


def files(shelf: Shelf) -> dict[str, str]:
    """Every file: `CHF.st` is whole, `LX_Line8.st` and `CHF_Motor.st` go after it, or `CHF_MotorBytes.st`."""
    made = {f"{one.name}.st": "\n".join([_head(one), *(part.text for part in one.parts)]) for one in shelf.libraries()}
    port, line, *_ = (file.text for file in library.adapter("linux", list(shelf.languages)))
    for drive in shelf.drives.values():
        first, other = f"{drive.prefix}_Motor", f"{drive.prefix}_MotorBytes"
        program = render("openplc/Bytes.st.j2", **vars(motor(drive)))
        made[f"{LINUX}.st"] = f"{port}\n{line}"
        made[f"{first}.st"] = f"{library.first_motor('linux', drive).text}\n{_task(first)}"
        made[f"{other}.st"] = f"{program}\n{_task(other)}"
    made["README.md"] = _page(shelf)
    return {f"{TARGET}/{path}": text for path, text in made.items()}


def _task(program: str) -> str:
    return render("openplc/Task.st.j2", program=program, scan=SCAN_MS)


def _head(one: Library) -> str:
    return render("openplc/head.st.j2", **_counted(one))


def _counted(one: Library) -> dict[str, object]:
    types = sum(isinstance(part.element, TypeDecl) for part in one.parts)
    drives = [drive.prefix for drive in one.drives]
    return {"name": one.name, "types": types, "blocks": len(one.parts) - types, "drives": drives}


def _page(shelf: Shelf) -> str:
    libraries = list(map(_counted, shelf.libraries()))
    return render("openplc/README.md.j2", libraries=libraries, one=libraries[1]["name"])
