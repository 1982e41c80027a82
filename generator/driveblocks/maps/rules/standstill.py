"""Rules on what proves standstill: no sign of a run, and an output frequency of 0 or near it, all at once."""

from driveblocks.maps.model import Drive
from driveblocks.maps.problem import Report
from driveblocks.maps.rules.condition import pattern
from driveblocks.meaning.pattern import WORD, Pattern

_MOST_HZ = 2
"""A motor turns at a frequency above this."""
_FREQUENCIES, _UNITS = ("output_frequency", "output_speed"), ("Hz", "r/min", None)


def check(drive: Drive, report: Report) -> None:
    """Note a proof that a running motor gives as well."""
    proof = drive.operation.standstill
    asked = [pattern(drive, condition) for condition in proof.all]
    runs = [
        (one, pattern(drive, one)) for each in drive.operation.status if each.shows == "running" for one in each.any
    ]
    place, registers = proof.place("all"), {one.register for one in asked}
    if len(registers) < 2 and not registers & {one.register for _, one in runs}:
        right = "ask for the status and for an output frequency of 0"
        report.miss(place, "one register alone does not prove standstill", right)
    if not any(_is_near_0(drive, [one for one in asked if one.register == each]) for each in registers):
        wrong = "no condition says that an output frequency or speed is 0, or near it"
        right = "add {register: its address, equals: 0}; or `below`, of a signed one `above`, too, up to 2 Hz"
        report.miss(place, wrong, right)
    for condition, one in runs:
        if not any(one.excludes(other) for other in asked):
            wrong = f"`running` is shown by {one}, which may be while standstill is proved"
            report.miss(condition.at, wrong, "let standstill ask the same bits for another value")


def _is_near_0(drive: Drive, asked: list[Pattern]) -> bool:
    """Whether what is asked of one register holds for a frequency or speed of 0, and for none at which a motor turns.

    Where the map measures neither, a number will do that no block writes, in a unit of theirs or in none.
    """
    register = asked[0].register
    measured, row = {one.register: one.shows for one in drive.operation.measures}, drive.register_at(register)
    if row is None or row.values or row.bits or row.unit not in _UNITS:
        return False
    written = [drive.operation.reference, *(each for one in drive.operation.commands for each in one.writes)]
    if measured.get(register) not in _FREQUENCIES and (
        {*measured.values()} & {*_FREQUENCIES}
        or register in measured
        or any(row is drive.register_at(each.register, "w") for each in written)
    ):
        return False
    counts = int(_MOST_HZ / row.scale.factor) if row.scale and row.unit == "Hz" and row.scale.factor > 0 else 0x3FFF
    beyond = {0x8000, 0x7FFF, min(counts + 1, 0x7FFF), WORD - counts if row.signed else WORD}
    return all(one.mask == WORD and one.holds(0) for one in asked) and not any(
        all(one.holds(word) for one in asked) for word in beyond
    )
