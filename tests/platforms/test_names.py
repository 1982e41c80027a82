"""Names: every target has its words, and adapters and first motors clash with nothing of the library."""

import re

from tests.platforms.stock import canon, made

from driveblocks.maps.rules import identifier
from driveblocks.platforms import CANONICAL, PLATFORMS, TARGETS, port
from structured_text.language.reserved import TARGET_WORDS

DECLARED = re.compile(r"^  (\w+)(?: AT %\S+)? : ", re.MULTILINE)
OUTER = re.compile(r"^(?:FUNCTION_BLOCK|FUNCTION|PROGRAM) (\w+)", re.MULTILINE)


def test_the_linter_knows_every_target_that_is_built() -> None:
    assert {CANONICAL, *TARGET_WORDS} == set(TARGETS)


def test_no_platform_has_a_name_of_the_library_or_twice_in_one_line_of_sight() -> None:
    for platform in PLATFORMS:
        motors = [port.first_motor(platform, drive) for drive in made().drives.values()]
        files = [*port.adapter(platform, []), *motors]
        outer = [name.upper() for file in files for name in OUTER.findall(file.text)]
        known = {name.upper() for name in canon()}
        assert len({*outer, *known}) == len(outer) + len(known), platform
        for file in files:
            names = [name.upper() for name in DECLARED.findall(file.text)]
            assert len(names) == len(set(names)) > 0, file.path
            assert not {*names} & {*outer, *known}, file.path


def test_no_family_may_begin_its_names_as_we_do() -> None:
    """A map with the prefix VFD would make a VFD_Drive beside VFD_HardStop."""
    ours = {*canon(), *(name for platform in PLATFORMS for name in adapters(platform))}
    drives = tuple(f"{drive.prefix}_" for drive in made().drives.values())
    assert {name.partition("_")[0] for name in ours if not name.startswith(drives)} == set(identifier.LIBRARY)


def adapters(platform: str) -> set[str]:
    """The names of a platform's own blocks."""
    return {name for file in port.adapter(platform, []) for name in OUTER.findall(file.text)}
