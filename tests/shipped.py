"""The shipped maps and their blocks with the programs that test them, read and made once per process."""

from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import TypeVar

from driveblocks.bench.unit import Unit
from driveblocks.maps import catalog, collection
from driveblocks.maps.model import Drive
from driveblocks.output.units import units as tested
from driveblocks.render.text import languages

Row = TypeVar("Row")
BOTH = languages(["en", "zh"], "utf-8")


@cache
def sources() -> list[collection.Source]:
    """The maps with their files."""
    return collection.read(catalog.shipped())


@cache
def drives() -> dict[str, Drive]:
    """The maps by prefix."""
    return {each.drive.prefix: each.drive for each in sources()}


@cache
def bases() -> dict[str, str]:
    """The prefix of the sister that a map has as its base, by its own."""
    prefix = {Path(each.path).stem: each.drive.prefix for each in sources()}
    return {each.drive.prefix: prefix[each.drive.base] for each in sources() if each.drive.base}


def sisters(table: Mapping[str, Row]) -> dict[str, Row]:
    """What is so of each drive, by prefix: of one with a base, as of that, where the table does not say otherwise."""
    return {**{own: table[base] for own, base in bases().items() if base in table}, **table}


@cache
def units() -> list[Unit]:
    """The shared blocks, then those of each map, in both languages, with their programs."""
    return tested(sources(), BOTH)
