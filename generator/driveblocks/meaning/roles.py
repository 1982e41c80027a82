"""What each read of a drive block is for: reads by their numbers in its plan, from 1."""

from collections.abc import Iterable
from dataclasses import dataclass

from driveblocks.maps.model import Drive, kept
from driveblocks.meaning.polls import fault_words, meaning_words, polls, speed_words, young_words
from driveblocks.meaning.status import registers, status

Numbers = tuple[int, ...]


@dataclass(frozen=True)
class Roles:
    """The reads that bring ..."""

    fast: Numbers
    """... what is asked every round."""
    proof: Numbers
    """... what proves standstill."""
    speed: Numbers
    """... the frequency among it; where it has none, all of it."""
    running: Numbers
    direction: Numbers
    """... which way it turns, where another brings whether it runs."""
    state: Numbers
    by_bus: Numbers
    fault: Numbers
    """... whether there is a fault, and which."""
    verify: Numbers
    """... what gives the reference its meaning: settings, and the drive's own maximum; and what forbids a start."""
    setting: Numbers
    """... of it the settings."""
    measure: Numbers
    young: Numbers
    """... what is shown while it is young: measures, and the code of a warning."""


@kept
def roles(drive: Drive) -> Roles:
    """What the reads of a drive are for."""
    reads, shows = polls(drive), status(drive)
    at = {address: number for number, one in enumerate(reads, 1) for address in one.addresses}

    def those(words: Iterable[int]) -> Numbers:
        return tuple(sorted({at[each] for each in words}))

    running, turns = (those(registers(shows.shows(name))) for name in ("running", "reverse"))
    return Roles(
        fast=tuple(number for number, one in enumerate(reads, 1) if one.fast),
        proof=those(registers(shows.standstill.patterns)),
        speed=those(speed_words(drive)),
        running=running,
        direction=turns if any(each not in turns for each in running) else (),
        state=those(registers(each.pattern for each in shows.states)),
        by_bus=those(registers(shows.by_bus.patterns)),
        fault=those((*registers(shows.shows("fault")), *fault_words(drive))),
        verify=those(meaning_words(drive)),
        setting=those(registers(shows.verify)),
        measure=those(one.register for one in drive.operation.measures),
        young=those(young_words(drive)),
    )
