"""Whose request is it: two makes on one slot, at one address, at each other's address, an old block, a refused stop.

`python -m tests.line.owners [--only NAME]` goes through all of them; a name is what happens and the families, as in
`slot,JSCC,CHF`. Nobody asks a motor to turn but where it says so: whatever turns was moved by a stop.
"""

import sys
from collections.abc import Callable, Iterator, Sequence
from functools import cache
from itertools import pairwise, product

from tests.line.budget import ORDERS
from tests.line.crowd import FAMILIES, Crowd, Exchange, Hall, crowd
from tests.line.many import Judged, arguments, judged, summary
from tests.second.drive import Drive
from tests.second.frames import LAST_READ
from tests.second.matrix import BY_TERMINALS, OWN_SPEED
from tests.second.pf4 import alike

S = 1_000_000
QUIET_US, READY_US, SPEED_US, STAND_US = 20 * S, 20 * S, 8 * S, 25 * S
OVERDUE_US = 3 * S
"""A slot that two blocks share, or an address, is overdue by then; there is time for the first contact."""
JOINED_US = 300_000
"""What was on its way before."""
RUN: dict[str, tuple[int, int]] = alike(
    {
        "ATV312": (6, 15),
        "CHF": (6, 1),
        "GD200A": (6, 1),
        "JSCC": (6, 1),
        "MX2": (5, 0xFF00),
        "PF4": (6, 0x12),
        "SN300G5": (16, 1),
    }
)
"""Function and word that make each run."""
OLD = 3 * 256
"""Abi of a version before."""
COMMANDED = ("ATV312", "GD200A", "PF4", "PF400", "PF40P", "PF4M", "PF525")
"""Families whose registers show whether the bus is in command."""
MODES = ("SpeedOnly", "MonitorOnly")
SILENT_US, EVERY_US = 5 * S, 3 * S
"""From its silence to its stop; from one stop to the next, which is a second, with what is asked of it between."""
Frame = tuple[int, int, bytes]


class Case:
    """Blocks and drives that do not fit, and what came of them."""

    def __init__(self, name: str, library: Crowd) -> None:
        """A line of three slots."""
        self.library, self.out = library, Judged(name)
        self.hall = Hall(library, 1, slots=3)
        self.joined_us = 0
        """When what is wrong has begun."""
        self.allowed: dict[int, set[Frame]] = {}
        """Writes that a unit may get, by function, register and data."""
        self.moves: set[int] = set()
        """Units that somebody runs."""
        self.hall.watch.append(self._heard)

    def _heard(self, exchange: Exchange) -> None:
        data, unit = exchange.data, exchange.data[0]
        for one in self.hall.models.get(unit, []):
            if one.output and one.by == "bus" and not one.stopping and unit not in self.moves:
                self.tell("moved", f"unit {unit} turns by {data.hex()}")
        strange = (data[1], int.from_bytes(data[2:4], "big"), data[4:]) not in self.allowed.get(unit, set())
        late = exchange.begins > self.joined_us + JOINED_US
        taken = any(reply[:6] == data[:6] for _, _, reply in exchange.replies)  # else it is no register of that drive
        if data[1] > LAST_READ and strange and late and taken:
            self.tell("write", f"{data.hex()} to unit {unit}")

    def tell(self, rule: str, seen: str) -> None:
        """A broken rule, and when."""
        shown = [f"Reason {d['Reason']:.0f} StopOverdue {d['StopOverdue']:.0f}" for d in self.hall.drives]
        self.out.tell(rule, f"{self.hall.now // 1000} ms: {seen}; {shown}")

    def model(self, family: str, unit: int, **options: object) -> Drive:
        """A drive, which may get the stops of its own family."""
        self.allowed[unit] = idle(family)
        return self.hall.model(family, unit, **options)

    def until(self, test: Callable[[], object], most_us: int) -> bool:
        """Until something is so."""
        end = self.hall.now + most_us
        while not test():
            if self.hall.now >= end:
                return False
            self.hall.run(self.hall.now + 10_000)
        return True

    def start(self, at: int, one: Drive) -> bool:
        """Run a drive by its block; what is written meanwhile is right."""
        unit = int(self.hall.drives[at]["Address"])
        self.moves.add(unit)
        self.joined_us = 1 << 60
        if not self.until(lambda: self.hall.drives[at]["Ready"], READY_US):
            self.tell("ready", "it is not")
        self.hall.put(at, RunForward=1)
        good = self.until(lambda: one.motor.hz(self.hall.now) >= 25, SPEED_US)
        if not good:
            self.tell("start", "it does not run")
        return good

    def joins(self) -> None:
        """From now on something is wrong."""
        self.joined_us = self.hall.now

    def stands(self, one: Drive) -> None:
        """It comes to standstill by a stop; from now on nobody runs it."""
        if not self.until(lambda: not one.shaft_hz(self.hall.now), STAND_US):
            self.tell("turns", f"{one.shaft_hz(self.hall.now):.0f} Hz, nobody stops it")
        self.moves.clear()

    def overdue(self, some: Sequence[int], *, most_us: int = OVERDUE_US) -> None:
        """Blocks show that a stop is overdue."""
        if not self.until(lambda: all(self.hall.drives[at]["StopOverdue"] for at in some), most_us):
            self.tell("not overdue", f"blocks {list(some)}")

    def quiet(self, us: int = QUIET_US) -> None:
        """Nothing happens; no block says that a motor stands which turns."""
        end = self.hall.now + us
        while self.hall.now < end:
            self.hall.run(self.hall.now + 100_000)
            for at, d in enumerate(self.hall.drives):
                units = self.hall.models.get(int(d["Address"]), [])
                if d["StopConfirmed"] and any(one.shaft_hz(self.hall.now) for one in units):
                    self.tell("confirmed", f"block {at} says standstill")


