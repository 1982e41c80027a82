"""The members of a drive block's two structures as a page shows them: their comments, and what the map adds."""

import re
from collections.abc import Iterator
from dataclasses import dataclass

from driveblocks.docs.pins import SCALES, unit_of
from driveblocks.maps.form import address_text
from driveblocks.maps.model import Drive
from driveblocks.meaning.conduct import reply_delay
from driveblocks.meaning.measure import PINS
from driveblocks.meaning.reference import reference
from driveblocks.meaning.status import status
from driveblocks.meaning.words import words
from driveblocks.render.drive import drive_block
from structured_text.language.tree import StructSpec, TypeDecl, VarDecl

MAP_HAS = "no use: the map has the scale"
NOT_SHOWN = "no use: the drive does not show it"
SAYS = {
    "ReferenceScale": "scale of the reference, where the manual gives none",
    **{key: f"scale of `{name}{unit}`, where the manual gives none" for name, unit, key in PINS.values() if key},
    "OutputVoltageV": "output voltage", "DcBusVoltageV": "voltage of the DC bus", "OutputPowerKW": "output power",
    "OutputSpeedRpm": "output speed, without its sign", "OutputTorquePercent": "torque, of the rated torque",
    "RelativePowerPercent": "output power, of the rated power", "DriveTemperatureDegC": "temperature of the drive",
    "MotorTemperatureDegC": "temperature of the motor", "OperatingTimeH": "operating hours", "EnergyKWh": "energy",
    "MotorTorqueNm": "torque of the motor",
    **{f"{name}Valid": f"`{name}{unit}` is fresh, and its scale known" for name, unit, _ in PINS.values()},
}  # fmt: skip
"""Where a comment leans on the line above it."""
ZEROS = {"KeepWord": "all of them 0", "PolePairs": "not set", **dict.fromkeys(SCALES, "not set")}
_ZERO = re.compile(r"; 0(?: or 65535)?: (?P<zero>[^;]+)")
_UNITS = re.compile(r",? (?:ms|Hz|A|V|kW)(?=;|$)|^(?:ms|Hz|A|V|kW)$")
_ABILITIES = {
    "CanReverse": "run_reverse", "CanJog": "jog_forward", "CanQuickStop": "quick_stop", "CanCoastStop": "coast_stop",
    "CanResetFault": "fault_reset",
}  # fmt: skip
"""Member -> the command that a drive has if it is TRUE."""
_AT_FAULT = {"FirstFaultHz": "output_frequency", "FirstFaultA": "output_current", "FirstFaultV": "dc_bus_voltage"}


@dataclass(frozen=True)
class Member:
    """One member: what it is called, holds and means, what 0 means, and what there is to say of it for this family."""

    name: str
    type: str
    unit: str
    says: str
    zero: str
    family: str
    required: bool


def members(declared: TypeDecl, drive: Drive) -> list[Member]:
    """The members of VFD_Settings or VFD_Diagnosis, in the order of declaration."""
    assert isinstance(declared.spec, StructSpec)  # noqa: S101  (both are structures)
    facts = dict([*_settings(drive), *_diagnosis(drive)])
    settings = declared.name == "VFD_Settings"
    return [_member(one, facts.get(one.name, ""), settings=settings) for one in declared.spec.fields]


def _member(one: VarDecl, family: str, *, settings: bool) -> Member:
    """A member; what 0 means stands apart where it is to be set."""
    said = " ".join(one.trailing.text.split()) if one.trailing else ""
    zero = _ZERO.search(said) if settings else None
    unit = unit_of(one.name)
    return Member(
        name=one.name,
        type=one.type.name,
        unit=unit,
        says=SAYS.get(one.name) or _UNITS.sub("", _ZERO.sub("", said) if zero else said),
        zero=_zero(zero["zero"], unit) if zero else ZEROS.get(one.name, ""),
        family=family,
        required=family.startswith("required"),
    )


def _zero(said: str, unit: str) -> str:
    return f"{said} {unit}" if said.isdigit() else said


def _settings(drive: Drive) -> Iterator[tuple[str, str]]:
    block, speed = drive_block(drive), reference(drive)
    word = address_text(speed.register)
    missing = f"required: the manual gives no scale of {word}"
    yield "ReferenceScale", MAP_HAS if speed.scaled else missing
    turns = f"required: {word} is in r/min" if speed.in_rpm else "no use: the reference is not in r/min"
    yield "PolePairs", turns
    for shows, (_, _, setting) in PINS.items():
        measure = block.showing.measures.get(shows)
        if not setting:
            continue
        if measure is None:
            yield setting, NOT_SHOWN
        elif measure.scale:
            yield setting, MAP_HAS
        else:
            yield setting, f"of {measure.word.address_text}: without it `{measure.at.pin}` is the raw count"
    keeps = [f"16#{mask:04X} of {address_text(register)}" for register, mask in block.ordering.keeps.items()]
    yield "KeepWord", ", ".join(keeps) or "no use: no bit is left over"
    if (delay := reply_delay(drive)) is not None:
        yield "TurnRoundMs", f"the drive answers later {delay}"


def _diagnosis(drive: Drive) -> Iterator[tuple[str, str]]:
    """What the block can say of a drive, and what it cannot."""
    found = drive_block(drive).showing.measures
    for shows, (name, unit, setting) in PINS.items():
        says = "" if shows in found else "always 0: the drive does not show it"
        valid = f"FALSE without `{setting}`" if shows in found and not found[shows].scale else ""
        yield f"{name}{unit}", f"from {found[shows].word.address_text}" if shows in found else says
        yield PINS[shows].valid, valid or ("always FALSE" if says else "")
    for name, shows in _AT_FAULT.items():
        if shows not in found:
            yield name, "always 0: the drive does not show it"
    coded = f"see `{drive.prefix}_WarningText`" if drive.warnings else "always 0: the map has no warning codes"
    yield "WarningCode", coded
    if not status(drive).shows("limit"):
        yield "LimitActive", "always FALSE: the drive does not show it"
    for name, does in _ABILITIES.items():
        yield name, "TRUE" if does in words(drive).named else "FALSE"
