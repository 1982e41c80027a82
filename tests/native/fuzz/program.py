"""The fuzz targets as a program: with libFuzzer, or with a main function that replays lines of hexadecimal."""

import functools
from collections.abc import Iterator
from pathlib import Path

from tests.native.driver import Driver, clang
from tests.native.sanitize.pins import pous
from tests.native.sanitize.program import drivers
from tests.native.sanitize.sanitizers import CLANGS, FIRM, Checked, runs
from tests.shipped import bases, drives

from structured_text.engines.matiec import MatiecEngine

HERE = Path(__file__).parent
SHARED = ("rtu_open", "ascii_decode", "parse_reply")


def targets() -> dict[str, str]:
    """Name of each target -> its function in C."""
    found = {name: f"target_{name}" for name in SHARED}
    for prefix in sorted(drives().keys() - bases()):  # a sister parses and builds as its base does
        found[f"{prefix.lower()}_reply"] = f"target_{prefix}_REPLY"
        found[f"{prefix.lower()}_request"] = f"target_{prefix}_REQUEST"
    return found


def text(engine: MatiecEngine) -> str:
    """The C after prelude.h."""
    library = pous(engine)
    return "\n".join([drivers(library, library), *_parts()])


def _parts() -> Iterator[str]:
    yield _file("targets")
    for prefix in sorted(drives().keys() - bases()):  # a sister parses and builds as its base does
        yield f"REPLY_TARGET({prefix}_REPLY)\nREQUEST_TARGET({prefix}_REQUEST, {prefix}_REPLY)\n"
    first, behind = _file("main").split("static const Target *chosen;")
    rows = ", ".join(f'{{"{name}", {function}}}' for name, function in targets().items())
    yield f"{first}static const Target TARGETS[] = {{{rows}}};\nstatic const Target *chosen;{behind}"


def _file(name: str) -> str:
    return f'#line 1 "{name}.h"\n{(HERE / name).with_suffix(".h").read_text(encoding="utf-8")}\n'


def replayer(engine: MatiecEngine, checked: Checked) -> Path:
    """The program with a main function. Raises what Driver.build raises."""
    return Driver(text(engine), checked.options, checked.command).build(engine)


@functools.cache
def libfuzzer() -> Checked | None:
    """clang with libFuzzer and the sanitizers, if they are there."""
    command = clang()
    for chosen in CLANGS if command else ():
        options = (*(each.replace("=address", "=fuzzer,address") for each in chosen), *FIRM, "-DLIBFUZZER")
        if command and runs(command, options, FUZZ_PROBE):
            return Checked("clang", command, options)
    return None


FUZZ_PROBE = (
    "int LLVMFuzzerTestOneInput(const unsigned char *d, unsigned long n) { return n > 4000 && d[4000] == 77; }\n"
)


def fuzzer(engine: MatiecEngine, checked: Checked) -> Path:
    """The program with libFuzzer. Raises what Driver.build raises."""
    return Driver(text(engine), checked.options, checked.command).build(engine)
