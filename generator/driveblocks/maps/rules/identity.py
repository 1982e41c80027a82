"""Rules on what a drive says of itself: of which family it is, who commands it, and its own maximum frequency."""

from collections.abc import Iterator
from itertools import combinations

from driveblocks.maps.form import address_text
from driveblocks.maps.model import Condition, Drive, Identity, InCommand, OwnMaximum
from driveblocks.maps.problem import Report
from driveblocks.maps.rules.access import known
from driveblocks.meaning.pattern import asked, of_condition


def check(drive: Drive, report: Report) -> None:
    """Note every rule that the identity, `commanded_by` or the own maximum break."""
    operation = drive.operation
    if drive.identity is not None:
        _conditions(drive.identity, report)
        _identity(drive, drive.identity, report)
    if operation.commanded_by is not None:
        _conditions(operation.commanded_by, report)
        for condition in operation.commanded_by.all:
            _in_command(drive, condition, report)
    if operation.own_maximum is not None:
        _own_maximum(drive, operation.own_maximum, report)


def _conditions(one: Identity | InCommand, report: Report) -> None:
    if not one.all:
        report.miss(one.place("all"), "without a condition it is true of every drive", "write the conditions")
    for earlier, later in combinations(one.all, 2):
        if of_condition(earlier).excludes(of_condition(later)):
            wrong = f"{address_text(later.register)} cannot have two values at once"
            report.add(later.place("equals"), wrong, "all conditions have to hold together; keep one of the two")


def _identity(drive: Drive, identity: Identity, report: Report) -> None:
    if identity.all and not any(asked(condition)[1] for condition in identity.all):
        wrong = "nothing but zeros proves no family: a register that is not in use may read 0, too"
        report.add(identity.place("all"), wrong, "ask for a code that the manual gives")
    moving = {*_written(drive), *_shown(drive)}
    for condition in identity.all:
        if condition.register in moving:
            wrong = f"{address_text(condition.register)} changes while the drive is in use"
            report.add(condition.place("register"), wrong, "name a register that holds one value for good")


def _written(drive: Drive) -> Iterator[int]:
    yield drive.operation.reference.register
    yield from (write.register for command in drive.operation.commands for write in command.writes)


def _shown(drive: Drive) -> Iterator[int]:
    operation = drive.operation
    yield from (condition.register for condition in operation.standstill.all)
    yield from (condition.register for status in operation.status for condition in status.any)
    yield from (measured.register for measured in operation.measures)
    yield from (state.register for state in operation.states)


def _in_command(drive: Drive, condition: Condition, report: Report) -> None:
    """Note a condition on what was set or written, which is not who is in command."""
    where, place = address_text(condition.register), condition.place("register")
    settings = {setting.register: setting.id for setting in drive.settings}
    if condition.register in settings:
        wrong = f"{where} holds the setting {settings[condition.register]}, which does not say who is in command now"
        report.add(place, wrong, "name a status register")
    elif condition.register in _written(drive):
        report.add(place, f"{where} holds what the PLC itself has written", "name a status register")


def _own_maximum(drive: Drive, maximum: OwnMaximum, report: Report) -> None:
    where, place = address_text(maximum.register), maximum.place("register")
    row = known(drive, maximum.register, "r", place, report)
    if row is None:
        return
    when = row.scale.when if row.scale else None
    parameter = drive.operation.reference.maximum
    if row.unit != "Hz" or row.scale is None:
        wrong = f"the drive's own maximum is compared in Hz, but {where} has no unit Hz with a scale"
        report.miss(place, wrong, "add both to the register where the manual gives them; else leave `own_maximum` out")
    elif row.scale.otherwise:
        wrong = f"the drive's own maximum, {where}, has several factors"
        report.add(place, wrong, "leave `own_maximum` out: its user sets `FullScaleHz`")
    elif when is not None and when not in drive.operation.reference.verify:
        wrong = f"the scale of {where} has a condition that nobody verifies"
        report.miss(place, wrong, "repeat the condition of `when` under `verify` of the reference")
    if maximum.register in (*_written(drive), *_shown(drive)):
        report.add(place, f"{where} changes while the drive is in use", "name the register that holds the limit")
    elif parameter is not None and row.id is not None and row.id != parameter:
        wrong = f"{where} is {row.id}, but 100 % of the reference is {parameter}"
        listed = any(each.id == parameter for _, each in drive.registers())
        there = "name the register" if listed else "add the row"
        report.add(place, wrong, f"{there} of {parameter}, or correct `maximum`")
