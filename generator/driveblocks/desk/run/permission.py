"""Which drives a person lets run on a real port, by typing what they are."""

import sys

from driveblocks import console
from driveblocks.desk.keyboard import Keyboard
from driveblocks.desk.run.controller import Controller

WIRED = "WIRED"


def ask(program: Controller, keyboard: Keyboard) -> frozenset[tuple[int, str]]:
    """Unit and path of the drives that may run."""
    blocks = [(program.unit(block), block.path) for block in program.wiring.drives]
    allowed = frozenset(each for each in blocks if _let_run(program, keyboard, *each))
    for unit, path in blocks:
        if (unit, path) not in allowed:
            console.write(f"{path}, unit {unit}: reads and stops only")
    return allowed


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
