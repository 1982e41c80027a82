"""Mistakes of former texts, planted into the present one: the matrix sees each."""

import pytest
from tests.second.matrix import named, run
from tests.second.station import built

from driveblocks.host.embedded.engine import EmbeddedEngine

ENDS = "EndsByAnswer := NOT MayMove AND (Proved OR MonitorOnly OR SpeedOnly);"
PLANTED = (
    # the end of a jog is what the line sends for a block that is not called
    ("Slot.StopWord := WORD#16#0005;", "Slot.StopWord := WORD#16#0008;",
     "CHF, full control, block not called for 12 s, at speed", {"stop", "prompt"}),
    # a stop in a mode that only reads, or only gives the reference, ends by proof alone, which there is none of
    (ENDS, ENDS.replace("MonitorOnly OR ", ""), "JSCC, MonitorOnly, nothing, at speed", {"contact", "close"}),
    (ENDS, ENDS.replace(" OR SpeedOnly", ""), "JSCC, SpeedOnly, StopAll pulse, at speed", {"contact", "close"}),
    # the mode is taken in the call of the restart, and no stop is sent
    ("PostStop := MustStop OR Follows OR Repeats;", "PostStop := (MustStop OR Follows OR Repeats) AND NOT SpeedOnly;",
     "CHF, full control, Restart into SpeedOnly, at speed", {"stop", "prompt"}),
)  # fmt: skip
SEEDS = 6


@pytest.mark.parametrize(("old", "new", "cell", "rules"), PLANTED)
def test_a_planted_mistake_is_seen(old: str, new: str, cell: str, rules: set[str]) -> None:
    counted: list[int] = []

    def edit(text: str) -> str:
        counted.append(text.count(old))
        return text.replace(old, new)

    stations = built(EmbeddedEngine(), edit)
    assert sum(counted) == 1, "the mistake has its place"
    found = [set(run(named(cell), seed, stations).rules) for seed in range(SEEDS)]
    assert any(each & rules for each in found), found
