"""What goes wrong with a plant in its test, and what has to become of it."""

from collections.abc import Callable, Collection

from driveblocks.docs.timing import proves_while_tripped
from driveblocks.plant.crew import BOOT_MS, REST_MS, SEEN_MS, START_MS, STAY_MS, Crew
from driveblocks.plant.model import HardStop, Motor
from driveblocks.plant.stand import Broken

STALE_MS = 5_000
"""Without a reply for so long a run ends."""
AWAY_MS = 3_000
"""How long a drive is without supply."""
PROOF_MS = 10_000
"""Beside a panel the proof of standstill comes within this time."""
OUTSIDE = 0.2
"""A broken wire shows counts so far outside of both ends, as a share."""
LOWEST_INT = -32768


def trip(crew: Crew, motor: Motor) -> None:
    """One has a fault: a standby takes its place, where its standstill is proved; a reset starts nothing.

    The others run on.
    """
    name, stand, seen = motor.name, crew.stand, crew.seen_ms(motor)
    others, drive, spares = crew.others([name]), stand.drives[name], _spares(crew, motor)
    stand.may = {*spares}
    drive.trip(next((each.code for each in motor.map.faults.codes if each.code and not each.power_cycle), 1))
    crew.see(lambda: bool(stand.pin(f"{name}.Fault")), seen, f"{name} shows its fault", [name], others)
    _lit(crew, name)
    crew.see_rest([name], others)
    group = crew.plant.group_of(name)
    if group and spares:
        crew.see_work(group.name, name, others)
        stand.may.clear()
    drive.clear_cause()
    crew.clear(motor)
    crew.see(lambda: not stand.pin(f"{name}.Fault"), seen + START_MS, f"the fault of {name} is reset", [name], others)
    crew.see_nothing(others)


def _spares(crew: Crew, motor: Motor) -> list[str]:
    """Who may take its place after a trip: nobody, where its drive proves no standstill while it has a fault."""
    group = crew.plant.group_of(motor.name)
    if group is None or not crew.duty(group.name) or not proves_while_tripped(motor.map):
        return []
    return [each for each in group.drives if not crew.off(each) and not crew.turning([each])]


def _lit(crew: Crew, name: str) -> None:
    """The lamps that show its fault."""
    crew.stand.scan()
    for lamp in crew.plant.lamps.values():
        if lamp.shows == "fault" and name in crew.stand.members(lamp.of) and not crew.stand.pin(lamp.name):
            raise Broken(f"the lamp {lamp.name} is lit while {name} has a fault", "it is dark")


def cut(crew: Crew, motor: Motor) -> None:
    """The cable of its line ends before it: it is gone, and all behind it."""
    stand, line = crew.stand, crew.plant.on(motor.line)
    far = line[line.index(motor) :]
    gone, wire = [each.name for each in far], stand.wires[motor.line]
    moving, others = crew.turning(gone), crew.others(gone, silent=True)
    stand.may.clear()
    wire.cut = [*(each.unit for each in far), *(each.unit for each in crew.plant.meters_on(motor.line))]
    for stop in crew.plant.hard_stops.values():
        if {*stop.drives} & {*moving}:
            _opens(crew, stop, [each for each in stop.drives if each in moving], others, alone=far == line)
    for each in moving:
        own = stand.drives[each].habits.watchdog_ms or 0
        off = f"{each} is stopped by its hard stop or its watchdog"
        crew.see(lambda each=each: not crew.turning([each]), own + SEEN_MS, off, [each], others)  # type: ignore[misc]
    crew.see_rest(moving, others)
    wire.cut = ()
    for each in gone:
        stand.drives[each].clear_cause()
        stand.drives[each].reset()
    crew.see_answers(gone, others)
    crew.see_nothing(others)


def _opens(crew: Crew, stop: HardStop, own: Collection[str], others: Collection[str], *, alone: bool) -> None:
    """Its contact opens, since motors cannot be stopped any more; later, where others of the line still answer."""
    late = max(crew.plant.drives[each].stop_within_ms for each in own)
    figures = [crew.figures[crew.plant.drives[each].line].cut for each in own]
    within = STALE_MS + max(figures) + (0 if alone else late)
    crew.see(lambda: stop.name in crew.opened(), within, f"the contact of {stop.name} opens", own, others)


