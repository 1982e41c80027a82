"""`blocks/tests/README.md`: how to run the test programs on a controller, and what each of them checks."""

from collections.abc import Iterable

from driveblocks.bench.harness import PER_SCAN
from driveblocks.bench.scenes.reason import REASONS
from driveblocks.bench.script import MOST_STAGES, SCAN_MS, Suite
from driveblocks.maps.view import UNPROVED

_HEAD = f"""# The test programs

Everything in this folder is written by `driveblocks build` from the vendor maps; nothing in the library needs it.
`driveblocks test` runs these programs on your computer. They are plain Structured Text, so a controller can run them
too: on the bench, without a drive, to see that its compiler translates the blocks correctly.

1. Import the library in the order of `../iec61131/order.txt`, then the files named in `iec61131/order.txt`: those of
   `harness`, those of `modbus`, and those of your drive. A controller short of memory takes one program at a time.
2. Call a program from a cyclic task. Each scan does one case, at most {PER_SCAN} checks; a program has at most
   {MOST_STAGES} cases. The programs of scenes (`TestMotor...`, `TestParameters`) wire the drive block and its line as a
   user does, with a drive that is simulated in memory instead of a port; each of their cases takes some scans, and each
   scan counts as {SCAN_MS} ms, however fast the task is.
3. When `Done` is TRUE, `Failures` must be 0 and `Checks` the number in the table below.
4. Otherwise `FirstFailed` is the number of the first check that failed. The comments of the program carry these
   numbers, with what is checked and where it is in the manual; `Expected` and `Actual` are the two values.

What the checks expect comes from the example frames of the manuals and from a model of the blocks that shares no code
with what writes them.
"""


def page(tables: Iterable[str]) -> str:
    return _HEAD + "".join(tables)


def _sentence(words: str) -> str:
    return f"{words[:1].upper()}{words[1:]}."


def table(suite: Suite) -> str:
    """What a suite checks, and which reasons it does not show."""
    total = sum(len(program.checks) for program in suite.programs)
    lines = [f"\n## {suite.name}: {total} checks\n", *([] if suite.vectors else [f"{_sentence(UNPROVED)}\n"])]
    lines += ["| program | checks | what it checks |", "|---|---:|---|"]
    for program in suite.programs:
        lines.append(f"| [`{program.name}`](iec61131/{program.path}) | {len(program.checks)} | {program.title} |")
    if suite.unreached:
        lines.append("\nThe scenes of the motor and its line show every number of `Reason` but these:\n")
        lines += [f"- {REASONS[name]} {name}: {why}" for name, why in suite.unreached.items()]
    return "\n".join(lines) + "\n"