@cache
def idle(family: str) -> set[Frame]:
    """What is written to a drive by its own block while nobody touches a pin, and when it is stopped."""
    found: set[Frame] = set()
    hall = Hall(crowd(), 1, slots=3)

    def heard(exchange: Exchange) -> None:
        data = exchange.data
        if data[1] > LAST_READ and (int.from_bytes(data[2:4], "big") == ORDERS[family]) and not runs_of(family, data):
            found.add((data[1], int.from_bytes(data[2:4], "big"), data[4:]))

    hall.watch.append(heard)
    hall.drive(family, 1)
    hall.model(family, 1)
    hall.restart()
    hall.run(10 * S)
    for pins in ({"RunForward": 1}, {"RunForward": 0}, {"JogForward": 1}, {"JogForward": 0}, {"SpeedOnly": 1}):
        hall.put(0, **pins)
        hall.run(hall.now + 8 * S)
    return found


def runs_of(family: str, data: bytes) -> bool:
    """Whether a write is what makes it run."""
    function, word = RUN[family]
    return data[1] == function and int.from_bytes(data[-2:], "big") == word


# ---------------------------------------------------------------- what happens


def slot(case: Case, first: str, second: str, rhythm: str) -> None:
    """Two blocks on one slot from power-up, with two units; perhaps in slower tasks."""
    h = case.hall
    case.model(first, 1)
    case.model(second, 2)
    h.drive(first, 1, 0)
    h.drive(second, 2, 0)
    _tasks(h, rhythm)
    h.restart()
    case.overdue([0, 1])
    case.quiet()


def _tasks(hall: Hall, rhythm: str) -> None:
    for at, scans in enumerate(rhythm.split()):
        hall.seen(at).nth = int(scans)


def slot_run(case: Case, first: str, second: str, rhythm: str) -> None:
    """A second block comes to the slot of a motor that runs: that one is stopped, and the other unit never moves."""
    h = case.hall
    one = case.model(first, 1)
    case.model(second, 2)
    h.drive(first, 1, 0)
    at = h.drive(second, 2, 0)
    _tasks(h, rhythm)
    h.call(at, on=False)
    h.restart()
    if case.start(0, one):
        h.call(at, on=True)
        case.joins()
        case.overdue([0])
        case.stands(one)
        case.quiet()


def address(case: Case, first: str, second: str) -> None:
    """Two blocks of two families at one address, where the first's drive is; from power-up."""
    h = case.hall
    case.model(first, 1)
    h.drive(first, 1)
    h.drive(second, 1)
    h.restart()
    case.overdue([0, 1])
    case.quiet()


