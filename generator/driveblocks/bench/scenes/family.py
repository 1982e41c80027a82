"""The tables of a family, called by themselves: what is read of a drive in turn, and what each command writes to it.

In the form of part.yaml; what they must show comes from the map alone.
"""

from collections.abc import Iterator
from typing import Any

from driveblocks.bench.scenes.drive import KINDS, ORDERS
from driveblocks.bench.scenes.scene import Shows
from driveblocks.maps.form import is_bit
from driveblocks.maps.model import Drive
from driveblocks.meaning.polls import fast_words, other_words, polls, schedule, slow_words
from driveblocks.meaning.reference import reference
from driveblocks.meaning.roles import roles
from driveblocks.meaning.status import status
from driveblocks.meaning.words import MOTIONS, Command, words
from driveblocks.modbus.layout import COIL_ON
from driveblocks.reference.naming import word_pin
from structured_text.language.writing import word

NEVER_MS, STALE_MS, LONGEST_MS = 65535, 1000, 8
"""The age of what was never read; what is older is too old; no reply comes later, ms."""

_ASK = "TheOrders.Ask"
"""What a command writes."""

Row = list[Any]
"""In words, what is given, what must be shown."""


def parts(drive: Drive) -> dict[str, Any]:
    """Of the two blocks their inputs and calls."""
    verify = "Verify? " if _reads_of(drive)["verify"] else ""
    step = "StepNumber# " if _several(drive) else ""
    times = "LongestMs# StaleMs# PassedMs#"
    reply = "Fresh? Surplus#USINT Entry# Count#USINT"
    inputs = f"Anew? Reread? Forget? {verify}{times} {reply} Turn# Words=Fetched"
    return {
        f"{drive.prefix}_Reads": {"inputs": inputs, "calls": [*_reads(drive), ["turns"], *_turns(drive)]},
        f"{drive.prefix}_Orders": {"inputs": f"Order# {step}ReferenceWord~", "calls": list(_orders(drive))},
    }


# ---------------------------------------------------------------- what is read


def _reads(drive: Drive) -> Iterator[Row]:
    """Each read is answered, first too short; all of it grows old, and is forgotten in three ways."""
    known = _Known(drive)
    numbers = range(len(known.reads))
    times = {"LongestMs": LONGEST_MS, "StaleMs": STALE_MS}
    yield ["a restart", {"Anew": True, "PassedMs": 5} | times, known.shows()]
    yield ["nothing is read", {"Anew": False}, known.shows()]
    for each in numbers:
        yield from known.answered(each)
    yield ["the last reply may be another's", *known.wait(LONGEST_MS)]
    yield ["its own would have come by now", *known.wait(1)]
    for each in sorted(known.roles["young"]):
        yield ["again", *known.read(each, 3)]
        yield ["as old as it may be", *known.wait(STALE_MS)]
        yield ["too old", *known.wait(1)]
    yield ["what was read proves nothing any more", {"Reread": True, "PassedMs": 0}, known.lost("since")]
    yield ["it is read again", {"Reread": False, "Entry": 0}, known.shows()]
    for each in reversed(numbers):
        yield [f"read {each + 1}", *known.read(each, 7)]
    yield ["one that nobody has asked for", *known.surplus()]
    for each in numbers:
        yield [f"read {each + 1}", *known.read(each, 7)]
    yield ["the last reply may be another's", *known.wait(LONGEST_MS)]
    if known.roles["verify"]:
        yield ["settings are checked again", {"Verify": True, "Entry": 0, "PassedMs": 0}, known.lost("settings")]
        yield ["... once", {"Verify": False}, known.shows()]
        for each in numbers:
            yield [f"read {each + 1}", *known.read(each, 11)]
    yield ["it is forgotten", {"Forget": True, "Entry": 0, "PassedMs": 0}, known.lost("since", "ages")]
    for each in numbers:
        yield [f"read {each + 1}", {"Forget": False} | known.read(each, 13)[0], known.shows()]
    yield ["a restart", {"Anew": True, "PassedMs": 0}, known.lost("since", "ages", "settings")]