def dip(crew: Crew, motor: Motor) -> None:
    """Its supply is gone for some seconds while it turns; it does not go on by itself."""
    name, drive = motor.name, crew.stand.drives[motor.name]
    others = crew.others([name], silent=True)
    crew.stand.may.clear()
    drive.power(on=False)
    crew.see_nothing(others, AWAY_MS)
    drive.power(on=True)
    crew.see_answers([name], others)
    proved: Callable[[], bool] = lambda: crew.rests(name)  # noqa: E731
    crew.see(proved, BOOT_MS, f"{name} at standstill, and StopConfirmed", [name], others)
    crew.see_nothing(others)


def dead(crew: Crew, name: str) -> None:
    """It is without supply before the others start: they start, turn and stop as ever, and no contact opens."""
    stand = crew.stand
    stand.drives[name].power(on=False)
    crew.see(lambda: not stand.pin(f"{name}.CommOk"), BOOT_MS, f"{name} is known to be gone", [name])
    free = [each for each in stand.targets if each != name and not _in_sequence(crew, each, name)]
    for each in free:
        crew.start(each, without=name)
    for each in free:
        crew.see_work(each, without=name)
    crew.see_nothing(crew.turning(stand.drives))
    if crew.opened():
        raise Broken("no contact opens for a drive that stood before it was silent", f"{', '.join(crew.opened())}")
    for each in free:
        crew.stop(each, without=name)


def _in_sequence(crew: Crew, target: str, name: str) -> bool:
    group = crew.plant.groups.get(target)
    return group is not None and group.kind == "sequence" and name in group.drives


def hard_stop(crew: Crew, name: str) -> None:
    """Somebody opens it and closes it again: its motors coast, and stay at rest."""
    own = list(crew.plant.hard_stops[name].drives)
    others = crew.others(own)
    crew.stand.may.clear()
    crew.stand.open.add(name)
    crew.see(lambda: not crew.turning(own), SEEN_MS, f"{name} takes the torque of its motors", own, others)
    told: Callable[[], bool] = lambda: not any(crew.stand.pin(f"{each}.Enable") for each in own)  # noqa: E731
    crew.see(told, SEEN_MS, f"{name} takes the Enable of its drive blocks", own, others)
    shown = f"{', '.join(own)} at standstill, and StopConfirmed"
    crew.see(lambda: all(map(crew.rests, own)), REST_MS, shown, own, others)
    crew.stand.open.discard(name)
    crew.see_nothing(others)


def broken_wire(crew: Crew, name: str) -> None:
    """What takes its speed from an input whose wire is broken is stopped, with its group."""
    stand, raw = crew.stand, crew.plant.inputs[name].raw
    own = {each.name for each in crew.plant.drives.values() if each.speed == name and each.mode == "full"}
    ended = {each for one in stand.targets if own & {*stand.members(one)} for each in stand.members(one)}
    before, others = stand.pin(name), crew.others(ended)
    stand.may.clear()
    stand.set(name, max(LOWEST_INT, int(raw[0] - OUTSIDE * (raw[1] - raw[0]))))
    crew.see_standstill(ended, others)
    stand.set(name, before)
    crew.see_nothing(others)


def panel(crew: Crew, name: str) -> None:
    """Another master reads a drive now and then: all run on, and all stop as ever."""
    stand = crew.stand
    stand.panel = name
    crew.see_nothing(crew.turning(stand.drives), 2 * STAY_MS)
    stand.may.clear()
    stand.set("Hmi_StopAll", value=True)
    crew.see_standstill([each.name for each in crew.plant.on(name) if each.mode == "full"], proof_ms=PROOF_MS)
    if crew.opened():
        raise Broken("a panel opens no contact", ", ".join(crew.opened()))


def restart(crew: Crew, run: Callable[[Crew], None]) -> None:
    """The PLC is switched off and on while motors turn and every start is held: all stop, and no start counts."""
    stand = crew.stand
    starts = [crew.button(each, "start") for each in stand.targets]
    for each in starts:
        stand.set(each, value=True)
    stand.may.clear()
    stand.restart()
    crew.see_standstill([each for each in stand.drives if stand.plant.drives[each].mode == "full"], proof_ms=BOOT_MS)
    crew.reset()
    crew.see_nothing()
    for each in starts:
        stand.set(each, value=False)
    crew.see_nothing()
    run(crew)
