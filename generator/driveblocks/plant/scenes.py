"""What a plant has to do, as whoever runs it would say: each scene is a case of its test."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial

from driveblocks.plant import troubles
from driveblocks.plant.crew import BOOT_MS, Crew
from driveblocks.plant.model import Motor, Plant
from driveblocks.plant.program import commanded
from driveblocks.plant.stand import Broken

FRAMES_MS = 500
"""The frames of a start take no longer."""
SETTLE_MS = 100
"""From a switch to the next one."""
OFF, READY, RUNNING = "off", "ready", "running"


@dataclass(frozen=True)
class Scene:
    """A case: where it begins, and what happens."""

    name: str
    play: Callable[[Crew], None]
    begins: str = RUNNING
    """The plant is switched off, may be started, or all of it runs."""
    drive: str = ""
    """This one is among those that run."""


def scenes(plant: Plant) -> Iterator[Scene]:
    """All of a plant, in the order of a day."""
    yield Scene("power-up: nothing turns, every drive answers, a reset closes the contacts", ready, OFF)
    for each in _full(plant):
        group = plant.group_of(each.name)
        if group is None or group.kind != "sequence":
            yield Scene(f"start and stop of {each.name}", partial(_alone, motor=each), READY)
    for name, group in plant.groups.items():
        yield Scene(f"start and stop of {name}: {', '.join(group.drives)}", partial(_group, name=name), READY)
    yield Scene("start of all together", _together, READY)
    for name in commanded(plant):
        for by in (*_buttons(plant, "stop", name), f"{name}_Stop"):
            yield Scene(f"stop of {name} by {by}", partial(_stop, by=by, name=name))
    for by in (*_buttons(plant, "stop_all", ""), "Hmi_StopAll"):
        yield Scene(f"stop of all by {by}", partial(_stop, by=by))
    yield from _troubles(plant)


def _troubles(plant: Plant) -> Iterator[Scene]:
    for each in _full(plant):
        yield Scene(f"trip of {each.name}", partial(troubles.trip, motor=each), drive=each.name)
    for each in plant.drives.values():
        yield Scene(f"cable cut before {each.name}", partial(troubles.cut, motor=each), drive=each.name)
        yield Scene(f"supply of {each.name} off and on", partial(troubles.dip, motor=each), drive=each.name)
        yield Scene(f"{each.name} without supply, the others at work", partial(troubles.dead, name=each.name), READY)
    for name in plant.hard_stops:
        yield Scene(f"{name} opened and closed", partial(troubles.hard_stop, name=name))
    for name in dict.fromkeys(each.speed for each in _full(plant) if isinstance(each.speed, str)):
        yield Scene(f"broken wire of {name}", partial(troubles.broken_wire, name=name))
    for name in (each for each in plant.lines if plant.on(each)):
        yield Scene(f"a panel on line {name}", partial(troubles.panel, name=name))
    yield Scene("PLC off and on with every start held", partial(troubles.restart, run=running))


def _full(plant: Plant) -> list[Motor]:
    """The drives that are run over their line."""
    return [each for each in plant.drives.values() if each.mode == "full"]


def _buttons(plant: Plant, does: str, of: str) -> list[str]:
    return [each.name for each in plant.buttons.values() if each.does == does and each.of == of]


# ------------------------------------------------------------ where scenes begin


def ready(crew: Crew) -> None:
    """From power-up until everything may start."""
    stand, drives = crew.stand, crew.plant.drives
    crew.see_answers(drives)
    closed = {*crew.plant.hard_stops} - {*crew.opened()}
    if closed:
        raise Broken("after power-up the contacts are open until a reset", f"closed: {', '.join(sorted(closed))}")
    crew.reset()
    full = [each.name for each in _full(crew.plant)]
    crew.see(lambda: all(stand.pin(f"{each}.Ready") for each in full), BOOT_MS, "all drives are ready", drives)


def running(crew: Crew, drive: str = "") -> None:
    """All at work; a drive is among them, for which others of its group are out of service."""
    group = crew.plant.group_of(drive) if drive else None
    if group is not None and (most := crew.duty(group.name)):
        for each in [one for one in group.drives if one != drive][most - 1 :][: len(group.drives) - 1 - most]:
            crew.stand.set(f"{each}_Off", value=True)
        crew.stand.wait(SETTLE_MS)
    for name in crew.stand.targets:
        crew.start(name)
    for name in crew.stand.targets:
        crew.see_work(name)


# ------------------------------------------------------------ starts and stops


def _alone(crew: Crew, motor: Motor) -> None:
    """One, while the others of its group are out of service."""
    name, group = motor.name, crew.plant.group_of(motor.name)
    for each in group.drives if group else ():
        crew.stand.set(f"{each}_Off", each != name)
    crew.stand.wait(SETTLE_MS)
    target = group.name if group else name
    crew.start(target)
    said = f"{name} turns at {crew.stand.asked(name):g} Hz"
    crew.see(lambda: crew.at_speed(name), crew.start_ms(target), said, [name])
    too = crew.turning([each for each in crew.plant.drives if each != name])
    if too:
        raise Broken(f"a start of {name} moves no other motor", crew.stand.states(too))
    crew.stop(target)


def _group(crew: Crew, name: str) -> None:
    group, begun = crew.plant.groups[name], dict[str, int]()
    crew.start(name)

    def seen() -> bool:
        for each in crew.turning(group.drives):
            begun.setdefault(each, crew.stand.ms)
        return crew.at_work(name)

    crew.see(seen, crew.start_ms(name), f"group {name} at work", group.drives)
    if group.kind == "sequence":
        least = (group.delay_ms or 0) - FRAMES_MS
        times = [begun[each] for each in group.drives]
        for before, after, each in zip(times, times[1:], group.drives[1:], strict=False):
            if after - before < least:
                raise Broken(f"{each} starts {group.delay_ms} ms after the one before it", f"{after - before} ms")
    crew.stop(name)


def _together(crew: Crew) -> None:
    """All starts at once; then all stops, one after the other."""
    running(crew)
    for name in crew.stand.targets:
        crew.stop(name, others=crew.others(crew.stand.members(name)))


def _stop(crew: Crew, by: str, name: str = "") -> None:
    """It stops a target, or all; a start that is held meanwhile starts nothing when it is released."""
    stand = crew.stand
    targets = [name] if name else stand.targets
    own = [each for one in targets for each in stand.members(one)]
    others, starts = crew.others(own), [crew.button(each, "start") for each in targets]
    stand.may -= {*own}
    stand.set(by, not stand.rest(by))
    crew.see_standstill(own, others)
    for each in starts:
        stand.set(each, value=True)
    crew.see_nothing(others)
    stand.set(by, stand.rest(by))
    crew.see_nothing(others)
    for each in starts:
        stand.set(each, value=False)
    crew.see_nothing(others)
