"""Every mode x every event x every state of the drive, with a second event on its heels, on lines of second models.

`python -m tests.second.matrix "CHF, full control, a trip, at speed" --seed 3` repeats one cell alone. Options of the
models, the size of the line, its mode and scan come from rows of all pairs, chosen by the cell's name and its seed.
"""

import argparse
import sys
from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cache
from itertools import product
from random import Random
from typing import Any

from tests.second import pairs
from tests.second.bench import Second
from tests.second.drive import Drive
from tests.second.events import AIMED, EVENTS, FAULT, LONG, Event
from tests.second.figures import FOREIGN, crowded, path_us
from tests.second.pf4 import VARIANTS, alike
from tests.second.station import ALONE, FAMILIES, RTU_ONLY, SIZES, types_of

from structured_text.engines.engine import Library

MODES = ("full control", "jog", "SpeedOnly", "MonitorOnly")
STATES = ("standstill", "starting", "at speed", "ramping down", "coasting", "tripped", "local")
BY_TERMINALS = alike(
    {
        "ATV312": {"CHCF": 2, "CD1": 1},
        "CHF": {"run": 1},
        "GD200A": {"P00_01": 1},
        "JSCC": {"F0_04": 1},
        "MX2": {"A002": 1},
        "PF4": {"P036": 1},
        "PF4M": {"run": 1},
        "PF525": {"P046": 2},
        "SN300G5": {"b1_02": 1},
        "V20": {"P0700": 2},
        "ACS355": {"1001": 1},
    }
)
OWN_SPEED = alike(
    {
        "ATV312": {"FR1": 1},
        "CHF": {"speed": 0},
        "GD200A": {"P00_06": 0},
        "JSCC": {"F0_08": 1},
        "MX2": {"A001": 2},
        "PF4": {"P038": 0},
        "PF4M": {"P108": 0},
        "PF525": {"P047": 1},
        "SN300G5": {"b1_01": 0},
        "V20": {"P1000": 1},
        "ACS355": {"1103": 0},
    }
)
JOGS = ("CHF", "GD200A")
START_MS = 6000
"""From an edge to its speed: 25 Hz at 10 Hz/s, and retries."""
FOLLOW_MS = 8000
"""From an edge to the reason that it is not followed: FollowWithinMs, 5 s, from the answer to run."""
READY_MS = 14_000
"""From the end of an event until it can be started again."""
STOPPING = 0
"""State of a block whose stop has not ended."""
RESET_MS = 8000
"""For a reset, which is given up after 10 s."""
FOREIGN_MS = 15_000
"""How long another master seems to be there after its last frame: no reset is sent meanwhile."""
APART_MS = (0, 20, 100, 300, 700, 1500, 1950)
"""When the second event comes."""
BOTH: tuple[Any, ...] = (False, True)
OPTIONS: dict[str, tuple[Any, ...]] = {
    # the line
    "size": SIZES, "ascii": BOTH, "ms": (20, 10, 40), "others run": BOTH, "before": ("", "a jog", "a coast"),
    "reverse": BOTH, "no scale": BOTH, "limit": BOTH, "refresh": (0, 300, 65535), "learns": BOTH,
    "echo": BOTH,
    # all models
    "start_us": (0, 200_000), "reply_us": ((10_000, 10_000), (10_000, 18_000)), "late_per_1000": (0, 30),
    "stop_key": BOTH, "start_key": BOTH, "stop_key_holds": BOTH, "terminals_act": (False,),
    "bus_stop_ends_others": BOTH, "not_in_command": ("acknowledges", "refuses"), "resumes_remote": BOTH,
    "coast_shows": ("zero", "shaft"), "running_in_ramp": BOTH, "code_after_reset": ("zero", "last"),
    "trip_output": ("coast", "ramp"), "latched": BOTH, "reset_needs_stop": BOTH, "resumes_after_reset": BOTH,
    "resumes_after_inhibit": BOTH, "retry_us": (None, 1_000_000), "resumes_after_power": BOTH,
    "ride_us": (0, 400_000), "dip_trips": BOTH, "comm_us": (None, 6_000_000),
    "comm_action": ("ramp", "quick", "coast"), "comm_trips": BOTH, "fed_by": ("own", "any"),
    "busy_refuses": ("parameters", "writes", "all"),
    # families
    "ATV312.disable_stops": ("Stt", "ramp"), "ATV312.reset_to": ("disabled", "ready"), "ATV312.reached_at_rest": BOTH,
    "ATV312.leaves": ("at once", "at standstill"), "MX2.coast_runs": BOTH,
    "MX2.run_acts": ("once", "always"), "MX2.reset_acts": ("rise", "fall"), "MX2.reset_cuts": BOTH,
    "MX2.reset_keeps_coils": BOTH, "MX2.reset_deaf_us": (0, 1_000_000), "MX2.volts": (1, 10), "MX2.half_pairs": BOTH,
    "MX2.way_while_running": ("turns", "next start"), "MX2.coil_13": ("running", "tripped"),
    "CHF.stop_ends_jog": BOTH, "CHF.jog_stop_ends_run": BOTH, "CHF.standby_in_coast": BOTH,
    "CHF.reserved_rows": BOTH, "CHF.two_byte_count": BOTH, "CHF.jogs_from_run": BOTH,
    "JSCC.commands_readable": BOTH, "JSCC.fault_word": (8, 9, 12), "JSCC.stop_resets": BOTH,
    "GD200A.stop_ends_jog": BOTH, "GD200A.jog_stop_ends_run": BOTH, "GD200A.jogs_from_run": BOTH,
    "GD200A.coast_stopped": BOTH,
    "PF4.start_acts": ("once", "always"), "PF4.stop_resets": BOTH, "PF4.commands_readable": BOTH,
    "SN300G5.key_cuts_line": BOTH,
    "V20.way_at_rest": ("asked", "clockwise", "counterclockwise"), "V20.before_plc": ("kept", "lost"),
    "V20.serial": ("in command", "not local"),
    "V20.on_in_ramp": BOTH, "V20.key_to": ("ready", "inhibited"), "V20.reached_at_rest": BOTH,
    "V20.speed_alone": ("acts",),  # else the motor stays at 0 Hz with SpeedOnly: known, for the block to mend
    "ACS355.ready_us": (0, 100_000), "ACS355.on_in_ramp": BOTH, "ACS355.key_to": ("ready", "inhibited"),
    "ACS355.reached_at_rest": BOTH, "ACS355.signs": BOTH,
    "SN300G5.run_needs_edge": BOTH, "KeepWord": (0, 0x24), "SN300G5.zero_speed_of": ("output", "shaft"),
}  # fmt: skip
LINE = (
    "size", "ascii", "ms", "others run", "before", "reverse", "no scale", "limit", "refresh", "learns", "KeepWord",
    "echo",
)  # fmt: skip