def _turns(drive: Drive) -> Iterator[Row]:
    """Which read it is in each turn; without one, the last."""
    reads = polls(drive)
    for turn, index in enumerate(schedule(reads)):
        read = reads[index]
        yield [f"turn {turn}", {"Turn": turn}, {
            "NextEntry": index + 1, "TheReads.Ask.Address": word(read.address), "TheReads.Ask.Quantity": read.words,
            "OtherQuantity": other_words(drive, read, reads), "TheReads.Ask.FunctionCode": read.function,
        }]  # fmt: skip


class _Known:
    """What has been read so far: how old each read is, and which were answered since."""

    def __init__(self, drive: Drive) -> None:
        self.drive, self.reads, self.roles = drive, polls(drive), _reads_of(drive)
        self.ages = [NEVER_MS] * len(self.reads)
        self.since = [False] * len(self.reads)
        self.since_ms = [0] * len(self.reads)
        self.settled = not self.roles["verify"]
        self.speed = self.proved = False
        """The frequency has come; it has, after all else that proves standstill."""
        self.doubted = False

    def answered(self, number: int) -> Iterator[Row]:
        """A reply that is too short, and a good one."""
        short, _ = self.read(number, 0, believed=False)
        yield [f"read {number + 1}, a register too few", short | {"PassedMs": 0}, self.shows()]
        gets, shows = self.read(number, 10 * number + 10)
        yield [f"read {number + 1}", gets, shows | self._words(number)]

    def read(self, number: int, passed: int, *, believed: bool = True) -> tuple[dict[str, Any], Shows]:
        """A reply to one of them."""
        self._pass(passed)
        self.speed = believed and number in self.roles["speed"]
        words = self.reads[number].words
        gets = {"Fresh": True, "Entry": number + 1, "Count": words - (not believed), "PassedMs": passed}
        if believed:
            self.since_ms[number] *= self.since[number]
            self.ages[number], self.since[number] = passed, True
        return gets | {f".Fetched[{at}]": word(256 * number + 257 + at) for at in range(words)}, self.shows()

    def wait(self, passed: int) -> tuple[dict[str, Any], Shows]:
        """No reply for some time."""
        self._pass(passed)
        self.speed = False
        return {"Fresh": False, "PassedMs": passed}, self.shows()

    def surplus(self) -> tuple[dict[str, Any], Shows]:
        """What was read just before may be the reply to another master."""
        gets, _ = self.wait(0)
        self.since = [self._sure(each) for each in range(len(self.reads))]
        self.doubted = True
        return gets | {"Surplus": 1}, self.shows()

    def lost(self, *what: str) -> Shows:
        """What counts no longer: what was answered `since`, its `ages`, the `settings`. No time passes meanwhile."""
        verify = self.roles["verify"]
        self._pass(0)
        self.speed = False
        if "ages" in what:
            self.ages = [NEVER_MS] * len(self.reads)
        if "since" in what:
            self.since = [False] * len(self.reads)
            self.doubted = False
        if "settings" in what and verify:
            self.settled = False
            self.since = [one and number not in verify for number, one in enumerate(self.since)]
        return self.shows()

    def _pass(self, passed: int) -> None:
        self.ages = [min(age + passed, NEVER_MS) for age in self.ages]
        self.since_ms = [each + passed for each in self.since_ms]

    def shows(self) -> Shows:
        roles = self.roles
        self.proved = (self.proved or self.speed) and self._all("proof")
        self.settled = self.settled or self._all("verify")
        found: Shows = {
            "StatusAgeMs": max(self.ages[each] for each in roles["fast"]),
            "MeasuresAgeMs": max((self.ages[each] for each in roles["measure"]), default=NEVER_MS),
            "FaultAgeMs": max((self.ages[each] for each in roles["fault"]), default=0),
            "ProofRead": self.proved, "SpeedRead": self.speed, "FaultRead": self._all("fault"),
            "SettingsRead": self.settled, "Doubted": self.doubted,
        }  # fmt: skip
        more = {"by_bus": "MasterRead", "state": "StatesRead", "verify": "MeaningRead"}
        found |= {name: self._all(role) for role, name in more.items() if roles[role]}
        return found | {f"Young{each + 1}": self.ages[each] <= STALE_MS for each in sorted(roles["young"])}

    def _all(self, role: str) -> bool:
        return all(self._sure(each) for each in self.roles[role])

    def _sure(self, number: int) -> bool:
        return self.since[number] and self.since_ms[number] > LONGEST_MS

    def _words(self, number: int) -> Shows:
        """The words that a read has brought."""
        read, kept = self.reads[number], fast_words(self.drive) | slow_words(self.drive)
        rows = {at: self.drive.register_at(read.address + at) for at in range(read.words) if read.address + at in kept}
        told = {at: 256 * number + 257 + at for at in rows}
        if is_bit(read.address):  # the bits of the first word
            told = {at: (256 * number + 257) >> at & 1 for at in rows}
        return {word_pin(row, read.address + at): word(told[at]) for at, row in rows.items() if row}


