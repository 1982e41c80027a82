"""Every figure of the project, side by side in one run: `python -m tests.bench.run`, some minutes on two cores.

Writes `performance.json` in `docs/measured`, and from it the page `performance.md`. What cannot be measured here is
named, and keeps the figures that it had. `--only crc,growth` measures some parts; `--page` none.

Exit status 1 if forms of the same work differ, or if a count cannot be repeated.
"""

import argparse
import shutil
import sys
import time
from collections.abc import Callable, Iterable
from dataclasses import dataclass

from tests.bench import blocks, checksums, drives, engines, growth, machine, page, record
from tests.bench.record import Part, Record, Rows
from tests.native.driver import lines

from structured_text.engines.embedded import EmbeddedEngine
from structured_text.engines.engine import EngineError
from structured_text.engines.matiec import MatiecEngine


@dataclass(frozen=True)
class Tools:
    """What is there to measure with."""

    matiec: tuple[MatiecEngine, ...]
    valgrind: bool
    pymodbus: bool

    @classmethod
    def found(cls) -> "Tools":
        """Look for them."""
        said = machine.describe()
        return cls(tuple(lines()), shutil.which("valgrind") is not None, said["pymodbus"] != "none")

    def missing(self, needs: Iterable[str]) -> str:
        """Those of `needs` that are not there, as words; empty if all are."""
        return " and ".join(need for need in needs if not getattr(self, need))


@dataclass(frozen=True)
class Measurement:
    """How a part is measured, and with which tools."""

    needs: tuple[str, ...]
    run: Callable[[Tools], Rows]


def _exchange(tools: Tools) -> Rows:
    """Imported when pymodbus is known to be there."""
    from tests.bench import exchange

    return exchange.measure(tools.matiec)


MEASUREMENTS: dict[str, Measurement] = {
    "crc": Measurement(("matiec",), lambda tools: checksums.measure(tools.matiec)),
    "exchange": Measurement(("matiec", "pymodbus"), _exchange),
    "memory": Measurement(("matiec",), lambda tools: blocks.memory(tools.matiec)),
    "instructions": Measurement(("matiec", "valgrind"), lambda tools: blocks.instructions(tools.matiec)),
    "times": Measurement(("matiec",), lambda tools: blocks.all_times(tools.matiec)),
    "drives": Measurement(("matiec",), lambda tools: drives.measure(tools.matiec)),
    "growth": Measurement((), lambda _: growth.measure()),
    "front end": Measurement((), lambda _: engines.front_end()),
    "engines": Measurement((), lambda tools: engines.measure([EmbeddedEngine(), *tools.matiec])),
}
"""Part of the record -> how it is measured, in the order of the record."""


def main() -> int:
    """Measure, and write the record and the page. Exit status 0, or 1 if anything is wrong."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", default=",".join(MEASUREMENTS), help=f"parts, of {', '.join(MEASUREMENTS)}")
    parser.add_argument("--page", action="store_true", help="only write the page from the record")
    wanted = parser.parse_args()
    names = [] if wanted.page else wanted.only.split(",")
    if unknown := set(names) - set(MEASUREMENTS):
        parser.error(f"there is no part {', '.join(sorted(unknown))}; the parts are {', '.join(MEASUREMENTS)}")
    found, tools = record.read(), Tools.found()
    good = [measured(name, found, tools) for name in MEASUREMENTS if name in names]
    page.write(_in_order(found))
    print(f"{record.DOCS.parent.name}/{record.DOCS.name}/{page.NAME} is written")
    return 0 if all(good) else 1


def _in_order(found: Record) -> Record:
    return {name: found[name] for name in MEASUREMENTS if name in found}


def measured(name: str, found: Record, tools: Tools) -> bool:
    """Measure one part into the record and write that, or say why not; whether nothing is wrong."""
    measurement = MEASUREMENTS[name]
    if missing := tools.missing(measurement.needs):
        print(f"{name}: not measured, there is no {missing}; its figures stay as they were", flush=True)
        return True
    start = time.perf_counter()
    try:
        rows = measurement.run(tools)
    except EngineError as error:
        print(f"{name}: {error}", file=sys.stderr, flush=True)
        return False
    found[name] = Part(machine.describe(), record.rounded(rows))
    record.write(_in_order(found))
    print(f"{name}: {time.perf_counter() - start:.0f} s", flush=True)
    return True


if __name__ == "__main__":
    sys.exit(main())