def address_run(case: Case, first: str, second: str) -> None:
    """A second block is given the address of a motor that runs: it is stopped."""
    h = case.hall
    one = case.model(first, 1)
    case.model(second, 2)
    h.drive(first, 1)
    at = h.drive(second, 2)
    h.restart()
    if case.until(lambda: h.drives[at]["StopConfirmed"], READY_US) and case.start(0, one):
        h.put(at, Address=1)
        case.joins()
        case.overdue([0])
        case.stands(one)
        case.quiet()


def address_typo(case: Case, first: str, second: str) -> None:
    """At standstill: an address typo opens no contact, and the right one again starts nothing."""
    h = case.hall
    case.model(first, 1)
    case.model(second, 2)
    h.drive(first, 1)
    at = h.drive(second, 2)
    h.restart()
    if case.until(lambda: all(d["StopConfirmed"] for d in h.drives), READY_US):
        h.put(at, Address=1)
        end = h.now + 10 * S
        while h.now < end:
            h.run(h.now + 100_000)
            if h.line["StopOverdue"]:
                case.tell("overdue", "all stand")
        h.put(at, Address=2)
        case.quiet(5 * S)
        if not case.until(lambda: all(d["Ready"] for d in h.drives), READY_US):
            case.tell("again", "not ready")


def wrong(case: Case, first: str, second: str) -> None:
    """A block alone at the address of another make's drive; sister models with the same words are none."""
    case.model(second, 1)
    case.hall.drive(first, 1)
    case.hall.restart()
    case.quiet()
    if idle(first) != idle(second) and case.hall.drives[0]["StopConfirmed"]:
        case.tell("stands", "a drive of another make is called stopped")


def swapped(case: Case, first: str, second: str) -> None:
    """Two blocks, each at the other's drive."""
    h = case.hall
    case.model(second, 1)
    case.model(first, 2)
    h.drive(first, 1)
    h.drive(second, 2)
    h.restart()
    case.quiet()


def changed(case: Case, first: str, second: str) -> None:
    """A block whose motor runs is given the address of another make: it takes that at standstill."""
    h = case.hall
    one = case.model(first, 1)
    case.model(second, 2)
    h.drive(first, 1)
    h.restart()
    if case.start(0, one):
        h.put(0, Address=2)
        case.joined_us = 1 << 60
        h.run(h.now + 3 * S)
        h.put(0, RunForward=0)
        case.joins()
        case.stands(one)
        case.quiet()


def old_block(case: Case, family: str) -> None:
    """A block of another version from the start: nothing is sent."""
    h = case.hall
    case.model(family, 1)
    case.allowed[1] = set()
    h.drive(family, 1)
    _old(case, family)
    h.restart()
    case.overdue([0], most_us=5 * S)
    h.put(0, RunForward=1)
    case.quiet()


def old_block_run(case: Case, family: str) -> None:
    """... from one call to the next, while its motor runs: the copy is sent."""
    h = case.hall
    one = case.model(family, 1)
    h.drive(family, 1)
    h.restart()
    if case.start(0, one):
        _old(case, family)
        case.joins()
        case.stands(one)
        case.quiet()


def _old(case: Case, family: str) -> None:
    block = case.hall.seen(0)
    block.function, block.word = RUN[family]
    block.block_abi, block.address = OLD, ORDERS[family]


def old_line(case: Case, family: str) -> None:
    """A line of another version: the block starts nothing."""
    h = case.hall
    one = case.model(family, 1)
    h.drive(family, 1)
    h.seen(0).line_abi = OLD
    h.restart()
    case.quiet(10 * S)
    if h.drives[0]["Ready"]:
        case.tell("ready", "beside an old line")
    h.put(0, RunForward=1)
    case.quiet(5 * S)
    if one.output:
        case.tell("starts", "beside an old line")


def old_line_run(case: Case, family: str) -> None:
    """... from one call to the next, while its motor runs: it posts its stop."""
    h = case.hall
    one = case.model(family, 1)
    h.drive(family, 1)
    h.restart()
    if case.start(0, one):
        h.seen(0).line_abi = OLD
        case.joins()
        case.stands(one)