def _reads_of(drive: Drive) -> dict[str, set[int]]:
    """What each read is needed for; here they count from 0."""
    return {role: {each - 1 for each in numbers} for role, numbers in vars(roles(drive)).items()}


# ---------------------------------------------------------------- what is written


def _orders(drive: Drive) -> Iterator[Row]:
    """Each write of each command; what is no command is a stop."""
    numbers = KINDS | ORDERS
    known = words(drive).named
    several = _several(drive)
    none = ["none", {"Order": 0}, _write(known["stop"], 0, several=several)]
    yield none
    for does, one in known.items():
        for step in range(len(one.writes)):
            called = does.replace("_", " ") + (f", write {step + 1}" if len(one.writes) > 1 else "")
            number = {"StepNumber": step} if several else {}
            shown = _write(one, step, several=several) | _awaited(drive, one, step)
            yield [called, {"Order": numbers[does]} | number, shown]
            yield none
    speed = reference(drive)
    shows: Shows = {f"{_ASK}.Address": word(speed.register), f"{_ASK}.Words[0]": word(0x1234), "Moves": False}
    if speed.pair:
        low = speed.pair == "low_first"
        shows |= {f"{_ASK}.Words[0]": word(0x1234 if low else 0), f"{_ASK}.Words[1]": word(0 if low else 0x1234)}
        shows |= {f"{_ASK}.Quantity": 2}
    yield ["the reference", {"Order": 10, "ReferenceWord": 0x1234}, shows]


def _several(drive: Drive) -> bool:
    return any(len(one.writes) > 1 for one in words(drive).commands)


def _awaited(drive: Drive, one: Command, step: int) -> Shows:
    """The state that the write after this one waits for; nothing is said where the block has no such outputs."""
    if not any(write.until for command in words(drive).commands for write in command.writes):
        return {}
    until = one.writes[step].until
    state = next((each.pattern for each in status(drive).states if each.name == until), None)
    if state is None:
        return {"Awaits": False}
    return {"Awaits": True, "StateMask": word(state.mask), "StateWord": word(state.value)}


def _write(one: Command, step: int, *, several: bool) -> Shows:
    write = one.writes[step]
    value = f"({_ASK}.Words[0] AND {word(write.names)})"
    sent = write.word & write.names
    found: Shows = {
        f"{_ASK}.Address": word(write.register),
        value: word(COIL_ON * sent if is_bit(write.register) else sent),
        "Moves": write is one.last and one.does in MOTIONS,
    }
    more: Shows = {"Last": len(one.writes) - 1, "HoldMs": write.stays_ms}
    return found | (more if several else {})
