"""What a drive measures, and the pins of a drive block that show it."""

from dataclasses import dataclass, replace
from typing import NamedTuple

from driveblocks.maps.model import Drive, kept
from driveblocks.maps.names import UNIT_NAMES
from driveblocks.meaning.citation import Citation, cited
from driveblocks.meaning.quantity import Quantity, quantity


class Pin(NamedTuple):
    """A pin that shows a measure: its name, its unit, and the setting that replaces a scale, where there is one."""

    name: str
    unit: str
    setting: str

    @property
    def pin(self) -> str:
        """Where a drive block shows it: two have pins of their own, the rest are members of Diagnosis."""
        return f"{'' if self.setting in PINNED else 'Diagnosis.'}{self.name}{self.unit}"

    @property
    def valid(self) -> str:
        """The member of Diagnosis that says whether it is valid."""
        return f"{self.name}Valid"


PINNED = ("FrequencyScale", "CurrentScale")
"""Settings of the measures that are outputs of the block."""
PINS = {
    "output_frequency": Pin("OutputFrequency", "Hz", "FrequencyScale"),
    "output_current": Pin("OutputCurrent", "A", "CurrentScale"),
    "output_voltage": Pin("OutputVoltage", "V", "VoltageScale"),
    "dc_bus_voltage": Pin("DcBusVoltage", "V", "DcVoltageScale"),
    "output_power": Pin("OutputPower", "KW", "PowerScale"),
    "output_speed": Pin("OutputSpeed", "Rpm", ""),
    "output_torque": Pin("OutputTorque", "Percent", ""),
    "relative_power": Pin("RelativePower", "Percent", ""),
    "drive_temperature": Pin("DriveTemperature", "DegC", ""),
    "motor_temperature": Pin("MotorTemperature", "DegC", ""),
    "operating_time": Pin("OperatingTime", "H", ""),
    "energy": Pin("Energy", "KWh", ""),
    "motor_torque": Pin("MotorTorque", "Nm", ""),
}
"""What a register can show -> its pin."""


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
    return found if UNIT_NAMES.get(found.unit or "") == PINS[name].unit else replace(found, factors=())


@kept
def own_maximum(drive: Drive) -> Measure | None:
    """The drive's own maximum frequency, or what 100 % is, where it can be read."""
    one = drive.operation.own_maximum
    return Measure("own maximum", cited(one), one.register, quantity(drive, one.register)) if one else None
