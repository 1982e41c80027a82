"""What can happen to the first drive of a line: each event begins, lasts, and ends."""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace
from random import Random

from tests.second.bench import METER, Second
from tests.second.drive import RUNS, STOPS, Fault
from tests.second.figures import FOREIGN, SHARED
from tests.second.line import Faults
from tests.second.pf4 import alike

Does = Callable[[Second, Random], None]
FAULT: dict[str, Fault] = alike(
    {"ATV312": 9, "CHF": 3, "GD200A": 4, "JSCC": 1, "MX2": 3, "PF4": 12, "SN300G5": "OC", "V20": 1, "ACS355": 1}
)
OTHER_FAULT: dict[str, Fault] = alike(
    {"ATV312": 18, "CHF": 2, "GD200A": 5, "JSCC": 2, "MX2": 7, "PF4": 7, "SN300G5": "OV", "V20": 2, "ACS355": 2}
)
STATUS = alike({
    "ATV312": 3201, "CHF": 0x1001, "GD200A": 0x2100, "JSCC": 0x2001, "MX2": 0x1000, "PF4": 0x2100, "SN300G5": 0x0010,
    "V20": 0x006D, "ACS355": 3,
})  # fmt: skip
PARAMETER = alike({
    "ATV312": 9001, "CHF": 0x0007, "GD200A": 0x0004, "JSCC": 0x0012, "MX2": 0x144D, "PF4": 0x0025, "PF4M": 0x0130,
    "PF525": 0x002D, "SN300G5": 0x0200, "V20": 0x000A, "ACS355": 0,
})  # fmt: skip
"""Before two that its manual lists."""
WRITES = alike({
    "ATV312": 0, "CHF": 0x8000, "GD200A": 0x8000, "JSCC": 0, "MX2": 0, "PF4": 0, "SN300G5": 0, "V20": 0,
    "ACS355": 0x0898,
})  # fmt: skip
"""Beside it; of ACS355, whose listed rows are all live or commands, words are written to 2201."""
SEVERAL = {"GD200A": 0x0400, "V20": 0x0010, "ACS355": 0x0899}
"""Rows on which neither the connection nor the full scale rests."""
LONGER = {"ACS355": 0x0899, "V20": 0x0010}
"""Where more than two words are read, if not after `PARAMETER`."""
COMMANDS = {"ATV312": 8501, "GD200A": 0x2000, "JSCC": 0x1000, "V20": 0x0063}
"""Where commands are, in families that take several words at once."""
UNUSED = {"SN300G5": 0x0013}
"""A row that the manual lists as unused, between two that can be read."""
NOWHERE = 0xFFF5
"""An address that no manual has."""
HIGHEST = alike({
    "ATV312": 247, "CHF": 247, "GD200A": 247, "JSCC": 247, "MX2": 247, "PF4": 247, "PF4M": 127, "SN300G5": 32,
    "V20": 247, "ACS355": 247,
})  # fmt: skip
"""Unit addresses."""
LONG_MS = 400
"""How long a drive may take to answer."""
ABSENT = 29
"""A unit address that no drive here has, and each could have."""
REMEMBERED_US = 10_000_000
"""Its frames count for so long, or until a restart."""
FORGOTTEN_US = 41_000_000
"""For how long the line may take copies of replies for another master."""
SEEN_BY = 7
"""More of them than the line bears, and some that may be damaged."""


def nothing(_: Second, __: Random) -> None:
    """..."""


@dataclass(frozen=True)
class Event:
    """An event: for how long, in ms, what begins and what ends it, and whether it concerns a drive alone."""

    begins: Does
    lasts: int = 0
    ends: Does = nothing
    stops: bool = True
    """The first drive may stop for it; else it must run on."""
    stops_all: bool = False
    """Others may stop for it, too."""
    neighbour: bool = False
    """The second drive may stop for it."""
    others: bool = False
    """All but the first may stop for it."""


