"""What a drive measures, and the pins of a drive block that show it."""

from dataclasses import dataclass, replace

from driveblocks.maps.model import Drive, kept
from driveblocks.maps.names import UNIT_NAMES
from driveblocks.meaning.citation import Citation, cited
from driveblocks.meaning.quantity import Quantity, quantity

PINS = {
    "output_frequency": ("OutputFrequency", "Hz", "FrequencyScale"),
    "output_current": ("OutputCurrent", "A", "CurrentScale"),
    "output_voltage": ("OutputVoltage", "V", "VoltageScale"),
    "dc_bus_voltage": ("DcBusVoltage", "V", "DcVoltageScale"),
    "output_power": ("OutputPower", "KW", "PowerScale"),
    "output_speed": ("OutputSpeed", "Rpm", ""),
    "output_torque": ("OutputTorque", "Percent", ""),
    "relative_power": ("RelativePower", "Percent", ""),
    "drive_temperature": ("DriveTemperature", "DegC", ""),
    "motor_temperature": ("MotorTemperature", "DegC", ""),
    "operating_time": ("OperatingTime", "H", ""),
    "energy": ("Energy", "KWh", ""),
}
"""What a register can show -> the pin, its unit, and the setting that replaces a scale, where there is one."""


@dataclass(frozen=True)
class Measure:
    """A measure, and its number; a scale in another unit than the pin's is none."""

    name: str
    said: Citation
    register: int
    quantity: Quantity


@kept
def measures(drive: Drive) -> tuple[Measure, ...]:
    """What a drive measures."""
    return tuple(
        Measure(one.shows, cited(one), one.register, _shown(drive, one.shows, one.register))
        for one in drive.operation.measures
    )


def _shown(drive: Drive, name: str, register: int) -> Quantity:
    found = quantity(drive, register)
    return found if UNIT_NAMES.get(found.unit or "") == PINS[name][1] else replace(found, factors=())


@kept
def own_maximum(drive: Drive) -> Measure | None:
    """The drive's own maximum frequency, or what 100 % is, where it can be read."""
    one = drive.operation.own_maximum
    return Measure("own maximum", cited(one), one.register, quantity(drive, one.register)) if one else None
