"""The named constants of the blocks in `line/` and `vfd/`: one table, so that a number has the same name in all."""

from driveblocks.render import reasons, results

STOPS = {"stop": 1, "quick_stop": 2, "coast_stop": 3, "jog_stop": 4}
"""Command -> its number as a kind of stop."""
ORDERS = {"run_forward": 5, "run_reverse": 6, "jog_forward": 7, "jog_reverse": 8, "fault_reset": 9}
"""Command -> its number as what is sent."""
NUMBERS = {
    # State of VFD_Control
    "STOPPING": (0, "a stop is on its way, or standstill is not proved yet"),
    "STOPPED": (1, "standstill is proved"),
    "REFERRING": (2, "a start: the reference is sent"),
    "COMMANDING": (3, "a start: the command is sent"),
    "RUNNING": (4, "the command is acknowledged"),
    "MONITORING": (5, "reads only"),
    "SPEEDING": (6, "the drive's terminals start and stop; the reference is sent"),
    # kinds of stop; a stronger one has a higher number
    "NO_STOP": (0, "none"),
    "RAMP_STOP": (STOPS["stop"], "stop along the ramp"),
    "QUICK_STOP": (STOPS["quick_stop"], "quick stop"),
    "COAST_STOP": (STOPS["coast_stop"], "coast stop"),
    "JOG_STOP": (STOPS["jog_stop"], "the end of a jog, which is a ramp"),
    # what is asked for, and what is sent
    "NOTHING": (0, "nothing"),
    "GO_FORWARD": (ORDERS["run_forward"], "run forward"),
    "GO_REVERSE": (ORDERS["run_reverse"], "run in reverse"),
    "JOG_AHEAD": (ORDERS["jog_forward"], "jog forward"),
    "JOG_BACK": (ORDERS["jog_reverse"], "jog in reverse"),
    "RESET_FAULT": (ORDERS["fault_reset"], "fault reset"),
    "SET_SPEED": (10, "reference"),
    # how far a fault reset has come
    "NO_RESET": (0, "none is asked for"),
    "HALTING": (1, "its stop is on its way"),
    "READING": (2, "the fault is read again"),
    "SENDING": (3, "the reset is on its way"),
    "CLEARING": (4, "the fault has to go"),
    # how a request has ended
    "DONE_NOT": (0, "the request is open"),
    "DONE_GOOD": (1, "a good reply"),
    "DONE_REFUSED": (2, "the drive refuses it"),
    "DONE_DAMAGED": (3, "wrong checksum"),
    "DONE_SILENCE": (4, "no reply"),
    "DONE_DOUBTED": (5, "the reply may have been an echo"),
    # what is sent first: a lower rank
    "RANK_STOP": (0, "a new stop"),
    "RANK_AGAIN": (1, "a stop again"),
    "RANK_COMMAND": (2, "run, reference"),
    "RANK_RESET": (3, "a fault reset"),
    "RANK_PARAMETER": (4, "a parameter"),
    "RANK_LATER": (5, "a command, after resets and parameters"),
    "RANK_REPEATED": (6, "a stop again, after commands and parameters"),
    "RANK_PROBE": (7, "a probe of a dead drive"),
    "RANK_POLL": (8, "a poll"),
    "RANK_NONE": (9, "nothing"),
    "RANK_BARRED": (10, "nothing but a stop may be sent to it"),
    # how far the line's own stop has come
    "FORCED_NONE": (0, "the line stops nobody by itself"),
    "FORCED_NEW": (1, "its stop is not sent yet"),
    "FORCED_FIRST": (2, "the stop that is sent first is sent"),
    "FORCED_OTHER": (3, "the first is acknowledged, the other one is due"),
    "FORCED_REFUSED": (4, "the first is refused, the other one is due"),
    "FORCED_AGAIN": (5, "all is answered; repeated, since nobody proves standstill"),
}
"""Name -> number and meaning. WHY_X is reason X, ERROR_X is result X."""


def named(*names: str, kind: str = "UINT") -> str:
    """Declarations of constants, one to a line, each with its meaning. Raises KeyError."""
    lines = []
    for name in names:
        number, meaning = _of(name)
        lines.append(f"  {name} : {kind} := {number}; (* {meaning} *)")
    return "\n".join(lines)


def _of(name: str) -> tuple[int, str]:
    """Number and meaning of a constant."""
    if name.startswith("WHY_"):
        reason = reasons.by_name(name.removeprefix("WHY_"))
        return reason.code, reason.en
    if name.startswith("ERROR_"):
        result = results.by_name(name.removeprefix("ERROR_"))
        return result.code, result.en
    return NUMBERS[name]
