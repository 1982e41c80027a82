"""The simulated drives of a plant: each at its address, its keypad set as the plant file says."""

from dataclasses import replace
from math import ceil
from typing import Literal

from driveblocks.bench.simulator.drive import SimulatedDrive
from driveblocks.desk.run.drives import Named, open_scales
from driveblocks.meaning.watchdog import watchdog
from driveblocks.plant.model import Motor, Plant

USUAL_RAMP_S = 5
LOSES: dict[str, Literal["trip", "stop", "coast"]] = {
    "trips": "trip", "stop": "stop", "quick_stop": "stop", "coast_stop": "coast",
}  # fmt: skip
"""What a watchdog may do; whoever has set it has set one of these."""


def named(motor: Motor) -> Named:
    """A drive as `driveblocks run` simulates it."""
    maximum = ceil(max(motor.maximum_hz, motor.full_scale_hz or 0))
    scales = [(name, f"{motor.values[name]:f}") for name in open_scales(motor.map) if name in motor.values]
    return Named(motor.path, motor.map, motor.unit, maximum, tuple(scales))


def drive(plant: Plant, motor: Motor) -> SimulatedDrive:
    """The same with its ramps and its watchdog; a ramp that nobody gives is as long as its stop lets it be."""
    made = named(motor).made(ascii_mode=plant.lines[motor.line].way.mode == "ascii")
    usual = min(USUAL_RAMP_S, motor.stop_within_ms / 2000)
    ramps = [float(motor.maximum_hz) / float(each or usual) for each in (motor.ramp_up_s, motor.ramp_down_s)]
    up, down = (max(1, round(each)) for each in ramps)
    silence, own = motor.values.get("WatchdogMs"), watchdog(motor.map)
    made.habits = replace(
        made.habits,
        ramp=up,
        stop_ramp=down,
        watchdog_ms=int(silence) if own and silence else None,
        watchdog=next((LOSES[does] for _, does in own.reactions if does in LOSES), "trip") if own else "trip",
        watchdog_code=next((each.code for each in motor.map.faults.codes if each.code), 1),
    )
    return made
