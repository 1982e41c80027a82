"""Explainers of the shipped drives, of the example, and of the standard alone."""

from pathlib import Path

from tests import shipped

from driveblocks.desk.explain.explanation import Explainer, Explanation
from driveblocks.desk.explain.paste import read
from driveblocks.maps.load import load
from driveblocks.modbus.frame import seal

EXAMPLE = Path(__file__).parents[2] / "maps" / "example.yaml"


class Explain:
    """Explains frames by the prefix of a drive; "" is the standard."""

    def __init__(self) -> None:
        """Load every map once."""
        drives = {"EX100": load(EXAMPLE), **shipped.drives()}
        self.of = {"": Explainer(), **{prefix: Explainer(drive) for prefix, drive in drives.items()}}

    def __call__(self, prefix: str, frame: str, request: str | None = None) -> Explanation:
        """Explain a pasted frame."""
        return self.of[prefix].explain(read(frame), read(request, "request") if request is not None else None)


def rtu(body: str) -> str:
    """A frame with a right CRC."""
    return seal("rtu", bytes.fromhex(body)).hex(" ")
