"""Rules on how the speed reference is given, and on what the pins of the drive block show."""

from decimal import Decimal

from driveblocks.maps.form import address_text
from driveblocks.maps.model import Drive, Forbidding, Measured, Operation, Reference, Register, Status
from driveblocks.maps.names import UNIT_NAMES
from driveblocks.maps.problem import Report
from driveblocks.maps.rules.access import cyclic, known
from driveblocks.maps.rules.parameter import of_form
from driveblocks.maps.rules.unique import unique
from driveblocks.meaning.measure import PINS
from driveblocks.meaning.pattern import asked

_UNITS = {name: unit for unit, name in UNIT_NAMES.items()}
"""The last part of a pin's name -> the unit that it shows its value in."""
_PARTS = {"percent_of_maximum": "percentage", "fraction_of_full_scale": "fraction"}
_LEAST_HZ, _MOST_HZ = Decimal("0.1"), Decimal(10_000)
"""What 100 % can be."""


def check(drive: Drive, report: Report) -> None:
    """Note every rule that the reference, the status or the measures break."""
    operation = drive.operation
    _reference(drive, operation.reference, report)
    if operation.lower_limit is not None:
        _parameter(drive, operation, "lower_limit", report)
    shown = unique(operation.status, "shows", "status", report)
    if "running" not in shown:
        wrong = "nothing says whether the drive runs"
        report.miss(operation.place("status"), wrong, "add `shows: running` with the bits or values that say so")
    signs: tuple[Status | Forbidding, ...] = (*operation.status, *operation.forbids)
    for sign in signs:
        _any(drive, sign, report)
    unique(operation.measures, "shows", "measure", report)
    for measured in operation.measures:
        _measured(drive, measured, report)


def _any(drive: Drive, sign: Status | Forbidding, report: Report) -> None:
    if not sign.any:
        what = f"`{sign.shows}`" if isinstance(sign, Status) else "what forbids a start"
        report.miss(sign.place("any"), f"{what} has no condition", "write those that show it")
    for condition in sign.any:
        row = drive.register_at(condition.register)
        if row is not None and row.masks and condition.mask is None:
            wrong = f"the values of {address_text(condition.register)} are bits that may combine"
            report.add(condition.place("equals"), wrong, f"add `mask: {asked(condition)[1]}`")


def _measured(drive: Drive, measured: Measured, report: Report) -> None:
    place = measured.place("register")
    row = known(drive, measured.register, "r", place, report)
    pin = PINS[measured.shows]
    unit = _UNITS[pin.unit]
    if row is not None and (row.values or row.bits):
        wrong = f"{address_text(measured.register)} lists {'values' if row.values else 'bits'}"
        report.add(place, f"{wrong}, which are no {measured.shows}", "name the register that holds the number")
    elif row is not None and row.unit not in (None, unit):
        wrong = f"`{measured.shows}` is shown in {unit}, but {address_text(measured.register)} has the unit {row.unit}"
        report.add(place, wrong, "name another register, or correct its `unit`")
    elif row is not None and not (pin.setting or (row.unit and row.scale)):
        wrong = f"`{measured.shows}` is shown in {unit}, but {address_text(measured.register)} has no unit with a scale"
        report.miss(place, wrong, "add both to the register where the manual gives them; else leave the measure out")
    elif row is not None and row is drive.register_at(drive.operation.reference.register, "w"):
        wrong = f"`{measured.shows}` is shown by {address_text(measured.register)}, which the PLC itself has written"
        report.add(place, wrong, "name the register that measures it")


def _reference(drive: Drive, reference: Reference, report: Report) -> None:
    row = cyclic(drive, reference.register, reference.place("register"), report)
    if row is None:
        return
    _reverses(drive, reference, row, report)
    _full_scale(reference, row, report)
    unit = {"frequency": "Hz", "speed": "r/min"}.get(reference.means, "%")
    if row.unit not in (None, unit):
        wrong = f"the reference means {reference.means}, but {address_text(reference.register)} has the unit {row.unit}"
        other = f"blocks command Hz, % or r/min: a reference in {row.unit} has no block; look for one in the manual"
        known_unit = row.unit in ("Hz", "%", "r/min")
        report.add(reference.place("means"), wrong, "correct one of them" if known_unit else other)
    when = row.scale.when if row.scale else None
    if row.scale is not None and row.scale.otherwise:
        wrong = (
            f"the reference {address_text(reference.register)} has several factors, and a wrong one is another speed"
        )
        right = "keep the one that `verify` asks for, or leave `scale` out: then the user sets `ReferenceScale`"
        report.add(row.scale.place("otherwise"), wrong, right)
    elif when is not None and when not in reference.verify:
        wrong = f"the scale of {address_text(reference.register)} has a condition that nobody verifies"
        report.miss(reference.place("verify"), wrong, "repeat the condition of `when` under `verify`")
    _maximum(drive, reference, report)


