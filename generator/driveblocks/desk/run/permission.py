"""Which drives a person lets run on a real port, by typing what they are."""

import sys
from collections.abc import Collection, Iterable

from driveblocks import console
from driveblocks.desk.clock import Clock
from driveblocks.desk.keyboard import Keyboard
from driveblocks.desk.master import Master
from driveblocks.desk.port import Port
from driveblocks.desk.run.controller import Controller, LineEnd
from driveblocks.desk.run.stopper import speech
from driveblocks.desk.site.family import stranger
from driveblocks.desk.site.reader import Reads
from driveblocks.maps.collection import Source

WIRED = "WIRED"


def ask(program: Controller, keyboard: Keyboard) -> frozenset[tuple[int, str]]:
    """Unit and path of the drives that may run."""
    blocks = [(program.unit(block), block.path) for block in program.wiring.drives]
    allowed = frozenset(each for each in blocks if _let_run(program, keyboard, *each))
    for unit, path in blocks:
        if (unit, path) not in allowed:
            console.write(f"{path}, unit {unit}: reads and stops only")
    return allowed


def strangers(line: LineEnd, port: Port, clock: Clock, free: Collection[int], maps: Iterable[Source]) -> list[str]:
    """Why drives that may run are of another family than their blocks, by reads alone."""
    units = {unit: drive for unit, drive in line.units().items() if unit in free}
    master = Master(Reads(port), clock, speech(line, units))
    every = {each.path.stem: each.drive for each in maps}
    found = (
        stranger(master, drive, unit, {stem: one for stem, one in every.items() if one.prefix != drive.prefix})
        for unit, drive in units.items()
    )
    return [each for each in found if each]


def _let_run(program: Controller, keyboard: Keyboard, unit: int, path: str) -> bool:
    if _typed(f"REAL PORT. To let {path} run, type its name and its unit address: ", keyboard) != f"{path} {unit}":
        return False
    if program.number(f"{path}.Usual.WatchdogMs"):
        return True
    lone = f"{path} has no watchdog (its WatchdogMs is 0): it runs on when this computer fails."
    return _typed(f"{lone}\nIf a hard stop is wired, type {WIRED}: ", keyboard) == WIRED


def _typed(question: str, keyboard: Keyboard) -> str:
    sys.stdout.write(question)
    sys.stdout.flush()
    answer = (keyboard.line() or "").strip()
    if not keyboard.echoes:
        sys.stdout.write(f"{answer}\n")
    return answer
