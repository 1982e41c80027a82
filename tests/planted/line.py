"""`python -m tests.planted.line KIND`: exit status 1 if a random line in C of a kind fails; needs matiec."""

import sys
import tempfile
from pathlib import Path

from tests.line.cline import build

if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as folder:
        line = build(Path(folder))
        found = (line.random(0, count, sys.argv[1]).failures for count in (1000, 10_000, 100_000))
        sys.exit(int(any(found)))
