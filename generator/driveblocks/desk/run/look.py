"""A look at a running program: its drives, and the variables that a person names."""

from driveblocks.desk.run.controller import Controller
from driveblocks.desk.seen import Seen, View
from driveblocks.render.reasons import REASONS
from structured_text.engines.embedded.certainty import known
from structured_text.engines.engine import Value

_STARTING = {reason.code for reason in REASONS if reason.name in ("STARTING", "RAMPING", "RUNS")}
_WHY = {reason.code: reason.en for reason in REASONS}


def look(controller: Controller, names: tuple[str, ...], at_us: int, port_error: str = "") -> View:
    drives = tuple(_seen(controller, block.path) for block in controller.wiring.drives)
    shown = {name: controller.instance[name] for name in names}
    inputs = {name: controller.instance[name] for name in controller.wiring.inputs}
    return View(at_us, drives, shown, inputs, sum(controller.dropped.values()), port_error)


def _seen(controller: Controller, path: str) -> Seen:
    pin = {name: controller.instance[f"{path}.{name}"] for name in _PINS}
    hertz = known(pin["OutputFrequencyHz"], float)
    asked = known(pin["SpeedReferenceHz"], float)
    reason = known(pin["Reason"], int)
    return Seen(
        name=path,
        unit=controller.number(f"{path}.Unit.Served"),
        state=_state(pin),
        asked_hz=asked,
        hertz=hertz if pin["Diagnosis.OutputFrequencyValid"] else None,
        why=_WHY.get(reason, f"reason {reason}"),
    )


_PINS = (
    "CommOk", "Running", "Reverse", "AtSpeed", "Fault", "FaultCode", "StopConfirmed", "StopOverdue",
    "OutputFrequencyHz", "Diagnosis.OutputFrequencyValid", "SpeedReferenceHz", "Reason",
    "Control.KnowsDirection",
)  # fmt: skip


def _state(pin: dict[str, Value]) -> str:
    """What a drive does, in a word or two."""
    if not pin["CommOk"]:
        return "STOP OVERDUE" if pin["StopOverdue"] else "no reply"
    if pin["Fault"]:
        code = known(pin["FaultCode"], int)
        return f"fault {code}" if code else "fault"
    if pin["StopOverdue"]:
        return "STOP OVERDUE"
    if pin["Running"]:
        way = "reverse" if pin["Reverse"] else "forward" if pin["Control.KnowsDirection"] else "running"
        return f"{way}, at speed" if pin["AtSpeed"] else f"{way}"
    if pin["StopConfirmed"]:
        return "standstill"
    return "starting" if pin["Reason"] in _STARTING else "stopping"
