"""Rules on how the speed reference is given."""

from driveblocks.maps.form import address_text
from driveblocks.maps.model import Drive, Reference, Register
from driveblocks.maps.problem import Report
from driveblocks.maps.rules.access import known
from driveblocks.maps.rules.parameter import of_form


def check(drive: Drive, report: Report) -> None:
    """Note every rule that the reference breaks."""
    _reference(drive, drive.operation.reference, report)


def _reference(drive: Drive, reference: Reference, report: Report) -> None:
    row = known(drive, reference.register, "w", reference.place("register"), report)
    if row is None:
        return
    _reverses(drive, reference, row, report)
    if "PID" in f"{row.name} {row.text_zh}":
        wrong = f"{address_text(reference.register)} is called `{row.name}`, which is no speed reference"
        report.add(reference.place("register"), wrong, "name the register that takes the frequency")
    unit = "Hz" if reference.means == "frequency" else "%"
    if row.unit not in (None, unit):
        wrong = f"the reference means {reference.means}, but {address_text(reference.register)} has the unit {row.unit}"
        report.add(reference.place("means"), wrong, "correct one of them")
    when = row.scale.when if row.scale else None
    if when is not None and when not in reference.verify:
        wrong = f"the scale of {address_text(reference.register)} has a condition that nobody verifies"
        report.miss(reference.place("verify"), wrong, "repeat the condition of `when` under `verify`")
    _maximum(drive, reference, report)


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
    if not any(command.does in ("run_reverse", "jog_reverse") for command in drive.operation.commands):
        wrong = "a negative reference reverses, but no command does, and no block sends a negative reference"
        right = "add the command `run_reverse`, or say it in the `note` of the register instead"
        report.miss(place, wrong, right)


def _maximum(drive: Drive, reference: Reference, report: Report) -> None:
    if reference.maximum is None:
        if reference.means == "percent_of_maximum":
            wrong = "the reference is a percentage, but nothing says of what"
            report.miss(reference.at, wrong, "add `maximum` with the id of that parameter")
        return
    of_form(drive, reference, reference.maximum, report, "maximum")
    ids = {row.id for _, row in drive.registers()} | {setting.id for setting in drive.settings}
    if reference.maximum not in ids:
        wrong = f"there is no parameter `{reference.maximum}`"
        report.miss(reference.place("maximum"), wrong, "name the id of a register or setting")
