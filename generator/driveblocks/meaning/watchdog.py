"""The drive's own watchdog of a silent line: what feeds it, when it acts, and what the drive then does."""

from dataclasses import dataclass
from decimal import Decimal

from driveblocks.maps.model import Drive, SilenceTime, kept
from driveblocks.meaning.citation import Citation, cited
from driveblocks.meaning.reference import reference
from driveblocks.meaning.setting import setting


@dataclass(frozen=True)
class Time:
    """After how much silence it acts: counts of a keypad setting, or of a register."""

    said: Citation
    setting: str | None
    register: int | None
    count_ms: Decimal
    least_ms: Decimal | None
    """By the range of the setting, where the manual has one."""
    most_ms: Decimal | None


@dataclass(frozen=True)
class Watchdog:
    """What a map says of it."""

    said: Citation
    feeds: str | None
    """Any good frame, read or write; None: the manual does not say, or names registers."""
    fed_by: tuple[int, ...]
    """The registers whose writes alone feed it."""
    counts: str | None
    """While the motor runs, always, or while the bus is in command; None: the manual does not say."""
    time: Time | None
    chosen_by: str | None
    """The setting that chooses what the drive does."""
    reactions: tuple[tuple[int | None, str], ...]
    """Its values, and what the drive does with each."""
    off: tuple[str, int] | None
    """The setting that switches it off, and its value."""
    note: str | None

    def takes(self, written: range) -> bool:
        """Whether a good request feeds it that writes these registers, or with none reads."""
        if self.fed_by:
            return any(each in written for each in self.fed_by)
        return self.feeds != ("reads" if written else "writes")


@kept
def watchdog(drive: Drive) -> Watchdog | None:
    """The watchdog of a drive; None where the manual knows of none."""
    one = drive.watchdog
    if one is None:
        return None
    off = one.disabled_by
    return Watchdog(
        said=cited(one),
        feeds=one.feeds,
        fed_by=one.fed_by,
        counts=one.counts,
        time=_time(drive, one.time) if one.time else None,
        chosen_by=one.chosen_by,
        reactions=tuple((each.value, each.does) for each in one.reactions),
        off=(off.setting, off.value) if off else None,
        note=one.note,
    )


def _time(drive: Drive, time: SilenceTime) -> Time:
    by, count = setting(drive, time.setting), time.milliseconds
    least, most = (each * count for each in by.bounds) if by and by.bounds else (None, None)
    return Time(cited(time), time.setting, time.register, count, least, most)


def feeds(drive: Drive) -> str | None:
    """What of a drive block feeds it: polls, reference, or run; None where there is none, or nobody says."""
    own = watchdog(drive)
    if own is None or not (own.feeds or own.fed_by):
        return None
    if own.feeds == "writes" or reference(drive).register in own.fed_by:
        return "reference"
    return "run" if own.fed_by else "polls"


def counts_at_rest(drive: Drive) -> bool:
    """Whether it counts at standstill, too."""
    own = watchdog(drive)
    return own is not None and own.counts in ("always", "bus_in_command")


def at_rest(drive: Drive) -> bool:
    """Whether a drive block feeds it at standstill, too: by a reference of 0, which moves nothing."""
    return counts_at_rest(drive) and feeds(drive) in (None, "reference")
