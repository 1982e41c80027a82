"""The named constants of the blocks in `line/` and `vfd/`: one table, so that a number has the same name in all."""

import re

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
    "RANK_FIRST": (1, "a read that has to come before a stop"),
    "RANK_ATTEMPT": (2, "a stop that decides whether it is overdue"),
    "RANK_CHECK": (3, "a poll that decides whether the drive is dead, or lives again"),
    "RANK_AGAIN": (4, "a stop again"),
    "RANK_FEED": (5, "a command that feeds a watchdog"),
    "RANK_COMMAND": (6, "run, or a reference that has changed"),
    "RANK_RESET": (7, "a fault reset"),
    "RANK_STOP_DEAD": (8, "a stop again, to a dead drive"),
    "RANK_PROBE": (9, "a probe of a dead drive"),
    "RANK_PARAMETER": (10, "a parameter"),
    "RANK_REFRESH": (11, "a reference that has not changed"),
    "RANK_READ": (12, "a guaranteed read"),
    "RANK_NONE": (13, "nothing"),
    # why a slot gets nothing, or only stops
    "BARRED_NOT": (0, "it is served"),
    "BARRED_LATE": (1, "a late reply may come"),
    "BARRED_DEAD": (2, "it is dead, and others have the line"),
    "BARRED_HOLD": (3, "the drive is busy, or has just come back: reads and stops only"),
    "BARRED_UNATTENDED": (4, "its drive block is not called"),
    "BARRED_SHARED": (5, "two drive blocks use it"),
    "BARRED_DOUBLED": (6, "another slot has its unit address"),
    "BARRED_VERSION": (7, "its drive block is of another version"),
    "BARRED_LINE": (8, "a restart, or no time passes"),
    # the compartments of a slot
    "BOX_STOP": (0, "compartment of the stop"),
    "BOX_COMMAND": (1, "compartment of the command"),
    "BOX_PARAMETER": (2, "compartment of the parameter"),
    "BOX_POLL": (3, "compartment of the poll"),
    # events of MB_Life, beside how a request has ended
    "LIFE_CALL": (0, "a call of the line"),
    "LIFE_ANEW": (6, "another drive, or a restart: nothing of before holds"),
    # of two slots with one unit address
    "DOUBLED_NOT": (0, "no other slot has its unit address"),
    "DOUBLED_FIRST": (1, "another slot has taken its unit address"),
    "DOUBLED_LATER": (2, "it has taken that of another slot"),
    # events of MB_Sending, MB_Exchange and MB_Next
    "SENDING_BEGINS": (0, "a request is chosen and booked as sent"),
    "SENDING_ENDS": (1, "it has ended"),
    "SENDING_BACK": (2, "it is taken out of the mailbox"),
    "EXCHANGE_CALL": (0, "a call of the line begins"),
    "EXCHANGE_HEARD": (1, "a character was received"),
    "EXCHANGE_ENDS": (2, "all that was received is heard"),
    "EXCHANGE_OPEN": (3, "a request is opened"),
    "EXCHANGE_DROP": (4, "the open request is given up"),
    "EXCHANGE_ANEW": (5, "a restart"),
    "NEXT_BEGINS": (0, "nobody has offered anything"),
    "NEXT_OFFER": (1, "a slot offers what it asks for"),
    "NEXT_DECIDES": (2, "who is next"),
    "NEXT_SENT": (3, "what was chosen is sent"),
    "NEXT_ANEW": (4, "a restart"),
    # the exchange
    "PHASE_FREE": (0, "no request is open"),
    "PHASE_MAILBOX": (1, "a request is in the mailbox"),
    "PHASE_WIRE": (2, "it is on the wire, or its reply awaited"),
    "FOUND_NONE": (0, "none"),
    "FOUND_REPLY": (1, "a frame that may be a reply"),
    "FOUND_REQUEST": (2, "a request of another master"),
    "FOUND_LATE": (3, "the reply to the last request, after its time"),
    "REFUSED_MOST": (4, "so many first polls that are refused in a row go before the reads of others"),
    "FOUND_EITHER": (4, "a request of another master, or the reply of a drive whose byte count has two bytes"),
    "ECHO_UNKNOWN": (0, "it is not known whether the port hears its own characters"),
    "ECHO_NONE": (1, "it does not"),
    "ECHO_HEARD": (2, "it does"),
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


def errors(body: str) -> str:
    """Declarations of the result codes that a body names, as they come in it. Raises KeyError."""
    return named(*dict.fromkeys(re.findall(r"\bERROR_[A-Z_]+", body)))


def _of(name: str) -> tuple[int, str]:
    """Number and meaning of a constant."""
    if name.startswith("WHY_"):
        reason = reasons.by_name(name.removeprefix("WHY_"))
        return reason.code, reason.en
    if name.startswith("ERROR_"):
        result = results.by_name(name.removeprefix("ERROR_"))
        return result.code, result.en
    return NUMBERS[name]