def silent(case: Case, family: str) -> None:
    """A drive that runs and falls silent is sent its stop every second, whatever has to be read of it before."""
    h = case.hall
    one = case.model(family, 1)
    h.drive(family, 1)
    h.restart()
    if not case.start(0, one):
        return
    stops: list[int] = []

    def heard(exchange: Exchange) -> None:
        data = exchange.data
        if data[1] > LAST_READ and int.from_bytes(data[2:4], "big") == ORDERS[family] and not runs_of(family, data):
            stops.append(exchange.begins)

    h.watch.append(heard)
    h.deaf.add(1)
    begun = h.now + SILENT_US
    h.run(h.now + 60 * S)
    times = [begun, *(at for at in stops if at > begun), h.now]
    gap = max(later - at for at, later in pairwise(times))
    if gap > EVERY_US:
        case.tell("unstopped", f"{gap // 1000} ms without a stop, {len(stops)} in a minute")


def refused(case: Case, family: str, mode: str, how: str) -> None:
    """A restart, or a power-up, into a mode without command, while the bus runs the motor and stops are refused."""
    h = case.hall
    one = case.model(family, 1)
    h.drive(family, 1)
    h.restart()
    if not case.start(0, one):
        return
    case.joined_us = 1 << 60
    one.be_strict(h.now, 15 * S)
    pins = {"RunForward": 0, mode: 1}
    if how == "restart":
        h.put(0, **pins)
        h.restart()
    else:
        case.hall = h = Hall(case.library, 2, slots=3, before=h)
        h.watch.append(case._heard)
        h.drive(family, 1, **pins)
        h.restart()
    case.overdue([0], most_us=15 * S)
    case.stands(one)


def terminals(case: Case, family: str, mode: str, how: str) -> None:
    """The same, where terminals run it and the map shows who is in command: no contact is opened."""
    h = case.hall
    one = case.model(family, 1, not_in_command="refuses", settings=BY_TERMINALS[family] | OWN_SPEED[family])
    case.joined_us = 1 << 60
    h.drive(family, 1, **{mode: 1})
    h.restart()
    case.until(lambda: h.drives[0]["CommOk"], READY_US)
    h.run(h.now + 5 * S)
    one.terminal(True, h.now)
    h.run(h.now + 5 * S)
    if how == "restart":
        h.restart()
    else:
        case.hall = h = Hall(case.library, 2, slots=3, before=h)
        h.drive(family, 1, **{mode: 1})
        h.restart()
    end = h.now + 30 * S
    while h.now < end:
        h.run(h.now + 100_000)
        if h.drives[0]["StopOverdue"]:
            case.tell("overdue", "terminals run it, and the drive says so")
    if one.motor.hz(h.now) < 1:
        case.tell("stopped", "terminals ran it")


Happens = Callable[..., None]
SHARED: dict[str, Happens] = {"slot": slot, "slot run": slot_run}
PAIRS = {"address": address, "address run": address_run, "typo": address_typo,
         "wrong": wrong, "swapped": swapped, "changed": changed}  # fmt: skip
ALONE: dict[str, Happens] = {
    "old block": old_block,
    "old block run": old_block_run,
    "old line": old_line,
    "old line run": old_line_run,
    "silent": silent,
}
RESTARTS: dict[str, Happens] = {"refused": refused, "terminals": terminals}
HAPPENS = SHARED | PAIRS | ALONE | RESTARTS


def names() -> Iterator[str]:
    """All of them."""
    pairs = [(first, second) for first, second in product(FAMILIES, FAMILIES) if first != second]
    yield from (f"{what},{a},{b},{how}" for what in SHARED for a, b in pairs for how in ("1 1", "1 2", "2 5", "5 3"))
    yield from (f"{what},{first},{second}" for what in PAIRS for first, second in pairs)
    yield from (f"{what},{family}" for what in ALONE for family in FAMILIES)
    modes = list(product(FAMILIES, MODES, ("restart", "power-up")))
    yield from (f"refused,{','.join(each)}" for each in modes)
    yield from (f"terminals,{','.join(each)}" for each in modes if each[0] in COMMANDED)


def judge(name: str) -> Judged:
    """Judge a case by its name."""
    what, *families = name.split(",")
    for each in set(families) & set(FAMILIES):
        idle(each)  # a line of its own, and there is one at a time
    case = Case(name, crowd())
    HAPPENS[what](case, *families)
    return case.out


def main() -> int:
    """Go through all of them."""
    parser = arguments(__doc__ or "", 0)
    parser.add_argument("--only", default="", help="those whose name begins so")
    options = parser.parse_args()
    crowd()  # compiled once, for all processes
    return summary(judged((n for n in names() if n.startswith(options.only)), judge, options.jobs, options.store))


if __name__ == "__main__":
    sys.exit(main())
