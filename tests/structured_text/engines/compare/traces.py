"""What matiec did with the corpus, as a checksum of the full state after each scan, so that all engines can be asked.

`python -m tests.structured_text.engines.compare.traces` records it anew: both lines are run and must agree.
"""

import json
import sys
from itertools import islice
from pathlib import Path
from zlib import crc32

from tests.structured_text.engines.compare.cases import Case, load_cases
from tests.structured_text.engines.compare.lockstep import Run, State, lockstep

from structured_text.engines.discovery import MATIEC_NAMES, survey
from structured_text.engines.engine import Engine, Value

FILE = Path(__file__).with_name("traces.json")
SEED = 1


def checksums(case: Case, engine: Engine) -> list[str]:
    """Of every scan, without copies of in-outs that only matiec keeps, and what the system's library computes."""
    run, but = Run(engine, case), (*case.handed_on, *case.library)
    return [_checksum(run.scan(each), but) for each in islice(case.stimuli(SEED), case.trace)]


def _checksum(state: State, but: tuple[str, ...]) -> str:
    kept = {path: _plain(value) for path, value in state.items() if not (but and path.startswith(but))}
    return f"{crc32(repr(sorted(kept.items())).encode()):08x}"


def _plain(value: Value) -> object:
    """To the bit, but every NaN is like every other."""
    return value.hex() if isinstance(value, float) else value


def read() -> dict[str, list[str]]:
    """What was recorded, by case."""
    return {name: text.split() for name, text in json.loads(FILE.read_text("utf-8")).items()}


def main() -> int:
    """Record; 1 if the lines differ, 2 if one of them is missing."""
    found = [each.engine for each in survey().candidates() if each.name in MATIEC_NAMES and each.engine]
    if len(found) < len(MATIEC_NAMES):
        print("needs both lines of matiec; `driveblocks doctor` says what is missing")
        return 2
    made: dict[str, str] = {}
    for name, case in load_cases().items():
        difference = lockstep(case, [Run(engine, case) for engine in found], case.trace, SEED)
        if difference is not None:
            print(f"not recorded, the lines differ: {difference}")
            return 1
        made[name] = " ".join(checksums(case, found[0]))
    FILE.write_text(json.dumps(made, indent=1) + "\n", encoding="utf-8", newline="\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
