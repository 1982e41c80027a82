"""A hundred one-token changes of control and drive blocks, drawn by a seed: which of them do the proofs find?

`python -m tests.prove.mutants` draws changes that lint and build, proves on each until something is not proved, and
prints what; the survivors are for a person to judge: which rule is not written down, or can nobody tell the change from
the text? The seed was fixed before any change had been judged by a rule.
"""

import re
from collections.abc import Iterator
from random import Random

from tests.drives import station
from tests.drives.station import FAMILIES
from tests.second.mutants import NAME, SWAPS, TOKEN, Mutant

SEED, NUMBER = 22, 100
CONTROL = ("Control", "Pins", "Run", "FaultReset", "Start", "StopRound", "Send", "Why")
DRIVE = ("Link", "Unit", "Usual")
OF_EACH = ("Drive", "Reads", "Orders", "Reference", "Standstill")
BLOCKS = (
    *(f"VFD_{each}" for each in (*CONTROL, *DRIVE)),
    *(f"{family}_{each}" for family in FAMILIES for each in OF_EACH),
)


def every() -> Iterator[Mutant]:
    """All changes, in the order of the texts; comments and declarations stay."""
    for source in station.texts(kinds=FAMILIES):
        named = NAME.search(source.text)
        if not named or named[1] not in BLOCKS:
            continue
        plain = re.sub(r"\(\*.*?\*\)", lambda each: re.sub(r"[^\n]", " ", each[0]), source.text, flags=re.DOTALL)
        begins = plain.rindex("END_VAR") + len("END_VAR")
        for token in TOKEN.finditer(plain, begins):
            old = token[0]
            new = str(int(old) + 1) if old.isdigit() else SWAPS.get(old)
            if new is not None:
                yield Mutant(named[1], token.start(), plain.count("\n", 0, token.start()) + 1, old, new)


def drawn(seed: int = SEED) -> list[Mutant]:
    """All changes in the order of a seed; who takes the first ones leaves out those that do not lint or build."""
    found = list(every())
    Random(seed).shuffle(found)
    return found