def pin(name: str, value: bool, lasts: int, **more: bool) -> Event:
    """An input of the block, for a time."""

    def end(b: Second, _: Random) -> None:
        if name != b.mode:
            _put(b, name, not value)

    return Event(lambda b, _: _put(b, name, value), lasts, end, **more)


def line(name: str) -> Event:
    """An input of the line, for 100 ms."""
    return Event(lambda b, _: _line(b, name, True), 100, lambda b, _: _line(b, name, False), stops_all=True)


def key(name: str) -> Event:
    """A key of the drive's own keypad."""
    return Event(lambda b, _: b.models[0].press(name, b.now))  # type: ignore[arg-type]  # one of them


def late(ms: int, *, stops: bool) -> Event:
    """A scan that comes late."""
    return Event(lambda b, _: b.stall(ms), stops=stops, stops_all=stops)


def _put(b: Second, name: str, value: bool) -> None:
    b.put(0, **{name: value})


def _line(b: Second, name: str, on: bool) -> None:
    b.line(**{name: on})


def restart(mode: str = "") -> Event:
    """The PLC's first scan, with a mode chosen in the same call; then time enough for a stop."""

    def begin(b: Second, _: Random) -> None:
        if mode:
            b.put(0, **{mode: True})
        b.restart()

    return Event(begin, 10_000, stops_all=True)


def _twin(b: Second, chance: Random) -> None:
    b.twin(on=True, address=chance.choice([1, ABSENT]))
    b.judge.stores[ABSENT] = lambda _: False


def _absent(b: Second, _: Random) -> None:
    b.judge.stores[ABSENT] = lambda _: False
    b.put(0, Address=ABSENT)


def _wrong_from_the_start(b: Second, chance: Random) -> None:
    _absent(b, chance)
    b.block["Contact.Restart"] = b.restarts_contact = True
    b.restart()
    b.block["Contact.Restart"] = b.restarts_contact = False


def _absent_and_stall(b: Second, chance: Random) -> None:
    _absent(b, chance)
    b.scan()
    b.stall(2000)


def _parameters(b: Second, chance: Random) -> None:
    """Readers and writers of some drives, before and after their blocks, within some scans; first one to be refused."""
    b.ask("Writer", 0, NOWHERE, 1, permitted=False)
    b.run(200)
    for index in range(min(len(b.models), 3)):
        address, kind = PARAMETER[b.types[index]], b.types[index]
        for name in (*(("Reader", "Writer") if index == 0 else ()), f"Reader{index}", f"Writer{index}"):
            reads = name.startswith("Reader")
            place = address + (1 if name == "Reader" else 2)
            value = 100 * place & 0xFFF if reads else chance.randrange(1, 500)
            b.ask(name, index, place if reads else WRITES[kind] | address, value)
            b.run(chance.choice([0, 0, 20, 60]))


def _wavering(b: Second, chance: Random) -> None:
    """The references of all others never rest, not even afterwards, while parameters are asked for."""
    b.wavers = True
    for index in range(1, len(b.models)):
        b.put(index, RunForward=True)
    b.run(3000)
    _parameters(b, chance)


def _others_trip(b: Second, chance: Random) -> None:
    """All others trip, so that their stops are repeated; the first is stopped, started, and asked for parameters."""
    for one, kind in zip(b.models[1:], b.types[1:], strict=True):
        one.trip(FAULT[kind], b.now)
    b.run(2000)
    _ready_again(b)
    _asked(b, chance)
    b.run(2000)
    _parameters(b, chance)


def _stop(b: Second) -> None:
    b.release()
    b.wait(lambda: b.shows("StopConfirmed"), 9000)


def _unpermitted(b: Second, chance: Random) -> None:
    """At standstill nothing but the permission is missing; a write that has it is sent."""
    _stop(b)
    b.ask("Writer", 0, NOWHERE, 1, permitted=False)
    b.run(1000)
    b.ask("Writer", 0, WRITES[b.types[0]] | PARAMETER[b.types[0]], chance.randrange(1, 500))