@cache
def rows(family: str = "") -> list[pairs.Row]:
    """Rows of all pairs of options, without those of drives that are never on a line with this one.

    So a new family changes no row of the others, and a cell that once failed keeps its own.
    """
    apart = {*ALONE} - {family}
    return pairs.rows({name: values for name, values in OPTIONS.items() if name.partition(".")[0] not in apart})


class NotReached(Exception):  # noqa: N818  (no error: there is no such state)
    """The drive cannot come to the state of a cell: why."""


@dataclass(frozen=True)
class Cell:
    """A field of the matrix; its name says all but the seed."""

    family: str
    mode: str
    event: str
    state: str

    def __str__(self) -> str:
        """As it is named, and read by `named`."""
        return f"{self.family}, {self.mode}, {self.event}, {self.state}"


def named(name: str) -> Cell:
    """The cell of a name."""
    return Cell(*name.split(", "))


def cells() -> list[Cell]:
    """All of them; CHF alone jogs, as the library knows the drives."""
    events = (*EVENTS, *AIMED)
    return [Cell(*each) for each in product(FAMILIES, MODES, events, STATES) if each[1] != "jog" or each[0] in JOGS]


def row_of(cell: Cell, seed: int, chance: Random | None = None) -> pairs.Row:
    """The options of a run: the first thing that is drawn."""
    row: pairs.Row = (chance or Random(f"{cell} {seed}")).choice(rows(cell.family))
    return row


@dataclass
class Outcome:
    """How a run of a cell ended."""

    cell: Cell
    seed: int
    second: str = ""
    """The second event."""
    rules: list[str] = field(default_factory=list)
    """Broken rules, the first one first; empty: all held."""
    told: list[str] = field(default_factory=list)
    not_reached: str = ""
    events: list[str] = field(default_factory=list)
    """All of them, in their order."""


