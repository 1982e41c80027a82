"""A virtual line whose drives are simulated ones, of several families if wanted; their time passes with the scans."""

from collections.abc import Sequence
from dataclasses import replace

from tests.line.vline import POLL, STOP, Bench, Config, Drive

from driveblocks.bench.simulator.drive import SimulatedDrive
from structured_text.engines.engine import Instance


class DriveBench(Bench):
    """A line with a simulated drive in each slot: at its unit address, with its turn-round and its form of refusals."""

    def __init__(
        self,
        drives: Sequence[SimulatedDrive],
        config: Config | None = None,
        seed: int = 0,
        block: Instance | None = None,
        **pins: int | bool,
    ) -> None:
        """Begin a line; what each slot asks is left to the drive blocks, or to `ask`."""
        super().__init__(replace(config or Config(), drives=len(drives)), seed, block, **pins)
        self.simulated = list(drives)
        self.stepped = 0
        for slot, drive in enumerate(drives):
            dialect = drive.table.dialect
            self.drives[slot] = Drive(drive.unit, self.kind, turn_us=drive.turn_us, answer=drive.reply)
            self.put(
                slot,
                UnitAddress=drive.unit,
                ExceptionAdd=0 if dialect.function else dialect.added,
                ErrorFunction=dialect.function or 0,
                ErrorAddress=dialect.address or 0,
            )

    def fill_as_kind(self, slot: int) -> None:
        """Nothing: the drives are no kind of the line's own tests."""
        for box in (STOP, POLL):
            self.fill(slot, box, 0, 0, quantity=0)

    def scan(self, took: int | None = None, elapsed: int | None = None) -> None:
        """One scan, and what the drives do in its time."""
        now = (self.now + (self.config.scan if took is None else took)) // 1000
        for drive in self.simulated:
            drive.step(now - self.stepped)
        self.stepped = now
        super().scan(took, elapsed)
