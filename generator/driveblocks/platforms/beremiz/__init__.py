"""Beremiz, and what else reads PLCopen's exchange format in its neutral form, TC6 2.01."""

from driveblocks.platforms.record import Platform

RECORD = Platform("beremiz", 3, title="Beremiz and PLCopen XML", yours="DriveBlocks/")
