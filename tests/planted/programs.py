"""`python -m tests.planted.programs MAP NAME...`: exit status 1 if a check of these test programs of a map fails.

A name is the beginning of what follows `_Test`, in the programs of the drive or in the shared ones.
"""

import sys

from tests.planted.verdict import ended
from tests.shipped import BOTH
from tests.testing.conftest import only, run

from driveblocks.bench.unit import Unit
from driveblocks.maps import catalog, collection
from driveblocks.output.units import units


def has(unit: Unit, name: str) -> bool:
    """Whether a unit has such a program."""
    return any(one.name.partition("_Test")[2].startswith(name) for one in unit.suite.programs)


def found() -> bool:
    """Whether a check fails."""
    of, *names = sys.argv[1:]
    made = units(collection.read(catalog.chosen([of])), BOTH)
    wanted = [(unit, [name for name in names if has(unit, name)]) for unit in made]
    return not run(*(only(unit, *those) for unit, those in wanted if those)).passed


if __name__ == "__main__":
    sys.exit(ended(found))
