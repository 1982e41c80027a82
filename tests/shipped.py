"""The shipped maps and their blocks with the programs that test them, read and made once per process."""

from functools import cache

from driveblocks.maps import catalog, collection
from driveblocks.maps.model import Drive
from driveblocks.output.units import units as tested
from driveblocks.render.text import languages
from driveblocks.testing.unit import Unit

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
def units() -> list[Unit]:
    """The shared blocks, then those of each map, in both languages, with their programs."""
    return tested(sources(), BOTH)
