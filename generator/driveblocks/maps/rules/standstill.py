"""Rules on what proves that the motor stands: a status that says so, and an output frequency of 0, both at once."""

from driveblocks.maps.form import address_text
from driveblocks.maps.model import Bit, Condition, Drive, Value
from driveblocks.maps.problem import Report
from driveblocks.maps.rules.condition import bit_at

_SPEED = ("frequency", "speed", "频率", "转速", "速度")
_WANTED = ("set ", "setting", "reference", "command", "target", "设定", "给定", "指令", "目标")
"""Words for a frequency that is asked for: it may be 0 while the motor turns."""
_STANDS = ("stop", "standby", "standstill", "zero speed", "停", "待机", "零速")
_TURNS = ("running", "turning", "rotating", "运行", "运转", "正转", "反转", "旋转")
_OTHER = ("fault", "error", "故障")
"""Words for a state in which the motor may stand or turn."""


def check(drive: Drive, report: Report) -> None:
    """Note every rule that the proof of standstill breaks."""
    proof = drive.operation.standstill
    place = proof.place("all")
    if len({condition.register for condition in proof.all}) < 2:
        right = "ask for the status and for an output frequency of 0"
        report.miss(place, "one register alone does not prove standstill", right)
    if not any(_says_frequency_is_0(drive, condition) for condition in proof.all):
        wrong = "no condition says that an output frequency or speed is 0"
        report.miss(place, wrong, "add {register: its address, equals: 0}")
    verdicts = [_verdict(drive, condition) for condition in proof.all]
    if True not in verdicts and False not in verdicts:
        wrong = "no condition says by the status that the drive does not run"
        report.miss(place, wrong, "ask for a status bit or value that is called running, stopped or standby")
    for condition, stands in zip(proof.all, verdicts, strict=True):
        if stands is False:
            wrong = f"standstill asks {address_text(condition.register)} for `{_called(drive, condition)[0]}`"
            report.add(condition.place("equals"), wrong, "ask for the state in which the motor stands")


def _says_frequency_is_0(drive: Drive, condition: Condition) -> bool:
    row = drive.register_at(condition.register)
    words = f"{row.name or ''} {row.text_zh or ''}".lower() if row is not None else ""
    is_speed = _hold(words, _SPEED) and not _hold(words, _WANTED)
    return condition.bit is None and condition.equals == 0 and is_speed


def _verdict(drive: Drive, condition: Condition) -> bool | None:
    """Whether a condition asks for a state that is called standing (True) or not (False), or None."""
    words, is_bit = _called(drive, condition)[1], _bit(drive, condition) is not None
    stands, turns = _hold(words, _STANDS), _hold(words, _TURNS if is_bit else (*_TURNS, *_OTHER))
    if not stands and not turns:
        return None
    return (stands and not turns) == (bool(condition.equals) or not is_bit)


def _called(drive: Drive, condition: Condition) -> tuple[str, str]:
    """What the register calls the awaited value or bit: its name, and all words for it in lower case."""
    named = _bit(drive, condition) or _value(drive, condition)
    return (named.name or "", f"{named.name} {named.text_zh or ''}".lower()) if named is not None else ("", "")


def _bit(drive: Drive, condition: Condition) -> Bit | None:
    """The single bit that a condition asks for, where its values have no names of their own."""
    row = drive.register_at(condition.register)
    bit = bit_at(row, condition.bit.first) if row is not None and condition.bit else None
    return bit if bit is not None and not bit.values and len(bit.bit) == 1 else None


def _value(drive: Drive, condition: Condition) -> Value | None:
    row = drive.register_at(condition.register)
    bit = bit_at(row, condition.bit.first) if row is not None and condition.bit else None
    values = bit.values if bit is not None else row.values if row is not None and condition.bit is None else ()
    return next((value for value in values if value.value == condition.equals), None)


def _hold(words: str, some: tuple[str, ...]) -> bool:
    return any(word in words for word in some)