def _several(b: Second, chance: Random) -> None:
    """At standstill, words that all differ: as many as a block can ask for, and some that end in a command."""
    _stop(b)
    kind, words = b.types[0], chance.sample(range(1, 500), 4)
    row, command = PARAMETER[kind], COMMANDS.get(kind, 0)
    asked = [("Reader", row + 1 if count == 2 else LONGER.get(kind, row + 1), count) for count in (2, 4, 3)]
    asked += [("Writer", row if count == 1 else SEVERAL.get(kind, row + 1), count) for count in (2, 3, 1)]
    asked += [("Writer", command - at, 1 + at) for at in (1, 2) if command]
    asked += [("Writer", command - at, at) for at in (2, 3) if command]
    for name, place, count in asked:
        commands = place < command < place + count
        first = place if name == "Reader" or commands else WRITES[kind] | place
        b.ask(name, 0, first, *words[-count:], commands=commands)
        b.wait(lambda: not b.judge.asked, 3000)
        b.scan()


def _weaker(b: Second, chance: Random) -> None:
    """Stop pins that are released before the motor is at standstill, and weaker ones after them."""
    for name, on, off in (("CoastStop", True, False), ("QuickStop", True, False), ("Enable", False, True)):
        b.put(0, **{name: on}).run(100)
        b.put(0, **{name: off}).run(chance.choice([40, 200, 600]))


def _millisecond(b: Second, _: Random) -> None:
    b.was_ms, b.ms = b.ms, 1


def _unanswered(b: Second, chance: Random) -> None:
    """At standstill: a read and a write that nobody answers, and a read that the drive refuses."""
    _stop(b)
    row, kind, one = PARAMETER[b.types[0]], b.types[0], b.models[0]
    for name, place in (("Reader", row + 1), ("Writer", WRITES[kind] | row)):
        b.mute = place
        b.ask(name, 0, place, chance.randrange(1, 500))
        b.wait(lambda: not b.judge.asked, 3000)
    b.mute, options = None, one.o
    one.o = replace(options, forbidden=frozenset([row + 2]))
    b.ask("Reader0", 0, row + 2, 0)
    b.wait(lambda: not b.judge.asked, 3000)
    one.o = options


def _stopped_after_a_write(b: Second, chance: Random) -> None:
    """A start that is stopped soon after its first write."""
    written = len(b.frames)
    b.put(0, **{b.start_pin: True})
    b.wait(lambda: any(each.unit == 1 and not each.read for each in b.frames[written:]), 1000)
    b.run(chance.randrange(0, 200, b.ms))
    b.release().run(1000)


def _slow_port(b: Second, chance: Random) -> None:
    """What waits in the mailbox: a parameter that nothing takes back, then writes of a start that a stop does."""
    _stop(b)
    b.slow_port(on=True)
    b.run(1000)
    b.ask("Writer", 0, WRITES[b.types[0]] | PARAMETER[b.types[0]], chance.randrange(1, 500))
    b.run(2000)
    for _ in range(4):
        _ready_again(b)
        _stopped_after_a_write(b, chance)


def _waiting(b: Second, chance: Random) -> None:
    """Another address while a request waits in the mailbox: it is taken back whole. Of a meter no stop is next."""
    _stop(b)
    b.judge.stores[ABSENT] = lambda _: False
    b.meter(on=True)
    b.slow_port(on=True)
    b.run(1000)
    for _ in range(2):
        b.wait(lambda: b.waits(1), 3000)
        b.put(0, Address=ABSENT).run(chance.choice([20, 60, 200]))
        b.put(0, Address=1).run(4000)
        b.wait(lambda: b.waits(METER) or not b.metered, 3000)
        b.meter(on=b.metered, address=ABSENT)
        b.run(chance.choice([20, 60, 200]))
        b.meter(on=b.metered)
        b.run(4000)


def _typed_twice(b: Second, _: Random) -> None:
    """A meter is given the address of the drive; where no slot is left for a meter, nothing happens."""
    b.meter(on=True, address=1)
    b.pins[0]["Doubled"] = b.metered


