"""The block of one family, and at its address a drive of another one, typed from its manual."""

from functools import cache
from typing import Any

from tests.second.frames import opened, rtu
from tests.second.kinds import drive as model
from tests.second.line import Bench
from tests.second.pf4 import VARIANTS
from tests.second.station import FAMILIES, built

from driveblocks.bench.simulator.drive import SimulatedDrive
from driveblocks.bench.simulator.habits import Habits
from structured_text.engines.embedded.engine import EmbeddedEngine
from structured_text.engines.engine import Library

KIND = {"ATV312": "atv", "CHF": "chf", "GD200A": "gd", "JSCC": "jscc", "MX2": "mx", "PF4": "pf", "SN300G5": "sn"}
KIND |= {name: name.lower() for name in VARIANTS}
QUICK: dict[str, Any] = {"silence_us": 0, "reply_us": (1000, 1000), "char_us": 10}
"""Times on the wire are not what is looked at."""


class Model(SimulatedDrive):
    """A second model as a bench calls its drives."""

    def __init__(self, family: str, unit: int, **options: Any) -> None:
        """Power it up, standing, its reference at its keypad's value."""
        self.drive = model(KIND[family], unit, **QUICK | options)
        self.drive.reference_hz = 25.0
        self.family, self.now = family, 0
        self.turned = 0.0
        """The highest speed that its shaft has had, Hz."""
        self.changes: list[bytes] = []
        """What it has let others write."""

    @property
    def unit(self) -> int:  # type: ignore[override]
        """Its address."""
        return self.drive.unit

    @property
    def mode(self) -> str:
        """As its text has it."""
        return self.drive.state(self.now)

    @property
    def turn_us(self) -> int:  # type: ignore[override]
        """Until its reply begins."""
        return 1000

    def step(self, ms: int) -> None:
        """Let time pass."""
        self.now += 1000 * ms
        self.turned = max(self.turned, abs(self.drive.shaft_hz(self.now)))

    def reply(self, request: bytes) -> bytes | None:
        """What it answers; None: nothing."""
        found = self.drive.receive(rtu(request), self.now)
        reply = opened(found[0][1]) if found else None
        if reply is not None and request[1] > 4 and reply[:6] == request[:6]:
            self.changes.append(request)
        return reply


class Strange(Bench):
    """Blocks of some families, and at their addresses drives of others."""

    drives: list[Any]

    def __init__(
        self, blocks: tuple[str, ...], drives: tuple[str, ...], library: Library | None = None, **options: Any
    ) -> None:
        """Power up; drive n has the address of block n."""
        self.there, self.options = drives, options
        super().__init__(*blocks, stations=library or stations(blocks), start=False)

    def restart(self) -> "Strange":
        """As for every bench."""
        super().restart()
        return self

    def stopped(self, drive: int = 0) -> "Strange":
        """As for every bench."""
        super().stopped(drive)
        return self

    def simulated(self, habits: Habits, ascii_: bool) -> list[Any]:  # noqa: ARG002  (as the bench calls it)
        """The strangers."""
        return [Model(family, at, **self.options) for at, family in enumerate(self.there, 1)]


@cache
def stations(blocks: tuple[str, ...]) -> Library:
    """A station of these blocks."""
    return built(EmbeddedEngine(), [blocks])


PAIRS = [(one, other) for one in FAMILIES for other in FAMILIES if one != other]
