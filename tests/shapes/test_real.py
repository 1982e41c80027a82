"""Real drives that are no shipped maps: what their makers say, what only others say, and that their motors turn."""

import re
from dataclasses import replace
from functools import cache
from pathlib import Path

import pytest

from driveblocks.bench import runner
from driveblocks.bench.unit import Unit
from driveblocks.maps import trust
from driveblocks.maps.collection import Source
from driveblocks.maps.load import load
from driveblocks.maps.model import Drive
from driveblocks.output.units import units
from driveblocks.render.drive import drive_block
from driveblocks.render.text import languages
from structured_text.engines.embedded.engine import EmbeddedEngine

ADDRESSES: dict[str, dict[str | None, list[int]]] = {
    "atv12": {
        "CMD": [8501], "LFR": [8502], "CMI": [8504], "ETA": [3201], "RFR": [3202], "FRH": [3203], "LCR": [3204],
        "ULN": [3207], "LFT": [7121], "DP0": [7200], "SFR": [3102], "TFR": [3103], "HSP": [3104], "LSP": [3105],
        "ADD": [6001], "TBR": [6003], "TFO": [6004], "TTO": [6005], "SLL": [7010], "CHCF": [8401], "FR1": [8413],
    },
}  # fmt: skip
"""Typed by hand, decimal, as the makers print them; without an id in their order."""
SHOWN = {"atv12": "ABS(ATV12_EstimatedMotorFrequencyHz(Raw := Reads."}
"""How the pin of the output frequency is made: RFR of an Altivar is negative in reverse, the pin of no family is."""


def file(name: str) -> Path:
    """Where a map is."""
    return Path(__file__).with_name(f"{name}.yaml")


@cache
def drive(name: str) -> Drive:
    """A map."""
    return load(file(name))


@pytest.mark.parametrize("name", ADDRESSES)
def test_addresses_are_those_that_the_maker_prints(name: str) -> None:
    found: dict[str | None, list[int]] = {}
    for _, row in drive(name).registers():
        found.setdefault(row.id, []).append(row.address.first)
    assert found == ADDRESSES[name]
    assert all([one.register] == found[one.id] for one in drive(name).settings)


def test_what_the_makers_table_does_not_say_is_in_use_and_wants_a_check() -> None:
    altivar = drive("atv12")
    assert trust.rung(altivar) == (
        "commands in use, status in use, serial transcribed, faults in use, other settings in use"
    )
    assert trust.counted(altivar)["commands"] == {"read": 2, "in_use": 4}
    in_use = {one.name for one in trust.facts(altivar) if one.trust == "in_use"}
    assert in_use >= {"run_forward", "run_reverse", "stop", "quick_stop", "running", "state switched_on"}
    assert drive_block(altivar).own["second_hand"]


@pytest.mark.parametrize("name", ADDRESSES)
def test_a_motor_turns_both_ways(name: str) -> None:
    found = units([Source(file(name), drive(name))], languages(["en"], "utf-8"))
    blocks = {each.path: each for unit in found for each in unit.blocks}
    block = next(text.text for path, text in blocks.items() if path.endswith(f"{drive(name).prefix}_Drive.st"))
    assert f"OutputFrequencyHz := {SHOWN[name]}" in block
    unit = next(each for each in found if each.suite.name == name)
    made = tuple(each for each in unit.suite.programs if re.search("_Test(MotorStart|Scales|Standstill)", each.path))
    assert len(made) == 3
    some = replace(unit.suite, programs=made)
    assert runner.run([Unit(some, tuple(blocks.values()))], [EmbeddedEngine()]).passed


def test_states_in_two_words_are_awaited_apart() -> None:
    altivar = drive("atv12")
    first, second = altivar.operation.states
    states = (first, replace(second, register=altivar.operation.measures[0].register))
    ordering = drive_block(replace(altivar, operation=replace(altivar.operation, states=states))).ordering
    assert [one.name for one in ordering.awaited] == ["Awaits", "StateMask", "StateWord", "StateMask1", "StateWord1"]
    assert re.findall(r"Reads\.(\w+) AND Orders\.(\w+)\) = Orders\.(\w+)", ordering.reached) == [
        ("StatusWordFrequencyWord", "StateMask", "StateWord"),
        ("EstimatedMotorFrequencyWord", "StateMask1", "StateWord1"),
    ]
    assert [write.wait and write.wait.number for write in ordering.orders[5]] == ["", "1", None]
