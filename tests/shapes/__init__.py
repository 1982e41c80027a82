"""Made-up drives, one for each shape of a command: a path of states, a pulse, two registers, active-low bits.

Each is an edit of the skeleton that `driveblocks new` writes; tests/maps/bad.py says how an edit is written.
`python -m tests.shapes NAME` prints one as a whole map.
"""

from functools import cache
from pathlib import Path

from tests.maps import bad

from driveblocks.maps.load import loads
from driveblocks.maps.model import Drive
from driveblocks.maps.page import skeleton

FILE = Path(__file__).with_name("shapes.diff")


@cache
def texts() -> dict[str, str]:
    """The maps by name."""
    return {name: case.text for name, case in bad.edits(FILE, _skeleton)}


@cache
def values() -> dict[str, str]:
    """Maps whose commands are plain, and whose references and measures are not, by name."""
    return {name: case.text for name, case in bad.edits(FILE.with_name("values.diff"), _base)}


@cache
def shapes() -> dict[str, Drive]:
    """The drives by name."""
    return {name: loads(text, f"{name}.yaml") for name, text in texts().items()}


@cache
def signs() -> dict[str, str]:
    """Maps that show their status in other ways than by bits, by name."""
    return {name: case.text for name, case in bad.edits(FILE.with_name("status.diff"), _base)}


def _base(name: str) -> list[str]:
    """The skeleton, the drive that coils command, or a map of those of `texts`."""
    if name in texts():
        return texts()[name].split("\n")
    if name != "coils":
        return _skeleton(name)
    return (bad.FOLDER / "coils.yaml").read_text(encoding="utf-8").split("\n")[1:]


def _skeleton(_: str) -> list[str]:
    """The lines of the skeleton, without the first, which is for editors."""
    return skeleton().split("\n")[1:]
