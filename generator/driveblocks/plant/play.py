"""A plant to be played with: its program, its drives, and the circuits around it, for `driveblocks run`."""

from driveblocks.desk.run.setup import Given
from driveblocks.plant import program, simulated
from driveblocks.plant.line import sources
from driveblocks.plant.model import Plant
from driveblocks.plant.stand import at_rest
from structured_text.engines.embedded import EmbeddedInstance


def given(plant: Plant) -> Given:
    """What a run needs. Raises Refused."""
    drives = {each.name: simulated.named(each) for each in plant.drives.values()}
    circuits = Circuits(tuple(plant.hard_stops))
    return Given(program.text(plant), sources(plant), drives, dict(at_rest(plant)), circuits.close)


class Circuits:
    """The hard stops: each closes and opens with its contact, and in between a person may open it."""

    def __init__(self, names: tuple[str, ...]) -> None:
        """All are open."""
        self._closed = dict.fromkeys(names, False)

    def close(self, instance: EmbeddedInstance) -> None:
        """What became of the contacts in the last scan."""
        for name, before in self._closed.items():
            now = bool(instance[f"{name}_Ok"])
            if now != before:
                self._closed[name] = now
                instance[f"{name}_Closed"] = now
