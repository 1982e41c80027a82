"""What a map of an earlier format has to say instead."""

from driveblocks.maps.nodes import Entries, Node, Scalar
from driveblocks.maps.problem import Report

_RIGHT = (
    "write `format: 2`, and beside each bit and value of a command register what it `does` at 1, and `at_0` where "
    "that is something, too: names decide nothing; each place is named"
)
INSTEAD = {
    ("feeds", "read"): "write `reads`",
    ("feeds", "reference"): "write `writes`, or the register of the reference under `fed_by`",
    ("feeds", "run"): "write `writes`, or the register of the commands under `fed_by`",
}
"""By a key and what it said in format 1."""


def renewed(root: Node | None, noted: Report | None = None) -> Node | None:
    """The same map as one of this format, so that all that is to be changed in it is told at once; noted, if asked."""
    said = root.entries["format"][1] if isinstance(root, Entries) and "format" in root.entries else None
    if not isinstance(root, Entries) or not isinstance(said, Scalar) or said.text != "1":
        return root
    if noted:
        noted.add(said.at, "`format: 1` is the form of earlier maps", _RIGHT)
    key, _ = root.entries["format"]
    return Entries(root.entries | {"format": (key, said._replace(text="2"))}, root.at)
