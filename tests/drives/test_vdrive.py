"""The simulated drive in C answers as the one in Python does: one script of requests and events, played to both."""

import random
import shutil
import subprocess
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import pytest
from tests.drives.tables import header
from tests.simulator.shapes import shape
from tests.simulator.talk import MAPS

from driveblocks.simulator.drive import SimulatedDrive
from driveblocks.simulator.habits import Habits

HERE = Path(__file__).parent
COMPILER = shutil.which("cc") or shutil.which("gcc")
BURSTS = 700
FLAGS = ("local", "follows", "keeps_running", "warning", "inhibit", "power")
HABITS = (
    Habits(),
    Habits(auto_restart=True, resumes=True, coast_shows_zero=False, settle_ms=30, busy_refuses_all=True),
    Habits(runs_while_stopping=False, stop_ends_jog=False, keeps_fault_code=True, watchdog_ms=700, watchdog="stop"),
    Habits(watchdog_ms=900, watchdog_code=33, scale=MAPS["JSCC"].sections[1].registers[0].scale.factor),  # type: ignore[union-attr]  # JSCC 2000H has one
    Habits(watchdog_ms=900, watchdog="coast", store_ms=2000, auto_restart=True),
)
SHAPES = ("states", "edge", "active low", "pulse", "two registers")


class Event(NamedTuple):
    """A line of the script: what happens to which drive, with two numbers and a request."""

    what: str
    drive: int
    a: int = 0
    b: int = 0
    request: bytes = b""

    def __str__(self) -> str:
        return f"{self.what} {self.drive} {int(self.a)} {int(self.b)} {self.request.hex() or '-'}"


def drives() -> list[SimulatedDrive]:
    """Every family of single registers with habits of all kinds, and every shape with two."""
    singles = [drive for drive in MAPS.values() if not any(row.words for _, row in drive.registers())]
    made = [(drive, habits) for drive in singles for habits in HABITS]
    made += [(shape(name), habits) for name in SHAPES for habits in HABITS[:2]]
    return [SimulatedDrive(drive, 1 + index % 3, habits) for index, (drive, habits) in enumerate(made)]


def script(made: list[SimulatedDrive], chance: random.Random) -> Iterator[Event]:
    """Events at random, a drive for some while: most of them a command, a reading or a little time."""
    for _ in range(BURSTS):
        number = chance.randrange(len(made))
        yield from (Event(what, number, what in {"follows", "power"}) for what in FLAGS)
        yield Event("clear_cause", number)
        for _ in range(30):
            yield event(made[number], number, chance)
        yield Event("step", number, chance.choice([1, 20_000]))


def event(one: SimulatedDrive, number: int, chance: random.Random) -> Event:
    """Something that happens to a drive."""
    kind = chance.random()
    if kind < 0.6:
        return Event("ask", number, request=request(one, chance))
    if kind < 0.88:
        return Event("step", number, chance.choice([1, 10, 100, 100, 1000]))
    return chance.choice(
        [
            Event(chance.choice(FLAGS), number, chance.randrange(2)),
            Event("trip", number, chance.choice([1, 17, 18, 33, 60])),
            Event("clear_cause", number),
            Event("step", number, 20_000),
            Event("reset", number),
            Event("power", number, chance.randrange(2)),
            Event("keypad_run", number, chance.choice([-1, 10, 40]), chance.randrange(2)),
            Event("keypad_stop", number),
            Event("load", number, chance.randrange(150)),
            Event("set", number, *chance.choice([(0x0203, 7), (0x0010, 0xFFFF), (0x0007, 9), (0x000F, 1)])),
        ]
    )


