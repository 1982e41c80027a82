"""Measurement of the CRC: the blocks through matiec beside forms in C, frames of 8, 64 and 256 bytes."""

from collections.abc import Iterable

from tests.bench.forms import NATIVE, ROUNDS, timed
from tests.bench.record import Rows

from structured_text.engines.matiec import MatiecEngine

BUILDS = {"stock": True, "unforced": False}
"""How matiec's C is compiled: as its runtime has it, or without the test whether a variable is forced."""


def measure(engines: Iterable[MatiecEngine], rounds: int = ROUNDS) -> Rows:
    """Nanoseconds of one call: `<form> <bytes> <chained or independent>` -> `<line> <build>` and `... median`.

    Raises EngineError if a form gives another checksum than the definition.
    """
    rows: Rows = {}
    for engine in engines:
        for build, forced in BUILDS.items():
            taken, _ = timed(engine, (NATIVE / "crc.c").read_text("utf-8"), forced=forced, rounds=rounds)
            for form, one in taken.items():
                columns = rows.setdefault(form, {})
                columns[f"{engine.name} {build}"] = one.least
                columns[f"{engine.name} {build} median"] = one.median
    return rows
