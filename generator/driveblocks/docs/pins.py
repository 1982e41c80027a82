"""The pins of a block as a page shows them, read from the block's typed tree."""

import re
from dataclasses import dataclass

from structured_text.language.tree import FunctionBlock, Literal, VarDecl, VarKind

GROUPS = {
    "Enable": "command", "SpeedReferenceHz": "speed", "Address": "drive", "MonitorOnly": "mode",
    "ManualChecked": "map and settings", "CommOk": "state", "Warning": "fault and reason", "StopConfirmed": "stop",
    "OutputFrequencyHz": "values", "Error": "error", "Diagnosis": "diagnosis",
}  # fmt: skip
"""First pin of a group -> what the group is about."""
RANGES = {
    "SpeedReferenceHz": "0.0 to `MaximumHz`",
    "MaximumHz": "0.1 to 10000.0",
    "FullScaleHz": "0.1 to 10000.0",
    "StopWithinMs": "1 to 65534",
}
"""What the type alone does not say."""
BOUNDS = {"USINT": "0 to 255", "UINT": "0 to 65535", "REAL": "0.0 to 1.0E6"}
UNITS = {
    "Hz": "Hz", "Ms": "ms", "A": "A", "V": "V", "KW": "kW", "Rpm": "r/min", "Percent": "%", "DegC": "°C", "H": "h",
    "KWh": "kWh",
}  # fmt: skip
SCALES = {
    "ReferenceScale": "counts/Hz", "FrequencyScale": "Hz/count", "CurrentScale": "A/count", "VoltageScale": "V/count",
    "DcVoltageScale": "V/count", "PowerScale": "kW/count",
}  # fmt: skip
_MUST = "required: "
_UNIT = re.compile(r"[a-z](Hz|Ms|A|V|KWh?|Rpm|Percent|DegC|H)$")
_SAID = re.compile(r"^required: |, [\d.]+ to [\d.]+(?= Hz| ms|;)|,? (?:ms|Hz|A|V|kW)(?=$|;)")
"""What has a column of its own: whether it is required, its range, its unit."""
SAYS = {"SpeedReferenceHz": "requested speed"}
"""Where the range is all that the block says."""
_IDLE = re.compile(r"not needed here|not needed: .*|always FALSE.*|the drive does not show it")


@dataclass(frozen=True)
class Pin:
    name: str
    type: str
    unit: str
    group: str
    """What the group is about that begins with it; empty inside a group."""
    range: str
    default: str
    says: str
    required: bool
    idle: bool
    """This family has no use for it."""


def pins(block: FunctionBlock, kind: VarKind, ranges: dict[str, str]) -> list[Pin]:
    """The pins of a kind, in the order of declaration; `ranges` are those that differ from drive to drive."""
    found = [one for group in block.blocks if group.kind is kind for one in group.variables]
    return [_pin(one, RANGES | ranges) for one in found]


def _pin(one: VarDecl, ranges: dict[str, str]) -> Pin:
    said = " ".join(one.trailing.text.split()) if one.trailing else ""
    type_ = one.type.name
    unit = unit_of(one.name)
    idle = _IDLE.fullmatch(said) is not None
    bounds = BOUNDS.get(type_, "") if one.kind is VarKind.INPUT else ""
    # a unit address of 0 is none, and a slot is no request
    required = said.startswith(_MUST) or one.name in {"Address", "Slot"}
    return Pin(
        name=one.name,
        type=type_,
        unit=unit,
        group=GROUPS.get(one.name, ""),
        range="" if idle else ranges.get(one.name, bounds),
        default="" if required else _default(one),
        says=SAYS.get(one.name) or (_SAID.sub("", said) if unit or one.name == "Address" else said.removeprefix(_MUST)),
        required=required and not idle,
        idle=idle,
    )


def unit_of(name: str) -> str:
    """The unit that the last part of a name gives, or that of a scale; empty if it gives none."""
    unit = _UNIT.search(name)
    return SCALES.get(name) or (UNITS[unit[1]] if unit else "")


def _default(one: VarDecl) -> str:
    """The value of a pin that nothing is wired to."""
    if isinstance(one.initial, Literal):
        return one.initial.text
    return {"BOOL": "FALSE", "REAL": "0.0", "MB_Slot": "", "VFD_Settings": "all 0"}.get(one.type.name, "0")