def _typed_right(b: Second, chance: Random) -> None:
    """By the meter's own address, or by none."""
    b.pins[0]["Doubled"] = False
    if b.metered and chance.random() < 0.5:
        b.meter(on=True)
        b.run(1000)
        _measures(b)
    _no_meter(b, chance)


def _taken(b: Second, chance: Random) -> None:
    b.slow_port(on=False)
    _no_meter(b, chance)


def _metered(b: Second, chance: Random) -> None:
    """A meter, which StopAll and a program that leaves it alone do not concern."""
    b.meter(on=True)
    b.run(3000)
    _measures(b)
    b.line(StopAll=True).run(chance.choice([20, 200, 2500]))
    b.line(StopAll=False).run(3000)
    _measures(b)
    b.call_meter(called=False)
    b.run(4000)
    b.call_meter(called=True)
    b.run(3000)
    _measures(b)


def _measures(b: Second) -> None:
    shown = [b.block[each] for each in ("Meter.Valid", "MeterWords[0]", "MeterWords[1]", "Meter.ErrorID")]
    if b.metered and shown != [True, 0x1234, 0x5678, 0]:
        b.judge.tell(0, "meter", f"shows {shown}")


def _no_meter(b: Second, _: Random) -> None:
    b.meter(on=False)
    b.call_meter(called=True)
    b.run(100)
    b.call_meter(called=False)


def _highest(b: Second, _: Random) -> None:
    """The highest address that its family can have is asked, where nobody answers, and the next one is not.

    A block takes another address only while it shows StopConfirmed, which it soon does not where others run the drive.
    """
    _stop(b)
    if b.models[0].by == "keypad" or not b.shows("StopConfirmed"):
        return
    highest = HIGHEST[b.types[0]]
    for address in (highest, highest + 1):
        b.judge.stores[address] = lambda _: False
        before = len(b.frames)
        b.put(0, Address=address).run(2500)
        asked = any(each.unit == address for each in b.frames[before:])
        if asked != (address == highest) or (b.reason() == "MISSING") == asked:
            b.judge.tell(0, "address", f"{address}: asked {asked}, {b.reason()}")
        _right(b, _)
        b.run(2500)


def _faults(b: Second, chance: Random) -> None:
    """Two faults by turns, at any place in a round of reads; a person resets each at the drive."""
    one = b.models[0]
    for fault in 3 * (FAULT[b.types[0]], OTHER_FAULT[b.types[0]]):
        one.trip(fault, b.now)
        b.wait(lambda: b.shows("Fault"), 4000)
        b.run(2000)
        one.reset(b.now)
        b.wait(lambda: not b.shows("Fault"), 4000)
        b.run(chance.randrange(1000, 2000, 20))


def _stores(b: Second, _: Random) -> None:
    """Two blocks of one drive, more than a minute after power-up."""
    b.release()
    b.run(62_000)
    for name in ("Storer", "Storer0"):
        b.ask(name, 0, 0xFFFD, 0)
        b.run(2000)


def _dead_and_readdressed(b: Second, chance: Random) -> None:
    """It runs on and does not answer; a new address is not taken before it is at standstill."""
    b.deaf.add(1)
    b.run(chance.choice([20, 100, 2000]))
    _absent(b, chance)


def _found_again(b: Second, chance: Random) -> None:
    _right(b, chance)
    b.deaf.discard(1)


def _right(b: Second, _: Random) -> None:
    b.put(0, Address=1)


def _dead(b: Second, _: Random) -> None:
    b.deaf.add(1)


def _neighbour_dead(b: Second, _: Random) -> None:
    if len(b.models) > 1:
        b.deaf.add(2)


def _all_but_one_dead(b: Second, _: Random) -> None:
    """... of which each takes long to answer."""
    for index in range(1, len(b.models)):
        b.put(index, TurnRoundMs=LONG_MS, LongestMs=LONG_MS)
        b.deaf.add(index + 1)


