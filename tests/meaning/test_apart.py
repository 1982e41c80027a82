"""Nothing that the room of meanings hands out holds a piece of a map: what it gives is plain data of its own."""

from collections.abc import Iterator
from dataclasses import fields, is_dataclass
from typing import Any

import pytest
from tests import shipped

from driveblocks.maps.form import Numbered
from driveblocks.maps.problem import Taken
from driveblocks.meaning.measure import measures, own_maximum
from driveblocks.meaning.reference import reference
from driveblocks.meaning.roles import roles
from driveblocks.meaning.serial import serial
from driveblocks.meaning.setting import settings
from driveblocks.meaning.status import status
from driveblocks.meaning.watchdog import watchdog

MEANINGS = (serial, status, roles, measures, own_maximum, reference, watchdog, settings)


def held(value: Any, path: str) -> Iterator[tuple[str, Any]]:
    """Everything that is reached from a value by fields, entries and keys."""
    yield path, value
    if isinstance(value, dict):
        for key, each in value.items():
            yield from held(each, f"{path}[{key}]")
    elif isinstance(value, (tuple, list, set, frozenset)):
        for at, each in enumerate(value):
            yield from held(each, f"{path}[{at}]")
    elif is_dataclass(value):
        for field in fields(value):
            yield from held(getattr(value, field.name), f"{path}.{field.name}")


NUMBERS = (Numbered, Taken)
"""An address and a place are numbers, also where they know how a person calls them."""


@pytest.mark.parametrize("prefix", shipped.drives())
def test_what_is_handed_out_is_plain_data_that_nothing_changes(prefix: str) -> None:
    drive = shipped.drives()[prefix]
    for path, value in (each for meaning in MEANINGS for each in held(meaning(drive), meaning.__name__)):
        assert type(value) in NUMBERS or not type(value).__module__.startswith("driveblocks.maps"), path
        assert not isinstance(value, (list, set, dict)), path
        assert not is_dataclass(value) or vars(type(value))["__dataclass_params__"].frozen, path
