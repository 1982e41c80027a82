"""Names: every target has its words, and adapters and first motors clash with nothing of the library."""

import re

from tests.export.stock import canon, made

from driveblocks.export import CANONICAL, TARGETS
from driveblocks.render import library
from driveblocks.st.reserved import TARGET_WORDS

DECLARED = re.compile(r"^  (\w+)(?: AT %\S+)? : ", re.MULTILINE)
OUTER = re.compile(r"^(?:FUNCTION_BLOCK|FUNCTION|PROGRAM) (\w+)", re.MULTILINE)


def test_the_linter_knows_every_target_that_is_built() -> None:
    assert {CANONICAL, *TARGET_WORDS} == set(TARGETS)


def test_no_platform_has_a_name_of_the_library_or_twice_in_one_line_of_sight() -> None:
    for platform in library.PLATFORMS:
        motors = [library.first_motor(platform, drive) for drive in made().drives.values()]
        files = [*library.adapter(platform, []), *motors]
        outer = [name.upper() for file in files for name in OUTER.findall(file.text)]
        known = {name.upper() for name in canon()}
        assert len({*outer, *known}) == len(outer) + len(known), platform
        for file in files:
            names = [name.upper() for name in DECLARED.findall(file.text)]
            assert len(names) == len(set(names)) > 0, file.path
            assert not {*names} & {*outer, *known}, file.path