def _all_back(b: Second, _: Random) -> None:
    for index in range(1, len(b.models)):
        b.deaf.discard(index + 1)


def _neighbour_back(b: Second, _: Random) -> None:
    b.deaf.discard(2)


def _unsaid(b: Second, _: Random) -> None:
    """It runs, and the master hears nothing of it."""
    _ready_again(b)
    b.unsaid = True
    b.put(0, **{b.start_pin: True})


def _unsaid_and_ignored(b: Second, chance: Random) -> None:
    _ready_again(b)
    ignore(b, RUNS)
    _unsaid(b, chance)


def _said(b: Second, chance: Random) -> None:
    b.unsaid = False
    _obeys(b, chance)


def _dead_and_restart(b: Second, _: Random) -> None:
    b.deaf.add(1)
    b.restart()


def _short_start(b: Second, _: Random) -> None:
    _ready_again(b)
    b.put(0, **{b.start_pin: True})


def _no_line(b: Second, _: Random) -> None:
    b.leave("SkipLine")


def _line_again(b: Second, _: Random) -> None:
    b.leave("SkipLine", on=False)


def _turns_round(b: Second, _: Random) -> None:
    b.models[0].turn_round(b.now)


def _back(b: Second, _: Random) -> None:
    b.deaf.discard(1)


def _trip(b: Second, chance: Random) -> None:
    b.models[0].trip(FAULT[b.types[0]], b.now, cause=chance.random() < 0.3)


def _trip_and_reset(b: Second, _: Random) -> None:
    """... before it stands."""
    b.release()
    b.models[0].trip(FAULT[b.types[0]], b.now)
    b.wait(lambda: b.shows("Fault"), 3000)
    b.put(0, FaultReset=True).run(100)
    b.put(0, FaultReset=False)


def _trip_and_held_reset(b: Second, _: Random) -> None:
    """... whose button is held; not every drive is reset by the bus."""
    b.release()
    b.models[0].trip(FAULT[b.types[0]], b.now)
    b.wait(lambda: b.shows("Fault"), 3000)
    b.run(3000)
    b.put(0, FaultReset=True)


def _power(on: bool) -> Does:
    return lambda b, _: b.models[0].power(on, b.now)


def _inhibit(on: bool) -> Does:
    return lambda b, _: b.models[0].inhibit(on, b.now)


def _flicker(name: str) -> Event:
    def begin(b: Second, _: Random) -> None:
        b.flicker = name

    def end(b: Second, _: Random) -> None:
        b.flicker = ""
        _put(b, name, name == "Enable")

    return Event(begin, 8000, end)


def _wire(lasts: int, **faults: int) -> Event:
    def begin(b: Second, _: Random) -> None:
        b.faults = Faults(**faults)

    def end(b: Second, _: Random) -> None:
        b.faults = Faults()

    lossy = not faults.keys().isdisjoint(("lost", "unanswered"))
    return Event(begin, lasts, end, stops=lossy, stops_all=lossy)


def _noise(b: Second, _: Random) -> None:
    b.noise = 150


def _no_noise(b: Second, _: Random) -> None:
    b.noise = 0


def _slow(b: Second, _: Random) -> None:
    b.was_ms, b.ms = b.ms, 50 if len(b.models) > 3 else 80


def _fast(b: Second, _: Random) -> None:
    b.ms = b.was_ms


def _unreadable(addresses: Mapping[str, int], *, on: bool) -> Does:
    def does(b: Second, _: Random) -> None:
        one, address = b.models[0], addresses.get(b.types[0])
        one.o = replace(one.o, forbidden=frozenset([address] if on and address is not None else []))

    return does


def _again(b: Second, _: Random) -> None:
    b.release()


def _asked(b: Second, _: Random) -> None:
    b.put(0, **{b.start_pin: True})


def _opposite(pin: str) -> str:
    return pin[:3] + ("Reverse" if pin.endswith("Forward") else "Forward")


