"""Who judges the blocks of a changed map: the manuals' frames, the reference model of the map as it was, typed facts.

Each judge raises AssertionError, or KeyError where a block, pin or function is gone.
"""

import itertools
from collections.abc import Callable, Iterator
from functools import cache
from types import ModuleType
from typing import Any

from tests.blocks import asking, driving, meanings, permissions, vectors
from tests.blocks.library import Blocks
from tests.blocks.test_reply import assert_by_chance
from tests.maps import test_facts, test_facts_of_coils_and_charts
from tests.maps.facts.powerflex_sisters import SISTERS
from tests.shipped import drives

from driveblocks.maps.model import Drive
from driveblocks.reference.naming import name_of
from driveblocks.reference.request import BUILDABLE, Asked

Judge = Callable[[Blocks, Drive], None]

NAMES = {
    "SN300G5": ("sn300g5", "SN"),
    "JSCC": ("jscc", "JS"),
    "CHF": ("chf", "CH"),
    "GD200A": ("gd200a", "GD"),
    "PF4": ("powerflex_4", "PF"),
    "ATV312": ("altivar_312", "ATV"),
    "MX2": ("mx2", "MX"),
    **{name: (name, name) for name in SISTERS},
}
"""What the module of facts calls each drive: in its table, and as a global."""
FACTS = {
    key: test_facts_of_coils_and_charts if key in ("altivar_312", "mx2") else test_facts for key, _ in NAMES.values()
}

EXCHANGE = ("CanRead", "CanWrite", "Request")


def judge(blocks: Blocks, drive: Drive, changed: list[str], other: Drive) -> None:
    """Judge the blocks that differ; `drive` is the map as it was, `other` only says where to look first."""
    if any(name.removeprefix(f"{drive.prefix}_") in EXCHANGE for name in changed):
        _requests(blocks, drive, other)
    for name in changed:
        _JUDGES.get(name.removeprefix(f"{drive.prefix}_").removesuffix("En").removesuffix("Zh"), _nothing)(
            blocks, drive
        )
    for row in meanings.decoded(drive):
        if f"{drive.prefix}_{name_of(row)}" in changed:
            meanings.assert_decoder(blocks, drive, row)
    for row in meanings.scaled(drive):
        if meanings.scale_name(drive, row) in changed:
            meanings.assert_scale(blocks, drive, row)


def _requests(blocks: Blocks, drive: Drive, other: Drive) -> None:
    for frame in drive.frames:
        if frame.direction == "request" and frame.means.function in BUILDABLE:
            vectors.assert_request(blocks, drive, frame)
    draw, changed = asking.Asking(drive), asking.Asking(other)
    apart = draw.model.readable ^ changed.model.readable | draw.model.writable ^ changed.model.writable
    unit, words = drive.serial.unit.min, tuple(range(125))
    first = (Asked(code, unit, at, 1, words=words) for at in sorted(apart)[:16] for code in (3, 6, 16))
    limits = [*draw.limits()]
    casts = (asked for asked in limits if asked.unit == 0)
    for asked in itertools.chain(first, casts, limits[:: max(1, len(limits) // 400)], (draw.any() for _ in range(400))):
        asking.assert_request(blocks, draw, asked)


def _replies(blocks: Blocks, drive: Drive) -> None:
    for frame in drive.frames:
        if frame.direction == "reply":
            vectors.assert_reply(blocks, drive, frame)
    assert_by_chance(blocks, drive, 400)


def _commands(blocks: Blocks, drive: Drive) -> None:
    driving.assert_commands(blocks, drive, driving.all_pins())
    driving.assert_commands(blocks, drive, driving.motions())


def _references(blocks: Blocks, drive: Drive) -> None:
    for given in driving.references(drive):
        driving.assert_reference(blocks, drive, given)


def _nothing(_: Blocks, __: Drive) -> None:
    """Requests and registers are judged by themselves."""


_JUDGES: dict[str, Judge] = {
    "Reply": _replies,
    "Command": _commands,
    "Reference": _references,
    "Standstill": meanings.assert_standstill,
    "MayWrite": permissions.assert_writes,
    "ParameterAddress": permissions.assert_numbers,
    "FaultNumber": meanings.assert_fault_number,
    "FaultText": meanings.assert_code_texts,
    "ErrorText": meanings.assert_code_texts,
    "BitText": meanings.assert_bit_texts,
    "ValueText": meanings.assert_value_texts,
}

# ---------------------------------------------------------------- facts typed by hand


def facts(drive: Drive) -> None:
    """The tests of typed facts with this map in place of the shipped one. Raises what the first red test raises."""
    key, name = NAMES[drive.prefix]
    module = FACTS[key]
    before = drives()[drive.prefix]
    _put(module, key, name, drive)
    try:
        for test, arguments in _tests(key):
            test(**arguments)
    finally:
        _put(module, key, name, before)


def _put(module: ModuleType, key: str, name: str, drive: Drive) -> None:
    """A drive in the place of the shipped one."""
    setattr(module, name, drive)
    if hasattr(module, "DRIVES"):
        module.DRIVES[key] = drive


def _tests(key: str) -> Iterator[tuple[Callable[..., None], dict[str, Any]]]:
    """Every test of facts with its arguments, but those of other drives."""
    others = {other for other, _ in NAMES.values()} - {key}
    for name, test in vars(FACTS[key]).items():
        if not name.startswith("test_") or any(name.startswith(f"test_{other}_") for other in others):
            continue
        for arguments in _arguments(test):
            if arguments.get("drive") not in others:
                yield test, arguments


def _arguments(test: Callable[..., None]) -> Iterator[dict[str, Any]]:
    """What pytest's parametrize would hand to a test."""
    marks = [mark for mark in getattr(test, "pytestmark", []) if mark.name == "parametrize"]
    choices = [[_named(mark.args[0], value) for value in mark.args[1]] for mark in marks]
    for combination in itertools.product(*choices):
        yield {name: value for part in combination for name, value in part.items()}


def _named(names: str | tuple[str, ...], value: Any) -> dict[str, Any]:
    listed = [name.strip() for name in names.split(",")] if isinstance(names, str) else list(names)
    return dict(zip(listed, value, strict=True)) if len(listed) > 1 else {listed[0]: value}


@cache
def shipped_is_good() -> None:
    """The facts hold for the shipped maps as they are: otherwise every change would seem to be noticed."""
    for drive in drives().values():
        facts(drive)
