"""The text of every block, from which all other forms are made: for the CI of a PLC project, and for reading."""

from driveblocks.platforms.record import Platform

RECORD = Platform("iec61131", 1, title="the text of each block")