def _other_way(b: Second, _: Random) -> None:
    b.release().put(0, **{_opposite(b.start_pin): True})


def _half(b: Second, _: Random) -> None:
    b.put(0, SpeedReferenceHz=10.0)


def _whole(b: Second, _: Random) -> None:
    b.put(0, SpeedReferenceHz=25.0)


def _ready_again(b: Second) -> None:
    b.release()
    b.wait(lambda: b.shows("Ready"), 9000)


def ignore(b: Second, what: Iterable[str]) -> None:
    """The first drive acknowledges some orders, and does not obey them."""
    b.models[0].o = replace(b.models[0].o, ignores=frozenset(what))


def _ignores_runs(b: Second, _: Random) -> None:
    _ready_again(b)
    ignore(b, RUNS)
    b.put(0, **{b.start_pin: True})


def _ignores_stops(b: Second, _: Random) -> None:
    ignore(b, STOPS)
    b.release()


def _obeys(b: Second, _: Random) -> None:
    """At last, and what it has acknowledged, too: no run is left over in it that nobody can know of."""
    b.release()
    ignore(b, ())
    b.models[0].commanded = None


def _busy(b: Second, _: Random) -> None:
    _ready_again(b)
    b.models[0].be_busy(b.now, 700_000)
    b.put(0, **{b.start_pin: True})


def _busy_stop(b: Second, _: Random) -> None:
    b.models[0].be_busy(b.now, 2_000_000)
    b.release()


def _refused_stop(b: Second, chance: Random) -> None:
    lasts_ms = chance.choice((100, 700, 1500))
    b.models[0].be_strict(b.now, 1000 * lasts_ms)
    b.release().run(lasts_ms)


def _busy_ramp(b: Second, chance: Random) -> None:
    b.release()
    b.run(chance.randrange(2000, 4000, 100))
    b.models[0].be_busy(b.now, 700_000)


def _stop_all_alone(b: Second, _: Random) -> None:
    _leave(b, True)
    b.line(StopAll=True)


def _called_again(b: Second, _: Random) -> None:
    b.line(StopAll=False)
    _leave(b, False)


def _switched_off(b: Second, _: Random) -> None:
    _stop(b)
    b.put(0, SupplyOff=True)
    b.models[0].power(False, b.now)


def _switched_off_and_left(b: Second, _: Random) -> None:
    """Its supply returns while nobody attends: whatever goes on by itself then has to be found and stopped."""
    b.put(0, SupplyOff=True)
    b.models[0].power(False, b.now)
    b.run(200)
    _leave(b, True)
    b.run(1000)
    b.models[0].power(True, b.now)


def _attended(b: Second, _: Random) -> None:
    _leave(b, False)
    b.run(100)
    b.put(0, SupplyOff=False)


def _switched_on(b: Second, _: Random) -> None:
    b.models[0].power(True, b.now)
    b.run(100)
    b.put(0, SupplyOff=False)


def _strangers(b: Second, _: Random) -> None:
    b.strange = True


def _rarely(ms: int) -> Does:
    def does(b: Second, _: Random) -> None:
        b.run(11_000)  # a round of what the line remembers
        b.strange, b.strange_ms, b.strange_us = True, ms, b.now

    return does


def _acknowledged(b: Second, chance: Random) -> None:
    """What a person has acknowledged, and goes on, is found again."""
    _rarely(1100)(b, chance)
    b.run(11_000)
    b.acknowledge()


def _few_gone(b: Second, _: Random) -> None:
    """Four or fewer in ten seconds are none."""
    doubled = b.now - b.judge.claims.doubled_us < FORGOTTEN_US
    doubled = doubled or any(one.o.late_per_1000 for one in b.models)  # late replies may be counted with the few
    if b.block["TheLine.ErrorID"] == FOREIGN and not doubled:
        b.judge.tell(0, "strangers", "a few of their frames, and ErrorID is theirs")
    b.strange, b.strange_ms = False, 0


