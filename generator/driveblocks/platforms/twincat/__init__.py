"""TwinCAT 3."""

from driveblocks.platforms.record import Platform

RECORD = Platform(
    "twincat", 5, title="TwinCAT 3", where="a serial terminal of Beckhoff", prefix="TC", drawn="a POU in LD"
)
