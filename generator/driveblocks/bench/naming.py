"""Names of a drive's blocks: its prefix, and the register's name as the reference model makes it."""

from driveblocks.maps.model import Drive, Register
from driveblocks.reference.naming import name_of

UNITS = {
    "Hz": "Hz", "A": "A", "V": "V", "kW": "KW", "W": "W", "%": "Percent", "r/min": "Rpm", "Nm": "Nm", "s": "S",
    "ms": "Ms", "h": "H", "°C": "DegC", "kHz": "KHz", "Ohm": "Ohm", "kWh": "KWh",
}  # fmt: skip
"""A unit as the last part of a name."""


def register_block(drive: Drive, row: Register) -> str:
    return f"{drive.prefix}_{name_of(row)}"


def scale_block(drive: Drive, row: Register) -> str:
    """The function that gives a register's engineering value; the row has a scale."""
    return f"{drive.prefix}_{name_of(row)}{UNITS[row.unit] if row.unit else ''}"