def _strangers_gone(b: Second, _: Random) -> None:
    since = max(b.now - REMEMBERED_US, b.judge.units[0].restarted_us, b.acknowledged_us)
    many = len([at for at in b.strangers if at > since]) > SEEN_BY  # it speaks after replies
    told = b.block["TheLine.ErrorID"] in (FOREIGN, SHARED)  # a slot with two blocks is the worse
    if many and (not told or (b.shows("Ready") and not b.pins[0].get("Left"))):
        b.judge.tell(0, "strangers", f"their frames, and ErrorID {b.block['TheLine.ErrorID']!r}")
    b.strange, b.strange_ms = False, 0
    b.run(300)  # the last of them has come
    b.acknowledge()


def _both_ways(b: Second, _: Random) -> None:
    b.put(0, RunForward=True, RunReverse=True)


def _wrong_reference(b: Second, chance: Random) -> None:
    b.put(0, SpeedReferenceHz=chance.choice([-5.0, -0.06]))


def _too_fast(b: Second, _: Random) -> None:
    b.put(0, SpeedReferenceHz=70.0)


AIMED = {
    "frames of another master now and then": Event(_rarely(1100), 11_000, _strangers_gone, stops_all=True),
    "frames of another master go on": Event(_acknowledged, 9000, _strangers_gone, stops_all=True),
    "few frames of another master": Event(_rarely(2900), 11_000, _few_gone, stops=False),
    "a restart while it is dead": Event(_dead_and_restart, 12_000, _back, stops_all=True),
    "a start of 60 ms": Event(_short_start, 60, _again),
    "a start of 300 ms": Event(_short_start, 300, _again),
    "the line is not called": Event(_no_line, 6000, _line_again, stops_all=True),
    "the pin falls": Event(_again, 5000),
    "a stall of 2 s and time after it": Event(lambda b, _: b.stall(2000), 7000, stops_all=True),
    "Enable is FALSE for long": pin("Enable", False, 11_000),
    "a stop pin for long": pin("QuickStop", True, 11_000),
    "a run is not acknowledged": Event(_unsaid, 6000, _said),
    "a run is neither acknowledged nor obeyed": Event(_unsaid_and_ignored, 9000, _said),
    "a trip and its reset": Event(_trip_and_reset, 3000),
    "a trip and a held reset": Event(_trip_and_held_reset, 3000, lambda b, _: _put(b, "FaultReset", False)),
    "the motor turns round": Event(_turns_round, 8000),
    "a write without permission and one with it": Event(_unpermitted, 2000),
    "parameters without an answer": Event(_unanswered, 2000),
    "all others trip": Event(_others_trip, 6000, stops_all=True),
    "references of others never rest": Event(_wavering, 8000),
    "parameters of several words": Event(_several, 1000),
    "weaker and weaker stops": Event(_weaker, 2000, _whole),
    "scans of a millisecond": Event(_millisecond, 1000, _fast, stops=False),
    "its highest address": Event(_highest, 1000, _right),
    "one fault after another": Event(_faults, 3000),
    "a run of more than a minute": Event(nothing, 63_000, stops=False),
    "another address for a dead drive": Event(_dead_and_readdressed, 6000, _found_again),
    "all but one are dead": Event(_all_but_one_dead, 30_000, _all_back, stops=False, stops_all=True),
    "replies lost": _wire(8000, unanswered=100),
    "replies cut short": _wire(6000, truncated=150),
    "noise before replies": Event(_noise, 6000, _no_noise, stops=False),
    "a stop while it is busy": Event(_busy_stop, 5000),
    "a stop is refused": Event(_refused_stop, 5000),
    "it is busy in its ramp": Event(_busy_ramp, 3000),
    "a slow port": Event(_slow_port, 1000, lambda b, _: b.slow_port(on=False)),
    "another address while a frame waits": Event(_waiting, 1000, _taken),
    "its address is typed twice": Event(_typed_twice, 4000, _typed_right),
    "a meter": Event(_metered, 1000, _no_meter, stops_all=True),
    "its supply returns while its block is not called": Event(_switched_off_and_left, 20_000, _attended),
}
"""Events that look at one rule each."""
LONG = ("nothing", "two stores")
"""Events that are no second ones: they take a minute of the bus, or none."""
EVENTS: dict[str, Event] = {
    "nothing": Event(nothing, 8000, stops=False),
    "StopAll pulse": line("StopAll"),
    "Restart": restart(),
    "Restart into SpeedOnly": restart("SpeedOnly"),
    "Restart into MonitorOnly": restart("MonitorOnly"),
    "block not called for 2 s": Event(lambda b, _: _leave(b, True), 2000, lambda b, _: _leave(b, False)),
    "block not called for 12 s": Event(lambda b, _: _leave(b, True), 12_000, lambda b, _: _leave(b, False)),
    "a stall of 300 ms": late(300, stops=False),
    "a stall of 2 s": late(2000, stops=True),
    "a shared slot": Event(_twin, 4000, lambda b, _: b.twin(on=False)),
    "a changed address": Event(_absent, 4000, _right),
    "a changed address and a stall of 2 s": Event(_absent_and_stall, 4000, _right, stops_all=True),
    "a wrong address from the start": Event(_wrong_from_the_start, 3000, _right, stops_all=True),
    "a reset": pin("FaultReset", True, 100),
    "a dead drive": Event(_dead, 9000, _back),
    "a dead neighbour": Event(_neighbour_dead, 9000, _neighbour_back, stops=False, neighbour=True),
    "a trip": Event(_trip, 9000),
    "a supply dip of 300 ms": Event(_power(False), 300, _power(True)),
    "a safe torque off": Event(_inhibit(True), 1000, _inhibit(False)),
    "keypad start": key("start"),
    "keypad stop": key("stop"),
    "Enable falls": pin("Enable", False, 4000),
    "QuickStop": pin("QuickStop", True, 4000),
    "CoastStop": pin("CoastStop", True, 4000),
    "the pin falls and rises": Event(_again, 200, _asked),
    "the other direction": Event(_other_way, 2000, _again),
    "SpeedOnly": pin("SpeedOnly", True, 4000),
    "MonitorOnly": pin("MonitorOnly", True, 4000),
    "Enable flickers": _flicker("Enable"),
    "QuickStop flickers": _flicker("QuickStop"),
    "replies doubled": _wire(10_000, twice=200),
    "frames lost": _wire(4000, lost=200, unanswered=100),
    "slow scans": Event(_slow, 12_000, _fast, stops=False),
    "it refuses to be read": Event(_unreadable(STATUS, on=True), 12_000, _unreadable(STATUS, on=False)),
    "an unused row is refused": Event(_unreadable(UNUSED, on=True), 12_000, _unreadable(UNUSED, on=False), stops=False),
    "parameters": Event(_parameters, 1000, stops=False),
    "two stores": Event(_stores, 1000),
    "it ignores runs": Event(_ignores_runs, 9000, _obeys),
    "it ignores stops": Event(_ignores_stops, 9500, _obeys),
    "it is busy": Event(_busy, 3500),
    "StopAll while its block is not called": Event(_stop_all_alone, 900, _called_again, stops_all=True),
    "supply off on purpose": Event(_switched_off, 6000, _switched_on),
    "SupplyOff while it runs": pin("SupplyOff", True, 4000),
    "frames of another master": Event(_strangers, 5000, _strangers_gone, stops_all=True),
    "both directions": Event(_both_ways, 3000, lambda b, _: _released(b)),
    "a negative reference": Event(_wrong_reference, 3000, _whole),
    "a reference above the maximum": Event(_too_fast, 8000, _whole, stops=False),
    "another reference": Event(_half, 3000, _whole, stops=False),
}


def _released(b: Second) -> None:
    b.release()


def _leave(b: Second, on: bool) -> None:
    b.leave("Skip0", on=on)
