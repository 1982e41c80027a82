"""The demonstration: three makes of drives on one line, from power-up to a stop of all, each step announced."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

import driveblocks
from driveblocks.bench.simulator.drive import SimulatedDrive
from driveblocks.desk.run.drives import COUNTS_PER_HERTZ, PER_COUNT
from driveblocks.desk.run.session import Session
from structured_text.engines.engine import Value

PROGRAM = "three_makes.st"
RAMP, COAST = 40, 60
"""Hz/s: short, since nobody waits for a motor that does not turn."""
SCALES: dict[str, Value] = {
    "CountsPerHertz": float(COUNTS_PER_HERTZ), "Fan.Settings.FrequencyScale": float(PER_COUNT),
}  # fmt: skip
"""What a person finds out on the motor, since no manual says it; here, what simulated drives have."""
FAULT = 4
DRIVES = ("Pump1", "Pump2", "Fan")
HOLD_US = 700_000
"""For so long what was announced has to be seen before the next step."""
PATIENCE_US = 10_000_000


def path() -> Path:
    """The program: inside an installed package, else beside `generator/` in a checkout."""
    package = Path(driveblocks.__file__).resolve().parent
    packed = package / "examples"
    return (packed if packed.is_dir() else package.parents[1] / "examples") / PROGRAM


@dataclass(frozen=True)
class Act:
    """A step: what is said, set, and done to the fan's drive, and what must be so before the next one."""

    says: str
    sets: Mapping[str, Value] = field(default_factory=dict)
    happens: Callable[[SimulatedDrive], None] = lambda _: None
    then: Mapping[str, Value] = field(default_factory=dict)


def _all(pin: str, *names: str) -> dict[str, Value]:
    return {f"{name}.{pin}": True for name in names or DRIVES}


ACTS = (
    Act("power-up: every drive gets a stop, and is then read", {"PumpHertz": 40.0, "FanHertz": 30.0, **SCALES},
        then=_all("Ready") | {"HardStopOk": False}),
    Act("the reset button: the contact of the hard stop closes", {"Reset": True}, then={"HardStopOk": True}),
    Act("start: all run pins rise, and the motors ramp up",
        {"Reset": False, **dict.fromkeys(("Pump1On", "Pump2On", "FanOn"), True)}, then=_all("AtSpeed")),
    Act(f"the fan's drive trips: fault {FAULT}; the pumps run on", happens=lambda fan: fan.trip(FAULT),
        then={"Fan.Fault": True, "Fan.Running": False, **_all("Running", "Pump1", "Pump2")}),
    Act("reset: the run pin falls, Reset rises; fault gone, nothing starts", {"FanOn": False, "Reset": True},
        happens=SimulatedDrive.clear_cause, then={"Fan.Fault": False, "Fan.Running": False, **_all("Ready", "Fan")}),
    Act("a new edge: the run pin rises", {"Reset": False, "FanOn": True}, then=_all("AtSpeed")),
    Act("stop all: one pin of the line", {"StopAll": True}, then=_all("StopConfirmed")),
)  # fmt: skip


class Demo:
    """Plays the acts in a session, and sees whether what was announced came true."""

    def __init__(self, session: Session, fan: SimulatedDrive) -> None:
        """Prepare; `step` is to be called before every scan."""
        self._session = session
        self._fan = fan
        self._waiting = list(ACTS)
        self._act: Act | None = None
        self._begun_us = 0
        self._true_us: int | None = None

    @property
    def wrong(self) -> str:
        """What has not come true; empty after the last step."""
        left = [self._act] if self._act else self._waiting[:1]
        return f"this did not come true: {left[0].says}" if left else ""

    def step(self, at_us: int) -> None:
        if self._act is not None:
            self._look(self._act, at_us)
        if self._act is None and self._waiting:
            self._play(at_us)
        elif self._act is None:
            self._session.ending.ask("the demonstration is over", alone=True)
        elif at_us - self._begun_us > PATIENCE_US:
            self._session.ending.ask("the demonstration has failed", alone=True)

    def _look(self, act: Act, at_us: int) -> None:
        """Whether the act has come true, and long enough."""
        instance = self._session.controller.instance
        if any(instance[name] != value for name, value in act.then.items()):
            self._true_us = None
        elif self._true_us is None:
            self._true_us = at_us
        elif at_us - self._true_us >= HOLD_US:
            self._act = self._true_us = None

    def _play(self, at_us: int) -> None:
        act = self._act = self._waiting.pop(0)
        self._begun_us = at_us
        self._session.told.put(act.says)
        self._session.marks.append((at_us, act.says))
        act.happens(self._fan)
        for name, value in act.sets.items():
            self._session.controller.instance[name] = value
