"""What no manual says of its drive, and a simulated one must have: settings of the motor, and how it behaves."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from decimal import Decimal
from types import MappingProxyType
from typing import Literal


@dataclass(frozen=True, kw_only=True)
class Habits:
    """Settings, each with a default; frequencies in Hz, ramps in Hz/s, times in ms.

    Frequencies are kept in thousandths of a hertz, ramps in whole Hz/s, so that every sum comes out the same in C.
    """

    maximum_hz: int = 50
    jog_hz: int = 5
    pole_pairs: int = 2
    """Of its motor: at 50 Hz it turns at 3000 r/min divided by them."""
    ramp: int = 10
    """Up, and down to a stop."""
    stop_ramp: int | None = None
    """Down to a stop, where it is another one."""
    quick_ramp: int = 50
    """Down after a quick stop."""
    coast_ramp: int = 5
    """How fast a motor without current becomes slower."""
    coast_shows_zero: bool = True
    """The output frequency is 0 while the motor coasts; else it is that of the shaft."""
    runs_while_stopping: bool = True
    """The status says running until the output frequency is 0."""
    stop_ends_jog: bool = True
    """A stop ends a jog; else only a jog stop does."""
    settle_ms: int = 0
    """From a step's word to the state that it leads to."""
    resumes: bool = False
    """After a reset, a run bit that is still set acts again."""
    auto_restart: bool = False
    """It keeps its command and reference over a loss of power, and continues to run."""
    keeps_fault_code: bool = False
    """The fault's register shows the last fault after a reset; else 0."""
    scale: Decimal = Decimal("0.01")
    """Engineering units per count where the map has no scale."""
    scales: Mapping[int, Decimal] = field(default_factory=lambda: MappingProxyType({}))
    """The same by register, where one scale for all will not do."""
    misread: int = 10
    """How many times too high a reference is while what gives it its meaning is not so."""
    store_ms: int = 100
    """How long storing takes; the drive refuses parameters meanwhile, where its map lists such a code."""
    busy_refuses_all: bool = False
    """While it stores it refuses all writes, commands too."""
    watchdog_ms: int | None = None
    """How long it takes for what feeds its watchdog, which counts as its map says; None: it has no watchdog."""
    watchdog: Literal["trip", "stop", "coast"] = "trip"
    watchdog_code: int = 1
    """The fault code of a trip by the watchdog."""
    amperes: int = 10
    """Output current while running, at a load of 100 %."""
    bus_volts: int = 540
    motor_volts: int = 400
    """Output voltage at the maximum frequency."""
    kilowatts: int = 4
    """Output power at the maximum frequency, at a load of 100 %."""
    drive_degrees: int = 40
    """Temperature of its heat sink, degrees C."""
    motor_degrees: int = 50
    hours: int = 100
    """How long it has run."""
    kilowatt_hours: int = 12
    """What it has taken."""
    turn_us: int = 5000
    """From the end of a request to the start of its reply, for the line to wait."""