def request(one: SimulatedDrive, chance: random.Random) -> bytes:
    """A request: a word of a command or of the reference, a reading, or nonsense."""
    table = one.table
    unit = bytes([chance.choice([one.unit] * 12 + [0, 9])])
    kind = chance.random()
    if kind < 0.05:
        return unit[: chance.randrange(2)] + chance.randbytes(chance.randrange(9))
    if kind < 0.6:
        patterns = [move.pattern for move in table.moves] + [n.pattern for move in table.moves for n in move.needs]
        pattern = chance.choice(patterns)
        address, word = pattern.register, one.memory[pattern.register] & ~pattern.mask | pattern.value
        if chance.random() < 0.1:
            word |= 6  # bits that no command of a made-up drive sets, and whose absence stops it
        if chance.random() < 0.2:
            address, word = table.reference.register, chance.choice([0, 100, 3000, 0xF448, 0xFFFF])
        elif chance.random() < 0.1:
            span = chance.choice(table.writable)
            address, word = chance.choice([span.first, span.last, table.storage.register & 0xFFFF]), chance.randrange(3)
        return unit + write(one, address, word, chance)
    spots = [gauge.register for gauge in table.gauges] + list(table.named)
    spots += [table.present or 0x14, *(chance.choice(table.readable + table.writable).last for _ in range(3))]
    first, number = chance.choice(spots), chance.choice([1, 1, 1, 2, 5, 17])
    if number < 17 and not table.copies.keys().isdisjoint(range(first, first + number)):
        first, number = table.gauges[0].register, 1  # the drive in C says nothing again
    return unit + b"\3" + first.to_bytes(2, "big") + number.to_bytes(2, "big")


def write(one: SimulatedDrive, address: int, word: int, chance: random.Random) -> bytes:
    """A write by a function that the drive has, of one word or two."""
    if 6 in one.table.functions and (16 not in one.table.functions or chance.random() < 0.7):
        return b"\6" + address.to_bytes(2, "big") + word.to_bytes(2, "big")
    words = [word, chance.choice([0, 1000, 5000])][: chance.choice([1, 1, 2])]
    data = b"".join(each.to_bytes(2, "big") for each in words)
    return b"\x10" + address.to_bytes(2, "big") + len(words).to_bytes(2, "big") + bytes([len(data)]) + data


def happen(one: SimulatedDrive, event: Event) -> str:
    """Play an event; what the line in C prints for it."""
    reply = b""
    match event.what:
        case "ask":
            reply = one.reply(event.request) or b""
        case "step" | "trip" | "set":
            getattr(one, event.what)(*[event.a, event.b][: 1 + (event.what == "set")])
        case "clear_cause" | "reset" | "keypad_stop":
            getattr(one, event.what)()
        case "power" | "inhibit":
            getattr(one, event.what)(on=bool(event.a))
        case "keypad_run":
            one.keypad_run(None if event.a < 0 else event.a, reverse=bool(event.b))
        case "load":
            one.load = event.a
        case _:
            setattr(one, event.what, bool(event.a))
    state = -1 if one.state is None else one.table.states.index(one.state)
    return f"{reply.hex()} {one.motor.output} {one.motor.shaft} {one.fault} {state} {one.stores}"


@pytest.mark.skipif(COMPILER is None, reason="needs cc or gcc")
def test_both_models_do_the_same(tmp_path: Path) -> None:
    made = drives()
    for name in ("vdrive.h", "vdrive.c", "vscript.c"):
        shutil.copy(HERE / name, tmp_path)
    (tmp_path / "vdrives.h").write_text(header(made), encoding="utf-8")
    quiet = ["-Wno-missing-field-initializers", "-Wno-missing-braces"]
    command = [str(COMPILER), "-O1", "-Wall", "-Wextra", "-Werror", *quiet, "vscript.c", "-o", "vscript"]
    built = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert built.returncode == 0, built.stderr[:4000]
    # as it goes on, the script knows what it did: words of commands keep the bits of their register
    events, expected = [], []
    for event in script(made, random.Random(12)):  # the seed makes one script of it
        events.append(event)
        expected.append(happen(made[event.drive], event))
    ran = subprocess.run(
        [str(tmp_path / "vscript")], input="\n".join(map(str, events)), capture_output=True, text=True, check=True
    )
    got = ran.stdout.splitlines()
    assert len(got) == len(expected)
    for index, (event, one, other) in enumerate(zip(events, got, expected, strict=True)):
        assert one == other, (
            f"event {index}: {event}\n"
            + "\n".join(
                f"{each} -> {text}"
                for each, text in zip(events[:index], expected, strict=False)
                if each.drive == event.drive
            )[-2000:]
        )
    told = " ".join(expected)
    assert all(f"{code:02x}" in told for code in (0x83, 0x90, 0x86))
    assert any(one.stores for one in made)
