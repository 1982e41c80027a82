"""Record again how matiec runs the corpus.

`python -m tests.structured_text.engines.traces.record`.

Both lines are run and must agree: a block on which they differ is no canonical text, and nothing is recorded for it.
"""

import sys
from collections.abc import Sequence

from tests.structured_text.engines.compare.cases import Case, load_cases
from tests.structured_text.engines.compare.lockstep import Run, lockstep, states
from tests.structured_text.engines.traces.trace import SEED, Trace, path_of, write

from structured_text.engines.discovery import MATIEC_NAMES, survey
from structured_text.engines.engine import Engine


def main() -> int:
    """Record every case; 1 if the lines differ on one, 2 if one of them is missing."""
    candidates = [each for each in survey().candidates() if each.name in MATIEC_NAMES]
    engines = [each.engine for each in candidates if each.engine is not None]
    for each in candidates:
        print(f"{each.name}: {'records' if each.engine else 'does not record'}, {each.note}")
    if len(engines) < len(MATIEC_NAMES):
        return 2
    differences = [text for case in load_cases().values() if (text := _record(case, engines))]
    print("\n".join(differences), end="\n" if differences else "")
    return 1 if differences else 0


def _record(case: Case, engines: Sequence[Engine]) -> str:
    """Record one case; what the lines differ in, if they do."""
    difference = lockstep(case, [Run(engine, case) for engine in engines], case.trace, SEED)
    if difference is not None:
        return f"not recorded, the lines differ: {difference}"
    kept = tuple(states(case, engines[0], case.trace, SEED))
    changed = write(Trace(case.name, SEED, tuple(each.name for each in engines), kept))
    size = path_of(case.name).stat().st_size
    print(f"{case.name}: {len(kept)} scans, {size} bytes, {'written' if changed else 'unchanged'}")
    return ""


if __name__ == "__main__":
    sys.exit(main())
