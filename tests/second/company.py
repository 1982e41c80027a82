"""What happens to several on a line: they die together, a panel reads what we read, makes meet where they should not.

Each is an event of the walks, on lines of one, three or eight drives; where a line has too few, nothing happens.
"""

from collections.abc import Callable
from random import Random

from tests.second.bench import Second
from tests.second.events import Event, nothing

STRICT_US = 10_000_000
"""How long stops are refused after a restart."""
OVERDUE_MS = 8000
"""A stop that is refused after a restart is overdue by then, or a slow line's attempts are not over."""
RESTED_MS = 9000
"""From a released pin to standstill."""
Does = Callable[[Second, Random], None]


def _die(b: Second, chance: Random) -> None:
    """Some of the others, or all."""
    others = range(1, len(b.models))
    for index in chance.sample(others, chance.randint(1, len(others)) if others else 0):
        b.deaf.add(index + 1)


def _return(b: Second, _: Random) -> None:
    b.deaf -= set(range(2, len(b.models) + 1))


def _panel(b: Second, chance: Random) -> None:
    b.panel_ms = chance.choice((20, 60, 150, 300, 500))


def _no_panel(b: Second, _: Random) -> None:
    b.panel_ms = 0
    b.run(300)
    b.acknowledge()


def _other_make(b: Second, chance: Random) -> None:
    b.other(on=True, address=chance.choice((1, 29)))
    b.judge.stores[29] = lambda _: False


def _no_other(b: Second, _: Random) -> None:
    b.other(on=False)


def _at_rest(b: Second, *some: int) -> bool:
    """Stop some, and see whether they may be given other addresses."""
    if max(some) >= len(b.models):
        return False
    for index in some:
        b.release(index)
    return b.wait(lambda: all(b.shows("StopConfirmed", index) for index in some), RESTED_MS)


def _one_address(b: Second, _: Random) -> None:
    """The second drive's block is given the address of the first."""
    if _at_rest(b, 1):
        b.put(1, Address=1)
        b.pins[0]["Doubled"] = b.pins[1]["Doubled"] = True


def _swap(b: Second, _: Random) -> None:
    if _at_rest(b, 0, 1):
        b.put(0, Address=2).put(1, Address=1)


def _right(b: Second, _: Random) -> None:
    for index in range(min(2, len(b.models))):
        b.pins[index]["Doubled"] = False
        b.put(index, Address=index + 1)
    b.run(4000)


def _refused(mode: str) -> Does:
    """The bus runs it, the program restarts into a mode without command, and the drive refuses to be stopped."""

    def does(b: Second, _: Random) -> None:
        one = b.models[0]
        runs = one.by == "bus" and not one.stopping
        if mode == b.mode or not runs:
            return
        one.be_strict(b.now, STRICT_US)
        b.put(0, **{mode: True})
        b.restart()
        most = max(OVERDUE_MS, int(b.number("StopWithinMs")) + 2000)
        said = b.wait(lambda: b.shows("StopOverdue") or one.by != "bus", most)
        if not said:
            b.judge.tell(0, "refused in silence", b.told(0))

    return does


def _own_mode(mode: str) -> Does:
    def does(b: Second, _: Random) -> None:
        b.put(0, **{mode: mode == b.mode})

    return does


COMPANY: dict[str, Event] = {
    "others die together": Event(_die, 9000, _return, stops=False, others=True),
    "a panel": Event(_panel, 9000, _no_panel, stops_all=True),
    "another make on its slot": Event(_other_make, 4000, _no_other),
    "two makes at one address": Event(_one_address, 4000, _right, neighbour=True),
    "addresses are swapped": Event(_swap, 4000, _right, neighbour=True),
    "a stop is refused after a restart into SpeedOnly": Event(
        _refused("SpeedOnly"), 12_000, _own_mode("SpeedOnly"), stops_all=True
    ),
    "a stop is refused after a restart into MonitorOnly": Event(
        _refused("MonitorOnly"), 12_000, _own_mode("MonitorOnly"), stops_all=True
    ),
    "nothing for a while": Event(nothing, 3000, stops=False),
}
"""Events of the walks alone: the matrix goes by drives that are alone with what happens to them."""
