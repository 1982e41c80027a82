"""Rules on what proves standstill: a status that says so, and an output frequency of 0, both at once."""

from dataclasses import replace

from driveblocks.maps.form import Span, address_text
from driveblocks.maps.model import Bit, Condition, Drive, Value
from driveblocks.maps.problem import Report
from driveblocks.maps.rules.condition import bit_at, exclude
from driveblocks.maps.rules.term import negated, wanted

_SPEED = ("frequency", "speed", "频率", "转速", "速度")
_STANDS = ("stop", "standby", "standstill", "zero speed", "停", "待机", "零速")
_TURNS = ("running", "turning", "rotating", "operating", "operation enabled", "运行", "运转", "正转", "反转", "旋转")
_OTHER = ("fault", "error", "故障")
"""Words for a state in which the motor may be at standstill or turn."""


def check(drive: Drive, report: Report) -> None:
    proof = drive.operation.standstill
    place, before = proof.place("all"), len(report.problems)
    if len({condition.register for condition in proof.all}) < 2:
        right = "ask for the status and for an output frequency of 0"
        report.miss(place, "one register alone does not prove standstill", right)
    if not any(_says_frequency_is_0(drive, condition) for condition in proof.all):
        wrong = "no condition says that an output frequency or speed is 0"
        report.miss(place, wrong, "add {register: its address, equals: 0}")
    verdicts = [_verdict(drive, condition) for condition in proof.all]
    if True not in verdicts and False not in verdicts:
        wrong = "no condition on the status says that the drive does not run"
        report.miss(place, wrong, "ask for a status bit or value that is called running, stopped or standby")
    for condition, stands in zip(proof.all, verdicts, strict=True):
        if stands is False:
            asked = _called(drive, condition)[0] or f"{condition.equals:04X}H"
            wrong = f"standstill asks {address_text(condition.register)} for `{asked}`"
            report.add(condition.place("equals"), wrong, "ask for the state in which the motor is at standstill")
    if len(report.problems) == before:
        _while_running(drive, report)


def _while_running(drive: Drive, report: Report) -> None:
    """Note a condition of `running` that can hold while standstill is proved."""
    runs = (status.any for status in drive.operation.status if status.shows == "running")
    for condition in (condition for some in runs for condition in some):
        if not any(exclude(condition, other) for other in drive.operation.standstill.all):
            wrong = "the drive can be running while standstill is proved"
            report.miss(condition.at, wrong, "let standstill ask the same bits for another value")


def _says_frequency_is_0(drive: Drive, condition: Condition) -> bool:
    row = drive.register_at(condition.register)
    words = f"{row.name or ''} {row.text_zh or ''}".lower() if row is not None else ""
    is_speed = _hold(words, _SPEED) and not wanted(words)
    return condition.bit is None and condition.mask is None and condition.equals == 0 and is_speed


def _verdict(drive: Drive, condition: Condition) -> bool | None:
    """Whether a condition asks for a state that is called standstill (True) or not (False), or None.

    Of the bits of a mask, one that is called so is enough.
    """
    if condition.mask is None:
        return _verdict_of(drive, condition)
    places = [place for place in range(16) if condition.mask >> place & 1]
    single = (replace(condition, mask=None, bit=Span(n, n), equals=condition.equals >> n & 1) for n in places)
    found = {_verdict_of(drive, one) for one in single}
    return next((verdict for verdict in (False, True) if verdict in found), None)


def _verdict_of(drive: Drive, condition: Condition) -> bool | None:
    words, is_bit = _called(drive, condition)[1], _bit(drive, condition) is not None
    stands, turns = _hold(words, _STANDS), _hold(words, _TURNS if is_bit else (*_TURNS, *_OTHER))
    if (not stands and not turns) or (is_bit and negated(words)):
        return None
    return (stands and not turns) == (bool(condition.equals) or not is_bit)


def _called(drive: Drive, condition: Condition) -> tuple[str, str]:
    """What the register calls the awaited value or bit: its name, and all words for it in lower case."""
    named = _bit(drive, condition) or _value(drive, condition)
    return (named.name or "", f"{named.name} {named.text_zh or ''}".lower()) if named is not None else ("", "")


def _bit(drive: Drive, condition: Condition) -> Bit | Value | None:
    """The single bit that a condition asks for, where its values have no names of their own."""
    row = drive.register_at(condition.register)
    if row is None or condition.bit is None:
        return None
    bit = bit_at(row, condition.bit.first)
    if row.masks:
        return next((value for value in row.values if value.value == 1 << condition.bit.first), None)
    return bit if bit is not None and not bit.values and len(bit.bit) == 1 else None


def _value(drive: Drive, condition: Condition) -> Value | None:
    row = drive.register_at(condition.register)
    bit = bit_at(row, condition.bit.first) if row is not None and condition.bit else None
    values = bit.values if bit is not None else row.values if row is not None and condition.bit is None else ()
    return next((value for value in values if value.value == condition.equals), None)


def _hold(words: str, some: tuple[str, ...]) -> bool:
    return any(word in words for word in some)
