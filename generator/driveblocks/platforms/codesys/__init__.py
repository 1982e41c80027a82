"""CODESYS and its relatives, which import a dialect of PLCopen's XML."""

from driveblocks.platforms.record import Platform

RECORD = Platform(
    "codesys", 4, title="CODESYS and its relatives", where="a serial port of CODESYS", prefix="CD", parity=True
)
