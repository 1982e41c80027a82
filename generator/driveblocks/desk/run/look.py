"""A look at a running program: its drives, and the variables that a person names."""

import re
from collections.abc import Mapping

from driveblocks.desk.run.controller import Controller
from driveblocks.desk.run.wiring import DriveBlock
from driveblocks.desk.seen import Seen, View
from driveblocks.maps.model import Drive
from driveblocks.meaning import advice
from driveblocks.meaning.words import words
from driveblocks.render.reasons import REASONS, STATES
from structured_text.engines.embedded.certainty import known
from structured_text.engines.engine import Value

_STARTING = {reason.code for reason in REASONS if reason.name in ("STARTING", "RAMPING", "RUNS")}
_STOPPING = next(code for code, (name, _) in enumerate(STATES) if name == "stopping")
_REASONS = {reason.code: reason for reason in REASONS}
_NOTHING = ("nothing", "wait")
_LINK = re.compile(r"\[([^]]*)]\([^)]*\)")


def look(controller: Controller, names: tuple[str, ...], at_us: int, port_error: str = "") -> View:
    drives = tuple(_seen(controller, block) for block in controller.wiring.drives)
    shown = {name: controller.instance[name] for name in names}
    inputs = {name: controller.instance[name] for name in controller.wiring.inputs}
    return View(at_us, drives, shown, inputs, sum(controller.dropped.values()), port_error)


def _seen(controller: Controller, block: DriveBlock) -> Seen:
    pin = {name: controller.instance[f"{block.path}.{name}"] for name in PINS}
    return seen(block.path, controller.drive(block), controller.unit(block), pin)


def seen(name: str, drive: Drive, unit: int, pin: Mapping[str, Value]) -> Seen:
    """A drive by the PINS of its block."""
    hertz = known(pin["OutputFrequencyHz"], float)
    why, remedy = _why(drive, known(pin["Reason"], int), known(pin["FaultCode"], int))
    return Seen(
        name=name,
        unit=unit,
        state=_state(pin, drive),
        asked_hz=known(pin["SpeedReferenceHz"], float),
        hertz=hertz if pin["Diagnosis.OutputFrequencyValid"] else None,
        why=why,
        remedy=remedy,
        most_hz=known(pin["MaximumHz"], float),
    )


def _why(drive: Drive, code: int, fault: int) -> tuple[str, str]:
    """A reason, or the fault that is one, in words, and what to do about it."""
    reason = _REASONS.get(code)
    if reason is None:
        return f"reason {code}", ""
    its = advice.of_code(drive, fault) if reason.name == "FAULT" else None
    if its is not None:
        told = its.remedies or its.causes or ("remove the cause",)
        return its.name, _plain(f"{told[0]}; clears it: {its.clears}")
    without = reason.without if "fault_reset" not in words(drive).named else ""
    remedy = _plain(without or reason.remedy)
    return reason.en, "" if remedy.startswith(_NOTHING) else remedy


def _plain(text: str) -> str:
    """Without the marks of a page."""
    return _LINK.sub(r"\1", text).replace("`", "")


PINS = (
    "CommOk", "Running", "Reverse", "AtSpeed", "Fault", "FaultCode", "StopConfirmed", "StopOverdue",
    "OutputFrequencyHz", "Diagnosis.OutputFrequencyValid", "SpeedReferenceHz", "MaximumHz", "Reason",
    "Control.KnowsDirection", "Control.State",
)  # fmt: skip


def _state(pin: Mapping[str, Value], drive: Drive) -> str:
    """What a drive does, in a word or two."""
    if not pin["CommOk"]:
        return "STOP OVERDUE" if pin["StopOverdue"] else "no reply"
    if pin["Fault"]:
        code = known(pin["FaultCode"], int)
        its = advice.of_code(drive, code)
        return " ".join(("fault", *([str(code)] if code else ()), *([its.keypad] if its and its.keypad else ())))
    if pin["StopOverdue"]:
        return "STOP OVERDUE"
    if pin["Running"]:
        return _running(pin)
    if pin["StopConfirmed"]:
        return "standstill"
    return "starting" if pin["Reason"] in _STARTING else "stopping"


def _running(pin: Mapping[str, Value]) -> str:
    way = "reverse" if pin["Reverse"] else "forward" if pin["Control.KnowsDirection"] else "running"
    if pin["Control.State"] == _STOPPING:
        return f"{way}, stopping"
    return f"{way}, at speed" if pin["AtSpeed"] else way
