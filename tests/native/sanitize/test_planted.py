"""The sanitizers see what they are there for: every index beside its array, and every number beside its type."""

import pytest
from tests.native.driver import run
from tests.native.sanitize import planted
from tests.native.sanitize.sanitizers import Checked, compilers, found_lines, why_none

from structured_text.engines.matiec import MatiecEngine


def tools() -> list[tuple[MatiecEngine, Checked]]:
    """The first line of matiec with each compiler: the lines declare arrays alike."""
    if not (lines := found_lines()):
        pytest.skip("iec2c was not found")
    if not (found := compilers(lines[0])):
        pytest.skip(why_none(lines[0]))
    return [(lines[0], checked) for checked in found]


def test_an_index_beside_its_array_ends_the_program() -> None:
    """-1, the length, the length + 1 and 65535, read and written; most of them still lie inside the instance."""
    for engine, checked in tools():
        program = planted.build(engine, checked)
        for number, access in enumerate(planted.ACCESSES):
            length = planted.LENGTHS[access.partition("_")[2]]
            for good in (0, length - 1):
                assert run(program, number, good).stdout == "went on\n", (checked.name, access, good)
            for bad in (-1, length, length + 1, 65535):
                done = run(program, number, bad)
                assert done.returncode, (checked.name, access, bad)
                assert "out of bounds" in done.stderr, (checked.name, access, bad)


@pytest.mark.parametrize(("way", "compiler_names"), [(0, {"clang"}), (1, {"gcc", "clang"}), (2, {"gcc", "clang"})])
def test_a_number_beside_its_type_ends_the_program(way: int, compiler_names: set[str]) -> None:
    """A sum that leaves UINT (which only clang can see), a REAL that no integer holds, a sum that leaves DINT."""
    for engine, checked in tools():
        done = run(planted.build(engine, checked), way)
        assert bool(done.returncode) is (checked.name in compiler_names), (checked.name, done.stderr)
