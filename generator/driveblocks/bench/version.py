"""The program for what a PLC can ask about its library."""

from collections.abc import Iterator

from driveblocks import __version__
from driveblocks.bench import kit
from driveblocks.bench.script import Script
from driveblocks.maps.model import Drive
from driveblocks.maps.revision import revision

ABI = 4
"""What the heads of the shared types say."""
HALF = 1 << 16


def scripts(drive: Drive, stem: str) -> Iterator[Script]:
    """One program: ABI, version, revision, and nothing for an item that does not exist."""
    program = kit.script(drive, stem, "Version", "which library this is")
    parts = [int(part) for part in __version__.split(".")[:3]]
    version = sum(part * 100**place for place, part in enumerate(reversed(parts)))
    for item, (what, wanted) in enumerate(
        {"ABI": ABI, "version": version, "revision of the map": revision(drive), "no such item": 0}.items()
    ):
        asked = f"{drive.prefix}_Version(Item := {item})"
        program.stage(
            what,
            kit.is_number(f"UDINT_TO_UINT({asked} / {HALF})", wanted // HALF, f"{what}, high word"),
            kit.is_number(f"UDINT_TO_UINT({asked} MOD {HALF})", wanted % HALF, f"{what}, low word"),
        )
    yield program
