"""A real drive that is no shipped map: what the maker's table says of it, and what only software in use says, apart."""

import re
from dataclasses import replace
from functools import cache
from pathlib import Path

from driveblocks.maps import trust
from driveblocks.maps.collection import Source
from driveblocks.maps.load import load
from driveblocks.maps.model import Drive
from driveblocks.output.units import units
from driveblocks.render.drive import drive_block
from driveblocks.render.text import languages
from driveblocks.testing import runner
from driveblocks.testing.unit import Unit
from structured_text.engines.embedded.engine import EmbeddedEngine

FILE = Path(__file__).with_name("atv12.yaml")
ADDRESSES = {
    "CMD": 8501, "LFR": 8502, "CMI": 8504, "ETA": 3201, "RFR": 3202, "FRH": 3203, "LCR": 3204, "ULN": 3207, "LFT": 7121,
    "DP0": 7200, "SFR": 3102, "TFR": 3103, "HSP": 3104, "LSP": 3105, "ADD": 6001, "TBR": 6003, "TFO": 6004, "TTO": 6005,
    "SLL": 7010, "CHCF": 8401, "FR1": 8413,
}  # fmt: skip
"""Typed by hand from the sheet Parameters, decimal, as it prints them."""


@cache
def drive() -> Drive:
    """The map."""
    return load(FILE)


def test_addresses_are_those_of_the_makers_table() -> None:
    rows = {row.id: row for _, row in drive().registers()}
    assert {id_: row.address.first for id_, row in rows.items()} == ADDRESSES
    assert all(one.register == ADDRESSES[one.id] for one in drive().settings)
    assert {id_ for id_, row in rows.items() if row.signed} == {"LFR", "RFR", "FRH"}


def test_what_the_makers_table_does_not_say_is_in_use_and_wants_a_check() -> None:
    assert trust.counted(drive()) == {
        "commands": {"read": 3, "in_use": 4}, "status": {"read": 4, "in_use": 3}, "faults": {"in_use": 34},
    }  # fmt: skip
    in_use = {name for facts in trust.rungs(drive()).values() for name, one in facts.items() if one}
    assert in_use >= {"run_forward", "run_reverse", "stop", "quick_stop", "running", "state switched_on"}
    assert drive_block(drive()).own.second_hand


def test_a_motor_turns_both_ways_and_its_frequency_is_shown_without_sign() -> None:
    """RFR is negative in reverse."""
    found = units([Source(FILE, drive())], languages(["en"], "utf-8"))
    blocks = {each.path: each for unit in found for each in unit.blocks}
    block = next(text.text for path, text in blocks.items() if path.endswith("ATV12_Drive.st"))
    assert "OutputFrequencyHz := ABS(ATV12_EstimatedMotorFrequencyHz(Raw := Reads." in block
    unit = next(each for each in found if each.suite.name == "atv12")
    made = tuple(each for each in unit.suite.programs if re.search("_Test(MotorStart|Scales|Standstill)", each.path))
    assert len(made) == 3
    some = replace(unit.suite, programs=made)
    assert runner.run([Unit(some, tuple(blocks.values()))], [EmbeddedEngine()]).passed
