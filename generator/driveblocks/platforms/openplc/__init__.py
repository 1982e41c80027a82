"""OpenPLC, and every other compiler of plain text."""

from driveblocks.platforms.record import Platform

RECORD = Platform("openplc", 2, title="OpenPLC and plain text")