class Run:
    """One run of a cell."""

    def __init__(self, cell: Cell, seed: int, stations: Library | None = None) -> None:
        """Draw options and times by name and seed, and power up."""
        self.cell, self.seed = cell, seed
        self.chance = Random(f"{cell} {seed}")
        self.row = row = row_of(cell, seed, self.chance)
        second = self.chance.choice([each for each in EVENTS if each not in (*LONG, cell.event)])
        self.second = second if seed % 2 else ""
        self.events = [each for each in (cell.event, self.second) if each]
        ascii_ = row["ascii"] and cell.family not in RTU_ONLY
        types = types_of(cell.family, row["size"], ascii_=ascii_)
        self.by_bus = cell.mode in MODES[:2]
        settings = {} if self.by_bus else dict(BY_TERMINALS[cell.family])
        if cell.mode == "MonitorOnly":
            settings |= OWN_SPEED[cell.family]
        pins: dict[str, Any] = {} if self.by_bus else {cell.mode: True}
        if row["limit"]:
            pins["MaximumHz"] = 40.0
        if row["no scale"] and cell.family == "CHF":
            pins["FrequencyScale"] = 0.0
        pins |= {"RefreshMs": row["refresh"], "KeepWord": row["KeepWord"]}
        pins |= {"TurnRoundMs": 0} if row["learns"] else {}
        self.bench = b = Second(
            *types, options={each: self._options(each) for each in FAMILIES}, settings=settings, pins=pins,
            stations=stations, seed=seed, ms=row["ms"], ascii_=ascii_,
        )  # fmt: skip
        for index in range(1, len(types)):
            b.put(index, RefreshMs=row["refresh"])
        self.judge = b.judge
        b.mode, b.echo = cell.mode, row["echo"]
        b.start_pin = ("Jog" if cell.mode == "jog" else "Run") + ("Reverse" if row["reverse"] else "Forward")

    def _options(self, family: str) -> dict[str, Any]:
        given = {k: v for k, v in self.row.items() if "." not in k and k not in LINE}
        like = "PF4" if family in VARIANTS else family
        given |= {k.split(".")[1]: v for k, v in self.row.items() if k.startswith(f"{like}.")}
        given["late_us"] = 25_000
        if self.cell.state == "coasting":
            given["stop_mode"] = "coast"
        if like in ("ACS355", "ATV312", "GD200A", "MX2", "PF4", "V20"):
            given["busy_refuses"] = "parameters"  # their manuals have no code of a busy drive
        if not self.by_bus:
            given["settings_act"] = "at once"
        if family == "V20" and self.cell.mode == "MonitorOnly":
            given["comm_us"] = None  # nothing feeds it then, as its page says
        return given

    # ------------------------------------------------------------ to the state

    @property
    def one(self) -> Drive:
        """The drive that things happen to."""
        return self.bench.models[0]

    def state(self) -> str:
        """Where the drive truly is; terminals that are in command are no other hand here."""
        return self._state_of(0)

    def _state_of(self, index: int) -> str:
        one, now = self.bench.models[index], self.bench.now
        found: str = one.state(now)
        if found != "local" or self.by_bus or one.local:
            return found
        if one.stopping:
            return "ramping down"
        return "at speed" if one.motor.slope == 0.0 and one.motor.hz(now) else "starting"

    def start(self) -> None:
        """An edge, or the wired terminal."""
        if self.by_bus:
            self.bench.put(0, **{self.bench.start_pin: True})
        else:
            self.one.terminal(True, self.bench.now)

    def stop(self) -> None:
        """Its end."""
        if self.by_bus:
            self.bench.release()
        else:
            self.one.terminal(False, self.bench.now)

    def fail(self, rule: str, index: int = 0) -> None:
        """A rule that the run itself sees broken."""
        self.judge.tell(index, rule, self.bench.told(index))

    def ready(self, index: int = 0) -> bool:
        """Wait until the block would start its drive, or without its command, until it reads it."""
        b = self.bench
        most = READY_MS * (1 + crowded(b)) + self.judge.late_us(index) // 1000  # it has to answer 20 times before
        if index or self.by_bus:
            return b.wait(lambda: b.shows("Ready", index) and b.shows("StopConfirmed", index), most)
        good = b.wait(lambda: b.shows("CommOk", index), most)
        b.run(2000)  # stops of a restart, which may end what terminals run
        # one that is refused ends when standstill is read
        b.wait(lambda: not b.shows("StopOverdue", index) and b.number("State", index) != STOPPING, most)
        return good

    def at_speed(self, index: int = 0) -> bool:
        """Wait until the motor truly is."""
        b = self.bench
        return b.wait(lambda: self._state_of(index) == "at speed", START_MS + path_us(b, index) // 1000)

    def reach(self) -> None:
        """From power-up to the state. Raises NotReached."""
        b = self.bench
        b.run(1500)
        if not all(self.ready(index) for index in range(len(b.models))):
            self.fail("start")
            raise NotReached("it never becomes ready")
        b.press()
        if not b.contact:
            self.fail("close")
        if self.cell.mode == "jog" and not b.out("CanJog"):
            raise NotReached("it has no jog")
        self._before()
        if self.row["others run"]:
            for index in range(1, len(b.models)):
                b.put(index, RunForward=True)
            for index in range(1, len(b.models)):
                if not self.at_speed(index):
                    self.fail("start", index)
        self._to_state()

    def _before(self) -> None:
        """A jog or a coast that has ended well."""
        b, what = self.bench, self.row["before"]
        if not self.by_bus or not what or not b.out("CanJog" if what == "a jog" else "CanCoastStop"):
            return
        b.put(0, **{"JogForward" if what == "a jog" else "RunForward": True}).run(1500)
        if what == "a coast":
            b.put(0, CoastStop=True).run(1500)
        b.release().put(0, CoastStop=False)
        b.wait(lambda: not self.one.motor.hz(b.now), 9000)
        if not self.ready():
            self.fail("start")

    def _to_state(self) -> None:
        b, state = self.bench, self.cell.state
        if state == "standstill":
            return
        if state == "local":
            self._to_local()
            return
        self.start()
        if state == "starting":
            most = START_MS + path_us(b, 0) // 1000
            moved = b.wait(lambda: self.state() == "starting" and abs(self.one.motor.hz(b.now)) > 1, most)
        else:
            moved = self.at_speed()
        if not moved:
            self.fail("start")
            raise NotReached("it does not start")
        if state == "tripped":
            self.one.trip(FAULT[self.cell.family], b.now)
            b.run(400)
        elif state in ("ramping down", "coasting"):
            self.stop()
            if not b.wait(lambda: self.state() == state, 3000):
                self.fail("stop")
                raise NotReached(f"it does not come to {state}")

    def _to_local(self) -> None:
        b = self.bench
        self.one.press("local", b.now)
        self.one.press("start", b.now)
        if not b.wait(lambda: abs(self.one.motor.hz(b.now)) > 1, 3000):
            raise NotReached("its keypad does not start it")

    # ------------------------------------------------------------ the events, and after them

    def happen(self) -> None:
        """Both events, until both are over."""
        b, first = self.bench, (EVENTS | AIMED)[self.cell.event]
        due: list[tuple[int, Event, bool]] = [(b.now, first, True)]
        if self.second:
            due.append((b.now + 1000 * self.chance.choice(APART_MS), EVENTS[self.second], True))
        self._keep([event for _, event, _ in due])
        while due:
            due.sort(key=lambda each: each[0])
            at, event, begins = due.pop(0)
            while b.now < at:
                b.scan()
            (event.begins if begins else event.ends)(b, self.chance)
            if begins:
                due.append((b.now + 1000 * event.lasts, event, False))
        b.run(3000)

    def _keep(self, events: list[Event]) -> None:
        b = self.bench
        driven = {i for i, one in enumerate(b.models) if one.by == "bus" and not one.stopping}
        if any(each.stops_all for each in events):
            driven = set()
        if any(each.stops for each in events) or self.cell.mode == "MonitorOnly":
            driven -= {0}
        if any(each.neighbour for each in events):
            driven -= {1}
        if any(each.others for each in events):
            driven &= {0}
        self.judge.kept = driven

    def heal(self) -> None:
        """What a person does when all is over: release, make good, reset, start anew."""
        b = self.bench
        self.judge.kept = set()
        b.deaf.clear()
        b.put(0, Enable=True, QuickStop=False, CoastStop=False, FaultReset=False, Address=1)
        b.put(0, SpeedOnly=self.cell.mode == "SpeedOnly", MonitorOnly=self.cell.mode == "MonitorOnly")
        for index in range(len(b.models)):
            b.release(index)
        self.one.terminal(False, b.now)
        self.one.inhibit(False, b.now)
        self.one.power(True, b.now)
        self._keypad()
        b.run(1500)
        b.wait(lambda: not any(one.motor.hz(b.now) for one in b.models), 12_000)
        b.acknowledge()
        self._faults()
        b.acknowledge()
        if not all(self.ready(index) for index in range(len(b.models))):
            self.fail("again")
            return
        b.press()
        if not b.contact:
            self.fail("close")
        if self.by_bus and self.one.held:
            self._start_in_vain()
        self.start()
        if not self.at_speed():
            self.fail("again")
        self.stop()
        b.run(1000)

    def _start_in_vain(self) -> None:
        """A stop key that was pressed after the last stop holds the drive, and no register shows that.

        No rule promises that the first start is followed then; if it is not, its block says so, and stops the drive,
        which lets go: the next start is a start as any other.
        """
        b = self.bench
        self.start()
        told = b.wait(lambda: b.reason() == "NOT_FOLLOWED" or self.state() == "at speed", FOLLOW_MS)
        if not told or (b.reason() == "NOT_FOLLOWED" and not b.out("CommandNotFollowed")):
            self.fail("again")
        self.stop()
        if not self.ready():
            self.fail("again")

    def _keypad(self) -> None:
        b, one = self.bench, self.one
        if one.by == "keypad":
            one.press("stop", b.now)
            b.wait(lambda: not one.output, 9000)  # which lasts to the end of its ramp: no other key acts before
        if one.local:
            one.press("local", b.now)
        if one.cut:
            self._cycle(one)

    def _cycle(self, one: Drive) -> None:
        """Its supply, off and on."""
        one.power(False, self.bench.now)
        self.bench.run(3000)
        one.power(True, self.bench.now)
        self.bench.run(1000)

    def _faults(self) -> None:
        b = self.bench
        for index, one in enumerate(b.models):
            one.clear_cause(b.now)
            for _ in range(3):  # power that returns may find another fault
                self._reset(index, one)

    def _reset(self, index: int, one: Drive) -> None:
        """By the bus, by a button, by its supply, whatever it takes."""
        b = self.bench
        b.wait(lambda: b.block["TheLine.ErrorID"] != FOREIGN, FOREIGN_MS)
        if one.fault is not None and b.out("CanResetFault", index):
            b.put(index, FaultReset=True).run(100)
            b.put(index, FaultReset=False).run(1000)
            b.wait(lambda: one.fault is None, RESET_MS)
            mine = (index or self.by_bus) and b.shows("CommOk", index) and not one.cut
            if one.fault is not None and one.fault != one.LOW_VOLTAGE and mine:
                self.fail("reset", index)
        if one.fault is not None:
            one.reset(b.now)  # a wired button: a key may end the connection
            b.run(500)
        if one.fault is not None or one.cut:
            self._cycle(one)

    def go(self) -> Outcome:
        """To the state, through the events, and back."""
        out = Outcome(self.cell, self.seed, self.second, events=self.events)
        try:
            self.reach()
            self.happen()
            self.heal()
        except NotReached as why:
            out.not_reached = str(why)
        for at, unit, rule, seen in self.judge.found:
            if rule not in out.rules:
                out.rules.append(rule)
            out.told.append(f"{rule}: {at // 1000} ms, unit {unit}: {seen}")
        return out


def run(cell: Cell, seed: int = 0, stations: Library | None = None) -> Outcome:
    """Run a cell."""
    return Run(cell, seed, stations).go()


def frames(bench: Second, around_ms: int) -> Iterator[str]:
    """Frames within a second of a moment."""
    for each in bench.frames:
        if abs(each.ms - around_ms) <= 1000 and not each.read:
            yield f"  {each.ms} ms: unit {each.unit} function {each.function} {each.address:04X}H {each.word:04X}H"


def main() -> int:
    """Repeat one cell."""
    parser = argparse.ArgumentParser(description=main.__doc__)
    parser.add_argument("cell")
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args()
    one = Run(named(options.cell), options.seed)
    outcome = one.go()
    row = {name: value for name, value in one.row.items() if "." not in name or name.startswith(one.cell.family)}
    print(f"{one.cell}, seed {options.seed}; then {one.second or 'nothing more'}; {row}")
    print("\n".join(outcome.told) or outcome.not_reached or "every rule has held")
    if one.judge.found:
        print("pins", one.bench.pins[0])
        print("\n".join(frames(one.bench, one.judge.found[0][0] // 1000)))
    return 1 if outcome.rules else 0


if __name__ == "__main__":
    sys.exit(main())
