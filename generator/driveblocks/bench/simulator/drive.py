"""A simulated drive: it answers requests, and things happen to it."""

from driveblocks.bench.simulator.answer import answer
from driveblocks.bench.simulator.machine import Machine


class SimulatedDrive(Machine):
    """A drive of a family at a unit address, powered, at standstill. Time passes by `step` alone."""

    def reply(self, request: bytes) -> bytes | None:
        """The reply to a request, both without checksum (unit, function, data); None for silence."""
        return answer(self, request)
