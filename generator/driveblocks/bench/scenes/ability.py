"""What a family can do, as far as scenes ask for it."""

from dataclasses import dataclass
from functools import cached_property

from driveblocks.bench.scenes.drive import KINDS, ORDERS
from driveblocks.maps.model import Drive
from driveblocks.maps.rivals import first_reads
from driveblocks.meaning.measure import measures
from driveblocks.meaning.polls import fault_words, meaning_words, polls
from driveblocks.meaning.reference import reference
from driveblocks.meaning.roles import roles
from driveblocks.meaning.status import registers, status
from driveblocks.meaning.watchdog import at_rest, feeds
from driveblocks.meaning.words import MOTIONS, Command, words


@dataclass(frozen=True)
class Ability:
    """A family: its commands, what it shows, a fault that it may have."""

    drive: Drive

    def can(self, does: str) -> bool:
        """Whether it has a command."""
        return does in words(self.drive).named

    def order(self, does: str) -> int:
        """Number of the motion that the drive is commanded for one: a negative reference turns a run forward round."""
        one = words(self.drive).named.get(does)
        return ORDERS["run_forward" if one and one.negative else does]

    @property
    def run(self) -> Command:
        """The command that every family has."""
        return words(self.drive).named["run_forward"]

    def path_ms(self, does: str) -> int:
        """How long the writes before the last one of a command may take, each with the reads that it waits for."""
        return sum(300 + write.stays_ms for write in words(self.drive).named[does].writes[:-1])

    def shows(self, what: str) -> bool:
        """Whether its status shows something."""
        return bool(status(self.drive).shows(what))

    def measures(self, what: str) -> bool:
        """Whether it measures something."""
        return any(one.name == what for one in measures(self.drive))

    def kind(self, wanted: str) -> int:
        """Number of the stop that is sent where one is wanted: the drive's own, else its stop."""
        return KINDS[wanted if self.can(wanted) else "stop"]

    @cached_property
    def runs_by_speed(self) -> bool:
        """Whether the frequency alone says that it runs: not at 0 Hz, and as long as the motor coasts after a trip."""
        signs = registers(status(self.drive).shows("running"))
        return {*signs} <= {one.register for one in measures(self.drive)}

    @cached_property
    def trips_at_once(self) -> bool:
        """Whether the read that says that it runs no more says, too, that it has tripped."""
        told = registers(status(self.drive).shows("fault")) or fault_words(self.drive)
        running = [polls(self.drive)[number - 1].addresses for number in roles(self.drive).running]
        return all(any(each in read for read in running) for each in told)

    @cached_property
    def absent(self) -> frozenset[str]:
        """Pins that say nothing, since the drive shows nothing of the kind."""
        names = [] if self.measures("output_frequency") else ["OutputFrequencyHz", "AtSpeed"]
        if names and not self.shows("zero_speed"):
            names.append("ZeroSpeed")
        return frozenset(names if self.shows("fault") else [*names, "Fault"])

    @cached_property
    def runs_at_once(self) -> bool:
        """Whether a run is one write, in a register of its own."""
        return len(self.run.writes) == 1 and self.run.last.register != reference(self.drive).register

    @cached_property
    def feeds(self) -> str:
        """What feeds its watchdog, which a drive block takes for the reference unless the map says more."""
        return feeds(self.drive) or "reference"

    @property
    def fed_at_rest(self) -> bool:
        """Whether it is fed at standstill, too."""
        return at_rest(self.drive)

    @cached_property
    def settings_come_first(self) -> bool:
        """Whether what gives the reference its meaning is in the reads that prove standstill."""
        proof = [range(each.address, each.address + each.words) for each in polls(self.drive) if each.fast]
        return all(any(word in each for each in proof) for word in meaning_words(self.drive))

    @cached_property
    def known_by_refusal(self) -> bool:
        """Whether a read that a drive of another make answers is sent before the first stop."""
        return any(each.shows == "refusal" for each in first_reads(self.drive))

    @cached_property
    def turns(self) -> int:
        """Reads that take turns: each is as many rounds old."""
        return sum(not each.fast for each in polls(self.drive)) or 1

    @cached_property
    def motions(self) -> tuple[str, ...]:
        """The motions that the drive can be commanded, of MOTIONS."""
        return tuple(each for each in MOTIONS if self.can(each))

    @cached_property
    def codes(self) -> tuple[int, int]:
        """Two faults: numbers that it can show."""
        faults = self.drive.faults
        listed = [one.code for one in faults.codes if one.code]
        if faults.bits:
            last = 16 * (faults.bits.last - faults.bits.first + 1)
            listed = [code for code in listed if code <= last]
        found = [*listed, 5, 7]
        return found[0], next(code for code in found if code != found[0])

    @property
    def silent_ms(self) -> int:
        """How long the drive is silent in a fault reset, ms."""
        silenced = self.drive.operation.silenced
        return silenced[1] if silenced else 0

    @property
    def warning(self) -> int:
        """The code that a warning of the simulated drive has; 0 where the drive has none."""
        codes = self.drive.warning_codes
        return codes[0].code if codes else 0

    @cached_property
    def code(self) -> int:
        """The fault that scenes use; 0 where the drive does not say which it has."""
        faults = self.drive.faults
        return self.codes[1] if faults.present is not None or faults.bits else 0
