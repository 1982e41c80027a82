"""The serial port of a runtime on Linux that takes C: OpenPLC Runtime v3 and Beremiz, which are built by matiec."""

from driveblocks.platforms.record import Platform

RECORD = Platform("linux", 7, where="a serial port of Linux", prefix="LX", parity=True, busy=False)