def _full_scale(reference: Reference, row: Register, report: Report) -> None:
    """Note a fraction whose full scale is missing or does not fit its register, and a full scale of what is none."""
    where, count = address_text(reference.register), reference.full_scale
    if reference.means != "fraction_of_full_scale":
        for key in ("full_scale", "full_scale_hz"):
            if getattr(reference, key) is not None:
                wrong = f"`{key}` belongs to a `fraction_of_full_scale`, not to a {reference.means}"
                report.add(reference.place(key), wrong, "remove it, or correct `means`")
        return
    highest = row.range.max if row.range else 0x7FFF if row.signed else 0xFFFF
    if count is None:
        wrong = "the reference is a fraction, but nothing says which word is full scale"
        report.miss(reference.at, wrong, "add `full_scale`, such as 4000H")
    elif not 0 < count <= highest:
        wrong = f"the full scale {count} does not fit {where}, which holds at most {highest}"
        report.add(reference.place("full_scale"), wrong, "correct it, or `signed` or `range` of the register")
    if reference.full_scale_hz is not None and not _LEAST_HZ <= reference.full_scale_hz <= _MOST_HZ:
        wrong = f"a full scale of {reference.full_scale_hz} Hz"
        report.add(reference.place("full_scale_hz"), wrong, f"write {_LEAST_HZ} to {_MOST_HZ}")
    if row.scale is not None:
        wrong = f"{where} has a scale, and `full_scale` says what a word of it means"
        report.add(reference.place("full_scale" if count is not None else "means"), wrong, "keep one of them")


def _reverses(drive: Drive, reference: Reference, row: Register, report: Report) -> None:
    """Note a negative reference that the register cannot hold, or on a drive that no pin can reverse."""
    if not reference.negative_reverses:
        return
    where, place = address_text(reference.register), reference.place("negative_reverses")
    if not row.signed:
        report.add(place, f"a negative reference, but {where} is not signed", "add `signed: true` to the register")
    elif row.range is not None and row.range.min >= 0:
        wrong = f"a negative reference, but the range of {where} starts at {row.range.min}"
        report.add(place, wrong, "correct the range, or remove `negative_reverses`")
    elif row.range is not None and drive.operation.by_sign and row.range.min != -row.range.max:
        wrong = f"a negative reference reverses, but {where} holds {row.range.min} to {row.range.max}"
        report.add(row.place("range"), wrong, "both ends are the same number; correct one, or leave the range out")
    if not any(command.does in ("run_reverse", "jog_reverse") for command in drive.operation.commands):
        wrong = "a negative reference reverses, but no command does, and no block sends a negative reference"
        right = "add the command `run_reverse`, or say it in the `note` of the register instead"
        report.miss(place, wrong, right)


def _maximum(drive: Drive, reference: Reference, report: Report) -> None:
    if reference.maximum is None:
        if reference.means in _PARTS and reference.full_scale_hz is None:
            wrong = f"the reference is a {_PARTS[reference.means]}, but nothing says of what"
            report.miss(reference.at, wrong, "add `maximum` with the id of that parameter")
        return
    if reference.full_scale_hz is not None:
        wrong = "a parameter holds what 100 % is, or it is given for good"
        report.add(reference.place("full_scale_hz"), wrong, "remove it, or `maximum`")
    _parameter(drive, reference, "maximum", report)


def _parameter(drive: Drive, entry: Reference | Operation, key: str, report: Report) -> None:
    """Note a parameter that the map does not have."""
    id_ = getattr(entry, key)
    of_form(drive, entry, id_, report, key)
    ids = {row.id for _, row in drive.registers()} | {setting.id for setting in drive.settings}
    if id_ not in ids:
        report.miss(entry.place(key), f"there is no parameter `{id_}`", "name the id of a register or setting")
