"""Commands and references of a drive, against the reference model."""

import itertools
import random
from collections.abc import Iterator
from dataclasses import astuple, replace
from math import inf, nan
from typing import Any

from tests.blocks.library import Blocks, number, result, scan

from driveblocks.maps.model import Drive
from driveblocks.reference.command import Commands, Pins
from driveblocks.reference.speed import Encoded, SpeedReference

PIN_NAMES = {
    "Enable": "enable",
    "Stop": "stop",
    "QuickStop": "quick_stop",
    "CoastStop": "coast_stop",
    "RunForward": "run_forward",
    "RunReverse": "run_reverse",
    "JogForward": "jog_forward",
    "JogReverse": "jog_reverse",
    "FaultReset": "fault_reset",
    "StopAcknowledged": "stop_acknowledged",
    "ResetAcknowledged": "reset_acknowledged",
}
FLAGS = ("Stopping", "Resetting", "Changed")
SPEEDS = (0.0, -0.0, 0.004, 0.005, 0.01, 0.5, 1.0, 25.0, 49.995, 50.0, 60.0, 299.99, 327.67, 327.68, 400.0, 655.35)
WRONG = (nan, inf, -inf, -0.001, -0.0049, -0.0051, -0.049, -0.051, -1.0, 1.0e31, -1.0e31, 3.4e38)
HUGE = (655.36, 1000.0, 40000.0, 65535.0, 1.0e6, 9.0e9, 9.0e29)
MAXIMA = (0.0, 50.0, 60.0, 400.0, 0.1, 0.0999, 10000.0, 10000.1, nan, -1.0, inf)
SCALES = (0.0, 10.0, 100.0, 0.5, -1.0, nan, inf)
"""Counts per Hz; only asked for where the map has no scale."""


def assert_commands(blocks: Blocks, drive: Drive, steps: Iterator[Pins]) -> None:
    """One instance and one reference model through the same steps; each command register keeps other bits."""
    model = Commands(drive)
    kept = {f"KeepWord{'' if at == model.home else f'{at:04X}H'}": at for at, bits in model.kept.items() if bits}
    instance = blocks.library.instance(f"{drive.prefix}_Command")
    for turn, pins in enumerate(steps):
        words = {at: (0x0000, 0xFFFF, 0x2AF4, 0x5503)[(turn + place) % 4] for place, at in enumerate(kept.values())}
        values: dict[str, bool | int] = {name: getattr(pins, field) for name, field in PIN_NAMES.items()}
        scan(instance, values | {name: words[at] for name, at in kept.items()})
        told = model.step(replace(pins, keep=words))
        outputs = (instance["Address"], instance["Value"], result(instance), *map(instance.__getitem__, FLAGS))
        assert outputs == astuple(told), (pins, outputs, told)


def pressed(pins: dict[str, Any]) -> Pins:
    """Pins by their names in the reference model."""
    return Pins(**pins)


def all_pins() -> Iterator[Pins]:
    """Every combination of pins, one after the other in a fixed order at random."""
    combinations = list(itertools.product([False, True], repeat=len(PIN_NAMES)))
    random.Random(9).shuffle(combinations)
    for each in combinations:
        yield pressed(dict(zip(PIN_NAMES.values(), each, strict=True)))


def motions() -> Iterator[Pins]:
    """Jogging, running, and letting go in turn: what the last motion leaves."""
    asks = [{}, *({name: True} for name in list(PIN_NAMES.values())[1:]), {"enable": False}]
    for first, second in itertools.product(asks, repeat=2):
        for ask in (first, {}, second, {}):
            yield pressed(ask)


def resets() -> Iterator[Pins]:
    """A reset is asked, and then anything happens, for a few calls at a time."""
    chance = random.Random(17)
    for _ in range(150):
        held = chance.sample(list(PIN_NAMES.values())[1:8], chance.choice([0, 0, 1, 1, 2]))
        for _ in range(chance.randint(3, 9)):
            over = dict.fromkeys(held, chance.random() < 0.7)
            flags = {name: chance.random() < 0.3 for name in list(PIN_NAMES.values())[8:]}
            yield pressed({"enable": chance.random() < 0.9, **over, **flags})


References = tuple[float, float, float, float]
"""SpeedReferenceHz, MaximumHz, FullScaleHz, ReferenceScale."""


def encode(blocks: Blocks, drive: Drive, given: References) -> Encoded:
    """Run the reference block once."""
    own = SpeedReference(drive)
    pins = dict(zip(("SpeedReferenceHz", "MaximumHz", "FullScaleHz"), given, strict=False))
    scale = {"ReferenceScale": given[3]} if own.factor is None else {}
    done = blocks.run(f"{drive.prefix}_Reference", {**pins, **scale})
    assert done["Address"] == own.address
    limited, hertz = done["Limited"], done["AskedHz"]
    assert isinstance(limited, bool)
    assert isinstance(hertz, float)
    return Encoded(result(done), number(done, "Value"), limited, hertz=hertz)


def assert_reference(blocks: Blocks, drive: Drive, given: References) -> None:
    """The result and the word, or those that arithmetic in single precision may give beside a half."""
    wanted, found = SpeedReference(drive).encode(*given), encode(blocks, drive, given)
    assert found.result in wanted.results, (given, found, wanted)
    assert found.value in wanted.near, (given, found, wanted)
    if len(wanted.results) == 1:
        assert found.hertz == wanted.hertz, (given, found, wanted)
    if len(wanted.near) == 1 and not wanted.at_the_end:
        assert found.limited == wanted.limited, (given, found, wanted)


def references(drive: Drive) -> Iterator[References]:
    """Speeds, maxima and scales that try every limit; then a limit beside a full scale."""
    model = SpeedReference(drive)
    scales = SCALES if model.factor is None else (0.0,)
    for hertz, maximum, scale in itertools.product((*SPEEDS, *WRONG, *HUGE), MAXIMA, scales):
        yield hertz, maximum, (maximum if 0.1 <= maximum <= 10000.0 else 50.0) if model.percent else 0.0, scale
    for hertz, full in itertools.product((-1.0, 0.0, 25.0, 45.0, 70.0, nan), (*MAXIMA, 40.0)):
        yield hertz, 50.0, full, 10.0
