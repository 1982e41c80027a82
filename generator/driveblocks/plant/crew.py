"""Who tries a plant on its stand: what they do by hand, what they look at, and for how long they wait for it."""

from collections.abc import Callable, Collection, Mapping

from driveblocks.desk.site.line import Figures
from driveblocks.meaning.words import words
from driveblocks.plant.model import Motor, Plant
from driveblocks.plant.stand import Broken, Stand

BOOT_MS = 30_000
"""Until all drives answer and may be started."""
START_MS = 6_000
"""From a start to a turning motor, beside its ramp."""
SEEN_MS = 3_000
"""Until what a drive shows has been seen, beside the age of its status."""
STAY_MS = 3_000
"""How long it is watched that nothing happens."""
REST_MS = 60_000
"""Until a motor that coasts has come to rest."""
USUAL_RAMP_S = 5
SLACK = 1.2
"""How much longer than its ramp a motor may take to its speed."""
LEAST_HZ, TOLERANCE = 0.3, 0.02
"""How far from what is asked a speed may be: so many Hz, or this share of it."""


class Crew:
    """At one stand; `figures` are those of the plant's lines."""

    def __init__(self, stand: Stand, figures: Mapping[str, Figures]) -> None:
        """Nobody has done anything yet."""
        self.stand, self.figures = stand, figures

    @property
    def plant(self) -> Plant:
        return self.stand.plant

    # ------------------------------------------------------------ by hand

    def button(self, target: str, does: str) -> str:
        """The first button that does it, else that of the panel."""
        found = (each.name for each in self.plant.buttons.values() if each.does == does and each.of == target)
        return next(found, f"{target}_{does.capitalize()}")

    def start(self, target: str, without: str = "") -> None:
        """Press its start; all of it but one may turn from now on."""
        self.stand.may |= {*self.stand.members(target)} - {without}
        self.stand.push(self.button(target, "start"))

    def stop(self, target: str, without: str = "", others: Collection[str] = ()) -> None:
        """Press its stop, and wait until all of it, but for one, is proved at standstill."""
        own = [each for each in self.stand.members(target) if each != without]
        self.stand.may -= {*own}
        self.stand.push(self.button(target, "stop"))
        self.see_standstill(own, others)

    def reset(self) -> None:
        """Close the contacts of the hard stops."""
        self.stand.push("Hmi_Reset")
        self.see(lambda: not self.opened(), SEEN_MS, "a reset closes the contacts of all hard stops", self.plant.drives)

    def clear(self, motor: Motor) -> None:
        """Reset a fault by a button, where the drive takes that over the bus; else at its keypad."""
        of = {motor.name, *(each.name for each in self.plant.groups.values() if motor.name in each.drives)}
        own = (each.name for each in self.plant.buttons.values() if each.does == "reset" and each.of in of)
        if "fault_reset" in words(motor.map).named:
            self.stand.push(next(own, "Hmi_Reset"))
        else:
            self.stand.drives[motor.name].reset()

    # ------------------------------------------------------------ by eye

    def opened(self) -> list[str]:
        """Hard stops whose contact is open."""
        return [each for each in self.plant.hard_stops if not self.stand.pin(f"{each}_Ok")]

    def turning(self, names: Collection[str]) -> list[str]:
        """Those whose drive gives an output."""
        return [each for each in names if self.stand.drives[each].motor.driven]

    def at_speed(self, name: str) -> bool:
        """Whether it turns as asked, forward, and its block shows that it runs."""
        asked, turns = self.stand.asked(name), self.stand.drives[name].hertz
        return abs(turns - asked) <= max(LEAST_HZ, TOLERANCE * asked) and bool(self.stand.pin(f"{name}.Running"))

    def rests(self, name: str) -> bool:
        """Whether its shaft stands, and its block shows that this is proved."""
        return not self.stand.drives[name].motor.shaft and bool(self.stand.pin(f"{name}.StopConfirmed"))

    def at_work(self, target: str, without: str = "") -> bool:
        """Whether a target does what it was started for."""
        members = [each for each in self.stand.members(target) if each != without and not self.off(each)]
        fast, most = [each for each in members if self.at_speed(each)], self.duty(target)
        return len(fast) == len(self.turning(members)) == min(most or len(members), len(members))

    def off(self, name: str) -> bool:
        """Whether it is out of service."""
        return self.plant.group_of(name) is not None and bool(self.stand.pin(f"{name}_Off"))

    def duty(self, target: str) -> int | None:
        """How many of a group run, where that is not all of them."""
        group = self.plant.groups.get(target)
        return group.duty or 1 if group and group.kind == "duty_standby" else None

    # ------------------------------------------------------------ with patience

    def see(
        self,
        holds: Callable[[], bool],
        within_ms: int,
        expected: str,
        names: Collection[str],
        others: Collection[str] = (),
    ) -> None:
        """Wait until something holds, while the others run on. Raises Broken, with what the named ones do."""

        def both() -> bool:
            slow = [each for each in others if not self.at_speed(each)]
            if slow:
                raise Broken("the other motors run on", self.stand.states(slow))
            return holds()

        self.stand.until(both, within_ms, expected, lambda: self.stand.states(names))

    def see_answers(self, names: Collection[str], others: Collection[str] = ()) -> None:
        """Drives answer."""
        self.see(
            lambda: all(self.stand.pin(f"{each}.CommOk") for each in names),
            BOOT_MS, f"{_all(names)} answer", names, others,
        )  # fmt: skip

    def see_work(self, target: str, without: str = "", others: Collection[str] = ()) -> None:
        """A target does what it was started for."""
        members, most = [each for each in self.stand.members(target) if each != without], self.duty(target)
        what = f"{most} of {_all(members)}" if most else _all(members)
        within = self.start_ms(target)
        self.see(lambda: self.at_work(target, without), within, f"{what} at speed", members, others)

    def see_standstill(self, names: Collection[str], others: Collection[str] = (), proof_ms: int = 0) -> None:
        """Each stands, and shows it, within its own time; `proof_ms` longer, where another disturbs."""
        begun, waits = self.stand.ms, set(names)

        def done() -> bool:
            waits.difference_update([each for each in waits if self.rests(each)])
            for each in waits:
                within = self.plant.drives[each].stop_within_ms + proof_ms
                if self.stand.ms - begun > within:
                    said = f"{each} at standstill, and StopConfirmed, within {within / 1000:g} s"
                    raise Broken(said, self.stand.state(each))
            return not waits

        longest = max(self.plant.drives[each].stop_within_ms for each in names) + proof_ms + START_MS
        self.see(done, longest, f"{_all(names)} at standstill", names, others)

    def see_rest(self, names: Collection[str], others: Collection[str] = ()) -> None:
        """Their shafts stand."""
        shafts = [self.stand.drives[each].motor for each in names]
        self.see(lambda: not any(each.shaft for each in shafts), REST_MS, f"{_all(names)} come to rest", names, others)

    def see_nothing(self, others: Collection[str] = (), ms: int = STAY_MS) -> None:
        """Nothing starts, which the stand watches; the others run on."""
        end = self.stand.ms + ms
        self.see(lambda: self.stand.ms >= end, ms + START_MS, "time passes", others, others)

    # ------------------------------------------------------------ who depends on whom

    def others(self, names: Collection[str], *, silent: bool = False) -> list[str]:
        """The motors that turn, and that nothing stops when these end: they are in no sequence with one of them.

        `silent`: the contact of their hard stop opens, too.
        """
        ended = {*names}
        if silent:
            open_ = [each for each in self.plant.hard_stops.values() if {*self.turning(names)} & {*each.drives}]
            ended |= {drive for each in open_ for drive in each.drives}
        for group in self.plant.groups.values():
            if group.kind == "sequence" and ended & {*group.drives}:
                ended |= {*group.drives}
        return [each for each in self.turning(self.plant.drives) if each not in ended]

    def start_ms(self, target: str) -> int:
        """How long a start takes at most."""
        members, group = self.plant.members(target), self.plant.groups.get(target)
        ramp = max(int(1000 * SLACK * float(each.ramp_up_s or USUAL_RAMP_S)) for each in members)
        each_ms = START_MS + (group.delay_ms or 1000) if group and group.kind == "sequence" else 0
        return START_MS + ramp + each_ms * len(members)

    def seen_ms(self, motor: Motor) -> int:
        """How long it takes until what a drive shows is seen."""
        ages = self.figures[motor.line].ages
        return SEEN_MS + next(each.promised.read for each in ages if each.unit.name == motor.name)


def _all(names: Collection[str]) -> str:
    return ", ".join(names)
